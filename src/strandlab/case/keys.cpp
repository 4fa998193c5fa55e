#include "strandlab/case/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/wood/laws/law.hpp"
#include "strandlab/wood/species.hpp"

namespace strandlab::cases {
namespace {

const Range kSize{.lo = mat::kSmallestSize_mm, .hi = mat::kLargestSize_mm};
const Range kSizeOrZero{.lo = mat::kSmallestSize_mm, .hi = mat::kLargestSize_mm, .zero = true};
const Range kGap{.lo = 0, .hi = mat::kLargestSize_mm};
const Range kSoftening{.lo = 0, .hi = 1, .lo_open = true};
constexpr double kDensest_kg_m3 = 1500;  // wood without pores

// Between the members of Case and the value types of TOML.
Value to_value(bool v) {
  return v;
}
Value to_value(int v) {
  return static_cast<std::int64_t>(v);
}
Value to_value(std::uint64_t v) {
  return static_cast<std::int64_t>(v);
}
Value to_value(double v) {
  return v;
}
Value to_value(const std::string& v) {
  return v;
}
Value to_value(const std::vector<double>& v) {
  return v;
}
Value to_value(const std::vector<std::string>& v) {
  return v;
}
Value to_value(mpm::Side v) {
  return std::string(v == mpm::Side::kFree ? "free" : "roller");
}
Value to_value(wood::Law v) {
  return std::string(wood::name(v));
}
Value to_value(wood::OffAxis v) {
  return std::string(wood::name(v));
}
Value to_value(const std::vector<vtest::Kind>& v) {
  std::vector<std::string> names(v.size());
  std::transform(v.begin(), v.end(), names.begin(), vtest::name);
  return names;
}

template <class T>
void from_value(const Value& value, T& v) {
  if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::uint64_t>) {
    v = static_cast<T>(std::get<std::int64_t>(value));
  } else {
    v = std::get<T>(value);
  }
}
void from_value(const Value& value, mpm::Side& v) {
  v = std::get<std::string>(value) == "free" ? mpm::Side::kFree : mpm::Side::kRoller;
}
void from_value(const Value& value, wood::Law& v) {
  v = wood::law_from_name(std::get<std::string>(value));
}
void from_value(const Value& value, wood::OffAxis& v) {
  v = wood::off_axis_from_name(std::get<std::string>(value));
}
void from_value(const Value& value, std::vector<vtest::Kind>& v) {
  v.clear();
  for (const auto& name : std::get<std::vector<std::string>>(value)) v.push_back(vtest::kind_from_name(name));
}

// A key whose value is the member that at(case, name) refers to.
template <class At>
Key make_key(std::string path, std::string unit, Range range, std::string help, At at) {
  Key key;
  key.path = std::move(path);
  key.unit = std::move(unit);
  key.range = range;
  key.help = std::move(help);
  key.get = [at](const Case& c, const std::string& name) { return to_value(at(c, name)); };
  key.set = [at](Case& c, const std::string& name, const Value& value) { from_value(value, at(c, name)); };
  return key;
}

template <class At>
Key key(std::string path, std::string unit, Range range, std::string help, At at) {
  return make_key(
      std::move(path), std::move(unit), range,
      std::move(help), [at](auto& c, const std::string&) -> auto& { return at(c); });
}

// The key of an option that a room declares; `part_of(case, name)` refers to the struct that holds it.
template <class Part, class PartOf>
Key option_key(const std::string& section, const Declaration<Part>& option, PartOf part_of) {
  Key key;
  key.path = section + "." + option.name;
  key.unit = option.unit;
  key.range = option.range;
  key.help = option.help;
  key.get = [part_of, get = option.get](const Case& c, const std::string& name) { return get(part_of(c, name)); };
  key.set = [part_of, set = option.set](Case& c, const std::string& name, const Value& value) {
    set(part_of(c, name), value);
  };
  if (!option.choices.empty()) key.choices = [choices = option.choices](const Case&) { return choices; };
  return key;
}

template <class Items, class NameOf>
auto& find_named(Items& items, const std::string& name, NameOf name_of_item) {
  const auto it =
      std::find_if(items.begin(), items.end(), [&](const auto& item) { return name_of_item(item) == name; });
  if (it == items.end()) throw InputError(fmt::format("the case has no {}", name));
  return *it;
}

template <class At>
Key kind_key(const std::string& name, std::string unit, Range range, std::string help, At at) {
  return make_key(
      "kinds.*." + name, std::move(unit), range, std::move(help), [at](auto& c, const std::string& kind) -> auto& {
        return at(find_named(c.kinds, kind, [](const KindSettings& k) { return k.name; }));
      });
}

template <class At>
Key material_key(const std::string& name, std::string unit, Range range, std::string help, At at) {
  return make_key(
      "materials.*." + name, std::move(unit), range,
      std::move(help), [at](auto& c, const std::string& material) -> auto& {
        return at(find_named(c.materials, material, [](const MaterialSettings& m) { return m.material.name; }));
      });
}

Key with_choices(Key key, std::function<std::vector<std::string>(const Case&)> choices) {
  key.choices = std::move(choices);
  return key;
}

Key file(Key key) {
  key.names_file = true;
  return key;
}

Key same_results(Key key) {
  key.changes_results = false;
  return key;
}

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  for (const auto& material : wood::library()) names.push_back(material.name);
  return names;
}

