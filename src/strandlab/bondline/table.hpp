// Tables as testing machines and spreadsheets write them: comma, semicolon or tab between cells, decimal point or
// comma, quoted cells, a row of units, a byte-order mark, UTF-8 or Latin-1, any line ending, lines of remarks above the
// header.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/bondline/units.hpp"

namespace strandlab::bondline {

// A column to look for. Its unit stands in the header ("t1_mm", "t1 (in)", "t1 [mm]") or in a row of units below it.
struct Quantity {
  std::vector<std::string> names;  // the first is its name in messages; case makes no difference
  Dimension dimension = Dimension::kText;
  std::string unit;  // our unit, for messages
  bool required = true;
};

class Table {
 public:
  // Reads a file; `quantities` are the columns to find. Throws InputError (file, line, column, what was given, what is
  // allowed) for a file that cannot be read, a required column that is missing, appears twice or has no known unit, a
  // row with too many cells, text where a number belongs, and decimal commas mixed with decimal points.
  Table(const std::filesystem::path& file, std::vector<Quantity> quantities);
  // The same for a text in memory; `source` opens the messages.
  Table(const std::string& text, const std::string& source, std::vector<Quantity> quantities);

  int rows() const { return static_cast<int>(rows_.size()); }
  int line(int row) const { return rows_[row].line; }  // 1-based line in the file
  std::string where(int row) const;                    // "file.csv:12"
  bool has(const std::string& name) const;             // is there a column of that quantity
  // Number in our unit; nothing for an empty cell or a mark of a missing value (-, NA, nan).
  std::optional<double> number(int row, const std::string& name) const;
  // Text of a cell, blanks trimmed; empty where there is no such column.
  std::string text(int row, const std::string& name) const;

  // Columns that are none of the quantities, in order, and their cells.
  std::vector<std::string> other_columns() const;
  std::string other(int row, int index) const { return rows_[row].cells[others_[index]]; }

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };
  struct Found {
    int column = -1;
    std::optional<double> factor;  // our unit per unit of the column
    std::string doubt;             // header that starts like this quantity but has an unknown unit
  };
  void parse(const std::string& text);
  static std::vector<Row> split(const std::string& text, char delimiter);
  int matches(const Row& header) const;  // number of quantities that a row names
  std::vector<Found> find_columns(const Row& header) const;
  void read_units_row();
  void check_columns() const;
  void check_cells();
  void decide_decimal_mark();
  const Found& found(const std::string& name) const;
  double parse_number(const Row& row, int column) const;
  std::string column_name(int column) const { return header_.cells[column]; }

  std::string source_;
  std::vector<Quantity> quantities_;
  std::vector<Found> found_;  // by quantity
  std::vector<int> others_;
  Row header_;
  std::vector<Row> rows_;
  char delimiter_ = ',';
  bool decimal_comma_ = false;
};

}  // namespace strandlab::bondline
