#include "strandlab/core/markup.hpp"

#include <gtest/gtest.h>

namespace strandlab {
namespace {

TEST(EscapedMarkup, KeepsWhateverItSaysText) {
  EXPECT_EQ(escaped_markup("a<b & \"c\" > d"), "a&lt;b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(escaped_markup("&amp;"), "&amp;amp;");
  EXPECT_EQ(escaped_markup("20 °C"), "20 °C");
}

}  // namespace
}  // namespace strandlab
