#include "strandlab/case/hotpress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/hotpress/cycle.hpp"

namespace strandlab::cases {
namespace {

transfer::Resin find_resin(const Case& c, const std::string& name) {
  for (const auto& r : transfer::resins())
    if (r.name == name) return r;
  const auto own = std::find_if(c.resins.begin(), c.resins.end(), [&](const auto& r) { return r.name == name; });
  if (own == c.resins.end()) throw InputError(fmt::format("there is no resin \"{}\"", name));
  if (!(own->E_kJ_mol > 0) || !(own->A_1_s > 0)) {
    throw InputError(
        fmt::format("resin \"{}\" has no constants: [resins.{}] must give E_kJ_mol and A_1_s", name, name));
  }
  return {name, 1e3 * own->E_kJ_mol, own->A_1_s, own->n, own->gel};
}

std::vector<hotpress::Point> platens(const std::string& program, double constant) {
  return program.empty() ? std::vector<hotpress::Point>{{0, constant}} : hotpress::parse_points(program);
}

std::vector<transfer::PermeabilityPoint> permeability_table(const std::string& text) {
  std::vector<transfer::PermeabilityPoint> table;
  if (text.empty()) return table;
  for (const auto& point : hotpress::parse_points(text)) {
    if (!(point.at > 0 && point.value > 0))
      throw InputError(fmt::format("\"{}\": densities (kg/m3) and permeabilities (m2) must be greater than 0", text));
    table.push_back({point.at, point.value});
  }
  return table;
}

transfer::Constants constants_of(const HotPressSettings& h) {
  transfer::Constants k;
  k.panel_width = 1e-3 * h.panel_width_mm;
  k.permeability_400 = h.K400_m2;
  k.permeability_slope = h.slope;
  k.permeability_in_plane = h.in_plane_ratio;
  k.permeabilities = permeability_table(h.permeability_table);
  return k;
}

}  // namespace

std::vector<std::string> resin_names(const Case& c) {
  std::vector<std::string> names;
  for (const auto& r : transfer::resins()) names.push_back(r.name);
  for (const auto& r : c.resins) names.push_back(r.name);
  return names;
}

void check_hotpress(const Case& c, const std::function<void(const std::string&, const std::string&)>& fail) {
  const auto& h = c.hotpress;
  const auto check = [&](const std::string& key, const auto& act) {
    try {
      act();
    } catch (const InputError& e) {
      fail("hotpress." + key, e.what());
    }
  };
  check("schedule", [&] { static_cast<void>(hotpress::parse_schedule(h.schedule)); });
  check("platen_program", [&] { static_cast<void>(platens(h.platen_program, h.platen_C)); });
  check("platen_bottom_program", [&] { static_cast<void>(platens(h.platen_bottom_program, h.platen_C)); });
  check("permeability.table", [&] { static_cast<void>(permeability_table(h.permeability_table)); });
  check("resin.face", [&] { static_cast<void>(find_resin(c, h.resin_face)); });
  check("resin.face_kinds", [&] {
    const auto known = kind_names(c);
    for (const auto& kind : h.face_kinds) {
      if (std::find(known.begin(), known.end(), kind) == known.end())
        throw InputError(
            fmt::format("\"{}\" is no kind of strand of this case; its kinds: {}", kind, quoted_list(known)));
    }
  });
  check("resin.core", [&] { static_cast<void>(find_resin(c, h.resin_core)); });
}

hotpress::Settings hotpress_settings(const Case& c) {
  const auto& h = c.hotpress;
  hotpress::Settings s;
  s.mechanics = h.mechanics == "uniform" ? hotpress::Mechanics::kUniform : hotpress::Mechanics::kColumn;
  s.schedule = hotpress::parse_schedule(h.schedule);
  s.platen_top = platens(h.platen_program, h.platen_C);
  s.platen_bottom = h.platen_bottom_program.empty() ? s.platen_top : platens(h.platen_bottom_program, h.platen_C);
  s.bottom_lead = h.bottom_lead_s;
  s.moisture_face = h.moisture_face;
  s.moisture_core = h.moisture_core;
  s.face_fraction = h.face_fraction;
  s.cells = h.cells;
  s.columns = h.columns;
  s.open_ends = h.columns > 1 && c.sides == mpm::Side::kFree;
  s.step = h.step_s;
  s.fastest = 1e-3 * h.max_mm_per_s;
  s.rate.exponent = h.rate_exponent;
  s.softening = h.softening;
  s.resin_face = find_resin(c, h.resin_face);
  s.resin_core = find_resin(c, h.resin_core);
  s.constants = constants_of(h);
  if (!h.log_file.empty()) s.log = hotpress::read_log(h.log_file, h.log_columns);
  return s;
}

hotpress::Carried carried_resin(const Case& c, const std::string& kind) {
  const auto& faces = c.hotpress.face_kinds;
  if (faces.empty()) return hotpress::Carried::kOfItsLayer;
  return std::find(faces.begin(), faces.end(), kind) != faces.end() ? hotpress::Carried::kFace
                                                                    : hotpress::Carried::kCore;
}

bool presses_hot(const Case& c) {
  return c.hotpress.given && c.hotpress.mechanics == "strands";
}

double closed_compaction(const Case& c, const mat::Mat& mat) {
  const auto settings = hotpress_settings(c);
  const auto size = hotpress::size_of(pressed_mat(c, mat));
  double closed = size.thickness;
  if (settings.log) {
    for (const auto& point : settings.log->position) closed = std::min(closed, point.value);
    if (settings.log->position.empty())
      throw InputError(
          fmt::format("{}: a log without positions can be followed with hotpress.mechanics = \"column\" only",
                      c.hotpress.log_file));
  } else {
    for (const auto& phase : settings.schedule) {
      if (phase.target) closed = std::min(closed, hotpress::thickness_of(*phase.target, size));
    }
  }
  return 1 - closed / size.thickness;
}

hotpress::PressedMat pressed_mat(const Case& c, const mat::Mat& mat) {
  const auto kinds = kinds_and_materials(c);
  hotpress::PressedMat pressed;
  pressed.thickness = 1e-3 * mat.thickness_mm();
  pressed.length = 1e-3 * mat.length_mm;
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    const auto& kind = find_kind(kinds, mat.layers[row].role, row);
    std::vector<hotpress::MatLayer> woods;  // strands of a row may be of several materials
    for (const auto& strand : mat.layers[row].strands) {
      const auto& material = find_material(kind, strand, kinds, row);
      const double mass =
          1e-3 * mat.thickness_of(row) * (strand.x1_mm - strand.x0_mm) / mat.length_mm * material.density_kg_m3;
      const auto same = std::find_if(woods.begin(), woods.end(),
                                     [&](const auto& wood) { return wood.material.name == material.name; });
      if (same == woods.end()) {
        woods.push_back({mass, material, carried_resin(c, mat.layers[row].role)});
      } else {
        same->dry_mass += mass;
      }
    }
    pressed.layers.insert(pressed.layers.end(), woods.begin(), woods.end());
  }
  return pressed;
}

}  // namespace strandlab::cases
