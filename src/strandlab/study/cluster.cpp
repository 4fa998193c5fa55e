#include "strandlab/study/cluster.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdio.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/study/claim.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;

// For a shell, as one word.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// What a command prints, and its exit code.
struct Answer {
  std::string text;
  int code = 0;
};

Answer answer_of(const std::string& command) {
  std::fflush(nullptr);
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw RunError(fmt::format("cannot start: {}", command));
  Answer answer;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) answer.text.append(part.data(), n);
  const int status = ::pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

constexpr int kLargestArray = 1000;  // as Slurm is installed: MaxArraySize = 1001, one more than the last number

int largest_array() {
  std::istringstream words(answer_of("scontrol show config 2>/dev/null").text);
  for (std::string word; words >> word;) {
    int number = 0;
    if (word != "MaxArraySize" || !(words >> word >> number)) continue;
    return std::max(1, number - 1);
  }
  return kLargestArray;
}

// Nothing is written to find out.
bool is_at_work(const Study& study, const Item& item) {
  const auto folder = study.item_folder(item);
  std::error_code error;
  return fs::exists(folder / "lock", error) && !Claim::attempt(folder);
}

std::string chunk_lines(const SlurmArray& array) {
  std::string text;
  for (const auto& chunk : array.chunks) {
    std::vector<std::string> hashes;
    hashes.reserve(chunk.size());
    for (const auto* item : chunk) hashes.push_back(item->hash);
    text += fmt::format("{}\n", fmt::join(hashes, " "));
  }
  return text;
}

// The number of a job from what `sbatch --parsable` prints, "4711" or "4711;cluster".
std::string submit(const std::string& command, run::Observer& observer) {
  const auto answer = answer_of(command);
  auto job = answer.text.substr(0, answer.text.find_first_of(";\n"));
  const bool number = !job.empty() && job.find_first_not_of("0123456789") == std::string::npos;
  if (answer.code != 0 || !number)
    throw RunError(fmt::format("sbatch has not taken the job (exit code {}): {}", answer.code, command));
  observer.say(fmt::format("study: job {}: {}", job, command));
  return job;
}

// The first number that no earlier submission has.
int free_number(const fs::path& folder) {
  std::error_code error;
  int number = 1;
  while (fs::exists(folder / fmt::format("array_{}.sh", number), error)) ++number;
  return number;
}

std::string collect_command(const Study& study, const std::vector<std::string>& jobs, const std::string& program) {
  return fmt::format("sbatch --parsable --dependency=afterany:{} --job-name=study-collect --output={} --wrap={}",
                     fmt::join(jobs, ":"), quoted((study.folder / "slurm" / "collect.log").string()),
                     quoted(fmt::format("{} study collect {}", quoted(program), quoted(study.folder.string()))));
}

}  // namespace

void refuse_missing_sbatch() {
  if (answer_of("command -v sbatch").code != 0)
    throw InputError("--runner slurm: there is no sbatch on this machine; --dry-run prints the commands for another");
}

std::vector<SlurmArray> slurm_arrays(const Study& study, int largest_array) {
  std::vector<SlurmArray> arrays;
  double chunk_s = kShortestTask_s;
  double longest_s = 0, bytes = 0;
  const auto close = [&](SlurmArray& array) {
    array.minutes = static_cast<int>(std::ceil(2 * longest_s / 60)) + 10;
    array.megabytes = static_cast<int>(std::ceil(1.5 * bytes / 1e6)) + 100;
  };
  for (const auto& item : study.items) {
    if (read_record(study, item).whole || is_at_work(study, item)) continue;
    if (chunk_s >= kShortestTask_s) {
      if (arrays.empty() || static_cast<int>(arrays.back().chunks.size()) == largest_array) {
        arrays.emplace_back();
        longest_s = bytes = 0;
      }
      arrays.back().chunks.emplace_back();
      chunk_s = 0;
    }
    arrays.back().chunks.back().push_back(&item);
    chunk_s += item.seconds;
    longest_s = std::max(longest_s, chunk_s);
    bytes = std::max(bytes, item.bytes);
    close(arrays.back());
  }
  return arrays;
}

