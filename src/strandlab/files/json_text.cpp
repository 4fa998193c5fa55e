#include "strandlab/files/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab::files {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t{2} << 30;  // bytes
constexpr std::size_t kLongestReason = 200;                 // characters of the parser's words

[[noreturn]] void reject(const std::string& where, const std::string& what) {
  throw InputError(fmt::format("{}: {}", where, what));
}

std::string at_byte(const std::string& text, std::size_t byte, const std::string& source) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return fmt::format("{}: line {}", source, 1 + std::count(text.begin(), end, '\n'));
}

// Place of the bracket that opens one level too many; the size of the text where none does.
std::size_t too_deep(const std::string& text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{') && ++depth > kDeepestJson)
      return i;
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
  }
  return text.size();
}

// The parser's message from the point where it says what is wrong; it opens with its own name and the place.
std::string parser_reason(const std::string& message) {
  const auto column = message.find("column ");
  const auto colon = message.find(": ", column == std::string::npos ? 0 : column);
  if (column != std::string::npos && colon != std::string::npos) return message.substr(colon + 2);
  const auto bracket = message.find("] ");
  return bracket == std::string::npos ? message : message.substr(bracket + 2);
}

}  // namespace

Json json_from_text(const std::string& text, const std::string& source, const std::string& what) {
  if (const auto place = too_deep(text); place < text.size()) {
    reject(at_byte(text, place, source),
           fmt::format("not {}: lists and objects within each other more than {} deep", what, kDeepestJson));
  }
  refuse_other_than_utf8(text, source);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto reason = parser_reason(error.what());
    // The number before a comma is whole, and a second one follows where a name belongs.
    const bool comma = reason.find("unexpected number literal; expected string literal") != std::string::npos;
    reject(at_byte(text, error.byte, source),
           fmt::format("not {}: not valid JSON: {}{}", what, shortened(reason, kLongestReason),
                       comma ? " (a decimal comma? numbers have a decimal point, 1.5)" : ""));
  } catch (const Json::exception& error) {
    reject(source,
           fmt::format("not {}: not valid JSON: {}", what, shortened(parser_reason(error.what()), kLongestReason)));
  }
}

Json read_json(const std::filesystem::path& file, const std::string& what) {
  const auto source = file.string();
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) reject(source, fmt::format("is a folder, not {}", what));
  const auto refuse = [&] {
    reject(source, fmt::format("cannot be read as {}: {}", what, std::generic_category().message(errno)));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!stream) refuse();
  std::string text;
  std::vector<char> buffer(std::size_t{1} << 16);
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), stream.get())) {
    text.append(buffer.data(), n);
    if (text.size() > kLargestFile) {
      reject(source, fmt::format("cannot be read as {}: it is larger than {} MB", what, kLargestFile >> 20));
    }
  }
  if (std::ferror(stream.get()) != 0) refuse();
  return json_from_text(text, source, what);
}

}  // namespace strandlab::files
