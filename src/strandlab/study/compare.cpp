#include "strandlab/study/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/record.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::study {
namespace {

using Json = nlohmann::json;
using Lines = std::vector<std::string>;

struct FinishedRun {
  std::string folder, name;
  Lines lines;      // what its results depend on but for the mat's chance
  std::string mat;  // "seed 3": what pairs it
  std::vector<Observation> observations;
};

bool is_of_chance(const std::string& line) {
  return line.rfind("run.seed = ", 0) == 0 || line.rfind("mat.file = ", 0) == 0;
}

std::vector<Observation> observations_of(const Json& record) {
  std::vector<Observation> list;
  const auto tested = run::tested_from_json(record.at("steps").at("test").at("states"));
  for (std::size_t s = 0; s < tested.size(); ++s) {
    const double density = record.at("states").at(s).at("density_kg_m3");
    std::map<std::string, int> glues;
    for (const auto& m : tested[s].result.moduli) {
      const std::string test = vtest::name(m.kind);
      list.push_back({0,
                      0,
                      {static_cast<int>(s) + 1, test, ++glues[test]},
                      tested[s].compaction,
                      density,
                      m.compliance_t_mm_per_MPa,
                      m.modulus_MPa});
    }
  }
  return list;
}

FinishedRun read_run(const std::string& folder) {
  const auto record = run::read_run_record(folder);
  const auto& steps = record.at("steps");
  if (!steps.contains("test") || !steps["test"].value("finished", false))
    throw InputError(
        fmt::format("{}: this run is not finished: its tests are not done; strandlab run goes on with it", folder));
  const auto c = run::read_run_case(folder);
  FinishedRun run{folder, record.value("case_name", "case"), cases::identity(c, cases::Step::kTest), {}, {}};
  std::erase_if(run.lines, is_of_chance);
  run.mat = c.mat_file.empty() ? fmt::format("run.seed = {}", c.seed) : "mat.file = " + c.mat_file;
  try {
    run.observations = observations_of(record);
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("{}: not the record of a strandlab run's tests ({})", folder + "/run.json", e.what()));
  }
  return run;
}

// Runs of a case, by the first of them.
using Groups = std::vector<std::vector<FinishedRun>>;

Groups grouped(const std::vector<std::string>& folders) {
  Groups groups;
  for (const auto& folder : folders) {
    auto run = read_run(folder);
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.front().lines == run.lines; });
    if (group == groups.end()) group = groups.insert(group, std::vector<FinishedRun>());
    for (const auto& other : *group) {
      if (other.mat == run.mat)
        throw InputError(fmt::format("{} and {} are the same panel ({}); replicates differ in run.seed or mat.file",
                                     other.folder, folder, run.mat));
    }
    group->push_back(std::move(run));
  }
  return groups;
}

// Lines of a group that not all groups have.
Lines own_lines(const Groups& groups, std::size_t which) {
  Lines own;
  for (const auto& line : groups[which].front().lines) {
    const bool everywhere = std::all_of(groups.begin(), groups.end(), [&](const auto& group) {
      const auto& lines = group.front().lines;
      return std::find(lines.begin(), lines.end(), line) != lines.end();
    });
    if (!everywhere) own.push_back(line);
  }
  return own;
}

std::vector<std::string> names_of(const Groups& groups) {
  constexpr std::size_t kMostLines = 3;
  std::vector<std::string> names;
  std::set<std::string> different;
  for (const auto& group : groups) {
    names.push_back(group.front().name);
    different.insert(names.back());
  }
  if (different.size() == groups.size()) return names;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    auto own = own_lines(groups, i);
    const auto all = own.size();
    own.resize(std::min(all, kMostLines));
    if (all > kMostLines) own.push_back(fmt::format("{} more", all - kMostLines));
    if (all > 0) names[i] += fmt::format(" ({})", fmt::join(own, "; "));
  }
  return names;
}

std::string cells_of_finding(const Finding& f) {
  const auto& s = f.modulus_MPa;
  return fmt::format("{:>11.4g}{:>10.1f}  {:<22}{:>9.4g}{:>4}{:>11.1f}{:>10.1f}{:>11.1f}{:>11.1f}\n", f.compaction,
                     f.density_kg_m3, f.measure.test, f.compliance_t_mm_per_MPa, s.n, s.mean, s.sd, s.low, s.high);
}

}  // namespace

Comparison compare_runs(const std::vector<std::string>& folders) {
  const auto groups = grouped(folders);
  const auto names = names_of(groups);
  Observations observations;
  std::map<std::string, std::uint64_t> mats;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const auto& run : groups[g]) {
      const auto number = mats.emplace(run.mat, mats.size()).first->second;
      for (auto o : run.observations) {
        o.cell = g;
        o.replicate = number;
        observations.add(o);
      }
    }
  }
  Comparison comparison;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Comparison::Group group{names[g], {}, observations.of_cell(g), {}};
    for (const auto& run : groups[g]) group.runs.push_back(run.folder);
    if (g > 0) group.differences = observations.difference({g}, {0});
    comparison.groups.push_back(std::move(group));
  }
  return comparison;
}

files::CsvTable table_of(const Comparison& comparison) {
  files::CsvTable table({"contrast", "case", "compaction", "test", "compliance_t_mm_per_MPa", "n", "mean_MPa", "sd_MPa",
                         "low_MPa", "high_MPa", "reference_MPa", "state", "density_kg_m3"});
  const auto add = [&table](const std::string& contrast, const std::string& name, const Finding& f, double reference) {
    const auto& s = f.modulus_MPa;
    table.add_row({contrast, name, f.compaction, f.measure.test, f.compliance_t_mm_per_MPa, static_cast<long long>(s.n),
                   s.mean, s.sd, s.low, s.high, reference, static_cast<long long>(f.measure.state), f.density_kg_m3});
  };
  for (const auto& group : comparison.groups)
    for (const auto& f : group.moduli) add("", group.name, f, std::nan(""));
  for (const auto& group : comparison.groups) {
    const auto contrast = fmt::format("{} - {}", group.name, comparison.groups.front().name);
    for (const auto& f : group.differences) add(contrast, group.name, f, f.reference_MPa);
  }
  return table;
}

std::string text_of(const Comparison& comparison) {
  const auto head = fmt::format("{:>11}{:>10}  {:<22}{:>9}{:>4}{:>11}{:>10}{:>11}{:>11}\n", "compaction", "kg/m3",
                                "test", "1/D_t", "n", "mean MPa", "sd", "low", "high");
  std::string text;
  for (const auto& group : comparison.groups) {
    text += fmt::format("{}: {} run(s)\n{}", group.name, group.runs.size(), head);
    for (const auto& f : group.moduli) text += cells_of_finding(f);
  }
  for (std::size_t g = 1; g < comparison.groups.size(); ++g) {
    const auto& group = comparison.groups[g];
    text += fmt::format("{} less {}, paired by seed", group.name, comparison.groups.front().name);
    text += group.differences.empty() ? ": no seed in common\n" : "\n" + head;
    for (const auto& f : group.differences) text += cells_of_finding(f);
  }
  return text + "low, high: 95 % t-interval of the mean; 1/D_t in mm/MPa\n";
}

}  // namespace strandlab::study
