#include "strandlab/hotpress/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/table/table.hpp"

namespace strandlab::hotpress {
namespace {

using table::Dimension, table::Quantity, table::Table;

// "3 mm", "Pos mm", "Pos": the column, and its unit where the last word is one.
void choose(Quantity& quantity, const std::string& given) {
  if (given.empty()) return;
  auto name = given;
  const auto blank = given.rfind(' ');
  if (blank != std::string::npos && table::unit_factor(quantity.dimension, given.substr(blank + 1))) {
    quantity.stated_unit = given.substr(blank + 1);
    name = given.substr(0, blank);
  }
  if (name.find_first_not_of("0123456789") == std::string::npos && name.size() < 4) {
    quantity.columns = {std::stoi(name)};
  } else {
    quantity.names = {name};
  }
  quantity.required = true;
}

std::vector<Quantity> quantities(const LogColumns& columns) {
  Quantity time{{"time", "t", "Zeit", "elapsed"}, Dimension::kTime, "s"};
  Quantity position{{"position", "gap", "thickness", "distance", "Weg"}, Dimension::kLength, "mm", false};
  Quantity pressure{{"pressure", "mat pressure", "specific pressure", "Druck"}, Dimension::kPressure, "MPa", false};
  Quantity top{{"top", "platen top", "top platen", "upper platen", "platen"}, Dimension::kTemperature, "C", false};
  Quantity bottom{{"bottom", "platen bottom", "bottom platen", "lower platen"}, Dimension::kTemperature, "C", false};
  choose(time, columns.time);
  choose(position, columns.position);
  choose(pressure, columns.pressure);
  choose(top, columns.platen_top);
  choose(bottom, columns.platen_bottom);
  return {time, position, pressure, top, bottom};
}

// The column's numbers in SI, `unit` of ours each.
std::vector<Point> column(const Table& table, const std::vector<double>& times, const std::string& name, double unit) {
  std::vector<Point> points;
  if (!table.has(name)) return points;
  for (int row = 0; row < table.rows(); ++row) {
    const auto value = table.number(row, name);
    if (value && std::isfinite(times[row])) points.push_back({times[row], unit * *value});
  }
  return points;
}

void refuse_short(const std::vector<Point>& points, const std::string& source, const std::string& what) {
  if (points.size() == 1) throw InputError(fmt::format("{}: one reading of {} is no record of a press", source, what));
}

Log log_of(const Table& table, const std::vector<Quantity>& q, const std::string& source) {
  const auto name = [&](std::size_t i) { return q[i].names[0]; };
  std::vector<double> times;
  double last = -HUGE_VAL;
  for (int row = 0; row < table.rows(); ++row) {
    const auto time = table.number(row, name(0));
    times.push_back(time.value_or(NAN));
    if (!time) continue;
    if (!(*time > last)) {
      throw InputError(
          fmt::format("{}: time {:g} s after {:g} s; a log goes forward in time", table.where(row), *time, last));
    }
    last = *time;
  }
  Log log{column(table, times, name(1), 1e-3), column(table, times, name(2), 1e6), column(table, times, name(3), 1),
          column(table, times, name(4), 1)};
  refuse_short(log.position, source, "position");
  refuse_short(log.pressure, source, "pressure");
  if (log.position.empty() && log.pressure.empty()) {
    throw InputError(
        fmt::format("{}: neither a column of position (mm) nor one of pressure (MPa, bar); one of them moves "
                    "the press",
                    source));
  }
  if (log.platen_bottom.empty()) log.platen_bottom = log.platen_top;
  return log;
}

}  // namespace

Log log_from_text(const std::string& text, const std::string& source, const LogColumns& columns) {
  const auto q = quantities(columns);
  return log_of(Table(text, source, q), q, source);
}

Log read_log(const std::filesystem::path& file, const LogColumns& columns) {
  const auto q = quantities(columns);
  return log_of(Table(file, q), q, file.string());
}

}  // namespace strandlab::hotpress
