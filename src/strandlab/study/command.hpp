// What `strandlab study` does, told to an observer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/run/observer.hpp"
#include "strandlab/study/runner.hpp"

namespace strandlab::study {

struct Command {
  std::filesystem::path plan;      // of plan() and run()
  std::filesystem::path folder;    // of the study; plan() and run(): empty for runs/<name of the plan>
  std::vector<std::string> items;  // of item(): numbers or hashes
  int threads = 1;                 // of item()
  bool dry_run = false;            // of plan() and run(): tell the plan and its cost, write nothing
  bool slurm = false;              // of run(): submit the items to Slurm instead
  bool snakemake = false;          // of list(): a Snakefile, else a list for GNU parallel
  RunnerOptions runner;
};

// Writes the plan. Throws as items_of() and write_study().
void plan(const Command& command, run::Observer& observer);
// Plans, runs what is not whole and collects, or leaves both to Slurm. Throws also as run_items(), and RunError, all
// else done, where items failed.
void run(const Command& command, run::Observer& observer);
// Runs items one after another, having waited for who is working on them. Throws as run_item(), and Cancelled, a
// checkpoint left, when the process gets SIGUSR1.
void item(const Command& command, run::Observer& observer);
// Collects the items that are whole, and says what is not.
void collect(const Command& command, run::Observer& observer);

// The items for another runner: a list for GNU parallel, or a Snakefile.
std::string list(const Command& command);

}  // namespace strandlab::study
