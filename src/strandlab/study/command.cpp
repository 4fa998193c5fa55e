#include "strandlab/study/command.hpp"

#include <fmt/format.h>

#include <csignal>
#include <optional>
#include <sstream>

#include "strandlab/core/error.hpp"
#include "strandlab/study/cluster.hpp"
#include "strandlab/study/collect.hpp"
#include "strandlab/study/folder.hpp"
#include "strandlab/study/item.hpp"
#include "strandlab/study/items.hpp"
#include "strandlab/study/page.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t asked_to_stop = 0;

// Stops the work when the process gets SIGUSR1, which a queue sends before it kills.
class Interruptible final : public run::Observer {
 public:
  explicit Interruptible(run::Observer& observer) : observer_(observer) {
    asked_to_stop = 0;
    before_ = std::signal(SIGUSR1, [](int) { asked_to_stop = 1; });
  }
  ~Interruptible() override { std::signal(SIGUSR1, before_); }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  void say(const std::string& line) override { observer_.say(line); }
  void warn(const std::string& line) override { observer_.warn(line); }
  void progress(const run::Progress& progress) override { observer_.progress(progress); }
  bool cancelled() override { return asked_to_stop != 0 || observer_.cancelled(); }

 private:
  run::Observer& observer_;
  void (*before_)(int) = SIG_DFL;
};

void say_lines(const std::string& text, run::Observer& observer) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) observer.say(line);
}

// The plan in its folder; a dry run tells it and writes nothing.
Study planned(const Command& command, run::Observer& observer) {
  const auto plan = read_plan(command.plan);
  const auto items = items_of(plan, observer);
  if (command.dry_run) say_lines(plan_text(plan, items), observer);
  for (const auto& line : summary_of(plan, items, worker_count(command.runner, items.size())))
    observer.say("study: " + line);
  const auto folder = command.folder.empty() ? fs::path("runs") / command.plan.stem() : command.folder;
  return command.dry_run ? study_of(plan, items, folder) : write_study(plan, items, folder);
}

void tell(const Study& study, const Collected& collected, run::Observer& observer) {
  for (const auto& line : collected.untestable) observer.warn(line);
  observer.say(
      fmt::format("study: {} of {} items are whole -> {}: results.csv, summary.csv, effects.csv, profiles.csv, "
                  "press.csv",
                  collected.whole, collected.all, study.folder.string()));
  try {
    observer.say(fmt::format("study: report: {}", write_page(study, collected).string()));
  } catch (const InputError& e) {
    observer.warn(fmt::format("no report.html: {}", e.what()));
  }
}

}  // namespace

void plan(const Command& command, run::Observer& observer) {
  const auto study = planned(command, observer);
  if (!command.dry_run) observer.say(fmt::format("study: plan -> {}", study.file("plan.csv").string()));
}

void run(const Command& command, run::Observer& observer) {
  if (command.slurm && !command.dry_run) refuse_missing_sbatch();
  const auto study = planned(command, observer);
  if (command.slurm) submit_to_slurm(study, command.runner.keep, command.dry_run, observer);
  if (command.slurm || command.dry_run) return;
  const auto failures = run_items(study, command.runner, observer);
  tell(study, collect(study), observer);
  if (failures.empty()) return;
  throw RunError(fmt::format("{} of {} items failed, the first is item {}: {}. strandlab study run tries them again",
                             failures.size(), study.items.size(), failures.front().item, failures.front().error));
}

void item(const Command& command, run::Observer& observer) {
  const auto study = open_study(command.folder);
  Interruptible interruptible(observer);
  for (const auto& name : command.items) {
    const auto& item = find_item(study, name);
    const auto claim = Claim::wait(study.item_folder(item));
    run_item(study, item, {command.threads, command.runner.keep}, std::nullopt, interruptible);
    observer.say(fmt::format("study: item {} is whole", item.number));
  }
}

void collect(const Command& command, run::Observer& observer) {
  const auto study = open_study(command.folder);
  const auto collected = collect(study);
  for (const auto& failure : collected.failures)
    observer.warn(fmt::format("item {} failed: {}", failure.item, failure.error));
  tell(study, collected, observer);
}

std::string list(const Command& command) {
  const auto study = open_study(command.folder);
  return command.snakemake ? snakefile(study, this_program()) : parallel_list(study, this_program());
}

}  // namespace strandlab::study