std::vector<std::string> material_names(const Case& c) {
  auto names = library_names();
  for (const auto& m : c.materials) names.push_back(m.material.name);
  return names;
}

std::vector<std::string> test_names(const Case&) {
  return vtest::kind_names();
}

// A user's material starts as its base: this key is read before the constants.
Key base_key() {
  Key key;
  key.path = "materials.*.base";
  key.help = "built-in material whose constants hold where none is given";
  key.choices = [](const Case&) { return library_names(); };
  const auto find = [](auto& c, const std::string& name) -> auto& {
    return find_named(c.materials, name, [](const MaterialSettings& m) { return m.material.name; });
  };
  key.get = [find](const Case& c, const std::string& name) { return Value(find(c, name).base); };
  key.set = [find](Case& c, const std::string& name, const Value& value) {
    auto& settings = find(c, name);
    settings.base = std::get<std::string>(value);
    settings.material = find_named(wood::library(), settings.base, [](const wood::Material& m) { return m.name; });
    settings.material.name = name;
  };
  return key;
}

// Read after E_L and before the other constants, which are then what the user gives or what the ratios make of E_L.
Key species_key() {
  Key key = material_key(
      "species", "", kAny,
      "species whose elastic ratios (USDA Wood Handbook) give the elastic constants that are not given from E_L_MPa; "
      "\"\": those of the base",
      [](auto& m) -> auto& { return m.species; });
  key.choices = [](const Case&) {
    std::vector<std::string> names{""};
    for (const auto& s : wood::species()) names.push_back(s.name);
    return names;
  };
  key.set = [](Case& c, const std::string& name, const Value& value) {
    auto& settings = find_named(
        c.materials, name, [](const MaterialSettings& m) -> const auto& { return m.material.name; });
    settings.species = std::get<std::string>(value);
    if (settings.species.empty()) return;
    settings.material = wood::with_ratios(settings.material, wood::find_species(settings.species));
  };
  return key;
}

void add_mat_keys(std::vector<Key>& t) {
  t.push_back(key(
      "mat.length_mm", "mm", {.lo = mat::kSmallestSize_mm, .hi = 1e5}, "length of the specimen along the panel",
      [](auto& c) -> auto& { return c.length_mm; }));
  t.push_back(key(
      "mat.layer_thickness_mm", "mm", kSize, "thickness of strands whose kind has none of its own",
      [](auto& c) -> auto& { return c.layer_thickness_mm; }));
  t.push_back(key(
      "mat.rows", "", kAny, "rows of strands, bottom to top: \"kind\" or \"kind*count\"",
      [](auto& c) -> auto& { return c.rows; }));
  t.push_back(file(key(
      "mat.file", "", kAny,
      "mat file to press in place of a random mat (its length, thickness and rows hold); \"\" for random",
      [](auto& c) -> auto& { return c.mat_file; })));
  t.push_back(with_choices(key(
                               "mat.offaxis", "", kAny,
                               "rows whose grain lies neither along nor across: held by the section in every "
                               "direction, or free to shear across (docs/theory.md)",
                               [](auto& c) -> auto& { return c.off_axis; }),
                           [](const Case&) -> std::vector<std::string> {
                             return {wood::name(wood::OffAxis::kExact), wood::name(wood::OffAxis::kUncoupled)};
                           }));
}

