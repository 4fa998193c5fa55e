// Tables as testing machines and spreadsheets write them: comma, semicolon or tab between cells, decimal point or
// comma, quoted cells, a row of units, a byte-order mark, UTF-8 or Latin-1, any line ending, lines of remarks above the
// header.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/table/units.hpp"

namespace strandlab::table {

// A column to look for. Its unit stands in the header ("t1_mm", "t1 (in)", "t1 [mm]") or in a row of units below it.
struct Quantity {
  std::vector<std::string> names;  // the first is its name in messages; case makes no difference
  Dimension dimension = Dimension::kText;
  std::string unit;  // our unit, for messages
  bool required = true;
  // Tables of instruments without a fixed form:
  bool several = false;        // any number of columns, told apart by labels; the header may hold further words, also
                               // before the name; where columns have several of the names, the first name counts
  std::vector<int> columns{};  // where they stand, 1 the first, in place of a search by name
  std::string stated_unit{};   // unit of columns that state none; a table that states another one is refused
  std::string option{};        // "--density": the user's options for these are --density-column and --density-unit
};

class Table {
 public:
  // Reads a file; `quantities` are the columns to find. Throws InputError (file, line, column, what was given, what is
  // allowed) for a file that cannot be read, a required column that is missing, appears twice (unless `several`) or has
  // no known unit, a row with too many cells, text where a number belongs, decimal commas mixed with decimal points, a
  // quote that is not closed or that closes before more text, UTF-16 and NUL bytes.
  Table(const std::filesystem::path& file, std::vector<Quantity> quantities);
  // The same for a text in memory; `source` opens the messages.
  Table(const std::string& text, const std::string& source, std::vector<Quantity> quantities);

  int rows() const { return static_cast<int>(rows_.size()); }
  int line(int row) const { return rows_[row].line; }  // 1-based line in the file
  std::string where(int row) const;                    // "file.csv:12"
  // Tables below each other under the same header, remarks between them: 0 the first, 1 from its repetition on...
  int section(int row) const { return rows_[row].section; }
  bool has(const std::string& name) const { return count(name) > 0; }
  int count(const std::string& name) const;  // columns of that quantity
  // What the header of such a column says besides name and unit: "3" of "Density 3 (kg/m3)".
  std::string label(const std::string& name, int which) const;
  // Number in our unit; nothing for an empty cell or a mark of a missing value (-, NA, nan).
  std::optional<double> number(int row, const std::string& name, int which = 0) const;
  // Text of a cell, blanks trimmed; empty where there is no such column.
  std::string text(int row, const std::string& name) const;

  // Columns that are none of the quantities, in order, and their cells.
  std::vector<std::string> other_columns() const;
  std::string other(int row, int index) const { return rows_[row].cells[others_[index]]; }

 private:
  // A quoted cell over several lines, or one with more text behind its closing quote.
  struct Quote {
    int opened = 0, closed = 0;  // lines; closed 0: never
    bool text_follows = false;
    int delimiters = 0;  // in it
  };
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
    int section = 0;
    std::vector<Quote> quotes = {};
  };
  struct Column {
    int number = 0;                // 0 the first
    std::optional<double> factor;  // our unit per unit of the column
    std::string label;
  };
  struct Found {
    std::vector<Column> columns;
    std::string doubt;  // header that starts like this quantity but has an unknown unit
  };
  void parse(const std::string& text);
  static std::vector<Row> split(const std::string& text, char delimiter);
  // How much speaks for a row to be the header, the first reason first.
  using Score = std::array<int, 4>;
  Score score(const std::vector<Row>& rows, std::size_t row) const;
  bool numbers_at_columns(const Row& row) const;
  std::size_t find_header(const std::string& text);
  std::size_t find_header_by_columns(const std::string& text);
  std::vector<Found> find_columns(const Row& header) const;
  void add_column(const Quantity& quantity, const Row& header, int column, const std::string& rest, Found& found) const;
  Found find_named(const Quantity& quantity, const Row& header) const;
  std::optional<Row> read_units_row();
  void begin_sections(const std::optional<Row>& units);
  bool is_remark(const Row& row) const;
  std::optional<double> unit_in_remarks(Dimension dimension) const;
  void take_stated_units();
  void refuse_unclosed(const std::vector<Row>& rows) const;
  void refuse_misplaced_quotes(const Row& row) const;
  void check_columns() const;
  void check_columns(const Quantity& quantity, const Found& found, const std::string& written) const;
  void check_cells();
  void decide_decimal_mark();
  template <class Visit>
  void for_each_number_column(Visit visit) const;
  const Found& found(const std::string& name) const;
  double parse_number(const Row& row, int column) const;
  std::string column_name(int column) const;
  std::string shown_name(int column) const;  // of a column, in messages

  std::string source_;
  std::vector<Quantity> quantities_;
  std::vector<Found> found_;  // by quantity
  std::vector<int> others_;
  std::vector<Row> remarks_;  // above the header
  Row header_;
  std::vector<Row> rows_;
  char delimiter_ = ',';
  bool decimal_comma_ = false;
};

}  // namespace strandlab::table
