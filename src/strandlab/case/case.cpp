#include "strandlab/case/case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "strandlab/case/estimate.hpp"
#include "strandlab/case/plate.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/mat/cut.hpp"
#include "strandlab/wood/species.hpp"

namespace strandlab::cases {
namespace {

constexpr double kStates = 1e4;  // states are told apart in steps of compaction of 1/kStates

const KindSettings& find_kind(const Case& c, const std::string& name, const std::string& row) {
  for (const auto& kind : c.kinds) {
    if (kind.name == name) return kind;
  }
  const auto names = kind_names(c);
  const auto near = nearest(name, names);
  throw InputError(fmt::format("row \"{}\" names no kind of strand{} Kinds of this case: {}", shortened(row),
                               near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near), quoted_list(names)));
}

// "core*10" -> 10 rows of core.
std::pair<std::string, int> parse_row(const std::string& row) {
  const auto star = row.find('*');
  if (star == std::string::npos) return {row, 1};
  int count = 0;
  const char* end = row.data() + row.size();
  const auto [last, error] = std::from_chars(row.data() + star + 1, end, count);
  if (error != std::errc() || last != end || count < 1 || count > 1000) {
    throw InputError(
        fmt::format("row \"{}\": after * comes a number of rows from 1 to 1000, as in \"core*10\"", shortened(row)));
  }
  return {row.substr(0, star), count};
}

mat::LayupRow layup_row(const KindSettings& kind, const mat::AngleDistribution& own_angles) {
  mat::LayupRow row;
  row.kind = kind.name;
  const bool cut = mat::are_cut(kind.statistics, own_angles);
  row.statistics = cut ? kind.statistics : mat::in_section(kind.statistics, own_angles);
  if (kind.thickness_mm > 0) row.thickness_mm = kind.thickness_mm;
  if (cut || own_angles.spread_deg > 0 || own_angles.sd_deg > 0) row.angles = own_angles;
  return row;
}

// What is wrong with a mat, and with which where it came from a file.
std::string about_mat(const Case& c, const InputError& e) {
  if (c.mat_file.empty()) return e.what();
  const std::string given = c.places.mat_file.empty() ? "" : c.places.mat_file + ": ";
  return fmt::format("{}{}: {}", given, c.mat_file, e.what());
}

// The thickest state decides: bending on supports is at a span in thicknesses.
void refuse_too_short(const Case& c, const Panel<2>& panel) {
  const double compaction = c.schedule.compactions.front();
  const double thickness = panel.initial_thickness_mm * (1 - compaction);
  const double needed = vtest::needed_length_mm(c.test, thickness);
  if (panel.length_mm >= needed * (1 - 1e-9)) return;  // up to round-off
  throw InputError(
      fmt::format("{}: test.kinds: 3- and 4-point bending at a span of {:g} thicknesses need a mat {:.0f} mm long at "
                  "compaction {} ({:.2f} mm thick); {} {:g}. Lengthen the mat, or begin with a denser state",
                  c.name, c.test.span_to_thickness, std::ceil(needed), compaction, thickness,
                  c.mat_file.empty() ? "mat.length_mm is" : "the length_mm of the mat file is", panel.length_mm));
}

}  // namespace

wood::Material find_material(const Case& c, const std::string& name) {
  for (const auto& user : c.materials) {
    if (user.material.name == name) return user.material;
  }
  for (const auto& built_in : wood::library()) {
    if (built_in.name == name) return built_in;
  }
  std::vector<std::string> names;
  for (const auto& built_in : wood::library()) names.push_back(built_in.name);
  for (const auto& user : c.materials) names.push_back(user.material.name);
  const auto near = nearest(name, names);
  throw InputError(fmt::format("there is no material \"{}\"{} Materials: {}", name,
                               near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near), quoted_list(names)));
}

std::vector<std::string> kind_names(const Case& c) {
  std::vector<std::string> names;
  for (const auto& kind : c.kinds) names.push_back(kind.name);
  return names;
}

Case::Case() : kinds{{"surface", "poplar", 0, {150, 20, 15, 4.95}}, {"core", "poplar", 90, {25, 3, 10, 1}}} {
  kinds[0].yield_factor = 0.5;  // hot faces and a warm core, until the heat itself drives the press
  kinds[1].yield_factor = 0.75;
  plate.width_mm = 0;
  schedule.compactions.clear();
  test.compliance_t_mm_per_MPa = {0, 0.0021, 0.0105, 0.0163, 0.05};
  grid.cell_aspect = 1.5;  // the cheapest that changes no modulus by 1 % (docs/performance.md, resolution)
}

mat::AngleDistribution angles(const Case& c, const KindSettings& kind) {
  constexpr double kUsualSd = 25;  // degrees, of strands that a forming machine lays
  const bool usual = is_plate(c) && kind.angle_spread_deg == 0 && kind.angle_kappa == 0;
  return {kind.angle_deg, kind.angle_spread_deg, kind.angle_sd_deg.value_or(usual ? kUsualSd : 0), kind.angle_kappa};
}

std::vector<const KindSettings*> row_kinds(const Case& c) {
  std::vector<const KindSettings*> kinds;
  for (const auto& text : c.rows) {
    const auto row = parse_row(text);
    kinds.insert(kinds.end(), static_cast<std::size_t>(row.second), &find_kind(c, row.first, text));
  }
  return kinds;
}

mat::StrandStatistics in_section(const Case& c, const KindSettings& kind) {
  return mat::in_section(kind.statistics, angles(c, kind));
}

