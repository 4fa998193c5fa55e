#include "strandlab/table/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/table/cells.hpp"

namespace strandlab::table {
namespace {

constexpr int kOpens = 2, kHolds = 1;

// Does a header open with one of the quantity's names (kOpens), hold one further in (kHolds), or neither (0)?
int names(const std::string& header, const Quantity& quantity) {
  const auto any = [&](auto rest_of) {
    return std::any_of(quantity.names.begin(), quantity.names.end(),
                       [&](const std::string& name) { return rest_of(header, name).has_value(); });
  };
  if (any(after_name)) return kOpens;
  return quantity.several && any(around_name) ? kHolds : 0;
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw InputError(fmt::format("{}: cannot be read", file.string()));
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

}  // namespace

Table::Table(const std::filesystem::path& file, std::vector<Quantity> quantities)
    : Table(file_text(file), file.string(), std::move(quantities)) {}

Table::Table(const std::string& text, const std::string& source, std::vector<Quantity> quantities)
    : source_(source), quantities_(std::move(quantities)) {
  std::string_view bytes = text;
  refuse_binary(bytes, source_);
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  parse(as_utf8(bytes));
}

// A quote opens a cell where nothing stands before it, and is text elsewhere (an inch mark) and in lines that begin
// with #.
std::vector<Table::Row> Table::split(const std::string& text, char delimiter) {
  std::vector<Row> rows;
  Row row{1, {}};
  std::string cell;
  bool quoted = false, was_quoted = false;
  Quote quote;
  int line = 1;
  const auto end_quote = [&](int closed, bool text_follows) {
    quote.closed = closed;
    quote.text_follows = text_follows;
    if (text_follows || closed != quote.opened) row.quotes.push_back(quote);
  };
  const auto end_cell = [&] {
    if (was_quoted) end_quote(line, false);
    row.cells.push_back(trimmed(cell));
    cell.clear();
    was_quoted = false;
  };
  const auto end_row = [&] {
    end_cell();
    const bool remark = !row.cells.front().empty() && row.cells.front().front() == '#';
    const bool empty =
        row.quotes.empty() && std::all_of(row.cells.begin(), row.cells.end(), [](const auto& c) { return c.empty(); });
    if (!remark && !empty) rows.push_back(std::move(row));
    row = {line + 1, {}};
  };
  const auto in_remark = [&] {
    const std::string first = row.cells.empty() ? trimmed(cell) : row.cells.front();
    return !first.empty() && first.front() == '#';
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += text[++i];
    } else if (quoted && c == '"') {
      quoted = false;
      was_quoted = true;
    } else if (c == '"' && !was_quoted && trimmed(cell).empty() && !in_remark()) {
      quoted = true;
      quote = {line};
    } else if (!quoted && c == delimiter) {
      end_cell();
    } else if (c == '\n' || c == '\r') {
      if (c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') ++i;
      if (quoted) cell += ' ';
      if (!quoted) end_row();
      ++line;
    } else {
      if (was_quoted && c != ' ' && c != '\t') {
        end_quote(line, true);
        was_quoted = false;
      }
      if (c == delimiter) ++quote.delimiters;
      cell += c;
    }
  }
  if (quoted) end_quote(0, false);
  end_row();
  return rows;
}

// A quote that was forgotten takes the rows that follow into its cell: to the end of the file, or to the next quote,
// behind which text follows that would have stood in it; or the cell holds as many delimiters as a whole row, which a
// remark over several lines does not (in a table of up to three columns it may).
void Table::refuse_unclosed(const std::vector<Row>& rows) const {
  const int columns = static_cast<int>(header_.cells.size());
  for (const auto& row : rows) {
    for (const auto& quote : row.quotes) {
      const bool whole_row = columns > 3 && quote.delimiters >= columns - 1;
      if (quote.closed == quote.opened || (quote.closed > 0 && !quote.text_follows && !whole_row)) continue;
      throw InputError(fmt::format(
          "{}:{}: a cell opens with a quote (\") that is not closed {}; write a quote that is "
          "meant as text twice, in a quoted cell",
          source_, quote.opened,
          quote.closed > 0 ? fmt::format("before line {}", quote.closed) : std::string("to the end of the file")));
    }
  }
}

// On one line, and not in remarks: a word in quotes may open one.
void Table::refuse_misplaced_quotes(const Row& row) const {
  for (const auto& quote : row.quotes) {
    if (!quote.text_follows) continue;
    throw InputError(
        fmt::format("{}:{}: text follows the closing quote (\") of a cell; write a quote that is meant as "
                    "text twice, in a quoted cell",
                    source_, quote.opened));
  }
}

// Takes a column whose header holds `rest` beside a name of the quantity.
void Table::add_column(const Quantity& quantity, const Row& header, int column, const std::string& rest,
                       Found& found) const {
  const std::string& cell = header.cells[column];
  const auto [unit, label] =
      quantity.several ? unit_and_label(quantity.dimension, rest) : UnitAndLabel{unit_text(rest), ""};
  const auto factor = unit_factor(quantity.dimension, unit);
  if (!unit.empty() && !factor) {
    if (quantity.dimension != Dimension::kText) found.doubt = cell;
    return;
  }
  if (!found.columns.empty() && found.columns.back().number == column) return;
  if (!found.columns.empty() && !quantity.several)
    throw InputError(fmt::format("{}:{}: columns '{}' and '{}' both give {}", source_, header.line,
                                 shortened(header.cells[found.columns[0].number]), shortened(cell), quantity.names[0]));
  found.columns.push_back({column, factor, label});
}

// The columns whose header opens with a name of the quantity. Of one that may have several columns: those with the
// first of its names that occurs; where none opens a header, those that hold one further in and open with no other
// quantity's.
Table::Found Table::find_named(const Quantity& quantity, const Row& header) const {
  const int width = static_cast<int>(header.cells.size());
  Found found;
  const auto search = [&](const std::string& name, auto rest_of) {
    for (int column = 0; column < width; ++column) {
      if (const auto rest = rest_of(header.cells[column], name)) add_column(quantity, header, column, *rest, found);
    }
    return quantity.several && !found.columns.empty();
  };
  const auto further_in = [&](const std::string& cell, const std::string& name) {
    const bool taken = std::any_of(quantities_.begin(), quantities_.end(),
                                   [&](const Quantity& other) { return names(cell, other) == kOpens; });
    return taken ? std::nullopt : around_name(cell, name);
  };
  for (const auto& name : quantity.names) {
    if (search(name, after_name)) return found;
  }
  for (const auto& name : quantity.names) {
    if (quantity.several && search(name, further_in)) return found;
  }
  return found;
}

std::vector<Table::Found> Table::find_columns(const Row& header) const {
  std::vector<Found> result(quantities_.size());
  const int width = static_cast<int>(header.cells.size());
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto& quantity = quantities_[q];
    for (const int number : quantity.columns) {
      if (number < 1 || number > width)
        throw InputError(fmt::format("{}:{}: no column {} for {}; there are {} columns", source_, header.line, number,
                                     quantity.names[0], width));
      const auto [unit, label] = unit_and_label(quantity.dimension, header.cells[number - 1]);
      result[q].columns.push_back({number - 1, unit_factor(quantity.dimension, unit), label});
    }
    if (!quantity.columns.empty()) continue;
    result[q] = find_named(quantity, header);
  }
  return result;
}

// First, that the row names what is required; then, that numbers follow below; then the other quantities; then, that
// the delimiter makes cells of it.
Table::Score Table::score(const std::vector<Row>& rows, std::size_t row) const {
  const auto& cells = rows[row].cells;
  int required = 0, optional = 0;
  std::vector<std::size_t> numbers;
  for (const auto& quantity : quantities_) {
    int best = 0;
    std::size_t where = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const int named = names(cells[k], quantity);
      if (named <= best) continue;
      best = named;
      where = k;
    }
    (quantity.required ? required : optional) += best;
    if (best > 0 && quantity.required && quantity.dimension != Dimension::kText) numbers.push_back(where);
  }
  const auto holds_numbers = [&](std::size_t at) {
    return at < rows.size() && std::all_of(numbers.begin(), numbers.end(), [&](std::size_t k) {
             return k < rows[at].cells.size() && is_number(rows[at].cells[k]);
           });
  };
  const bool followed = !numbers.empty() && (holds_numbers(row + 1) || holds_numbers(row + 2));  // a row of units
  return {required, followed ? 1 : 0, optional, static_cast<int>(cells.size())};
}

