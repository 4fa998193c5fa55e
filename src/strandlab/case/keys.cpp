#include "strandlab/case/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "strandlab/case/settings.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/glue/options.hpp"
#include "strandlab/hotpress/options.hpp"
#include "strandlab/mat/options.hpp"
#include "strandlab/mpm/options.hpp"
#include "strandlab/press/options.hpp"
#include "strandlab/vtest/options.hpp"
#include "strandlab/wood/options.hpp"
#include "strandlab/wood/species.hpp"

namespace strandlab::cases {
namespace {

template <class Items, class NameOf>
auto& find_named(Items& items, const std::string& name, NameOf name_of_item) {
  const auto it =
      std::find_if(items.begin(), items.end(), [&](const auto& item) { return name_of_item(item) == name; });
  if (it == items.end()) throw InputError(fmt::format("the case has no {}", name));
  return *it;
}

template <class AnyCase>
auto& kind_named(AnyCase& c, const std::string& name) {
  return find_named(c.kinds, name, [](const KindSettings& k) { return k.name; });
}
template <class AnyCase>
auto& material_named(AnyCase& c, const std::string& name) {
  return find_named(c.materials, name, [](const MaterialSettings& m) { return m.material.name; });
}
template <class AnyCase>
auto& resin_named(AnyCase& c, const std::string& name) {
  return find_named(c.resins, name, [](const ResinSettings& r) { return r.name; });
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

// The keys of a section, from the options of the structs that they fill; `part_of(case, name)` refers to the struct.
template <class Part, class PartOf>
std::vector<Key> keys_of(const std::string& section, const std::vector<Declaration<Part>>& options, PartOf part_of) {
  std::vector<Key> list;
  for (const auto& option : options) {
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
    list.push_back(std::move(key));
  }
  return list;
}
template <class Part, class PartOf>
std::vector<Key> keys_of_part(const std::string& section, const std::vector<Declaration<Part>>& options,
                              PartOf part_of) {
  return keys_of(
      section, options, [part_of](auto& c, const std::string&) -> auto& { return part_of(c); });
}
std::vector<Key> keys_of_case(const std::string& section, const std::vector<Declaration<Case>>& options) {
  return keys_of_part(
      section, options, [](auto& c) -> auto& { return c; });
}

// The table while it is collected.
class Table {
 public:
  void add(const std::vector<Key>& more) { keys_.insert(keys_.end(), more.begin(), more.end()); }
  // Behind a key that is there, for the order in which a reader wants to meet them.
  void insert_after(const std::string& path, const std::vector<Key>& more) {
    keys_.insert(place_of(path) + 1, more.begin(), more.end());
  }
  Key& at(const std::string& path) { return *place_of(path); }
  std::vector<Key> take() { return std::move(keys_); }

 private:
  std::vector<Key>::iterator place_of(const std::string& path) {
    return std::find_if(keys_.begin(), keys_.end(), [&](const Key& key) { return key.path == path; });
  }
  std::vector<Key> keys_;
};

std::vector<Key> same_results(std::vector<Key> list) {
  for (auto& key : list) key.changes_results = false;
  return list;
}

// A user's material starts as its base: this key is read after all of the base's own, and before the constants.
Key base_key() {
  Key key;
  key.path = "materials.*.base";
  key.help = "material, built in or another of [materials], whose constants hold where none is given";
  key.choices = material_names;
  key.get = [](const Case& c, const std::string& name) { return Value(material_named(c, name).base); };
  key.set = [](Case& c, const std::string& name, const Value& value) {
    auto& settings = material_named(c, name);
    settings.base = std::get<std::string>(value);
    settings.material = find_material(c, settings.base);
    settings.material.name = name;
  };
  return key;
}

// Read after E_L and before the other constants, which are then what the user gives or what the ratios make of E_L.
Key species_key() {
  Key key;
  key.path = "materials.*.species";
  key.help =
      "species whose elastic ratios (USDA Wood Handbook) give the elastic constants that are not given from E_L_MPa; "
      "\"\": those of the base";
  key.choices = [](const Case&) {
    std::vector<std::string> names{""};
    for (const auto& s : wood::species()) names.push_back(s.name);
    return names;
  };
  key.advice = wood::stand_in_for;
  key.get = [](const Case& c, const std::string& name) { return Value(material_named(c, name).species); };
  key.set = [](Case& c, const std::string& name, const Value& value) {
    auto& settings = material_named(c, name);
    settings.species = std::get<std::string>(value);
    if (settings.species.empty()) return;
    settings.material = wood::with_ratios(settings.material, wood::find_species(settings.species));
  };
  return key;
}

std::vector<Key> of_dimensions(int dimensions, std::vector<Key> list) {
  for (auto& key : list) key.dimensions = dimensions;
  return list;
}

// One key for a section and another for a plate.
void join(Key& key, const Key& of_plate) {
  key.get = [two = key.get, three = of_plate.get](const Case& c, const std::string& name) {
    return is_plate(c) ? three(c, name) : two(c, name);
  };
  key.set = [two = key.set, three = of_plate.set](Case& c, const std::string& name, const Value& value) {
    is_plate(c) ? three(c, name, value) : two(c, name, value);
  };
}

// Its value is that of the distribution: what is not given depends on the other keys.
Key angle_sd_key() {
  Key key;
  key.path = "kinds.*.angle_sd_deg";
  key.unit = "degrees";
  key.range = {.lo = 0, .hi = 90};
  key.help =
      "each strand has its own angle, normal about angle_deg with this standard deviation; in place of "
      "angle_spread_deg; 3D: 25 unless one of the others is given";
  key.get = [](const Case& c, const std::string& name) { return Value(angles(c, kind_named(c, name)).sd_deg); };
  key.set = [](Case& c, const std::string& name, const Value& value) {
    kind_named(c, name).angle_sd_deg = std::get<double>(value);
  };
  return key;
}

void add_mat_and_kinds(Table& t) {
  t.add(keys_of_case("mat", mat_settings()));
  t.at("mat.offaxis").dimensions = 2;
  t.insert_after("mat.length_mm",
                 of_dimensions(3, keys_of_part(
                                      "mat", mat::plate_options(), [](auto& c) -> auto& { return c.plate; })));
  t.at("mat.width_mm").set = [set = t.at("mat.width_mm").set](Case& c, const std::string& name, const Value& value) {
    const bool was_plate = is_plate(c);
    set(c, name, value);
    if (is_plate(c) && !was_plate) c.grid.cell_aspect = kPlateCellAspect;  // unless the case gives it
  };
  t.at("mat.file").names_file = true;
  t.add(keys_of(
      "kinds.*", kind_settings(), [](auto& c, const std::string& n) -> auto& { return kind_named(c, n); }));
  t.at("kinds.*.material").choices = material_names;
  t.insert_after("kinds.*.thickness_mm",
                 keys_of(
                     "kinds.*", mat::statistics_options(),
                     [](auto& c, const std::string& n) -> auto& { return kind_named(c, n).statistics; }));
  t.at("kinds.*.gap_mm").dimensions = t.at("kinds.*.gap_sd_mm").dimensions = 2;
  for (const auto& key : of_dimensions(3, keys_of(
                                              "kinds.*", mat::size_options(), [](auto&c, const std::string&n) -> auto& {
                                                return kind_named(c, n).sizes;
                                              }))) {
    join(t.at(key.path), key);
  }
  t.at("kinds.*.angle_kappa").dimensions = 3;
  t.insert_after("kinds.*.angle_spread_deg", {angle_sd_key()});
}

void add_materials(Table& t) {
  t.add({base_key(), species_key()});
  t.add(keys_of(
      "materials.*", wood::material_options(),
      [](auto& c, const std::string& n) -> auto& { return material_named(c, n).material; }));
}

void add_press(Table& t) {
  t.add(keys_of_part(
      "press", press::schedule_options(), [](auto& c) -> auto& { return c.schedule; }));
  t.insert_after("press.speed_m_s", keys_of_part(
                                        "press", state_settings(), [](auto& c) -> auto& { return c.states; }));
  t.insert_after("press.compactions", keys_of_case("press", side_settings()));
  t.insert_after("press.sides", of_dimensions(3, keys_of_case("press", half_settings())));
  t.add(keys_of_part(
      "press", mpm::contact_options(), [](auto& c) -> auto& { return c.mpm; }));
}

void add_hotpress(Table& t) {
  t.add(same_results(keys_of_part(
      "hotpress", hot_press_settings(), [](auto& c) -> auto& { return c.hotpress; })));
  t.at("hotpress.resin.face").choices = t.at("hotpress.resin.core").choices = resin_names;
  t.insert_after("hotpress.resin.face_kinds", same_results(keys_of_part(
                                                  "hotpress.softening", hotpress::softening_options(),
                                                  [](auto& c) -> auto& { return c.hotpress.softening; })));
  t.add(same_results(keys_of_part(
      "hotpress.log", hotpress::log_column_options(), [](auto& c) -> auto& { return c.hotpress.log_columns; })));
  t.add(same_results(keys_of(
      "resins.*", resin_settings(), [](auto& c, const std::string& n) -> auto& { return resin_named(c, n); })));
}

void add_grid(Table& t) {
  t.add(keys_of_part(
      "grid", press::resolution_options(), [](auto& c) -> auto& { return c.grid; }));
  t.add(keys_of_part(
      "grid", mpm::step_options(), [](auto& c) -> auto& { return c.mpm; }));
}

void add_glue_and_tests(Table& t) {
  t.add(keys_of_part(
      "glue", vtest::bond_options(), [](auto& c) -> auto& { return c.test; }));
  t.insert_after("glue.compliance_t_mm_per_MPa", keys_of_case("glue", bondline_settings()));
  t.at("glue.from_bondline").names_file = true;
  t.add(keys_of_part(
      "glue", glue::curing_options(), [](auto& c) -> auto& { return c.test.curing; }));
  t.add(keys_of_part(
      "test", vtest::test_options(), [](auto& c) -> auto& { return c.test; }));
}

void add_run(Table& t) {
  t.add(keys_of_case("run", run_settings()));
  auto& seed = t.at("run.seed");  // also of the spots of resin
  seed.set = [set = seed.set](Case& c, const std::string& name, const Value& value) {
    set(c, name, value);
    c.test.curing.coverage.seed = c.seed;
  };
  for (const char* key : {"run.threads", "run.checkpoint_interval_s", "run.pictures"})
    t.at(key).changes_results = false;
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
      {"hotpress", "the hot press: schedule, platens, moisture; with this table the mat is pressed hot"},
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
    Table t;
    add_mat_and_kinds(t);
    add_materials(t);
    add_press(t);
    add_hotpress(t);
    add_grid(t);
    add_glue_and_tests(t);
    add_run(t);
    return t.take();
  }();
  return table;
}

bool is_foreign(const Key& key, const Case& c) {
  return key.dimensions == (is_plate(c) ? 2 : 3);
}

std::string section_of(const Key& key) {
  return key.path.substr(0, key.path.rfind('.'));
}
std::string name_of(const Key& key) {
  return key.path.substr(key.path.rfind('.') + 1);
}

std::string with_name(std::string path, const std::string& name) {
  const auto star = path.find('*');
  return star == std::string::npos ? path : path.replace(star, 1, name);
}

std::vector<std::string> instances(const Case& c, const std::string& section) {
  std::vector<std::string> names;
  if (section == "kinds.*") {
    names = kind_names(c);
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

std::string meaning(const Key& key, const Case& c) {
  const auto rule = allowed(key, c);
  const auto unit_and_rule = key.unit + (key.unit.empty() || rule.empty() ? "" : "; ") + rule;
  return unit_and_rule.empty() ? key.help : fmt::format("{} ({})", key.help, unit_and_rule);
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
