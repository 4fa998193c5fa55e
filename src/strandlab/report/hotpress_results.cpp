#include "strandlab/report/hotpress_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace strandlab::report {
namespace {

using hotpress::Answers, hotpress::CellReading, hotpress::Cycle, hotpress::Instant;
using Json = nlohmann::json;

constexpr int kProfiles = 100, kSections = 20;  // times of transfer_profiles.csv and transfer_section.csv

// At about so many times, evenly, and at all marks.
void at_times(const Cycle& cycle, int times, const std::function<void(const Instant&)>& act) {
  const auto& record = cycle.record;
  const double every = (record.back().time - record.front().time) / times;
  double next = record.front().time;
  for (const auto& i : record) {
    if (i.time < next - 1e-9 && i.mark.empty()) continue;
    while (next <= i.time + 1e-9) next += every;
    act(i);
  }
}

// Mean of the two cells that have a part `from_face` of the mass between them and their faces.
template <class Of>
double both_sides(const Instant& i, double from_face, Of of) {
  const auto n = i.cells.size();
  const auto below = std::min(n - 1, static_cast<std::size_t>(from_face * static_cast<double>(n)));
  return .5 * (of(i.cells[below]) + of(i.cells[n - 1 - below]));
}

const CellReading& core(const Instant& i) {
  return i.cells[i.cells.size() / 2];
}

// Not a number where no layer carries the resin.
double least_cure(const Instant& i, bool face) {
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const auto& cell : i.cells)
    if (cell.face == face && !(cell.cure() >= least)) least = cell.cure();
  return least;
}

Json number(std::optional<double> value, double unit = 1) {
  return value && std::isfinite(*value) ? Json(*value * unit) : Json();
}

Json to_json(const hotpress::ResinAnswer& r) {
  return {{"resin", r.resin},
          {"layers", r.layers},
          {"cured_s", number(r.cured_at)},
          {"cured_in_all_layers_s", number(r.all_cured_at)},
          {"least_cure_at_opening", r.least_cure}};
}

std::string seconds(const std::optional<double>& t) {
  return t ? fmt::format("{:.0f} s", *t) : "not in this cycle";
}

std::string cure_line(const Answers& a) {
  std::string line;
  for (const auto& r : a.resins)
    line += fmt::format("{}{} in the {} {}", line.empty() ? "" : ", ", r.resin, r.layers, seconds(r.cured_at));
  return line;
}

}  // namespace

files::CsvTable hotpress_table(const Cycle& cycle) {
  files::CsvTable table({"time_s",
                         "phase",
                         "gap_mm",
                         "thickness_mm",
                         "pressure_MPa",
                         "wood_stress_MPa",
                         "platen_top_C",
                         "platen_bottom_C",
                         "T_face_C",
                         "T_quarter_C",
                         "T_core_C",
                         "M_face",
                         "M_quarter",
                         "M_core",
                         "gas_face_kPa",
                         "gas_quarter_kPa",
                         "gas_core_kPa",
                         "gas_mean_kPa",
                         "cure_face",
                         "cure_core",
                         "density_face_kg_m3",
                         "density_core_kg_m3",
                         "heat_kJ_m2",
                         "water_out_kg_m2"});
  const auto T = [](const CellReading& c) { return c.T; };
  const auto M = [](const CellReading& c) { return c.M; };
  const auto gas = [](const CellReading& c) { return 1e-3 * c.gas; };
  const auto density = [](const CellReading& c) { return c.density; };
  for (const auto& i : cycle.record) {
    table.add_row({i.time,
                   i.phase,
                   1e3 * i.gap,
                   1e3 * i.thickness,
                   1e-6 * i.pressure,
                   1e-6 * i.stress,
                   i.platen_top,
                   i.platen_bottom,
                   both_sides(i, 0, T),
                   both_sides(i, .25, T),
                   core(i).T,
                   both_sides(i, 0, M),
                   both_sides(i, .25, M),
                   core(i).M,
                   both_sides(i, 0, gas),
                   both_sides(i, .25, gas),
                   1e-3 * core(i).gas,
                   1e-3 * i.gas_mean,
                   least_cure(i, true),
                   least_cure(i, false),
                   both_sides(i, 0, density),
                   core(i).density,
                   1e-3 * i.heat,
                   i.water_out});
  }
  return table;
}

files::CsvTable profiles_table(const Cycle& cycle) {
  files::CsvTable table({"time_s", "state", "depth_mm", "T_C", "M", "gas_kPa", "cure", "density_kg_m3"});
  at_times(cycle, kProfiles, [&table](const Instant& i) {
    for (auto cell = i.cells.rbegin(); cell != i.cells.rend(); ++cell) {
      table.add_row(
          {i.time, i.mark, 1e3 * cell->depth, cell->T, cell->M, 1e-3 * cell->gas, cell->cure(), cell->density});
    }
  });
  return table;
}

files::CsvTable section_table(const Cycle& cycle) {
  files::CsvTable table({"time_s", "state", "x_mm", "depth_mm", "T_C", "M", "gas_kPa", "cure", "density_kg_m3"});
  const int columns = cycle.settings.columns;
  at_times(cycle, kSections, [&](const Instant& i) {
    const auto& cells = i.all();
    const std::size_t rows = cells.size() / static_cast<std::size_t>(columns);
    for (int column = 0; column < columns; ++column) {
      const double x_mm = (column + .5) * 1e3 * cycle.length / columns;
      for (std::size_t row = rows; row-- > 0;) {
        const auto& c = cells[static_cast<std::size_t>(column) * rows + row];
        table.add_row({i.time, i.mark, x_mm, 1e3 * c.depth, c.T, c.M, 1e-3 * c.gas, c.cure(), c.density});
      }
    }
  });
  return table;
}

