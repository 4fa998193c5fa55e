#include "strandlab/study/items.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/run/form.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;
using cases::Step;

constexpr double kPanelBytesPerParticle = 150;  // of a kept panel, HDF5

// The base case, read again for every item with other values.
class Base {
 public:
  explicit Base(const Plan& plan) : name_(plan.base) {
    const auto& ready = cases::ready_cases();
    const auto file = plan.folder / plan.base;
    std::error_code error;
    if (fs::is_regular_file(file, error)) {
      file_ = file;
    } else if (std::find(ready.begin(), ready.end(), plan.base) != ready.end()) {
      text_ = cases::resolved_text(cases::ready_case(plan.base));
    } else {
      const auto near = nearest(plan.base, ready);
      throw InputError(fmt::format("{}: base = \"{}\": neither a file in {} nor a ready case{} Ready cases: {}",
                                   plan.source, shortened(plan.base), plan.folder.string(),
                                   near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near),
                                   quoted_list(ready)));
    }
  }

  cases::Case with(const std::vector<std::string>& overrides) const {
    auto c = file_.empty() ? cases::case_from_text(text_, name_, overrides) : cases::read_case(file_, overrides);
    c.bondline_file.clear();  // the case has its number
    c.bondline_group.clear();
    c.bondline_groups.clear();
    c.threads = 1;
    return c;
  }

 private:
  std::string name_, text_;
  fs::path file_;
};

std::string override_of(const Setting& setting) {
  return setting.key + "=" + setting.value;
}

// A message on an override, "--set press.speed_m_s=4: ...", as one on the plan; others get the item before them.
std::string message_on_plan(const std::string& message, const std::vector<Setting>& settings, const std::string& item) {
  for (const auto& setting : settings) {
    const auto opening = "--set " + shortened(override_of(setting)) + ":";
    if (message.rfind(opening, 0) == 0) return setting.where + ":" + message.substr(opening.size());
  }
  return fmt::format("{}: {}", item, message);
}

std::string name_of_item(const std::vector<Setting>& settings, int replicate) {
  std::string text = "item of replicate " + std::to_string(replicate);
  for (const auto& setting : settings) text += fmt::format(", {} = {}", setting.key, shortened(shown(setting.value)));
  return text;
}

// What a cell sets in the case.
std::vector<Setting> settings_of(const Plan& plan, const std::vector<std::size_t>& cell) {
  auto settings = plan.settings;
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    const auto& block = plan.blocks[b];
    const auto& row = block.rows[cell[b]];
    for (std::size_t k = 0; k < block.keys.size(); ++k)
      if (!row[k].empty()) settings.push_back({block.keys[k], row[k], block.where});
  }
  return settings;
}

void refuse_replicates_of_a_file(const Plan& plan, const cases::Case& c) {
  if (plan.replicates == 1 || c.mat_file.empty()) return;
  throw InputError(
      fmt::format("replicates = {}, but the mat is read from mat.file: all replicates would be the same "
                  "panel. Take replicates = 1; several mats are an axis, \"mat.file\" = [...]",
                  plan.replicates));
}

PlannedItem plan_item(const Plan& plan, const Base& base, const std::vector<Setting>& settings, std::uint64_t seed) {
  std::vector<std::string> overrides;
  overrides.reserve(settings.size() + 1);
  for (const auto& setting : settings) overrides.push_back(override_of(setting));
  overrides.push_back(fmt::format("run.seed={}", seed));
  PlannedItem planned;
  auto resolved = base.with(overrides);
  refuse_replicates_of_a_file(plan, resolved);
  const auto formed = run::form(std::move(resolved));
  run::refuse_untestable(formed);
  const auto& c = formed.c;
  const auto cost = cases::estimate(c, formed.panel);
  planned.case_text = cases::resolved_text(c);
  planned.mat = std::hash<std::string>{}(mat::to_text(formed.mat));
  planned.press_seconds = cost.press_s;
  planned.disk_bytes = static_cast<double>(cost.particles * c.schedule.compactions.size()) * kPanelBytesPerParticle;
  planned.solves = static_cast<int>(c.schedule.compactions.size() * c.test.compliance_t_mm_per_MPa.size());
  planned.item.hash = cases::case_hash(c, Step::kTest);
  planned.item.pressing = cases::case_hash(c, Step::kPress);
  planned.item.seed = seed;
  planned.item.seconds = cost.press_s + cost.test_s;
  planned.item.bytes = cost.memory_bytes;
  return planned;
}

