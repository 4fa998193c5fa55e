// Bytes that users bring, as messages and results show them.
#include "strandlab/core/text.hpp"

#include <gtest/gtest.h>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab {
namespace {

using test::message_of;
using namespace std::string_literals;

// Characters at both ends of each length, and what RFC 3629 excludes: overlong forms, surrogates, beyond U+10FFFF.
TEST(Text, TellsUtf8FromOtherBytes) {
  for (const auto* text : {"", "a", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                           "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_TRUE(is_utf8(text)) << printable(text);
  for (const auto* text : {"\x80", "\xC1\xBF", "\xC3", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
                           "\xF4\x90\x80\x80", "\xFF", "a\xFC"})
    EXPECT_FALSE(is_utf8(text)) << printable(text);
}

TEST(Text, BytesThatAreNoCharacterAreWrittenOut) {
  EXPECT_EQ(as_text("f\xFCr.toml"), "f\\xfcr.toml");
  EXPECT_EQ(as_text("f\xC3\xBCr\n.toml"), "f\xC3\xBCr\n.toml");
}

TEST(Text, NoTerminalObeysWhatIsPrintable) {
  EXPECT_EQ(printable("a\x1B[31m\n\x7F\xFC"), "a\\x1b[31m\\x0a\\x7f\\xfc");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u009b31m");
  EXPECT_EQ(printable("Gr\xC3\xB6\xC3\x9F"
                      "e \xE2\x88\x92"),
            "Gr\xC3\xB6\xC3\x9F"
            "e \xE2\x88\x92");
}

TEST(Text, LongValuesAreShownByTheirBeginningAndLength) {
  EXPECT_EQ(shortened(std::string(80, 'x')), std::string(80, 'x'));
  EXPECT_EQ(shortened(std::string(1000000, 'x')), std::string(60, 'x') + "... (1000000 characters)");
  std::string umlauts;  // characters are counted, and none is cut in two
  for (int i = 0; i < 100; ++i) umlauts += "\xC3\xBC";
  EXPECT_EQ(shortened(umlauts, 3), "\xC3\xBC\xC3\xBC\xC3\xBC... (100 characters)");
}

TEST(Text, FilesThatAreNotUtf8AreRefusedWithTheirLine) {
  const auto refusal = [](const std::string& bytes) {
    return message_of<InputError>([&] { refuse_other_than_utf8(bytes, "a.toml"); });
  };
  for (const auto& bytes : {"\xFF\xFE[\0"s, "\xFE\xFF\0["s, "[\0m\0"s, "\0[\0m"s})
    EXPECT_EQ(refusal(bytes), "a.toml: this file is UTF-16; save it as UTF-8");
  EXPECT_EQ(refusal("a\nb\0c"s), "a.toml:2: a NUL byte; a text file has none");
  EXPECT_EQ(refusal("a\nb\nc\xFC"), "a.toml:3: the byte \\xfc is not UTF-8; save the file as UTF-8");
  EXPECT_NO_THROW(
      refuse_other_than_utf8("\xEF\xBB\xBF# Gr\xC3\xB6\xC3\x9F"
                             "e\r\n",
                             "a.toml"));
  EXPECT_NO_THROW(
      refuse_binary("Gr\xF6\xDF"
                    "e",
                    "a.csv"));
}

}  // namespace
}  // namespace strandlab
