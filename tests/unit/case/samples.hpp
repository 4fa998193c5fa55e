// A value for every key of the case table that differs from its default.
#pragma once

#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/case/keys.hpp"

namespace strandlab::cases {

struct Sample {
  const Key* entry = nullptr;
  std::string section;                 // "[kinds.surface]"
  std::string key;                     // "angle_deg"
  std::string dotted;                  // "kinds.surface.angle_deg"
  std::string name;                    // "surface"
  std::string value;                   // as TOML
  std::vector<std::string> base = {};  // overrides without which the key has no meaning: those of a plate, a width
};

// Its own assignment after those that make the case what it has to be.
inline std::vector<std::string> assignments(const Sample& sample) {
  auto list = sample.base;
  list.push_back(sample.dotted + "=" + sample.value);
  return list;
}

// A case with the section of the sample and nothing set in it.
inline Case plain_case(const Sample& sample) {
  return case_from_text(sample.section, "sample", sample.base);
}

inline std::string other_value(const Key& key, const Case& c, const std::string& name) {
  const auto value = key.get(c, name);
  if (key.path == "mat.file") return "\"/data/mat.json\"";
  if (key.path == "glue.from_bondline") return "\"/data/dls.json\"";
  if (key.path == "glue.group") return "\"PF-25\"";
  if (key.path == "glue.groups") return "[\"PF-25\", \"PF-1\"]";
  if (key.path == "glue.coverage_classes") return "[0.02, 0.5, 1]";
  if (key.path == "glue.coverage_compliances_mm_per_MPa") return "[0.02, 0.01, 0.005]";
  if (key.path == "hotpress.resin.face_kinds") return "[\"surface\"]";
  if (key.path == "mat.width_mm") return "290";
  if (key.path == "mat.rows") return "[\"core*3\"]";
  if (key.path == "hotpress.schedule") return "[\"close to 12 mm in 25 s\"]";
  if (key.path == "hotpress.log.file") return "\"/data/plc.csv\"";
  if (key.path.rfind("hotpress.log", 0) == 0) return "\"3\"";
  if (key.path == "hotpress.permeability.table") return "\"400 1e-12, 600 1e-14\"";
  if (key.path == "hotpress.platen_program" || key.path == "hotpress.platen_bottom_program") return "\"0 190, 60 180\"";
  if (key.path == "test.kinds") return "[\"bending_end_couple\"]";
  if (key.path == "press.compactions") return "[0.05, 0.25]";
  if (key.path == "press.densities_kg_m3") return "[500, 600]";
  if (key.path == "press.thicknesses_mm") return "[12, 8]";
  if (key.path == "materials.*.base") return "\"vtc\"";  // the last choice is the material itself
  if (key.choices) {
    const auto names = key.choices(c);
    return to_toml(Value(names.back()) == value ? names.front() : names.back());
  }
  if (const auto* flag = std::get_if<bool>(&value)) return to_toml(!*flag);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return to_toml(*whole + 1);
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    return to_toml(std::vector<double>(list->rbegin(), list->rend()));
  // Radial and tangential yield must stay equal where the axial one is infinite: a change below 1e-12 keeps the rule.
  if (key.path == "materials.*.Y_R_MPa" || key.path == "materials.*.Y_T_MPa") return "5.000000000000001";
  const double number = std::get<double>(value);
  return to_toml(number > 1e9 ? 100.0 : number * 0.9375 + (number == 0 ? 0.125 : 0));
}

inline std::vector<Sample> samples() {
  std::vector<Sample> list;
  for (const auto& key : keys()) {
    const auto section = section_of(key);
    Sample s{&key, {}, name_of(key), {}, {}, {}};
    if (section == "kinds.*") s.name = "surface";
    if (section == "materials.*" || section == "resins.*") s.name = "mine";
    const auto title = section.substr(0, section.find(".*")) + (s.name.empty() ? "" : "." + s.name);
    s.section = "[" + title + "]";
    s.dotted = title + "." + s.key;
    if (key.dimensions == 3)
      s.base = {"mat.length_mm=300", "mat.width_mm=300", "kinds.surface.angle_sd_deg=0", "kinds.core.angle_sd_deg=0"};
    if (key.path == "kinds.*.width_sd_mm") s.base = {"kinds.surface.width_mm=20"};
    if (key.path == "mat.width_mm") s.base = {"mat.length_mm=300"};
    const auto c = plain_case(s);
    s.value = other_value(key, c, s.name);
    list.push_back(s);
  }
  return list;
}

}  // namespace strandlab::cases