constexpr std::array kDelimiters{'\t', ';', ','};
constexpr std::size_t kHeaderWithin = 100;  // rows of remarks that may stand above the header

// The row that most speaks for, with the delimiter with which it does.
std::size_t Table::find_header(const std::string& text) {
  std::size_t header = 0;
  Score best{-1, 0, 0, 0};
  for (const char delimiter : kDelimiters) {
    const auto rows = split(text, delimiter);
    for (std::size_t i = 0; i < std::min(rows.size(), kHeaderWithin); ++i) {
      const auto found = score(rows, i);
      if (found <= best) continue;
      best = found;
      header = i;
      delimiter_ = delimiter;
    }
  }
  return header;
}

bool Table::numbers_at_columns(const Row& row) const {
  for (const auto& quantity : quantities_) {
    if (quantity.dimension == Dimension::kText) continue;
    for (const int number : quantity.columns) {
      if (number < 1 || number > static_cast<int>(row.cells.size()) || !looks_like_number(row.cells[number - 1]))
        return false;
    }
  }
  return true;
}

// Where columns are given by number: the row above the first that has numbers there, with the delimiter that gives most
// such rows. A table without a header gets an empty one.
std::size_t Table::find_header_by_columns(const std::string& text) {
  std::ptrdiff_t most = 0;
  for (const char delimiter : kDelimiters) {
    const auto rows = split(text, delimiter);
    const auto count = std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return numbers_at_columns(row); });
    if (count <= most) continue;
    most = count;
    delimiter_ = delimiter;
  }
  if (most == 0) return find_header(text);
  rows_ = split(text, delimiter_);
  std::size_t width = 0, first = 0;
  while (!numbers_at_columns(rows_[first])) ++first;
  for (auto i = first; i < rows_.size(); ++i) width = std::max(width, rows_[i].cells.size());
  if (first == 0) {
    rows_.insert(rows_.begin(), Row{rows_.front().line, {}});
    first = 1;
  }
  rows_[first - 1].cells.resize(std::max(width, rows_[first - 1].cells.size()));
  return first - 1;
}

