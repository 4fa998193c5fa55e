#include "strandlab/study/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/glue/measured.hpp"
#include "strandlab/report/html.hpp"
#include "strandlab/study/bands.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::study {
namespace {

using Json = nlohmann::json;

constexpr int kFewReplicates = 5;          // fewer: an interval of a mean is wider than the scatter itself
constexpr std::size_t kFindings = 12;      // effects that are told in words
constexpr std::size_t kShownFailures = 5;  // of items, in words

std::string key_in_short(const std::string& key) {
  return key.rfind("kinds.", 0) == 0 ? key.substr(6) : key.substr(key.find('.') + 1);
}

// "speed_m_s = 16, core.law = crushing"
std::string name_of_cell(const Plan& plan, const std::vector<std::size_t>& cell) {
  const auto keys = varied_keys(plan);
  const auto values = values_of(plan, cell);
  std::string name;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (values[i].empty()) continue;  // as the base case has it
    name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", key_in_short(keys[i]), shown(values[i]));
  }
  return name.empty() ? (keys.empty() ? "all panels" : "base case") : name;
}

// "16 · crushing", for legends.
std::string values_of_cell(const Plan& plan, const std::vector<std::size_t>& cell) {
  auto values = values_of(plan, cell);
  if (values.size() < 2) return name_of_cell(plan, cell);
  for (auto& value : values) value = value.empty() ? "base" : shown(value);
  return fmt::format("{}", fmt::join(values, " · "));
}

std::string lower(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string name_of_test(const std::string& test) {
  return lower(vtest::label(vtest::test_from_name(test)));
}

std::string name_of_glue(double compliance) {
  return std::isfinite(compliance) ? glue::name_of_bond(compliance) : "glue as varied";
}

std::vector<report::Sheet::Fact> board_of(const Study& study, const Collected& collected) {
  const auto& plan = study.plan;
  std::vector<report::Sheet::Fact> facts{{"Base", as_text(plan.base)}};
  for (const auto& block : plan.blocks) {
    std::vector<std::string> values;
    for (const auto& row : block.rows) {
      std::vector<std::string> shown_values;
      shown_values.reserve(row.size());
      for (const auto& value : row) shown_values.push_back(value.empty() ? "base" : shown(value));
      values.push_back(fmt::format("{}", fmt::join(shown_values, " / ")));
    }
    const bool many = values.size() > 8;
    if (many) values.resize(8);
    facts.push_back(
        {"Varied", fmt::format("{}: {}{}", fmt::join(block.keys, ", "), fmt::join(values, ", "), many ? ", ..." : "")});
  }
  facts.push_back({"Panels", fmt::format("{} of {} whole: {} cell(s), {} replicate(s) of each", collected.whole,
                                         collected.all, cells_of(plan).size(), plan.replicates)});
  return facts;
}

struct Told {
  double size = 0;  // of the effect, by which they are sorted
  report::Finding finding;
};

// Main effects at the last state with the glue in the middle of the list.
std::vector<report::Finding> effects_in_words(const Collected& collected) {
  std::map<std::string, std::pair<int, int>> last;  // by test: last state, glues
  for (const auto& effect : collected.effects) {
    auto& [state, glues] = last[effect.finding.measure.test];
    state = std::max(state, effect.finding.measure.state);
    glues = std::max(glues, effect.finding.measure.glue);
  }
  std::vector<Told> told;
  for (const auto& effect : collected.effects) {
    const auto& [measure, compaction, density, compliance, s, reference] = effect.finding;
    const auto& [state, glues] = last[measure.test];
    if (measure.state != state || measure.glue != (glues + 1) / 2 || !(reference > 0)) continue;
    const auto percent = [&reference = reference](double modulus) {
      return fmt::format("{:+.1f}", 100 * modulus / reference);
    };
    auto text =
        fmt::format("{} {} against {}: {} modulus {} % ({}, {:.0f} kg/m³)", effect.factor, effect.value, effect.against,
                    name_of_test(measure.test), percent(s.mean), name_of_glue(compliance), density);
    if (s.n < 2 || !std::isfinite(s.low))
      text += ", of one pair: no interval.";
    else if (s.low <= 0 && s.high >= 0)
      text += fmt::format(", not told apart from chance: 95 % interval {} to {} %, {} pairs.", percent(s.low),
                          percent(s.high), s.n);
    else
      text += fmt::format(", 95 % interval {} to {} %, {} pairs.", percent(s.low), percent(s.high), s.n);
    told.push_back({std::abs(s.mean / reference),
                    {report::Level::kNote, text, report::About::kBoard, "tornado",
                     "docs/studies.md, \"What is paired, and why\""}});
  }
  std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) { return a.size > b.size; });
  if (told.size() > kFindings) told.resize(kFindings);
  std::vector<report::Finding> findings;
  findings.reserve(told.size());
  for (auto& one : told) findings.push_back(std::move(one.finding));
  return findings;
}

