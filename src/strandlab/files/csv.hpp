// Tidy CSV tables: one header row, one observation per row.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

namespace strandlab::files {

// A number is written with the fewest digits that read back to the same double ("nan" and "inf" where it is not
// finite); text is quoted where RFC 4180 asks for it.
using CsvCell = std::variant<double, long long, std::string>;

class CsvTable {
 public:
  // Column names carry their units ("stress_MPa"). Throws std::invalid_argument for an empty or repeated name.
  explicit CsvTable(std::vector<std::string> columns);

  // Throws std::invalid_argument unless there is one cell per column.
  void add_row(std::vector<CsvCell> cells);

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t rows() const { return rows_.size(); }
  const std::vector<CsvCell>& row(std::size_t number) const { return rows_[number]; }
  std::string text() const;  // header and rows, each line ended by \n

  // Replaces `file` atomically; throws as write_atomically().
  void write(const std::filesystem::path& file) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<CsvCell>> rows_;
};

}  // namespace strandlab::files
