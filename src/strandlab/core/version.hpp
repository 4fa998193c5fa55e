#pragma once

namespace strandlab {
const char* version();  // "major.minor.patch" of this build
}  // namespace strandlab