void write_hotpress_tables(const Cycle& cycle, const std::filesystem::path& folder) {
  hotpress_table(cycle).write(folder / "hotpress.csv");
  profiles_table(cycle).write(folder / "transfer_profiles.csv");
  const auto section = folder / "transfer_section.csv";
  if (cycle.settings.columns > 1) {
    section_table(cycle).write(section);
  } else {
    std::filesystem::remove(section);
  }
}

Json to_json(const hotpress::Band& result) {
  const auto& a = result.answers;
  const auto& mat = result.cycle.mat;
  const auto& d = a.density;
  Json resins = Json::array();
  for (const auto& r : a.resins) resins.push_back(to_json(r));
  return {{"mechanics", hotpress::name(result.cycle.settings.mechanics)},
          {"dry_mass_kg_m2", mat.dry_mass},
          {"press_time_to_cure_s", number(a.press_time)},
          {"press_factor_s_per_mm", number(a.press_factor, 1e-3)},
          {"resins", resins},
          {"precured_part_of_faces", a.precured},
          {"core_100C_s", number(a.core_100C)},
          {"plateau_start_s", number(a.plateau_start)},
          {"plateau_length_s", number(a.plateau_length)},
          {"plateau_mean_C", number(a.plateau_mean)},
          {"pressure_peak_MPa", number(a.pressure_peak, 1e-6)},
          {"pressure_peak_s", a.pressure_peak_time},
          {"wood_stress_peak_MPa", number(a.stress_peak, 1e-6)},
          {"gas_core_peak_kPa", 1e-3 * a.gas_peak},
          {"gas_core_peak_s", a.gas_peak_time},
          {"gas_core_peak_kPa_K_times_3", 1e-3 * result.permeable.gas_peak},
          {"gas_core_peak_kPa_K_over_3", 1e-3 * result.tight.gas_peak},
          {"opening_s", a.opening},
          {"gas_largest_at_opening_kPa", 1e-3 * a.gas_at_opening},
          {"blow_risk", a.blow},
          {"blow_risk_K_times_3", result.permeable.blow},
          {"blow_risk_K_over_3", result.tight.blow},
          {"density_mean_kg_m3", d.mean},
          {"density_peak_kg_m3", d.peak},
          {"density_peak_depth_mm", 1e3 * d.peak_depth},
          {"density_skin_kg_m3", d.skin},
          {"density_core_kg_m3", d.core},
          {"density_peak_over_core", d.peak / d.core},
          {"M_face_at_opening", a.M_face},
          {"M_core_at_opening", a.M_core},
          {"M_mean_at_opening", a.M_mean},
          {"heat_kJ_m2", 1e-3 * a.heat},
          {"water_out_kg_m2", a.water_out},
          {"thickness_closed_mm", 1e3 * a.thickness_closed},
          {"thickness_opened_mm", 1e3 * a.thickness_opened},
          {"springback_percent", 1e2 * a.springback()},
          {"log_first_contact_s", result.cycle.log_start},
          {"balance_error_water", result.cycle.worst_balance[transfer::kWater]},
          {"balance_error_air", result.cycle.worst_balance[transfer::kAir]},
          {"balance_error_energy", result.cycle.worst_balance[transfer::kEnergy]}};
}

std::vector<std::string> summary(const hotpress::Band& result) {
  const auto& a = result.answers;
  std::vector<std::string> lines;
  if (const int columns = result.cycle.settings.columns; columns > 1)
    lines.push_back(fmt::format(
        "section              {} columns; what follows is of the middle one, densities are means", columns));
  lines.push_back(fmt::format("press time to cure   {} ({}){}", seconds(a.press_time), cure_line(a),
                              a.press_factor ? fmt::format("; {:.1f} s/mm", 1e-3 * *a.press_factor) : ""));
  lines.push_back(fmt::format(
      "core at 100 C        {}{}", seconds(a.core_100C),
      a.plateau_start ? fmt::format("; plateau of {:.0f} C for {:.0f} s", *a.plateau_mean, *a.plateau_length) : ""));
  if (std::isfinite(a.pressure_peak))
    lines.push_back(
        fmt::format("peak pressure        {:.2f} MPa at {:.0f} s", 1e-6 * a.pressure_peak, a.pressure_peak_time));
  lines.push_back(fmt::format("peak gas in the core {:.0f} kPa at {:.0f} s ({:.0f} to {:.0f} kPa with K x 3 and K / 3)",
                              1e-3 * a.gas_peak, a.gas_peak_time, 1e-3 * result.permeable.gas_peak,
                              1e-3 * result.tight.gas_peak));
  lines.push_back(
      fmt::format("blow risk, relative  {:.2f} {} ({:.2f} to {:.2f} with K x 3 and K / 3), opened at {:.0f} s", a.blow,
                  hotpress::risk(a.blow), result.permeable.blow, result.tight.blow, a.opening));
  const auto& d = a.density;
  lines.push_back(fmt::format(
      "density              mean {:.0f}, densest {:.0f} kg/m3 {:.1f} mm below the face, skin {:.0f}, core {:.0f}",
      d.mean, d.peak, 1e3 * d.peak_depth, d.skin, d.core));
  lines.push_back(fmt::format("thickness            {:.2f} mm closed, {:.2f} mm opened (springback at least {:.1f} %)",
                              1e3 * a.thickness_closed, 1e3 * a.thickness_opened, 1e2 * a.springback()));
  lines.push_back(
      fmt::format("moisture at opening  face {:.1f} %, core {:.1f} %, mean {:.1f} %; {:.2f} kg/m2 of water driven out",
                  1e2 * a.M_face, 1e2 * a.M_core, 1e2 * a.M_mean, a.water_out));
  return lines;
}

}  // namespace strandlab::report
