#include "strandlab/run/sheet.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/report/board_findings.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::run {
namespace {

using Json = nlohmann::json;
using report::Sheet;
using report::shown;

// Modulus of elasticity in bending that EN 300:2006 asks of the major axis, GPa.
constexpr double kOsb3_GPa = 3.5, kOsb4_GPa = 4.8;
constexpr double kAlong_deg = 30;  // rows whose grain is nearer to the panel's length run along it, for this purpose

const Json kNothing = Json::object();

const Json& part(const Json& record, const std::string& pointer) {
  const Json::json_pointer at(pointer);
  return record.contains(at) ? record.at(at) : kNothing;
}

bool is_done(const Json& record, const char* step) {
  return part(record, fmt::format("/steps/{}", step)).value("finished", false);
}

// ---- The board in words ---------------------------------------------------------------------------------------------

// Kinds of the rows, bottom to top.
std::vector<std::string> kinds_of_rows(const cases::Case& c, const Json& mat) {
  std::vector<std::string> kinds;
  if (mat.is_object() && mat.contains("layers")) {
    for (const auto& layer : mat["layers"]) kinds.push_back(layer.value("role", ""));
  } else if (c.mat_file.empty()) {
    for (const auto& row : cases::layup(c).rows) kinds.push_back(row.kind);
  }
  return kinds;
}

// "5 rows of surface, 10 of core, 5 of surface, from the bottom up"
std::string layup_in_words(const std::vector<std::string>& rows) {
  std::vector<std::string> parts;
  for (auto from = rows.begin(); from != rows.end();) {
    const auto to = std::find_if(from, rows.end(), [&](const std::string& kind) { return kind != *from; });
    const auto n = to - from;
    parts.push_back(parts.empty() ? fmt::format("{} {} of {}", n, n == 1 ? "row" : "rows", *from)
                                  : fmt::format("{} of {}", n, *from));
    from = to;
  }
  const char* order = parts.size() > 1 ? ", from the bottom up" : "";
  return fmt::format("{}{}", fmt::join(parts, ", "), order);
}

std::string grain(const cases::KindSettings& kind) {
  if (kind.angle_spread_deg >= 90) return "at any angle";
  if (kind.angle_spread_deg > 0) return fmt::format("at {:g}° ± {:g}°", kind.angle_deg, kind.angle_spread_deg);
  if (const double sd = kind.angle_sd_deg.value_or(0); sd > 0)
    return fmt::format("at {:g}° with a standard deviation of {:g}°", kind.angle_deg, sd);
  if (kind.angle_deg == 0) return "along the panel";
  return std::abs(kind.angle_deg) == 90 ? "across the panel" : fmt::format("at {:g}°", kind.angle_deg);
}

std::string size_in_words(const cases::Case& c, const cases::KindSettings& kind) {
  const auto& s = kind.statistics;
  const auto angles = cases::angles(c, kind);
  const bool across =
      std::abs(std::remainder(kind.angle_deg, 180.0)) == 90 && angles.spread_deg == 0 && angles.sd_deg == 0;
  if (!(s.length_mm > 0)) return {};
  if (!(s.width_mm > 0)) return fmt::format(", {:g} mm {} in the section", s.length_mm, across ? "wide" : "long");
  return fmt::format(", {:g} mm long and {:g} mm wide", s.length_mm, s.width_mm);
}

// Of the kinds that rows are of.
std::string strands_in_words(const cases::Case& c, const std::vector<std::string>& rows) {
  std::vector<std::string> parts;
  for (const auto& kind : c.kinds) {
    if (std::find(rows.begin(), rows.end(), kind.name) == rows.end()) continue;
    const double thickness = kind.thickness_mm > 0 ? kind.thickness_mm : c.layer_thickness_mm;
    const auto thick = c.mat_file.empty() ? fmt::format(", {:g} mm thick", thickness) : "";
    parts.push_back(fmt::format("{}: {}, grain {}{}{}", kind.name, kind.material, grain(kind), thick,
                                c.mat_file.empty() ? size_in_words(c, kind) : ""));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string glue_in_words(const cases::Case& c) {
  std::vector<std::string> names;
  for (const double compliance : c.test.compliance_t_mm_per_MPa) {
    const auto name = cases::name_of_glue(c, compliance);
    const bool by_value = compliance <= 0 || name.rfind("1/D_t", 0) == 0;
    names.push_back(by_value ? name : fmt::format("{} ({:.4g})", name, compliance));
  }
  return fmt::format("{}; 1/D_t in mm/MPa. Faces bond up to a gap of {:g} mm", fmt::join(names, ", "),
                     c.test.curing.max_gap_mm);
}

std::string pressing_in_words(const cases::Case& c) {
  if (cases::presses_hot(c)) return fmt::format("hot: {}", fmt::join(c.hotpress.schedule, ", "));
  const bool softened =
      std::any_of(c.kinds.begin(), c.kinds.end(), [](const auto& kind) { return kind.yield_factor < 1; });
  return fmt::format("cold, the platens close at {:g} m/s{}", c.schedule.speed_m_s,
                     softened ? "; softened strands stand in for heat" : "");
}

std::vector<Sheet::Fact> board_of(const cases::Case& c, const Json& record, const Json& mat) {
  const auto rows = kinds_of_rows(c, mat);
  std::vector<Sheet::Fact> facts;
  if (!rows.empty()) {
    facts.push_back({"Layup", layup_in_words(rows)});
    facts.push_back({"Strands", strands_in_words(c, rows)});
  }
  const auto& states = part(record, "/states");
  const double weight = part(record, "/mat").value("kg_per_m2", 0.0);
  if (states.is_array() && !states.empty()) {
    const auto& last = states.back();
    const double thickness = last.at("thickness_mm"), density = last.at("density_kg_m3");
    facts.push_back(
        {"Panel", fmt::format("{} mm thick, {:.0f} kg/m³, {} kg/m²", shown(thickness), density, shown(weight))});
  }
  if (mat.is_object() && mat.contains("length_mm"))
    facts.push_back({"Mat", fmt::format("{:g} mm long, {}", mat.value("length_mm", 0.0),
                                        c.mat_file.empty() ? fmt::format("of seed {}", c.seed)
                                                           : "read from " + as_text(c.mat_file))});
  facts.push_back({"Pressing", pressing_in_words(c)});
  facts.push_back({"Glue", glue_in_words(c)});
  return facts;
}

std::vector<std::string> limits_of(const cases::Case& c) {
  return {fmt::format(
              "Holds for: a section 1 mm deep in plane strain; stiffness, not strength; tests of the panel as {}.",
              cases::presses_hot(c) && c.hotpress.kept == "opened" ? "it came out of the press, cold and conditioned"
                                                                   : "frozen between the platens"),
          cases::presses_hot(c)
              ? "Not yet compared with measured boards: trust differences between panels before absolute numbers; gas "
                "and permeability rest on judgement (docs/hotpress.md)."
              : "Not yet compared with measured boards: trust differences between panels before absolute numbers "
                "(docs/verification.md)."};
}

// ---- The headline numbers -------------------------------------------------------------------------------------------

// What EN 300 asks is told of boards that have strands along and others.
bool is_oriented_board(const cases::Case& c, const std::vector<std::string>& rows) {
  bool along = false, other = false, strands = false;
  for (const auto& kind : c.kinds) {
    if (std::find(rows.begin(), rows.end(), kind.name) == rows.end()) continue;
    const bool spread = kind.angle_spread_deg > kAlong_deg;
    (std::abs(kind.angle_deg) < kAlong_deg && !spread ? along : other) = true;
    strands = strands || kind.statistics.gap_mm > 0;
  }
  return along && other && strands;
}

struct Tests {
  double compaction = 0;
  std::vector<std::string> names;
  std::vector<report::PanelModulus> moduli;
};

// Of the last state that has moduli.
Tests last_tests(const Json& record) {
  Tests tests;
  const auto& states = part(record, "/steps/test/states");
  if (!states.is_array()) return tests;
  const auto last = std::find_if(states.rbegin(), states.rend(),
                                 [](const Json& state) { return !state.value("moduli", Json::array()).empty(); });
  if (last == states.rend()) return tests;
  tests.compaction = last->at("compaction");
  for (const auto& m : last->at("moduli")) {
    report::PanelModulus modulus;
    modulus.test = m.at("test");
    modulus.compliance_t_mm_per_MPa = m.at("compliance_t_mm_per_MPa");
    modulus.modulus_MPa = m.at("modulus_MPa");
    if (std::find(tests.names.begin(), tests.names.end(), modulus.test) == tests.names.end())
      tests.names.push_back(modulus.test);
    tests.moduli.push_back(std::move(modulus));
  }
  return tests;
}

bool is_bending(const std::string& test) {
  return test.rfind("bending", 0) == 0;
}

Sheet::Headline headline_of(const std::string& test, const Tests& tests, const cases::Case& c,
                            const std::vector<std::string>& rows) {
  std::vector<double> compliances;
  for (const auto& m : tests.moduli)
    if (m.test == test) compliances.push_back(m.compliance_t_mm_per_MPa);
  const double glue = report::middle_glue(compliances);
  const auto of = [&](double compliance) -> std::optional<double> {
    for (const auto& m : tests.moduli)
      if (m.test == test && m.compliance_t_mm_per_MPa == compliance) return m.modulus_MPa;
    return std::nullopt;
  };
  std::vector<std::string> context;
  if (const auto perfect = of(0); perfect && glue > 0)
    context.push_back(fmt::format("{} with perfect bonds", shown(1e-3 * *perfect)));
  if (is_bending(test) && is_oriented_board(c, rows))
    context.push_back(fmt::format("EN 300 asks {:g} of OSB/3 and {:g} of OSB/4 along the board", kOsb3_GPa, kOsb4_GPa));
  double stiffest = 0;
  for (const auto& kind : cases::strand_kinds(c)) {
    if (std::find(rows.begin(), rows.end(), kind.name) != rows.end()) stiffest = std::max(stiffest, kind.material.E_L);
  }
  if (stiffest > 0) context.push_back(fmt::format("the strands' own E along the grain is {}", shown(1e-3 * stiffest)));
  return {report::short_label(test) + " modulus", shown(1e-3 * of(glue).value_or(std::nan(""))),
          fmt::format("GPa, glue: {}", cases::name_of_glue(c, glue)), fmt::format("{}", fmt::join(context, "; "))};
}

std::vector<Sheet::Headline> headlines_of(const cases::Case& c, const Json& record, const Json& mat) {
  std::vector<Sheet::Headline> list;
  const auto& states = part(record, "/states");
  if (!is_done(record, "press") || !states.is_array() || states.empty()) return list;
  const auto& last = states.back();
  const auto& press = part(record, "/steps/press");
  const auto profiles = press.value("density_profiles", Json::array());
  list.push_back({"Density", fmt::format("{:.0f}", last.at("density_kg_m3").get<double>()), "kg/m³, mean",
                  profiles.empty() ? ""
                                   : fmt::format("densest layers {:.0f}, core {:.0f} kg/m³",
                                                 profiles.back().at("peak_kg_m3").get<double>(),
                                                 profiles.back().at("core_kg_m3").get<double>())});
  const double compaction = last.at("compaction"), thickness = last.at("thickness_mm");
  list.push_back(
      {"Thickness", shown(thickness), "mm",
       fmt::format("{} % compaction of a mat of {} mm", shown(100 * compaction), shown(thickness / (1 - compaction)))});
  if (press.contains("highest_stress_MPa")) {
    const double stress = press["highest_stress_MPa"];
    list.push_back({"Highest pressure", shown(stress, 2), "MPa",
                    fmt::format("hot presses of mills give 0 to {:g} MPa", report::kHotPressMPa)});
  }
  const auto rows = kinds_of_rows(c, mat);
  if (!is_done(record, "test")) return list;
  const auto tests = last_tests(record);
  for (const auto& test : tests.names) list.push_back(headline_of(test, tests, c, rows));
  return list;
}

// ---- Tables ---------------------------------------------------------------------------------------------------------

std::string as_percent(double compaction) {
  return fmt::format("{:.1f} %", 100 * compaction);
}

Sheet::Table states_table(const Json& record) {
  Sheet::Table table{"table-states",
                     "The panel at each state kept",
                     {"compaction", "thickness, mm", "density, kg/m³", "densest layers", "outer quarters", "core"},
                     {}};
  const auto profiles = part(record, "/steps/press").value("density_profiles", Json::array());
  const auto& states = part(record, "/states");
  for (std::size_t i = 0; i < states.size(); ++i) {
    std::vector<std::string> row{as_percent(states[i].at("compaction")), shown(states[i].at("thickness_mm"), 4),
                                 fmt::format("{:.0f}", states[i].at("density_kg_m3").get<double>())};
    for (const auto* name : {"peak_kg_m3", "surface_kg_m3", "core_kg_m3"})
      row.push_back(i < profiles.size() ? fmt::format("{:.0f}", profiles[i].at(name).get<double>()) : "");
    table.rows.push_back(std::move(row));
  }
  return table;
}

// States down, glues across.
Sheet::Table modulus_table(const std::string& test, const cases::Case& c, const Json& record) {
  Sheet::Table table{"table-modulus-" + test, report::short_label(test) + " modulus, MPa", {"density, kg/m³"}, {}};
  for (const double compliance : c.test.compliance_t_mm_per_MPa)
    table.columns.push_back(cases::name_of_glue(c, std::max(compliance, 0.0)));
  const auto& kept = part(record, "/states");
  for (const auto& state : part(record, "/steps/test/states")) {
    const double compaction = state.at("compaction");
    std::vector<std::string> row{as_percent(compaction)};
    for (const auto& k : kept) {
      if (k.at("compaction") == state.at("compaction"))
        row[0] = fmt::format("{:.0f}", k.at("density_kg_m3").get<double>());
    }
    for (const auto& m : state.at("moduli")) {
      if (m.at("test") == test) row.push_back(shown(m.at("modulus_MPa")));
    }
    row.resize(table.columns.size(), "–");
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<Sheet::Table> tables_of(const cases::Case& c, const Json& record) {
  std::vector<Sheet::Table> tables;
  if (is_done(record, "press") && part(record, "/states").is_array()) tables.push_back(states_table(record));
  if (is_done(record, "test")) {
    for (const auto& test : last_tests(record).names) tables.push_back(modulus_table(test, c, record));
  }
  return tables;
}

std::vector<report::Finding> all_findings(const Json& record) {
  std::vector<report::Finding> all;
  for (const auto* step : {"press", "test"}) {
    if (!is_done(record, step)) continue;
    const auto list = part(record, fmt::format("/steps/{}", step)).value("findings", Json::array());
    for (auto& finding : report::findings_from_json(list)) all.push_back(std::move(finding));
  }
  return all;
}

}  // namespace

report::Sheet sheet_of(const cases::Case& c, const Json& record, const Json& mat) {
  Sheet sheet;
  sheet.title = record.value("case_name", as_text(c.name));
  sheet.board = board_of(c, record, mat);
  sheet.limits = limits_of(c);
  sheet.headlines = headlines_of(c, record, mat);
  sheet.findings = all_findings(record);
  sheet.tables = tables_of(c, record);
  return sheet;
}

}  // namespace strandlab::run
