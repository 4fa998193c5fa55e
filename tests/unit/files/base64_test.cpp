// The encoding of RFC 4648.
#include "strandlab/files/base64.hpp"

#include <gtest/gtest.h>

namespace strandlab::files {
namespace {

// RFC 4648, section 10.
TEST(Base64, HasTheTestVectorsOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

// Digits 62 and 63, and bytes that are negative as characters: 0xfb 0xff 0xfe is 111110 111111 111111 111110.
TEST(Base64, TakesBytesAsNumbersFrom0To255) {
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

}  // namespace
}  // namespace strandlab::files
