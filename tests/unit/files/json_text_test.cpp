// JSON of files: what anyone may write there ends in a message, not in an exhausted stack.
#include "strandlab/files/json_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab {
namespace {

using test::message_of;

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { files::json_from_text(text, "a.json", "a mat file"); });
}

std::string nested(int depth, const std::string& open, const std::string& close) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += open;
  for (int i = 0; i < depth; ++i) text += close;
  return text;
}

TEST(JsonText, IsReadUpToTheDeepestLevel) {
  EXPECT_EQ(files::json_from_text(nested(files::kDeepestJson, "[", "]"), "a.json", "a mat file").size(), 1U);
  EXPECT_EQ(refusal(nested(files::kDeepestJson + 1, "\n[", "]")),
            "a.json: line 102: not a mat file: lists and objects within each other more than 100 deep");
}

// 60,000 levels ended the program by a signal: what copies and writes JSON calls itself for every level.
TEST(JsonText, ThousandsOfLevelsAreRefused) {
  EXPECT_NE(refusal(nested(60000, "[", "]")).find("more than 100 deep"), std::string::npos);
  EXPECT_NE(refusal(std::string("{\"note\":").append(nested(60000, "{\"a\":[", "]}"))).find("more than 100 deep"),
            std::string::npos);
}

// Brackets in a text are no levels, also after a quotation mark that is part of it.
TEST(JsonText, BracketsInTextsAreText) {
  const std::string brackets(500, '[');
  const auto text = fmt::format("[\"\\\"{}\"]", brackets);
  EXPECT_EQ(files::json_from_text(text, "a.json", "a mat file").at(0), fmt::format("\"{}", brackets));
}

TEST(JsonText, FaultsNameTheirLine) {
  EXPECT_NE(refusal("[1,\n2,\n}").find("a.json: line 3: not a mat file: not valid JSON: "), std::string::npos);
}

TEST(JsonText, FilesThatCannotBeRead) {
  const test::TemporaryFolder folder;
  const auto message = [&](const char* name) {
    return message_of<InputError>([&] { files::read_json(folder / name, "a mat file"); });
  };
  EXPECT_NE(message("").find("is a folder, not a mat file"), std::string::npos);
  EXPECT_NE(message("none.json").find("none.json: cannot be read as a mat file: No such file"), std::string::npos);
}

}  // namespace
}  // namespace strandlab
