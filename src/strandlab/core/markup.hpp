// Text inside HTML, SVG and XML.
#pragma once

#include <string>
#include <string_view>

namespace strandlab {

// Text as markup, for elements and for attributes in double quotes: whatever it says, it stays text.
std::string escaped_markup(std::string_view text);

}  // namespace strandlab