void add_kind_keys(std::vector<Key>& t) {
  t.push_back(with_choices(kind_key(
                               "material", "", kAny, "material of the strands: built in or one of [materials]",
                               [](auto& k) -> auto& { return k.material; }),
                           material_names));
  t.push_back(kind_key(
      "angle_deg", "degrees", {.lo = -180, .hi = 180}, "grain against the section, 0 along the panel",
      [](auto& k) -> auto& { return k.angle_deg; }));
  t.push_back(kind_key(
      "angle_spread_deg", "degrees", {.lo = 0, .hi = 90},
      "each strand has its own angle, uniform within angle_deg +- this; 90: any angle",
      [](auto& k) -> auto& { return k.angle_spread_deg; }));
  t.push_back(kind_key(
      "thickness_mm", "mm", kSizeOrZero, "thickness of the strands; 0: mat.layer_thickness_mm",
      [](auto& k) -> auto& { return k.thickness_mm; }));
  t.push_back(kind_key(
      "length_mm", "mm", kSizeOrZero, "mean length of a strand in the section; 0 with gap 0: one strand fills the row",
      [](auto& k) -> auto& { return k.statistics.length_mm; }));
  t.push_back(kind_key(
      "length_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean",
      [](auto& k) -> auto& { return k.statistics.length_sd_mm; }));
  t.push_back(kind_key(
      "gap_mm", "mm", kGap, "mean gap between strands of a row", [](auto& k) -> auto& { return k.statistics.gap_mm; }));
  t.push_back(kind_key(
      "gap_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean",
      [](auto& k) -> auto& { return k.statistics.gap_sd_mm; }));
  t.push_back(kind_key(
      "yield_factor", "", kSoftening,
      "softening by heat and moisture: yield stresses and hardening_K over the material's; the pressing is cold and "
      "does "
      "not find it by itself",
      [](auto& k) -> auto& { return k.yield_factor; }));
  t.push_back(kind_key(
      "stiffness_factor", "", kSoftening,
      "softening in the hot press: elastic moduli over the material's; virtual tests are cold and take the material's",
      [](auto& k) -> auto& { return k.stiffness_factor; }));
  t.push_back(with_choices(kind_key(
                               "law", "", kAny,
                               "how the strands yield: hill (no change of volume) or crushing (cells collapse); see "
                               "docs/crushing.md",
                               [](auto& k) -> auto& { return k.law; }),
                           [](const Case&) { return wood::law_names(); }));
}

// A positive constant of wood in MPa (or kg/m^3, or no unit).
Key constant(const std::string& name, const std::string& unit, Range range, std::string help,
             double wood::Material::*member) {
  return material_key(
      name, unit, range, std::move(help), [member](auto& m) -> auto& { return m.material.*member; });
}

// Constants of the laws of yielding, as these declare them.
void add_law_keys(std::vector<Key>& t) {
  const auto material = [](auto& c, const std::string& name) -> auto& {
    return find_named(c.materials, name, [](const MaterialSettings& m) { return m.material.name; }).material;
  };
  wood::for_each_law([&]<class L>() {
    for (const auto& constant : L::description().constants) t.push_back(option_key("materials.*", constant, material));
  });
}

