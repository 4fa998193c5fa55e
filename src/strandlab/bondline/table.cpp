#include "strandlab/bondline/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>

#include "strandlab/core/error.hpp"

namespace strandlab::bondline {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

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

// Digits without what is only there for the eye: blanks, no-break and thin spaces, apostrophes; a typographic minus
// becomes a hyphen.
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

// The text a header or units cell holds between brackets and separators: "_mm", " (mm)", "[mm]", ", in mm" -> "mm".
std::string unit_text(std::string_view rest) {
  constexpr std::string_view kOpen = " _([,/:", kClose = " )]";
  while (!rest.empty() && kOpen.find(rest.front()) != std::string_view::npos) rest.remove_prefix(1);
  while (!rest.empty() && kClose.find(rest.back()) != std::string_view::npos) rest.remove_suffix(1);
  if (rest.size() > 3 && lower(std::string(rest.substr(0, 3))) == "in ") rest.remove_prefix(3);
  return trimmed(rest);
}

// What follows `name` in a header, nothing when the header does not start with that name as a word of its own.
std::optional<std::string> after_name(const std::string& header, const std::string& name) {
  if (lower(header.substr(0, name.size())) != lower(name)) return std::nullopt;
  const std::string rest = header.substr(name.size());
  if (!rest.empty() && std::string_view(" _([,/:").find(rest.front()) == std::string_view::npos) return std::nullopt;
  return rest;
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw InputError(fmt::format("{}: cannot be read", file.string()));
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

// Length of the UTF-8 character that starts a text, 0 where there is none.
std::size_t utf8_length(std::string_view text) {
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

// The text itself where it is UTF-8; else taken as Latin-1, which older spreadsheets write.
std::string as_utf8(std::string_view text) {
  for (std::string_view rest = text; !rest.empty();) {
    const auto length = utf8_length(rest);
    if (length > 0) {
      rest.remove_prefix(length);
      continue;
    }
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
  return std::string(text);
}

// What the marks in a number say about the file it stands in.
enum class Mark { kNone, kPoint, kComma, kThreeDigits };

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
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
  if (group) return Mark::kThreeDigits;  // 9.936 or 9,936: a decimal or a thousand
  return mark == '.' ? Mark::kPoint : Mark::kComma;
}

}  // namespace

Table::Table(const std::filesystem::path& file, std::vector<Quantity> quantities)
    : Table(file_text(file), file.string(), std::move(quantities)) {}

Table::Table(const std::string& text, const std::string& source, std::vector<Quantity> quantities)
    : source_(source), quantities_(std::move(quantities)) {
  std::string_view bytes = text;
  if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF")
    throw InputError(fmt::format("{}: is UTF-16 text; save it as UTF-8", source_));
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  parse(as_utf8(bytes));
}

std::vector<Table::Row> Table::split(const std::string& text, char delimiter) {
  std::vector<Row> rows;
  Row row{1, {}};
  std::string cell;
  bool quoted = false;
  int line = 1;
  const auto end_cell = [&] {
    row.cells.push_back(trimmed(cell));
    cell.clear();
  };
  const auto end_row = [&] {
    end_cell();
    const bool remark = !row.cells.front().empty() && row.cells.front().front() == '#';
    const bool empty = std::all_of(row.cells.begin(), row.cells.end(), [](const auto& c) { return c.empty(); });
    if (!remark && !empty) rows.push_back(std::move(row));
    row = {line + 1, {}};
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += text[++i];
    } else if (c == '"' && (quoted || trimmed(cell).empty())) {
      quoted = !quoted;
    } else if (!quoted && c == delimiter) {
      end_cell();
    } else if (c == '\n' || c == '\r') {
      if (c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') ++i;
      if (quoted) cell += ' ';
      if (!quoted) end_row();
      ++line;
    } else {
      cell += c;
    }
  }
  end_row();
  return rows;
}

std::vector<Table::Found> Table::find_columns(const Row& header) const {
  std::vector<Found> result(quantities_.size());
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto& quantity = quantities_[q];
    for (std::size_t column = 0; column < header.cells.size(); ++column) {
      for (const auto& name : quantity.names) {
        const auto rest = after_name(header.cells[column], name);
        if (!rest) continue;
        const std::string unit = unit_text(*rest);
        const auto factor = unit_factor(quantity.dimension, unit);
        const bool fits = unit.empty() || factor;
        if (!fits) {
          if (quantity.dimension != Dimension::kText) result[q].doubt = header.cells[column];
          continue;
        }
        if (result[q].column == static_cast<int>(column)) continue;
        if (result[q].column >= 0)
          throw InputError(fmt::format("{}:{}: columns '{}' and '{}' both give {}", source_, header.line,
                                       header.cells[result[q].column], header.cells[column], quantity.names[0]));
        result[q].column = static_cast<int>(column);
        result[q].factor = factor;
      }
    }
  }
  return result;
}

int Table::matches(const Row& header) const {
  int count = 0;
  for (const auto& quantity : quantities_) {
    count += std::any_of(header.cells.begin(), header.cells.end(), [&](const std::string& cell) {
      return std::any_of(quantity.names.begin(), quantity.names.end(),
                         [&](const std::string& name) { return after_name(cell, name).has_value(); });
    });
  }
  return count;
}

void Table::parse(const std::string& text) {
  constexpr std::size_t kHeaderWithin = 100;  // rows of remarks that may stand above the header
  std::size_t header = 0;
  int best = -1;
  for (char delimiter : {'\t', ';', ','}) {
    auto rows = split(text, delimiter);
    for (std::size_t i = 0; i < std::min(rows.size(), kHeaderWithin); ++i) {
      const int score = matches(rows[i]);
      if (score <= best) continue;
      best = score;
      header = i;
      delimiter_ = delimiter;
    }
  }
  rows_ = split(text, delimiter_);
  if (rows_.empty()) throw InputError(fmt::format("{}: is empty", source_));
  header_ = rows_[header];
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(header) + 1);
  found_ = find_columns(header_);
  for (std::size_t column = 0; column < header_.cells.size(); ++column) {
    const bool taken =
        std::any_of(found_.begin(), found_.end(), [&](const Found& f) { return f.column == static_cast<int>(column); });
    if (!taken && !header_.cells[column].empty()) others_.push_back(static_cast<int>(column));
  }
  read_units_row();
  check_columns();
  check_cells();
}