void Table::parse(const std::string& text) {
  const bool by_number = std::all_of(quantities_.begin(), quantities_.end(),
                                     [](const Quantity& q) { return !q.required || !q.columns.empty(); });
  const std::size_t header = by_number ? find_header_by_columns(text) : find_header(text);
  if (rows_.empty()) rows_ = split(text, delimiter_);
  if (rows_.empty()) throw InputError(fmt::format("{}: is empty", source_));
  header_ = rows_[header];
  refuse_unclosed(rows_);
  remarks_.assign(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(header));
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(header) + 1);
  found_ = find_columns(header_);
  for (int column = 0; column < static_cast<int>(header_.cells.size()); ++column) {
    const bool taken = std::any_of(found_.begin(), found_.end(), [&](const Found& f) {
      return std::any_of(f.columns.begin(), f.columns.end(), [&](const Column& c) { return c.number == column; });
    });
    if (!taken && !header_.cells[column].empty()) others_.push_back(column);
  }
  begin_sections(read_units_row());
  take_stated_units();
  check_columns();
  check_cells();
}

// Every column that holds numbers: visit(index of its quantity, column).
template <class Visit>
void Table::for_each_number_column(Visit visit) const {
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    if (quantities_[q].dimension == Dimension::kText) continue;
    for (std::size_t k = 0; k < found_[q].columns.size(); ++k) visit(q, k);
  }
}