void add_material_keys(std::vector<Key>& t) {
  using M = wood::Material;
  t.push_back(base_key());
  t.push_back(species_key());
  t.push_back(constant("density_kg_m3", "kg/m3", kPositive, "density as formed", &M::density_kg_m3));
  t.push_back(constant("E_L_MPa", "MPa", kPositive, "Young's modulus along the grain", &M::E_L));
  t.push_back(constant("E_R_MPa", "MPa", kPositive, "Young's modulus, radial (through the strand)", &M::E_R));
  t.push_back(constant("E_T_MPa", "MPa", kPositive, "Young's modulus, tangential", &M::E_T));
  t.push_back(constant("G_RL_MPa", "MPa", kPositive, "shear modulus", &M::G_RL));
  t.push_back(constant("G_TL_MPa", "MPa", kPositive, "shear modulus", &M::G_TL));
  t.push_back(constant("G_RT_MPa", "MPa", kPositive, "rolling shear modulus", &M::G_RT));
  t.push_back(constant("nu_RL", "", kAny, "Poisson's ratio -eps_L/eps_R under load along R", &M::nu_RL));
  t.push_back(constant("nu_TL", "", kAny, "Poisson's ratio -eps_L/eps_T under load along T", &M::nu_TL));
  t.push_back(constant("nu_TR", "", kAny, "Poisson's ratio -eps_R/eps_T under load along T", &M::nu_TR));
  add_law_keys(t);
}

void add_press_keys(std::vector<Key>& t) {
  t.push_back(key(
      "press.speed_m_s", "m/s", {.lo = 0, .hi = 1000, .lo_open = true},
      "closing speed of the platens; up to 16 panels from 20 % compaction on hardly depend on it",
      [](auto& c) -> auto& { return c.schedule.speed_m_s; }));
  t.push_back(key(
      "press.densities_kg_m3", "kg/m3",
      {.lo = 0, .hi = kDensest_kg_m3, .lo_open = true, .hi_open = true, .increasing = true},
      "densities of the panel at which it is kept, solved for the weight of each mat; this key or one of the next two",
      [](auto& c) -> auto& { return c.states.densities_kg_m3; }));
  t.push_back(key(
      "press.thicknesses_mm", "mm", {.lo = 0, .lo_open = true, .decreasing = true},
      "thicknesses of the panel at which it is kept, in place of densities",
      [](auto& c) -> auto& { return c.states.thicknesses_mm; }));
  t.push_back(key(
      "press.compactions", "", {.lo = 0, .hi = 1, .hi_open = true, .increasing = true},
      "compactions (1 - thickness/initial thickness) at which the panel is kept, in place of densities",
      [](auto& c) -> auto& { return c.states.compactions; }));
  t.push_back(with_choices(key(
                               "press.sides", "", kAny, "vertical sides of the mat: on rollers (symmetry) or free",
                               [](auto& c) -> auto& { return c.sides; }),
                           [](const Case&) -> std::vector<std::string> {
                             return {"roller", "free"};
                           }));
  t.push_back(key(
      "press.symmetric", "", kAny, "both platens move, else only the top one",
      [](auto& c) -> auto& { return c.schedule.symmetric; }));
  t.push_back(key(
      "press.ramp_time_fraction", "", {.lo = 0, .hi = 0.5}, "part of the pressing time spent on a smooth start",
      [](auto& c) -> auto& { return c.schedule.ramp_time_fraction; }));
  t.push_back(key(
      "press.record_interval_compaction", "", {.lo = 1e-6, .hi = 1}, "compaction between two lines of press.csv",
      [](auto& c) -> auto& { return c.schedule.record_interval_compaction; }));
  t.push_back(key(
      "press.friction", "", {.lo = 0, .hi = 10}, "Coulomb friction between strands",
      [](auto& c) -> auto& { return c.mpm.friction; }));
  t.push_back(key(
      "press.platen_friction", "", {.lo = 0, .hi = 10}, "Coulomb friction between strands and platens",
      [](auto& c) -> auto& { return c.mpm.platen_friction; }));
}