std::vector<report::Finding> findings_of(const Study& study, const Collected& collected) {
  auto findings = effects_in_words(collected);
  const auto about_work = [&findings](report::Level level, std::string text) {
    findings.push_back({level, std::move(text), report::About::kCalculation});
  };
  for (std::size_t i = 0; i < std::min(kShownFailures, collected.failures.size()); ++i)
    about_work(report::Level::kWarning,
               fmt::format("Item {} failed: {}", collected.failures[i].item, as_text(collected.failures[i].error)));
  if (collected.failures.size() > kShownFailures)
    about_work(report::Level::kWarning,
               fmt::format("{} more items failed.", collected.failures.size() - kShownFailures));
  for (const auto& line : collected.untestable) about_work(report::Level::kWarning, as_text(line));
  if (collected.whole < collected.all)
    about_work(report::Level::kNote, fmt::format("{} of {} items are whole; the rest is not in these numbers.",
                                                 collected.whole, collected.all));
  else
    about_work(report::Level::kGood, fmt::format("All {} items are whole.", collected.all));
  if (study.plan.replicates < kFewReplicates)
    about_work(report::Level::kNote,
               fmt::format("{} replicate(s): five or more give intervals of use.", study.plan.replicates));
  return findings;
}

// Of the last state, by test: a row for each cell, a column for each quality of glue.
std::vector<report::Sheet::Table> tables_of(const Study& study, const Collected& collected) {
  std::map<std::string, int> last;
  for (const auto& cell : collected.cells)
    for (const auto& f : cell) last[f.measure.test] = std::max(last[f.measure.test], f.measure.state);
  const auto cells = cells_of(study.plan);
  std::vector<report::Sheet::Table> tables;
  for (const auto& [test, state] : last) {
    report::Sheet::Table table{"table-means-" + test, "", {"cell"}, {}};
    std::map<int, std::string> glues;
    double density = 0;
    for (const auto& cell : collected.cells) {
      for (const auto& f : cell) {
        if (f.measure.test != test || f.measure.state != state) continue;
        const auto name = name_of_glue(f.compliance_t_mm_per_MPa);
        const auto [place, is_new] = glues.emplace(f.measure.glue, name);
        if (!is_new && place->second != name) place->second = fmt::format("glue {}", f.measure.glue);
        density = f.density_kg_m3;
      }
    }
    table.caption = fmt::format("Mean {} modulus, MPa, ± half its 95 % interval, of the last state ({:.0f} kg/m³)",
                                name_of_test(test), density);
    for (const auto& [number, name] : glues) table.columns.push_back(name);
    for (std::size_t i = 0; i < collected.cells.size(); ++i) {
      std::vector<std::string> row{name_of_cell(study.plan, cells[i])};
      row.resize(table.columns.size(), "–");
      for (const auto& f : collected.cells[i]) {
        if (f.measure.test != test || f.measure.state != state) continue;
        const auto column = static_cast<std::size_t>(std::distance(glues.begin(), glues.find(f.measure.glue))) + 1;
        const auto& s = f.modulus_MPa;
        row[column] = std::isfinite(s.high)
                          ? fmt::format("{} ± {}", report::shown(s.mean, 4), report::shown(s.high - s.mean, 2))
                          : report::shown(s.mean, 4);
      }
      table.rows.push_back(std::move(row));
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

// Of the mats of a cell: sd over mean of the first test at the last state, the mean of the cells.
std::vector<report::Sheet::Headline> headlines_of(const Collected& collected) {
  std::vector<report::Sheet::Headline> list{
      {"Panels", fmt::format("{}", collected.whole), fmt::format("of {}", collected.all), "pressed and tested"}};
  double sum = 0;
  int n = 0;
  std::string test;
  for (const auto& cell : collected.cells) {
    if (cell.empty()) continue;
    const auto& f = cell.back();  // of the last state and test
    if (!(f.modulus_MPa.sd > 0)) continue;
    sum += f.modulus_MPa.sd / f.modulus_MPa.mean;
    test = name_of_test(f.measure.test);
    ++n;
  }
  if (n > 0)
    list.push_back({"Scatter between mats", fmt::format("{:.1f}", 100 * sum / n), "%",
                    fmt::format("standard deviation of the {} modulus within a cell, over its mean", test)});
  return list;
}

report::Sheet sheet_of(const Study& study, const Collected& collected) {
  report::Sheet sheet;
  sheet.title = as_text(std::filesystem::absolute(study.folder).lexically_normal().filename().string());
  sheet.board = board_of(study, collected);
  sheet.limits = {
      "Differences are taken mat by mat, of replicates that share a seed; intervals are Student's t over replicates.",
      "They hold the chance of mats, not that of strands, glue and model."};
  sheet.headlines = headlines_of(collected);
  sheet.findings = findings_of(study, collected);
  sheet.tables = tables_of(study, collected);
  return sheet;
}

Json data_of(const Study& study, const Collected& collected) {
  const auto& plan = study.plan;
  Json cells = Json::array(), items = Json::array(), tests = Json::object(), glues = Json::array(),
       tables = Json::object();
  for (const auto& cell : cells_of(plan))
    cells.push_back({{"name", name_of_cell(plan, cell)}, {"values", values_of_cell(plan, cell)}});
  const std::set<const Item*> whole(collected.items.begin(), collected.items.end());
  std::map<int, std::string> errors;
  for (const auto& failure : collected.failures) errors[failure.item] = as_text(failure.error);
  for (const auto& item : study.items) {
    items.push_back({{"number", item.number},
                     {"hash", item.hash},
                     {"replicate", item.replicate},
                     {"seed", std::to_string(item.seed)},
                     {"cell", static_cast<std::size_t>(item.number - 1) % cells.size()},
                     {"state", whole.count(&item) > 0          ? "whole"
                               : errors.count(item.number) > 0 ? "failed"
                                                               : "missing"}});
  }
  for (const auto& name : vtest::test_names()) tests[name] = vtest::label(vtest::test_from_name(name));
  std::set<double> compliances;
  for (const auto& cell : collected.cells)
    for (const auto& f : cell)
      if (std::isfinite(f.compliance_t_mm_per_MPa)) compliances.insert(f.compliance_t_mm_per_MPa);
  for (const double compliance : compliances)
    glues.push_back({{"compliance_t_mm_per_MPa", compliance}, {"name", glue::name_of_bond(compliance)}});
  for (const auto* name : {"summary.csv", "effects.csv"}) {
    if (auto text = files::read_text(study.file(name))) tables[name] = *text;
  }
  tables["stress_bands"] = stress_bands(study, collected.items).text();
  tables["profile_bands"] = profile_bands(study, collected.items).text();
  return {{"format", 2},
          {"study",
           {{"keys", varied_keys(plan)},
            {"cells", cells},
            {"items", items},
            {"plan", as_text(plan.text)},
            {"words", {{"tests", tests}, {"glues", glues}}},
            {"tables", tables}}}};
}

}  // namespace

std::filesystem::path write_page(const Study& study, const Collected& collected) {
  auto file = study.file("report.html");
  files::write_atomically(
      file, report::filled_page(report::empty_page(), sheet_of(study, collected), data_of(study, collected)));
  return file;
}

}  // namespace strandlab::study
