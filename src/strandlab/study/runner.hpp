// Items of a study on this machine, several at a time.
#pragma once

#include <string>
#include <vector>

#include "strandlab/run/observer.hpp"
#include "strandlab/study/folder.hpp"
#include "strandlab/study/item.hpp"

namespace strandlab::study {

struct RunnerOptions {
  int workers = 0;          // processes at a time; 0: one per core
  double memory_bytes = 0;  // that all of them may take by the estimates; 0: what is free now
  Keep keep = Keep::kPanels;
};

// Workers of a study that runs `items` items on this machine: what the options say, at most one per item.
int worker_count(const RunnerOptions& options, std::size_t items);

struct Failure {
  int item = 0;  // its number
  std::string error;
};

// Runs all items that are not whole, each in a process of its own, forked from this one: one that crashes or runs out
// of memory takes no other with it, its memory comes back, and it starts at once, which a program that is started anew
// does not. An item that another `study run` is working on is left to it, and waited for. One that fails is recorded
// and does not stop the others; it is tried again by the next call. Returns those that failed. If this process is
// killed its workers end with it. Throws Cancelled, its workers ended, when the observer says so, and RunError where no
// process can be forked: where this one has other threads, which OpenBLAS starts at its first use unless it is told not
// to, as the program tells it.
std::vector<Failure> run_items(const Study& study, const RunnerOptions& options, run::Observer& observer);

}  // namespace strandlab::study