void add_grid_keys(std::vector<Key>& t) {
  t.push_back(key(
      "grid.cells_through_strand", "", {.lo = 1, .hi = 32}, "cells through the thickness of a strand",
      [](auto& c) -> auto& { return c.grid.cells_through_strand; }));
  t.push_back(key(
      "grid.cell_aspect", "", {.lo = 0.25, .hi = 8}, "length of a cell over its height",
      [](auto& c) -> auto& { return c.grid.cell_aspect; }));
  t.push_back(key(
      "grid.follow_platens", "", kAny, "the height of the cells follows the platens",
      [](auto& c) -> auto& { return c.grid.follow_platens; }));
  t.push_back(key(
      "grid.courant", "", {.lo = 0, .hi = 0.9, .lo_open = true}, "time step over the time a wave takes through a cell",
      [](auto& c) -> auto& { return c.mpm.courant; }));
  t.push_back(key(
      "grid.filter_interval_steps", "steps", {.lo = 0, .hi = 1e9},
      "steps between XPIC(2) filterings of velocity; 0: none", [](auto& c) -> auto& { return c.mpm.filter_interval; }));
}

void add_glue_keys(std::vector<Key>& t) {
  t.push_back(key(
      "glue.compliance_t_mm_per_MPa", "mm/MPa", kAny,
      "glue-line compliances 1/D_t along the strands; 0 is a perfect bond, and so is a negative one",
      [](auto& c) -> auto& { return c.test.compliance_t_mm_per_MPa; }));
  t.push_back(file(key(
      "glue.from_bondline", "", kAny,
      "result of `strandlab bondline` whose group gives 1/D_t in place of compliance_t_mm_per_MPa; \"\" for none",
      [](auto& c) -> auto& { return c.bondline_file; })));
  t.push_back(key(
      "glue.group", "", kAny, "group of that result", [](auto& c) -> auto& { return c.bondline_group; }));
  t.push_back(key(
      "glue.compliance_n_mm_per_MPa", "mm/MPa", kNotNegative, "glue-line compliance 1/D_n across the line",
      [](auto& c) -> auto& { return c.test.compliance_n_mm_per_MPa; }));
  t.push_back(key(
      "glue.max_gap_mm", "mm", kPositive, "strand faces closer than this are glued",
      [](auto& c) -> auto& { return c.test.curing.max_gap_mm; }));
}

void add_test_keys(std::vector<Key>& t) {
  t.push_back(
      with_choices(key(
                       "test.kinds", "", kAny, "virtual tests of the panel at each compaction and glue compliance",
                       [](auto& c) -> auto& { return c.test.kinds; }),
                   test_names));
  t.push_back(key(
      "test.elements_through_strand", "", {.lo = 1, .hi = vtest::kMostElements},
      "finite elements through the thickness of a strand",
      [](auto& c) -> auto& { return c.test.elements_through_strand; }));
  t.push_back(key(
      "test.span_to_thickness", "", {.lo = 8, .hi = 200},
      "span of 3- and 4-point bending over the panel's thickness: 20 in EN 310, 24 in ASTM D1037",
      [](auto& c) -> auto& { return c.test.span_to_thickness; }));
}

void add_run_keys(std::vector<Key>& t) {
  t.push_back(key(
      "run.seed", "", {.lo = 0, .hi = 9e18}, "seed of the random mat", [](auto& c) -> auto& { return c.seed; }));
  t.push_back(same_results(key(
      "run.threads", "", {.lo = 0, .hi = 1024}, "threads; 0: one per core. Results do not depend on it",
      [](auto& c) -> auto& { return c.threads; })));
  t.push_back(same_results(key(
      "run.checkpoint_interval_s", "s", {.lo = 0.01, .hi = 86400},
      "wall time between checkpoints: what a killed run can lose",
      [](auto& c) -> auto& { return c.checkpoint_interval_s; })));
}

Key resin_key(const std::string& name, std::string unit, Range range, std::string help, double ResinSettings::*member) {
  return make_key(
      "resins.*." + name, std::move(unit), range,
      std::move(help), [member](auto& c, const std::string& resin) -> auto& {
        return find_named(c.resins, resin, [](const ResinSettings& r) { return r.name; }).*member;
      });
}

