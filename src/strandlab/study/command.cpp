#include "strandlab/study/command.hpp"

#include <fmt/format.h>

#include <optional>
#include <sstream>

#include "strandlab/core/error.hpp"
#include "strandlab/study/collect.hpp"
#include "strandlab/study/folder.hpp"
#include "strandlab/study/item.hpp"
#include "strandlab/study/items.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;

void say_lines(const std::string& text, run::Observer& observer) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) observer.say(line);
}

// The plan in its folder; none where it is only to be told.
std::optional<Study> planned(const Command& command, run::Observer& observer) {
  const auto plan = read_plan(command.plan);
  const auto items = items_of(plan, observer);
  if (command.dry_run) say_lines(plan_text(plan, items), observer);
  for (const auto& line : summary_of(plan, items, worker_count(command.runner, items.size())))
    observer.say("study: " + line);
  if (command.dry_run) return std::nullopt;
  const auto folder = command.folder.empty() ? fs::path("runs") / command.plan.stem() : command.folder;
  return write_study(plan, items, folder);
}

void tell(const Study& study, const Collected& collected, run::Observer& observer) {
  for (const auto& line : collected.untestable) observer.warn(line);
  observer.say(
      fmt::format("study: {} of {} items are whole -> {}: results.csv, summary.csv, effects.csv, profiles.csv, "
                  "press.csv",
                  collected.whole, collected.all, study.folder.string()));
}

}  // namespace

void plan(const Command& command, run::Observer& observer) {
  if (const auto study = planned(command, observer))
    observer.say(fmt::format("study: plan -> {}", study->file("plan.csv").string()));
}

void run(const Command& command, run::Observer& observer) {
  const auto study = planned(command, observer);
  if (!study) return;
  const auto failures = run_items(*study, command.runner, observer);
  tell(*study, collect(*study), observer);
  if (failures.empty()) return;
  throw RunError(fmt::format("{} of {} items failed, the first is item {}: {}. strandlab study run tries them again",
                             failures.size(), study->items.size(), failures.front().item, failures.front().error));
}

void item(const Command& command, run::Observer& observer) {
  const auto study = open_study(command.folder);
  const auto& item = find_item(study, command.item);
  const auto claim = Claim::wait(study.item_folder(item));
  run_item(study, item, {command.threads, command.runner.keep}, std::nullopt, observer);
  observer.say(fmt::format("study: item {} is whole", item.number));
}

void collect(const Command& command, run::Observer& observer) {
  const auto study = open_study(command.folder);
  const auto collected = collect(study);
  for (const auto& failure : collected.failures)
    observer.warn(fmt::format("item {} failed: {}", failure.item, failure.error));
  tell(study, collected, observer);
}

}  // namespace strandlab::study