mat::Layup layup(const Case& c) {
  mat::Layup result{c.length_mm, c.layer_thickness_mm, {}};
  for (const auto* kind : row_kinds(c)) result.rows.push_back(layup_row(*kind, angles(c, *kind)));
  return result;
}

std::vector<StrandKind> strand_kinds(const Case& c) {
  const bool hot = presses_hot(c);  // then heat softens the wood, and no factors that stand in for it
  std::vector<StrandKind> kinds;
  for (const auto& kind : c.kinds) {
    kinds.push_back({kind.name, find_material(c, kind.material), kind.angle_deg, hot ? 1 : kind.yield_factor,
                     hot ? 1 : kind.stiffness_factor, c.off_axis});
    kinds.back().material.law = kind.law;
  }
  return kinds;
}

std::vector<StrandKind> kinds_and_materials(const Case& c) {
  auto kinds = strand_kinds(c);
  for (const auto& user : c.materials) {
    StrandKind kind;
    kind.name = "material " + user.material.name;
    kind.material = user.material;
    kinds.push_back(kind);
  }
  return kinds;
}

mat::Mat make_mat(const Case& c) {
  const auto& place = c.mat_file.empty() ? c.places.rows : c.places.mat_file;
  try {
    if (has_plate_mat(c)) {
      throw InputError(fmt::format(
          "{}: a mat in 3D: strandlab form, run, press and test take it, what else there is needs a section",
          c.mat_file.empty() ? fmt::format("mat.width_mm = {}", c.plate.width_mm) : c.mat_file));
    }
    if (!c.mat_file.empty()) return mat::read(c.mat_file, kind_names(c));
    const auto rows = layup(c);
    refuse_too_large(c, rows);
    return mat::form(rows, c.seed);
  } catch (const InputError& e) {
    if (place.empty()) throw;
    throw InputError(fmt::format("{}: {}", place, e.what()));
  }
}

Weight weigh(const Case& c, const mat::Mat& mat) {
  try {
    return strandlab::weigh(mat, kinds_and_materials(c));
  } catch (const InputError& e) {
    throw InputError(about_mat(c, e));
  }
}

double density_kg_m3(const Case& c, const mat::Mat& mat, double compaction) {
  return weigh(c, mat).kg_per_m2 / (1e-3 * mat.thickness_mm() * (1 - compaction));
}

void settle_states(Case& c, const mat::Mat& mat) {
  if (presses_hot(c)) {
    c.schedule.compactions = {std::round(kStates * closed_compaction(c, mat)) / kStates};
    return;
  }
  settle_states(c, density_kg_m3(c, mat, 0), mat.thickness_mm());
}

void settle_states(Case& c, double formed_kg_m3, double thickness_mm) {
  auto& compactions = c.schedule.compactions;
  compactions = c.states.compactions;
  if (!compactions.empty()) return;
  const bool by_density = c.states.thicknesses_mm.empty();
  const auto& asked = by_density ? c.states.densities_kg_m3 : c.states.thicknesses_mm;
  const double formed = by_density ? formed_kg_m3 : thickness_mm;
  const auto* unit = by_density ? "kg/m3" : "mm";
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto fail = [&](const std::string& reason) {
      throw InputError(fmt::format("{}: entry {}, {:g} {}, {}", c.places.states.empty() ? c.name : c.places.states,
                                   i + 1, asked[i], unit, reason));
    };
    const double compaction =
        std::round(kStates * (1 - (by_density ? formed / asked[i] : asked[i] / formed))) / kStates;
    if (compaction < 0)
      fail(fmt::format("is {} the mat as formed, which has {:.4g} {}: begin there or denser",
                       by_density ? "below" : "above", formed, unit));
    if (compaction >= 1) fail("leaves nothing of the mat");
    if (!compactions.empty() && compaction <= compactions.back())
      fail(fmt::format("is the same state as the entry before: both are compaction {}", compaction));
    compactions.push_back(compaction + 0.0);  // no -0
  }
}

std::vector<std::string> derived_constants(const Case& c) {
  std::vector<std::string> lines;
  for (const auto& settings : c.materials) {
    const auto& material = settings.material;
    const auto base = find_material(c, settings.base);
    const auto names = settings.species.empty()
                           ? wood::constants_in_common(material, base)
                           : wood::constants_from_ratios(material, wood::find_species(settings.species));
    if (names.empty() || (settings.species.empty() && material.E_L == base.E_L)) continue;
    const auto source =
        settings.species.empty()
            ? fmt::format(
                  "are those of {} as they stand, of which E_L is {} MPa; with a species they would follow from "
                  "E_L = {} MPa by its ratios",
                  settings.base, base.E_L, material.E_L)
            : fmt::format(
                  "follow from E_L = {} MPa by the elastic ratios of {} (USDA Wood Handbook, tables 5-1 and 5-2)",
                  material.E_L, settings.species);
    lines.push_back(fmt::format("material {}: {} {}", material.name, fmt::join(names, ", "), source));
  }
  return lines;
}

Panel<2> make_panel(const Case& c, const mat::Mat& mat) {
  refuse_too_large(c, mat);
  const double cell_height = mat::thinnest_layer(mat) / c.grid.cells_through_strand;
  try {
    auto panel = strandlab::make_panel(mat, kinds_and_materials(c), cell_height * c.grid.cell_aspect / kPointsPerCell,
                                       c.grid.cells_through_strand * kPointsPerCell);
    refuse_too_short(c, panel);
    return panel;
  } catch (const InputError& e) {
    throw InputError(about_mat(c, e));
  }
}

}  // namespace strandlab::cases