// Of the hot press; a cold run does not depend on them.
template <class T>
Key hot_key(const std::string& name, std::string unit, Range range, std::string help, T HotPressSettings::*member) {
  return same_results(key(
      "hotpress." + name, std::move(unit), range,
      std::move(help), [member](auto& c) -> auto& { return c.hotpress.*member; }));
}
template <class T>
Key log_key(const std::string& name, std::string help, T hotpress::LogColumns::*member) {
  return same_results(key(
      "hotpress.log." + name, "", kAny,
      std::move(help), [member](auto& c) -> auto& { return c.hotpress.log_columns.*member; }));
}
template <class T>
Key softening_key(const std::string& name, std::string unit, Range range, std::string help,
                  T hotpress::Softening::*member) {
  return same_results(key(
      "hotpress.softening." + name, std::move(unit), range,
      std::move(help), [member](auto& c) -> auto& { return c.hotpress.softening.*member; }));
}

void add_hotpress_schedule_keys(std::vector<Key>& t) {
  using H = HotPressSettings;
  const Range temperature{.lo = 20, .hi = 300};
  t.push_back(with_choices(hot_key("mechanics", "", kAny,
                                   "how the mat resists: as a column of its layers without gaps, or not at all, of "
                                   "uniform density",
                                   &H::mechanics),
                           [](const Case&) -> std::vector<std::string> {
                             return {"column", "uniform"};
                           }));
  t.push_back(
      hot_key("platen_C", "C", temperature, "temperature of the platens; above 220 with a warning", &H::platen_C));
  t.push_back(hot_key("platen_program", "", kAny,
                      "platen temperature against seconds since first contact in place of platen_C, as in \"0 200, 60 "
                      "190\"; \"\": platen_C",
                      &H::platen_program));
  t.push_back(hot_key("platen_bottom_program", "", kAny, "the same for the bottom platen; \"\": as the top one",
                      &H::platen_bottom_program));
  t.push_back(hot_key("bottom_lead_s", "s", {.lo = 0, .hi = 600},
                      "the mat lies on the hot bottom platen so long before the press touches it", &H::bottom_lead_s));
  t.push_back(
      hot_key("schedule", "", kAny,
              "phases: close (by position or pressure), hold, vent, open; mm, kg/m3 (oven-dry), % compaction, s, "
              "mm/s, MPa (docs/hotpress.md)",
              &H::schedule));
  t.push_back(hot_key("max_mm_per_s", "mm/s", kPositive, "fastest closing under pressure", &H::max_mm_per_s));
}

void add_hotpress_mat_keys(std::vector<Key>& t) {
  using H = HotPressSettings;
  const Range moisture{.lo = 0, .hi = 0.3}, fraction{.lo = 0, .hi = 0.5};
  t.push_back(hot_key("moisture_face", "kg/kg", moisture, "moisture content of the faces; above 0.25 with a warning",
                      &H::moisture_face));
  t.push_back(hot_key("moisture_core", "kg/kg", moisture, "moisture content of the core", &H::moisture_core));
  t.push_back(hot_key("face_fraction", "", fraction, "part of the mat's mass that each face is", &H::face_fraction));
  t.push_back(hot_key("panel_width_mm", "mm", kPositiveOrInfinite,
                      "width of the panel, along which gas escapes to the edges; inf: sealed edges",
                      &H::panel_width_mm));
  t.push_back(hot_key("cells", "", {.lo = 4, .hi = 400}, "cells of equal mass through the mat", &H::cells));
  t.push_back(hot_key("step_s", "s", {.lo = 0.001, .hi = 2}, "time step to 30 s; twice that to 90 s, then four times",
                      &H::step_s));
  t.push_back(hot_key("rate_exponent", "", {.lo = 0, .hi = 0.5}, "stress grows as this power of the rate of crushing",
                      &H::rate_exponent));
}

