#include "strandlab/table/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "strandlab/core/text.hpp"

namespace strandlab::table {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

constexpr std::string_view kSeparators = " _([,/:;)]-\t";

// A text without the separators at its ends.
std::string words(const std::string& text) {
  const auto first = text.find_first_not_of(kSeparators);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kSeparators) + 1 - first);
}

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::string trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_missing_mark(const std::string& cell) {
  static constexpr std::array kMarks{"", "-", "--", "na", "n/a", "#n/a", "nan", "null", "?"};
  return std::any_of(kMarks.begin(), kMarks.end(), [&](const char* mark) { return lower(cell) == mark; });
}

std::string bare_number(const std::string& cell) {
  std::string text;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const auto starts = [&](std::string_view what) {
      return std::string_view(cell).substr(i).substr(0, what.size()) == what;
    };
    if (is_blank(cell[i]) || cell[i] == '\'') continue;
    if (starts("\xC2\xA0")) {
      i += 1;
    } else if (starts("\xE2\x80\xAF") || starts("\xE2\x80\x89") || starts("\xE2\x80\x99")) {
      i += 2;
    } else if (starts("\xE2\x88\x92")) {
      text += '-';
      i += 2;
    } else {
      text += cell[i];
    }
  }
  if (!text.empty() && text.front() == '+') text.erase(0, 1);
  return text;
}

bool looks_like_number(const std::string& cell) {
  const std::string number = bare_number(cell);
  return !number.empty() && std::string_view("0123456789-.,").find(number.front()) != std::string_view::npos;
}

bool is_number(const std::string& cell) {
  return looks_like_number(cell) && bare_number(cell).find_first_not_of("0123456789-+.,eE") == std::string::npos;
}

std::string unit_text(std::string_view rest) {
  constexpr std::string_view kOpen = " _([,/:", kClose = " )]";
  while (!rest.empty() && kOpen.find(rest.front()) != std::string_view::npos) rest.remove_prefix(1);
  while (!rest.empty() && kClose.find(rest.back()) != std::string_view::npos) rest.remove_suffix(1);
  if (rest.size() > 3 && lower(std::string(rest.substr(0, 3))) == "in ") rest.remove_prefix(3);
  return trimmed(rest);
}

std::optional<std::string> after_name(const std::string& header, const std::string& name) {
  if (lower(header.substr(0, name.size())) != lower(name)) return std::nullopt;
  const std::string rest = header.substr(name.size());
  if (!rest.empty() && std::string_view(" _([,/:").find(rest.front()) == std::string_view::npos) return std::nullopt;
  return rest;
}

std::optional<std::string> around_name(const std::string& header, const std::string& name) {
  const auto is_word = [&header](std::size_t from, std::size_t past) {
    return (from == 0 || kSeparators.find(header[from - 1]) != std::string_view::npos) &&
           (past == header.size() || kSeparators.find(header[past]) != std::string_view::npos);
  };
  const std::string text = lower(header), word = lower(name);
  if (word.size() < 2) return std::nullopt;  // D and x name a column only where they open its header
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (is_word(at, at + word.size())) return header.substr(0, at) + " " + header.substr(at + word.size());
  }
  return std::nullopt;
}

UnitAndLabel unit_and_label(Dimension dimension, const std::string& rest) {
  const auto is_edge = [&rest](std::size_t at) {
    return at == 0 || at == rest.size() || kSeparators.find(rest[at - 1]) != std::string_view::npos ||
           kSeparators.find(rest[at]) != std::string_view::npos;
  };
  for (std::size_t length = rest.size(); length > 0; --length) {
    for (std::size_t past = rest.size(); past >= length; --past) {  // a unit stands last: "distance in board (mm)"
      const std::size_t from = past - length;
      const std::string part = rest.substr(from, length);
      if (!is_edge(from) || !is_edge(from + length) || !unit_factor(dimension, part)) continue;
      const std::string before = words(rest.substr(0, from)), after = words(rest.substr(past));
      return {part, before.empty() || after.empty() ? before + after : fmt::format("{} {}", before, after)};
    }
  }
  return {"", words(rest)};
}

std::string as_utf8(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  std::string converted;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      converted += c;
    } else {
      converted += static_cast<char>(0xC0U | (byte >> 6U));
      converted += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return converted;
}

Mark mark_of(const std::string& number) {
  const auto points = std::count(number.begin(), number.end(), '.');
  const auto commas = std::count(number.begin(), number.end(), ',');
  if (points == 0 && commas == 0) return Mark::kNone;
  if (points > 0 && commas > 0) return number.rfind('.') > number.rfind(',') ? Mark::kPoint : Mark::kComma;
  const char mark = points > 0 ? '.' : ',';
  if (points + commas > 1)
    return mark == '.' ? Mark::kComma : Mark::kPoint;  // 1.234.567: the other is the decimal mark
  const std::string_view text = number;
  const auto at = text.find(mark);
  std::string_view before = text.substr(0, at);
  if (!before.empty() && before.front() == '-') before.remove_prefix(1);
  const bool group = text.size() - at == 4 && all_digits(text.substr(at + 1)) && all_digits(before) &&
                     before.size() < 4 && before.front() != '0';
  if (group) return Mark::kThreeDigits;
  return mark == '.' ? Mark::kPoint : Mark::kComma;
}

}  // namespace strandlab::table