// Takes the row of units, if there is one, out of the rows.
std::optional<Table::Row> Table::read_units_row() {
  if (rows_.empty()) return std::nullopt;
  const Row& row = rows_.front();
  const auto cell_of = [&row](const Column& column) {
    return column.number < static_cast<int>(row.cells.size()) ? row.cells[column.number] : std::string();
  };
  bool units = false, numbers = false;
  for_each_number_column([&](std::size_t q, std::size_t k) {
    const std::string cell = cell_of(found_[q].columns[k]);
    if (is_missing_mark(cell)) return;
    (looks_like_number(cell) ? numbers : units) = true;
  });
  if (!units || numbers) return std::nullopt;
  for_each_number_column([&](std::size_t q, std::size_t k) {
    auto& column = found_[q].columns[k];
    const std::string cell = unit_text(cell_of(column));
    if (is_missing_mark(cell)) return;
    const auto factor = unit_factor(quantities_[q].dimension, cell);
    if (!factor)
      throw InputError(fmt::format("{}:{}: column '{}': '{}' is neither a number nor a known unit (allowed: {})",
                                   source_, row.line, shown_name(column.number), shortened(cell),
                                   known_units(quantities_[q].dimension)));
    if (column.factor && *column.factor != *factor)
      throw InputError(fmt::format("{}:{}: column '{}': its header says one unit and the row of units '{}'", source_,
                                   row.line, shown_name(column.number), shortened(cell)));
    column.factor = factor;
  });
  Row taken = row;
  rows_.erase(rows_.begin());
  return taken;
}

// Has text where the first of the quantities has its numbers.
bool Table::is_remark(const Row& row) const {
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    if (!quantities_[q].several || quantities_[q].dimension == Dimension::kText) continue;
    return std::all_of(found_[q].columns.begin(), found_[q].columns.end(), [&](const Column& column) {
      return column.number < static_cast<int>(row.cells.size()) && !is_number(row.cells[column.number]);
    });
  }
  return false;
}

// Exports of one specimen after the other repeat the header above each, perhaps with remarks before and units after it.
void Table::begin_sections(const std::optional<Row>& units) {
  const auto same = [](const Row& row, const Row& other) {
    const auto longest = std::max(row.cells.size(), other.cells.size());
    for (std::size_t k = 0; k < longest; ++k) {
      const bool one = k < row.cells.size() && !row.cells[k].empty(),
                 two = k < other.cells.size() && !other.cells[k].empty();
      if (one != two || (one && row.cells[k] != other.cells[k])) return false;
    }
    return true;
  };
  std::vector<Row> kept;
  int section = 0;
  bool after_header = false;
  for (auto& row : rows_) {
    if (same(row, header_)) {
      while (!kept.empty() && kept.back().section == section && is_remark(kept.back())) kept.pop_back();
      ++section;
      after_header = true;
      continue;
    }
    const bool repeats_units = after_header && units && same(row, *units);
    after_header = false;
    if (repeats_units) continue;
    row.section = section;
    kept.push_back(std::move(row));
  }
  rows_ = std::move(kept);
}

// The unit that remarks above the header state for all columns of a kind: "Units: inches, lb/ft3". None where they
// differ.
std::optional<double> Table::unit_in_remarks(Dimension dimension) const {
  std::optional<double> unit;
  for (const auto& row : remarks_) {
    const bool states = std::any_of(row.cells.begin(), row.cells.end(), [](const std::string& cell) {
      return lower(cell).find("unit") != std::string::npos;
    });
    if (!states) continue;
    for (std::string cell : row.cells) {
      if (lower(cell).rfind("units in ", 0) == 0) cell.erase(0, 9);  // no inches
      const auto factor = unit_factor(dimension, unit_and_label(dimension, cell).unit);
      if (!factor) continue;
      if (unit && *unit != *factor) return std::nullopt;
      unit = factor;
    }
  }
  return unit;
}

void Table::take_stated_units() {
  for_each_number_column([&](std::size_t q, std::size_t k) {
    const auto& quantity = quantities_[q];
    auto& column = found_[q].columns[k];
    if (quantity.stated_unit.empty() && quantity.several && !column.factor)
      column.factor = unit_in_remarks(quantity.dimension);
    if (quantity.stated_unit.empty()) return;
    const auto factor = unit_factor(quantity.dimension, quantity.stated_unit);
    if (!factor)
      throw InputError(fmt::format("unit '{}' of {} is not known (known: {})", quantity.stated_unit, quantity.names[0],
                                   known_units(quantity.dimension)));
    if (column.factor && *column.factor != *factor)
      throw InputError(fmt::format("{}:{}: column '{}' states its unit, and it is not {}", source_, header_.line,
                                   shown_name(column.number), quantity.stated_unit));
    column.factor = factor;
  });
}

