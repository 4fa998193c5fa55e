#include "strandlab/files/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "strandlab/files/atomic_file.hpp"

namespace strandlab::files {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
  return out;
}

std::string number(double value) {
  if (std::isnan(value)) return "nan";  // fmt keeps the sign of a NaN, which not every reader knows
  return fmt::format("{}", value);
}

std::string cell_text(const CsvCell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return number(*value);
  if (const auto* count = std::get_if<long long>(&cell)) return fmt::format("{}", *count);
  return csv_field(std::get<std::string>(cell));
}

}  // namespace

CsvTable::CsvTable(std::vector<std::string> columns) : columns_(std::move(columns)) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].empty()) throw std::invalid_argument(fmt::format("CSV column {} has no name", i + 1));
    if (std::find(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(i), columns_[i]) !=
        columns_.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw std::invalid_argument(fmt::format("CSV column {} is there twice", columns_[i]));
    }
  }
}

void CsvTable::add_row(std::vector<CsvCell> cells) {
  if (cells.size() != columns_.size()) {
    throw std::invalid_argument(fmt::format("CSV row of {} cells, {} columns", cells.size(), columns_.size()));
  }
  rows_.push_back(std::move(cells));
}

std::string CsvTable::text() const {
  std::string out;
  const auto add_line = [&out](const auto& cells, const auto& to_text) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) out += ',';
      out += to_text(cells[i]);
    }
    out += '\n';
  };
  add_line(columns_, csv_field);
  for (const auto& row : rows_) add_line(row, cell_text);
  return out;
}

void CsvTable::write(const std::filesystem::path& file) const {
  write_atomically(file, text());
}

}  // namespace strandlab::files