void add_hotpress_keys(std::vector<Key>& t) {
  using H = HotPressSettings;
  using S = hotpress::Softening;
  using L = hotpress::LogColumns;
  add_hotpress_schedule_keys(t);
  add_hotpress_mat_keys(t);
  t.push_back(with_choices(
      hot_key("resin.face", "", kAny, "resin of the faces, built in or of [resins]", &H::resin_face), resin_names));
  t.push_back(with_choices(hot_key("resin.core", "", kAny, "resin of the core", &H::resin_core), resin_names));
  t.push_back(softening_key("r", "", {.lo = 0, .hi = 1, .lo_open = true},
                            "what heat leaves of stiffness and yield far above the softening point", &S::floor));
  t.push_back(softening_key("kappa_dry", "1/K", kNotNegative, "decay with temperature of dry wood", &S::kappa_dry));
  t.push_back(softening_key("kappa_wet", "1/K", kNotNegative, "of wood of more than about 10 %", &S::kappa_wet));
  t.push_back(softening_key("k_yield", "", kNotNegative, "fall of ln yield per % of moisture content", &S::k_yield));
  t.push_back(softening_key("k_stiffness", "", kNotNegative, "fall of ln stiffness per % of moisture content",
                            &S::k_stiffness));
  t.push_back(
      hot_key("permeability.K400_m2", "m2", kPositive, "of a mat of 400 kg/m3, through the thickness", &H::K400_m2));
  t.push_back(
      hot_key("permeability.slope", "m3/kg", kNotNegative, "fall of its decimal logarithm with density", &H::slope));
  t.push_back(hot_key("permeability.in_plane_ratio", "", kPositive, "permeability along the panel over that",
                      &H::in_plane_ratio));
  t.push_back(hot_key("permeability.table", "", kAny,
                      "permeability (m2) against density (kg/m3) in place of the formula, as in \"400 5e-12, 640 "
                      "9.4e-14\"; \"\": the formula",
                      &H::permeability_table));
  t.push_back(hot_key("log.file", "", kAny,
                      "record of a press's controller (CSV) to follow in place of the schedule; \"\" for none",
                      &H::log_file));
  t.push_back(log_key("time",
                      "column of time: its name or number, with its unit where the header has none, as in \"1 s\"; "
                      "\"\": found by its name",
                      &L::time));
  t.push_back(log_key("position", "column of the gap between the platens, likewise", &L::position));
  t.push_back(
      log_key("pressure", "column of the pressure on the mat, followed where there is no position", &L::pressure));
  t.push_back(log_key("platen_top", "column of the top platen's temperature", &L::platen_top));
  t.push_back(
      log_key("platen_bottom", "column of the bottom platen's; as the top one where there is none", &L::platen_bottom));
}

void add_resin_keys(std::vector<Key>& t) {
  using R = ResinSettings;
  t.push_back(
      same_results(resin_key("E_kJ_mol", "kJ/mol", kNotNegative, "activation energy; must be given", &R::E_kJ_mol)));
  t.push_back(same_results(resin_key("A_1_s", "1/s", kNotNegative,
                                     "rate of cure is A exp(-E/(R T)) (1 - cure)^n; must be given", &R::A_1_s)));
  t.push_back(same_results(resin_key("n", "", {.lo = 0, .hi = 5, .lo_open = true}, "order of the cure", &R::n)));
  t.push_back(same_results(resin_key("gel", "", {.lo = 0, .hi = 1, .hi_open = true},
                                     "degree of cure from which on it has strength", &R::gel)));
}

// A text as TOML. A file name that is not UTF-8 is written with its bytes spelt out: TOML has no other bytes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char ch : as_text(text)) {
    if (ch == '"' || ch == '\\') out += '\\';
    if (static_cast<unsigned char>(ch) < 0x20 || ch == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(ch));
    } else {
      out += ch;
    }
  }
  return out + '"';
}

// Whole numbers with all their digits.
std::string limit(double v) {
  return v == std::floor(v) ? fmt::format("{:.0f}", v) : fmt::format("{}", v);
}

