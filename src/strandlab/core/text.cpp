#include "strandlab/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "strandlab/core/error.hpp"

namespace strandlab {
namespace {

constexpr std::size_t kLengthTakes = 20;  // characters of "... (1000 characters)"

bool is_control(unsigned char c) {
  return c < 0x20 || c == 0x7F;
}

// U+0080 to U+009F, which terminals obey like an escape sequence: in UTF-8 the byte C2 and the code itself.
bool is_two_byte_control(std::string_view character) {
  return character.size() == 2 && character[0] == '\xC2' && static_cast<unsigned char>(character[1]) < 0xA0;
}

// Calls visit(character) for each character of a text, and for each byte that belongs to none with valid = false.
template <class Visit>
void for_each_character(std::string_view text, Visit visit) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    visit(text.substr(0, std::max<std::size_t>(1, length)), length > 0);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
}

std::string byte_as_text(char byte) {
  return fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
}

std::ptrdiff_t line_of(std::string_view bytes, std::size_t at) {
  return 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n');
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  const auto follows = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  const bool whole = std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), follows);
  const auto second = length > 1 ? static_cast<unsigned char>(text[1]) : 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool outside = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return whole && !overlong && !outside ? length : 0;
}

bool is_utf8(std::string_view text) {
  bool valid = true;
  for_each_character(text, [&](std::string_view, bool is_character) { valid = valid && is_character; });
  return valid;
}

std::string as_text(std::string_view bytes) {
  std::string text;
  for_each_character(bytes, [&](std::string_view character, bool valid) {
    text += valid ? std::string(character) : byte_as_text(character.front());
  });
  return text;
}

std::string printable(std::string_view text) {
  std::string line;
  for_each_character(text, [&](std::string_view character, bool valid) {
    if (!valid || is_control(static_cast<unsigned char>(character.front())))
      line += byte_as_text(character.front());
    else if (is_two_byte_control(character))
      line += fmt::format("\\u{:04x}", static_cast<unsigned char>(character[1]));
    else
      line += character;
  });
  return line;
}

std::string shortened(std::string_view text, std::size_t characters) {
  std::size_t count = 0, kept = 0;
  for_each_character(text, [&](std::string_view character, bool) {
    if (count++ < characters) kept += character.size();
  });
  if (count <= characters + kLengthTakes) return std::string(text);
  return fmt::format("{}... ({} characters)", text.substr(0, kept), count);
}

std::string one_line(const std::string& message) {
  constexpr std::size_t kLongest = 4000;  // values in it are shortened where they are quoted
  if (message.size() <= kLongest) return printable(message);
  return printable(message.substr(0, kLongest / 2)) + " ... " +
         printable(message.substr(message.size() - kLongest / 2));
}

void refuse_binary(std::string_view bytes, const std::string& source) {
  const auto mark = bytes.substr(0, 2);
  // Without a mark: the first character, of ASCII in all our files, has a NUL beside it.
  const bool pair = mark.size() == 2 && (mark[0] == '\0') != (mark[1] == '\0');
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF" || pair)
    throw InputError(fmt::format("{}: this file is UTF-16; save it as UTF-8", source));
  if (const auto at = bytes.find('\0'); at != std::string_view::npos)
    throw InputError(fmt::format("{}:{}: a NUL byte; a text file has none", source, line_of(bytes, at)));
}

void refuse_other_than_utf8(std::string_view bytes, const std::string& source) {
  refuse_binary(bytes, source);
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = utf8_length(bytes.substr(at, 4));
    if (length == 0) {
      throw InputError(fmt::format("{}:{}: the byte {} is not UTF-8; save the file as UTF-8", source,
                                   line_of(bytes, at), byte_as_text(bytes[at])));
    }
    at += length;
  }
}

}  // namespace strandlab
