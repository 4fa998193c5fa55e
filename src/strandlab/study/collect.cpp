#include "strandlab/study/collect.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/csv.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/study/effects.hpp"
#include "strandlab/study/item.hpp"
#include "strandlab/study/observations.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::study {
namespace {

using Row = std::vector<files::CsvCell>;
using Columns = std::vector<std::string>;

struct WholeItem {
  const Item* item = nullptr;
  ItemRecord record;
};

Columns joined(Columns first, const Columns& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

Columns item_columns(const Plan& plan) {
  return joined({"item", "replicate"}, varied_keys(plan));
}

Row item_cells(const Item& item) {
  Row row{static_cast<long long>(item.number), static_cast<long long>(item.replicate)};
  for (const auto& value : item.values) row.emplace_back(shown(value));
  return row;
}

// The moduli of an item in the order of its case.
std::vector<Observation> observations_of(const WholeItem& whole, std::size_t cell) {
  std::vector<Observation> list;
  for (std::size_t s = 0; s < whole.record.tested.size(); ++s) {
    const auto& state = whole.record.states[s];
    std::map<std::string, int> glues;  // seen so far of each test
    for (const auto& m : whole.record.tested[s].result.moduli) {
      const std::string test = vtest::name(m.kind);
      list.push_back({cell,
                      static_cast<std::uint64_t>(whole.item->replicate),
                      {static_cast<int>(s) + 1, test, ++glues[test]},
                      state.compaction,
                      state.density_kg_m3,
                      m.compliance_t_mm_per_MPa,
                      m.modulus_MPa});
    }
  }
  return list;
}

void write_results(const Study& study, const std::vector<WholeItem>& items) {
  files::CsvTable table(joined(item_columns(study.plan), {"compaction", "test", "compliance_t_mm_per_MPa",
                                                          "modulus_MPa", "state", "density_kg_m3"}));
  for (const auto& whole : items) {
    for (const auto& o : observations_of(whole, 0)) {
      auto row = item_cells(*whole.item);
      row.insert(row.end(), {o.compaction, o.measure.test, o.compliance_t_mm_per_MPa, o.modulus_MPa,
                             static_cast<long long>(o.measure.state), o.density_kg_m3});
      table.add_row(std::move(row));
    }
  }
  table.write(study.file("results.csv"));
}

// The lines of each pressing's table with the item before them.
void write_joined(const Study& study, const std::vector<WholeItem>& items, const std::string& name,
                  const std::string& out) {
  std::string text;
  for (const auto& whole : items) {
    const auto table = files::read_text(study.pressing_folder(*whole.item) / name);
    if (!table) continue;  // as --keep nothing of another machine
    std::istringstream lines(*table);
    std::string line;
    std::getline(lines, line);
    files::CsvTable head(item_columns(study.plan));
    head.add_row(item_cells(*whole.item));
    const auto both = head.text();  // header and one row, each ended
    const auto end = both.find('\n');
    if (text.empty()) text = both.substr(0, end) + "," + line + "\n";
    const auto opening = both.substr(end + 1, both.size() - end - 2) + ",";
    while (std::getline(lines, line)) text += opening + line + "\n";
  }
  files::write_atomically(study.file(out), text);
}

const Columns kMeasureColumns{"compaction", "test", "compliance_t_mm_per_MPa"};

void add_measure(Row& row, const Finding& f) {
  row.insert(row.end(), {f.compaction, f.measure.test, f.compliance_t_mm_per_MPa});
}

void add_statistics(Row& row, const Finding& f) {
  const auto& s = f.modulus_MPa;
  row.insert(row.end(), {static_cast<long long>(s.n), s.mean, s.sd, s.low, s.high});
}

void write_summary(const Study& study, const Observations& observations) {
  const auto& plan = study.plan;
  const auto cells = cells_of(plan);
  files::CsvTable table(
      joined(joined(joined({"contrast"}, varied_keys(plan)), kMeasureColumns),
             {"n", "mean_MPa", "sd_MPa", "low_MPa", "high_MPa", "reference_MPa", "state", "density_kg_m3"}));
  const auto add = [&](const std::string& contrast, const std::vector<std::string>& values,
                       const std::vector<Finding>& findings) {
    for (const auto& f : findings) {
      Row row{contrast};
      for (const auto& value : values) row.emplace_back(value);
      add_measure(row, f);
      add_statistics(row, f);
      row.insert(row.end(), {f.reference_MPa, static_cast<long long>(f.measure.state), f.density_kg_m3});
      table.add_row(std::move(row));
    }
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    auto values = values_of(plan, cells[i]);
    for (auto& value : values) value = shown(value);
    auto findings = observations.of_cell(i);
    for (auto& f : findings) f.reference_MPa = std::nan("");
    add("", values, findings);
  }
  for (const auto& pair : contrasted_cells(plan))
    add(pair.name, pair.values, observations.difference({pair.first}, {pair.second}));
  table.write(study.file("summary.csv"));
}

void write_effects(const Study& study, const std::vector<Effect>& effects) {
  files::CsvTable table(joined(joined({"factor", "value", "against"}, kMeasureColumns),
                               {"n", "effect_MPa", "sd_MPa", "low_MPa", "high_MPa", "reference_MPa", "state"}));
  for (const auto& effect : effects) {
    Row row{effect.factor, effect.value, effect.against};
    add_measure(row, effect.finding);
    add_statistics(row, effect.finding);
    row.insert(row.end(), {effect.finding.reference_MPa, static_cast<long long>(effect.finding.measure.state)});
    table.add_row(std::move(row));
  }
  table.write(study.file("effects.csv"));
}

}  // namespace

Collected collect(const Study& study) {
  Collected collected;
  collected.all = study.items.size();
  std::vector<WholeItem> items;
  Observations observations;
  const auto cells = cells_of(study.plan).size();
  for (const auto& item : study.items) {
    auto record = read_record(study, item);
    if (!record.error.empty()) collected.failures.push_back({item.number, record.error});
    if (!record.whole) continue;
    for (const auto& state : record.tested)
      if (state.not_testable)
        collected.untestable.push_back(fmt::format("item {}, compaction {}: no moduli: {}", item.number,
                                                   state.compaction, state.not_testable->reason));
    items.push_back({&item, std::move(record)});
    for (const auto& o : observations_of(items.back(), static_cast<std::size_t>(item.number - 1) % cells))
      observations.add(o);
  }
  collected.whole = items.size();
  write_results(study, items);
  write_joined(study, items, "profile.csv", "profiles.csv");
  write_joined(study, items, "press.csv", "press.csv");
  write_summary(study, observations);
  collected.effects = main_effects(study.plan, observations);
  write_effects(study, collected.effects);
  for (const auto& item : items) collected.items.push_back(item.item);
  for (std::size_t i = 0; i < cells; ++i) collected.cells.push_back(observations.of_cell(i));
  return collected;
}

}  // namespace strandlab::study