void refuse_same_item(const std::map<std::string, std::string>& names, const std::string& hash, const std::string& name,
                      const std::string& source) {
  const auto same = names.find(hash);
  if (same == names.end()) return;
  throw InputError(
      fmt::format("{}: two items are the same case: {}; and {}. A value that the base case has already, or "
                  "a key that changes no result?",
                  source, same->second, name));
}

std::uint64_t base_seed_of(const Plan& plan, const Base& base) {
  if (plan.base_seed) return *plan.base_seed;
  return base.with({}).seed;
}

std::set<std::string> pressings_of(const std::vector<PlannedItem>& items) {
  std::set<std::string> pressings;
  for (const auto& planned : items) pressings.insert(planned.item.pressing);
  return pressings;
}

// Keys whose values change the mat of a replicate, and the others.
std::vector<std::string> what_is_shared(const Plan& plan, const std::vector<PlannedItem>& items) {
  std::vector<std::string> same, other;
  const auto cells = cells_of(plan);
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    std::set<std::size_t> mats;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto rest = cells[i];
      rest[b] = 0;
      if (std::all_of(rest.begin(), rest.end(), [](std::size_t row) { return row == 0; })) mats.insert(items[i].mat);
    }
    auto& list = mats.size() > 1 ? other : same;
    list.push_back(fmt::format("{}", fmt::join(plan.blocks[b].keys, " with ")));
  }
  std::vector<std::string> lines;
  if (!same.empty()) lines.push_back(fmt::format("same mats for all values of: {}", fmt::join(same, ", ")));
  if (!other.empty())
    lines.push_back(fmt::format("other mats, of the same seeds, for each value of: {}", fmt::join(other, ", ")));
  return lines;
}

}  // namespace

std::vector<PlannedItem> items_of(const Plan& plan, run::Observer& observer) {
  const Base base(plan);
  std::vector<PlannedItem> items;
  std::map<std::string, std::string> names;
  const auto cells = cells_of(plan);
  const auto all = static_cast<double>(cells.size()) * plan.replicates;
  const auto first_seed = base_seed_of(plan, base);
  for (int replicate = 1; replicate <= plan.replicates; ++replicate) {
    for (const auto& cell : cells) {
      run::stop_if_cancelled(observer);
      const auto number = items.size() + 1;
      observer.progress({"plan", static_cast<double>(number) / all, fmt::format("item {} of {}", number, all)});
      const auto settings = settings_of(plan, cell);
      const auto name = name_of_item(settings, replicate);
      try {
        items.push_back(plan_item(plan, base, settings, first_seed + static_cast<std::uint64_t>(replicate) - 1));
      } catch (const InputError& e) {
        throw InputError(message_on_plan(e.what(), settings, plan.source + ": " + name));
      }
      auto& item = items.back().item;
      refuse_same_item(names, item.hash, name, plan.source);
      names.emplace(item.hash, name);
      item.number = static_cast<int>(number);
      item.replicate = replicate;
      item.values = values_of(plan, cell);
    }
  }
  return items;
}

std::vector<std::string> summary_of(const Plan& plan, const std::vector<PlannedItem>& items, int workers) {
  double seconds = 0, disk = 0, memory = 0;
  long long solves = 0;
  std::set<std::string> pressings;
  for (const auto& planned : items) {
    const bool shared = !pressings.insert(planned.item.pressing).second;
    seconds += planned.item.seconds - (shared ? planned.press_seconds : 0);
    if (!shared) disk += planned.disk_bytes;
    solves += planned.solves;
    memory = std::max(memory, planned.item.bytes);
  }
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} cell(s) x {} replicate(s) = {} item(s): {} pressing(s), {} solve(s)",
                              items.size() / static_cast<std::size_t>(plan.replicates), plan.replicates, items.size(),
                              pressings_of(items).size(), solves));
  const auto shared = what_is_shared(plan, items);
  lines.insert(lines.end(), shared.begin(), shared.end());
  lines.push_back(fmt::format("estimated time: {} of one core, {} on {}", run::duration(seconds),
                              run::duration(seconds / workers), workers));
  lines.push_back(
      fmt::format("estimated memory: {:.0f} MB a worker; disk {:.0f} MB, next to nothing with --keep moduli",
                  memory / 1e6, disk / 1e6));
  return lines;
}

}  // namespace strandlab::study