std::string describe(const Range& r) {
  const bool lower = std::isfinite(r.lo), upper = std::isfinite(r.hi);
  std::string text;
  if (lower && upper) {
    const auto from = fmt::format("{} {}", r.lo_open ? "greater than" : "from", limit(r.lo));
    const char* to = r.hi_open ? "to less than" : (r.lo_open ? "and at most" : "to");
    text = fmt::format("{}{} {} {}", r.zero ? "0, or " : "", from, to, limit(r.hi));
  } else if (lower) {
    text = r.lo_open ? fmt::format("greater than {}", limit(r.lo)) : fmt::format("{} or more", limit(r.lo));
  }
  if (r.infinite) text += " (inf: never)";
  if (r.increasing) text += ", increasing";
  if (r.decreasing) text += ", decreasing";
  return text;
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> list{
      {"mat", "the mat before pressing"},
      {"kinds.*", "a kind of strand, named in mat.rows and in mat files; \"surface\" and \"core\" are always there"},
      {"materials.*",
       "a material of your own: a built-in one with some constants changed, or E_L_MPa with the ratios of a species"},
      {"press", "the press"},
      {"hotpress",
       "the hot press of `strandlab hotpress`: schedule, platens, moisture; the pressing of `strandlab run` is cold"},
      {"hotpress.resin", "resins of the mat"},
      {"hotpress.softening", "how heat and moisture soften wood across the grain"},
      {"hotpress.permeability", "permeability of the mat to gas"},
      {"hotpress.log", "record of a press to follow"},
      {"resins.*", "a resin of your own; built in are pf and pmdi"},
      {"grid", "resolution of the pressing simulation"},
      {"glue", "glue lines of the cured panel"},
      {"test", "virtual tests"},
      {"run", "how to run"}};
  return list;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> table = [] {
    std::vector<Key> t;
    add_mat_keys(t);
    add_kind_keys(t);
    add_material_keys(t);
    add_press_keys(t);
    add_hotpress_keys(t);
    add_resin_keys(t);
    add_grid_keys(t);
    add_glue_keys(t);
    add_test_keys(t);
    add_run_keys(t);
    return t;
  }();
  return table;
}

std::string section_of(const Key& key) {
  return key.path.substr(0, key.path.rfind('.'));
}
std::string name_of(const Key& key) {
  return key.path.substr(key.path.rfind('.') + 1);
}

std::vector<std::string> instances(const Case& c, const std::string& section) {
  std::vector<std::string> names;
  if (section == "kinds.*") {
    for (const auto& kind : c.kinds) names.push_back(kind.name);
  } else if (section == "materials.*") {
    for (const auto& material : c.materials) names.push_back(material.material.name);
  } else if (section == "resins.*") {
    for (const auto& resin : c.resins) names.push_back(resin.name);
  } else if (section.rfind("hotpress", 0) == 0 && !c.hotpress.given) {
    return names;
  } else {
    names.emplace_back();
  }
  return names;
}

std::string type_name(const Value& value) {
  static const char* names[] = {"true or false", "a whole number",    "a number",
                                "a text",        "a list of numbers", "a list of texts"};
  return names[value.index()];
}

std::string allowed(const Key& key, const Case& c) {
  if (key.choices) {
    auto names = key.choices(c);
    std::replace(names.begin(), names.end(), std::string(), std::string("\"\""));
    return fmt::format("one of {}", fmt::join(names, ", "));
  }
  return describe(key.range);
}

std::string to_toml(const Value& value) {
  struct Writer {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(const std::string& v) const { return quoted(v); }
    std::string operator()(const std::vector<double>& v) const { return fmt::format("[{}]", fmt::join(v, ", ")); }
    std::string operator()(const std::vector<std::string>& v) const {
      std::vector<std::string> items(v.size());
      std::transform(v.begin(), v.end(), items.begin(), quoted);
      return fmt::format("[{}]", fmt::join(items, ", "));
    }
  };
  return std::visit(Writer{}, value);
}

}  // namespace strandlab::cases
