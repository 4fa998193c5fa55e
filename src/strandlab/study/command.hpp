// What `strandlab study` does, told to an observer.
#pragma once

#include <filesystem>
#include <string>

#include "strandlab/run/observer.hpp"
#include "strandlab/study/runner.hpp"

namespace strandlab::study {

struct Command {
  std::filesystem::path plan;    // of plan() and run()
  std::filesystem::path folder;  // of the study; plan() and run(): empty for runs/<name of the plan>
  std::string item;              // of item(): number or hash
  int threads = 1;               // of item()
  bool dry_run = false;          // of plan() and run(): tell the plan and its cost, write nothing
  RunnerOptions runner;
};

// Writes the plan. Throws as items_of() and write_study().
void plan(const Command& command, run::Observer& observer);
// Plans, runs what is not whole and collects. Throws also as run_items(), and RunError, all else done, where items
// failed.
void run(const Command& command, run::Observer& observer);
// Runs one item, having waited for who is working on it. Throws as run_item().
void item(const Command& command, run::Observer& observer);
// Collects the items that are whole, and says what is not.
void collect(const Command& command, run::Observer& observer);

}  // namespace strandlab::study