std::string slurm_script(const Study& study, const SlurmArray& array, const fs::path& chunks,
                         const std::string& program, Keep keep) {
  return fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name=study\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --time={}\n"
      "#SBATCH --mem={}M\n"
      "#SBATCH --cpus-per-task=1\n"
      "#SBATCH --signal=B:USR1@60\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output={}\n"
      "# The items of this task; the shell waits, so that it hears the signal.\n"
      "trap '[ -z \"$work\" ] || {{ kill -USR1 $work; wait $work; }}; "
      "scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}\"; exit' USR1\n"
      "{} study item {} $(sed -n \"${{SLURM_ARRAY_TASK_ID}}p\" {}) --keep {} &\n"
      "work=$!\n"
      "wait $work\n",
      array.chunks.size(), array.minutes, array.megabytes, (study.folder / "slurm" / "%A_%a.log").string(),
      quoted(program), quoted(study.folder.string()), quoted(chunks.string()),
      keep == Keep::kModuli ? "moduli" : "panels");
}

void submit_to_slurm(const Study& relative, Keep keep, bool dry_run, run::Observer& observer) {
  auto study = relative;
  study.folder = fs::absolute(study.folder);  // a job may start elsewhere
  const auto program = this_program();
  const auto folder = study.folder / "slurm";
  const auto arrays = slurm_arrays(study, largest_array());
  int number = free_number(folder);
  std::vector<std::string> jobs;
  for (const auto& array : arrays) {
    const auto name = folder / fmt::format("array_{}", number++);
    const auto script_file = name.string() + ".sh", chunk_file = name.string() + ".txt";
    const auto script = slurm_script(study, array, chunk_file, program, keep);
    const auto command = fmt::format("sbatch --parsable {}", quoted(script_file));
    if (dry_run) {
      std::istringstream lines(script);
      for (std::string line; std::getline(lines, line);) observer.say("    " + line);
      observer.say(command);
      jobs.push_back("JOB");
      continue;
    }
    files::make_folder(folder);
    files::write_atomically(chunk_file, chunk_lines(array));
    files::write_atomically(script_file, script);
    jobs.push_back(submit(command, observer));
  }
  if (jobs.empty()) {
    observer.say("study: every item is whole or at work; nothing to submit");
    return;
  }
  const auto collect = collect_command(study, jobs, program);
  if (dry_run)
    observer.say(collect);
  else
    submit(collect, observer);
}

std::string parallel_list(const Study& study, const std::string& program) {
  std::string text;
  for (const auto& item : study.items)
    if (!read_record(study, item).whole)
      text +=
          fmt::format("{} study item {} {}\n", quoted(program), quoted(fs::absolute(study.folder).string()), item.hash);
  return text;
}

std::string snakefile(const Study& study, const std::string& program) {
  std::vector<std::string> hashes;
  for (const auto& item : study.items) hashes.push_back("\"" + item.hash + "\"");
  const auto folder = fs::absolute(study.folder).string();
  return fmt::format(
      "# snakemake --snakefile FILE --cores N\n"
      "FOLDER = r\"{0}\"\nPROGRAM = r\"{1}\"\nITEMS = [{2}]\n\n"
      "rule tables:\n"
      "    input: expand(FOLDER + \"/items/{{item}}/snakemake.done\", item=ITEMS)\n"
      "    shell: \"{{PROGRAM:q}} study collect {{FOLDER:q}}\"\n\n"
      "rule item:\n"
      "    output: touch(FOLDER + \"/items/{{item}}/snakemake.done\")\n"
      "    resources: mem_mb={3}\n"
      "    shell: \"{{PROGRAM:q}} study item {{FOLDER:q}} {{wildcards.item}}\"\n",
      folder, program, fmt::join(hashes, ", "),
      std::ceil(1.5e-6 * std::max_element(study.items.begin(), study.items.end(), [](const auto& a, const auto& b) {
                           return a.bytes < b.bytes;
                         })->bytes));
}

std::string this_program() {
  std::error_code error;
  const auto file = fs::read_symlink("/proc/self/exe", error);
  return error ? "strandlab" : file.string();
}

}  // namespace strandlab::study