void Table::read_units_row() {
  if (rows_.empty()) return;
  const Row& row = rows_.front();
  bool units = false;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    if (quantities_[q].dimension == Dimension::kText || found_[q].column < 0) continue;
    if (found_[q].column >= static_cast<int>(row.cells.size())) continue;
    const std::string& cell = row.cells[found_[q].column];
    if (is_missing_mark(cell)) continue;
    const std::string number = bare_number(cell);
    if (!number.empty() && std::string_view("0123456789-.,").find(number.front()) != std::string_view::npos) return;
    units = true;
  }
  if (!units) return;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    auto& found = found_[q];
    if (quantities_[q].dimension == Dimension::kText || found.column < 0) continue;
    const std::string cell =
        found.column < static_cast<int>(row.cells.size()) ? unit_text(row.cells[found.column]) : "";
    if (is_missing_mark(cell)) continue;
    const auto factor = unit_factor(quantities_[q].dimension, cell);
    if (!factor)
      throw InputError(fmt::format("{}:{}: column '{}': '{}' is neither a number nor a known unit (allowed: {})",
                                   source_, row.line, column_name(found.column), cell,
                                   known_units(quantities_[q].dimension)));
    if (found.factor && *found.factor != *factor)
      throw InputError(fmt::format("{}:{}: column '{}': its header says one unit and the row of units '{}'", source_,
                                   row.line, column_name(found.column), cell));
    found.factor = factor;
  }
  rows_.erase(rows_.begin());
}

void Table::check_columns() const {
  std::string missing;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto& quantity = quantities_[q];
    const std::string written = quantity.unit.empty() ? quantity.names[0] : quantity.names[0] + "_" + quantity.unit;
    if (found_[q].column >= 0) {
      if (quantity.dimension == Dimension::kText || found_[q].factor) continue;
      throw InputError(fmt::format("{}:{}: column '{}' has no unit; write {} or add a row of units (known: {})",
                                   source_, header_.line, column_name(found_[q].column), written,
                                   known_units(quantity.dimension)));
    }
    if (!quantity.required) continue;
    if (!found_[q].doubt.empty())
      throw InputError(fmt::format("{}:{}: column '{}' has no known unit; write {} (known: {})", source_, header_.line,
                                   found_[q].doubt, written, known_units(quantity.dimension)));
    missing += (missing.empty() ? "" : ", ") + written;
  }
  if (missing.empty()) return;
  std::string present;
  for (const auto& cell : header_.cells) present += (present.empty() ? "" : ", ") + cell;
  throw InputError(
      fmt::format("{}:{}: missing column {}; the header has: {}", source_, header_.line, missing, present));
}