void Table::check_columns(const Quantity& quantity, const Found& found, const std::string& written) const {
  if (quantity.dimension == Dimension::kText) return;
  for (const auto& column : found.columns) {
    if (column.factor) continue;
    const auto option = quantity.option.empty() ? "" : fmt::format(", or state it by {}-unit", quantity.option);
    throw InputError(fmt::format("{}:{}: column '{}' has no unit; write {} or add a row of units{} (known: {})",
                                 source_, header_.line, shown_name(column.number), written, option,
                                 known_units(quantity.dimension)));
  }
}

void Table::check_columns() const {
  std::string missing, options;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto& quantity = quantities_[q];
    const std::string written = quantity.unit.empty() ? quantity.names[0] : quantity.names[0] + "_" + quantity.unit;
    check_columns(quantity, found_[q], written);
    if (!found_[q].columns.empty() || !quantity.required) continue;
    if (!found_[q].doubt.empty())
      throw InputError(fmt::format("{}:{}: column '{}' has no known unit; write {} (known: {})", source_, header_.line,
                                   shortened(found_[q].doubt), written, known_units(quantity.dimension)));
    missing += (missing.empty() ? "" : ", ") + written;
    if (!quantity.option.empty())
      options += (options.empty() ? "; or say which it is by " : ", ") + quantity.option + "-column";
  }
  if (missing.empty()) return;
  std::string present;
  for (const auto& cell : header_.cells) present += (present.empty() ? "" : ", ") + shortened(cell);
  throw InputError(
      fmt::format("{}:{}: missing column {}; the header has: {}{}", source_, header_.line, missing, present, options));
}

void Table::check_cells() {
  const std::size_t columns = header_.cells.size();
  refuse_misplaced_quotes(header_);
  for (auto& row : rows_) {
    refuse_misplaced_quotes(row);
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
  for (const auto& row : rows_) {
    for_each_number_column([&](std::size_t q, std::size_t k) {
      const int column = found_[q].columns[k].number;
      if (!is_missing_mark(row.cells[column])) parse_number(row, column);
    });
  }
}

void Table::decide_decimal_mark() {
  std::string point, comma;  // where a decimal point and a decimal comma stand beyond doubt
  bool three_after_comma = false, three_after_point = false;
  for (const auto& row : rows_) {
    for_each_number_column([&](std::size_t q, std::size_t k) {
      const int column = found_[q].columns[k].number;
      const std::string& cell = row.cells[column];
      const std::string number = bare_number(cell);
      const std::string place =
          fmt::format("line {}, column '{}': '{}'", row.line, shown_name(column), shortened(cell));
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
    });
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
    throw InputError(fmt::format("{}:{}: column '{}': '{}' is not a number", source_, row.line, shown_name(column),
                                 shortened(row.cells[column])));
  return value;
}

const Table::Found& Table::found(const std::string& name) const {
  for (std::size_t q = 0; q < quantities_.size(); ++q)
    if (quantities_[q].names[0] == name) return found_[q];
  throw std::invalid_argument("no such quantity: " + name);
}

std::string Table::column_name(int column) const {
  return header_.cells[column].empty() ? std::to_string(column + 1) : header_.cells[column];
}

std::string Table::shown_name(int column) const {
  return shortened(column_name(column));
}

std::string Table::where(int row) const {
  return fmt::format("{}:{}", source_, rows_[row].line);
}

int Table::count(const std::string& name) const {
  return static_cast<int>(found(name).columns.size());
}

std::string Table::label(const std::string& name, int which) const {
  return found(name).columns[which].label;
}

std::optional<double> Table::number(int row, const std::string& name, int which) const {
  const auto& columns = found(name).columns;
  if (which >= static_cast<int>(columns.size()) || is_missing_mark(rows_[row].cells[columns[which].number]))
    return std::nullopt;
  return parse_number(rows_[row], columns[which].number) * columns[which].factor.value_or(1);
}

std::string Table::text(int row, const std::string& name) const {
  const auto& columns = found(name).columns;
  return columns.empty() ? "" : rows_[row].cells[columns[0].number];
}

std::vector<std::string> Table::other_columns() const {
  std::vector<std::string> names;
  for (int column : others_) names.push_back(column_name(column));
  return names;
}

}  // namespace strandlab::table
