// The items of a study: a cell of its plan and a replicate, as a case of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/run/observer.hpp"
#include "strandlab/study/plan.hpp"

namespace strandlab::study {

// What plan.csv says of an item.
struct Item {
  int number = 0;          // from 1, in the order of the plan: all cells of replicate 1, then all of replicate 2...
  std::string hash;        // of the resolved case: its name, on every machine
  std::string pressing;    // of the part of the case that the pressing depends on: items that share it share the panels
  int replicate = 0;       // from 1
  std::uint64_t seed = 0;  // of the mat
  double seconds = 0;      // estimated, on one thread: press and tests
  double bytes = 0;        // of memory, estimated
  std::vector<std::string> values;  // of the varied keys, as TOML; "": as the base case has it
};

// An item with what only the planning knows.
struct PlannedItem {
  Item item;
  std::string case_text;     // the resolved case
  std::size_t mat = 0;       // stands for the mat within this program
  double press_seconds = 0;  // share of the pressing in item.seconds
  double disk_bytes = 0;     // of the pressing's panels
  int solves = 0;            // factorisations of the tests: states x qualities of glue
};

// All items, each formed once to see that it can be pressed and tested and what it costs; the observer is told how far
// it is, and may stop it. Throws InputError for a base that is no case, for keys and values that no case takes
// ("plan.toml:5: press.speed_m_s = ..."), for items that cannot be pressed or tested, for two items that are the same
// case, and for several replicates of a mat that is read from a file.
std::vector<PlannedItem> items_of(const Plan& plan, run::Observer& observer);

// What a user decides about before it runs: cells, items, pressings, solves, what the replicates share, time on
// `workers` cores, memory, disk. Lines of text.
std::vector<std::string> summary_of(const Plan& plan, const std::vector<PlannedItem>& items, int workers);

}  // namespace strandlab::study