void Table::check_cells() {
  const std::size_t columns = header_.cells.size();
  for (auto& row : rows_) {
    for (std::size_t extra = columns; extra < row.cells.size(); ++extra) {
      if (row.cells[extra].empty()) continue;
      throw InputError(
          fmt::format("{}:{}: has {} cells, the header {} (a decimal comma in a comma-separated file must be "
                      "quoted)",
                      source_, row.line, row.cells.size(), columns));
    }
    row.cells.resize(columns);
  }
  decide_decimal_mark();
  for (const auto& row : rows_)
    for (std::size_t q = 0; q < quantities_.size(); ++q)
      if (quantities_[q].dimension != Dimension::kText && found_[q].column >= 0 &&
          !is_missing_mark(row.cells[found_[q].column]))
        parse_number(row, found_[q].column);
}

void Table::decide_decimal_mark() {
  std::string point, comma;  // where a decimal point and a decimal comma stand beyond doubt
  bool three_after_comma = false, three_after_point = false;
  for (const auto& row : rows_) {
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      if (quantities_[q].dimension == Dimension::kText || found_[q].column < 0) continue;
      const std::string& cell = row.cells[found_[q].column];
      const std::string number = bare_number(cell);
      const std::string place =
          fmt::format("line {}, column '{}': '{}'", row.line, column_name(found_[q].column), cell);
      switch (mark_of(number)) {
        case Mark::kPoint:
          if (point.empty()) point = place;
          break;
        case Mark::kComma:
          if (comma.empty()) comma = place;
          break;
        case Mark::kThreeDigits:
          (number.find(',') != std::string::npos ? three_after_comma : three_after_point) = true;
          break;
        case Mark::kNone:
          break;
      }
    }
  }
  if (!point.empty() && !comma.empty())
    throw InputError(fmt::format("{}: decimal commas and decimal points are mixed ({}; {})", source_, comma, point));
  // With nothing but groups of three digits: a comma is decimal in files that do not separate cells by it.
  const bool undecided = point.empty() && comma.empty();
  decimal_comma_ = !comma.empty() || (undecided && three_after_comma && !three_after_point && delimiter_ != ',');
}

double Table::parse_number(const Row& row, int column) const {
  std::string number = bare_number(row.cells[column]);
  const char thousands = decimal_comma_ ? '.' : ',';
  std::erase(number, thousands);
  std::replace(number.begin(), number.end(), ',', '.');
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size())
    throw InputError(fmt::format("{}:{}: column '{}': '{}' is not a number", source_, row.line, column_name(column),
                                 row.cells[column]));
  return value;
}

const Table::Found& Table::found(const std::string& name) const {
  for (std::size_t q = 0; q < quantities_.size(); ++q)
    if (quantities_[q].names[0] == name) return found_[q];
  throw std::invalid_argument("no such quantity: " + name);
}

std::string Table::where(int row) const {
  return fmt::format("{}:{}", source_, rows_[row].line);
}

bool Table::has(const std::string& name) const {
  return found(name).column >= 0;
}

std::optional<double> Table::number(int row, const std::string& name) const {
  const Found& column = found(name);
  if (column.column < 0 || is_missing_mark(rows_[row].cells[column.column])) return std::nullopt;
  return parse_number(rows_[row], column.column) * column.factor.value_or(1);
}

std::string Table::text(int row, const std::string& name) const {
  const Found& column = found(name);
  return column.column < 0 ? "" : rows_[row].cells[column.column];
}

std::vector<std::string> Table::other_columns() const {
  std::vector<std::string> names;
  for (int column : others_) names.push_back(column_name(column));
  return names;
}

}  // namespace strandlab::bondline
