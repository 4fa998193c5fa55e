// strandlab study: many panels by one plan. strandlab compare: finished runs side by side.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "strandlab/study/command.hpp"
#include "strandlab/study/compare.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

struct StudyArguments {
  study::Command command;
  std::string keep = "panels", runner = "local";
  double memory_MB = 0;
};

using Act = void (*)(const study::Command&, run::Observer&);

CLI::App* add_act(CLI::App& study, const char* name, const char* description, StudyArguments& a, Act act) {
  auto* command = study.add_subcommand(name, description);
  command->callback([&a, act] {
    a.command.runner.keep = a.keep == "moduli" ? study::Keep::kModuli : study::Keep::kPanels;
    a.command.slurm = a.runner == "slurm";
    a.command.runner.memory_bytes = 1e6 * a.memory_MB;
    Terminal terminal;
    act(a.command, terminal);
  });
  return command;
}

void add_plan_arguments(CLI::App& command, StudyArguments& a) {
  command.add_option("PLAN", a.command.plan, "plan file (docs/studies.md)")->required();
  command.add_option("-o,--output", a.command.folder, "folder of the study; default runs/<name of the plan>")
      ->type_name("DIR");
  command.add_flag("--dry-run", a.command.dry_run, "print the plan and what it will cost, write nothing");
}

void add_work_arguments(CLI::App& command, StudyArguments& a) {
  command.add_option("--keep", a.keep, "panels, for further tests, or moduli: tables only")
      ->check(CLI::IsMember({"panels", "moduli"}))
      ->capture_default_str();
}

}  // namespace

void add_study(CLI::App& app) {
  auto* study = app.add_subcommand("study", "many panels by one plan: axes, replicates, differences (docs/studies.md)");
  study->require_subcommand(1);
  auto shared = std::make_shared<StudyArguments>();
  auto& a = *shared;
  study->callback([shared] {});  // keeps the arguments as long as the command line
  auto* run = add_act(*study, "run", "plan, run and collect; again: goes on, or extends", a, study::run);
  add_plan_arguments(*run, a);
  add_work_arguments(*run, a);
  run->add_option("--workers", a.command.runner.workers, "items at a time (default: one per core)")
      ->check(CLI::Range(1, 1024));
  run->add_option("--memory-MB", a.memory_MB, "that all workers may take (default: what is free)")
      ->check(CLI::PositiveNumber);
  run->add_option("--runner", a.runner, "local (default), or slurm: submit an array of what is missing")
      ->check(CLI::IsMember({"local", "slurm"}));
  add_plan_arguments(*add_act(*study, "plan", "write plan.csv: every item, its case, its estimate", a, study::plan), a);
  auto* item = add_act(*study, "item", "run or resume one item; exit code 0 when it is whole", a, study::item);
  item->add_option("DIR", a.command.folder, "folder of the study")->required();
  item->add_option("K", a.command.items, "number or hash of the item in plan.csv; several run in turn")->required();
  item->add_option("--threads", a.command.threads, "threads (default 1)")->check(CLI::Range(1, 1024));
  add_work_arguments(*item, a);
  auto* collect = add_act(*study, "collect", "write the tables of the items that are whole", a, study::collect);
  collect->add_option("DIR", a.command.folder, "folder of the study")->required();
  auto* list = study->add_subcommand("export", "print the items for another runner");
  list->add_option("DIR", a.command.folder, "folder of the study")->required();
  list->add_flag("--snakemake,!--parallel", a.command.snakemake, "a Snakefile, or a list for GNU parallel (default)");
  list->callback([&a] { print("{}", study::list(a.command)); });
}

void add_compare(CLI::App& app) {
  using Texts = std::vector<std::string>;
  auto runs = std::make_shared<Texts>(), csv = std::make_shared<Texts>(1);
  auto* command = app.add_subcommand("compare", "moduli of finished runs: mean, interval, paired differences");
  command->add_option("RUN", *runs, "run folders; runs of a case with other seeds are replicates")->required();
  command->add_option("--csv", csv->front(), "also write a table to this file; - prints it instead");
  command->callback([runs, csv] {
    const auto comparison = study::compare_runs(*runs);
    const bool instead = csv->front() == "-";
    print("{}", instead ? table_of(comparison).text() : text_of(comparison));
    if (!instead && !csv->front().empty()) table_of(comparison).write(csv->front());
  });
}

}  // namespace strandlab::app
