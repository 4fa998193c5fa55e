// A study on machines with a queue: Slurm's arrays, lists for GNU parallel, Snakefiles. What is done is read from the
// folders of items, never asked of the queue.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/run/observer.hpp"
#include "strandlab/study/folder.hpp"
#include "strandlab/study/item.hpp"

namespace strandlab::study {

// A job array: a task works on a chunk of items, one after another.
struct SlurmArray {
  std::vector<std::vector<const Item*>> chunks;
  int minutes = 0;    // --time of a task
  int megabytes = 0;  // --mem
};

inline constexpr double kShortestTask_s = 900;  // of a chunk of several items, by the estimate

// The items that are neither whole nor at work, in chunks of kShortestTask_s or more, in arrays of at most
// `largest_array` tasks. The limits are twice the estimate and ten minutes, and one and a half times the memory.
std::vector<SlurmArray> slurm_arrays(const Study& study, int largest_array);

// The batch script of an array whose chunks are the lines of `chunks`. A minute before its limit a task is told by
// SIGUSR1, leaves a checkpoint and is queued again.
std::string slurm_script(const Study& study, const SlurmArray& array, const std::filesystem::path& chunks,
                         const std::string& program, Keep keep);

// Throws InputError, with the remedy, on a machine without sbatch.
void refuse_missing_sbatch();

// Writes scripts into slurm/ of the study's folder and submits them by sbatch, and a job that collects when all have
// ended; a dry run tells the scripts and commands and writes nothing. Throws RunError where sbatch fails.
void submit_to_slurm(const Study& study, Keep keep, bool dry_run, run::Observer& observer);

// A line for each item that is not whole: GNU parallel's input.
std::string parallel_list(const Study& study, const std::string& program);
// A Snakefile of all items and the tables.
std::string snakefile(const Study& study, const std::string& program);

// The file of this program.
std::string this_program();

}  // namespace strandlab::study
