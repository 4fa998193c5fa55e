// replay FILE|FOLDER...: gives a harness the inputs of its corpus, without a fuzzer. Ends with exit code 1 for an input
// that takes longer or more memory than a fuzzer allows, and where there is no input at all.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <vector>

#include "harness.hpp"

namespace {

namespace fs = std::filesystem;

constexpr double kLongest_s = 10;
constexpr double kLargest_MB = 2048;

std::vector<fs::path> inputs(int count, char** arguments) {
  std::vector<fs::path> files;
  for (int i = 1; i < count; ++i) {
    if (!fs::is_directory(arguments[i])) {
      files.emplace_back(arguments[i]);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(arguments[i])) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// What is wrong with the harness's answer; empty when nothing is.
std::string fault_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "cannot be read";
  const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
  const auto start = std::chrono::steady_clock::now();
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  } catch (const std::exception& error) {
    return fmt::format("not an InputError: {}", error.what());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (seconds > kLongest_s) return fmt::format("took {:.1f} s, allowed are {:g}", seconds, kLongest_s);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const double megabytes = static_cast<double>(used.ru_maxrss) / 1024;
  return megabytes > kLargest_MB ? fmt::format("took {:.0f} MB, allowed are {:g}", megabytes, kLargest_MB) : "";
}

}  // namespace

int main(int count, char** arguments) {
  const auto files = inputs(count, arguments);
  int faults = files.empty() ? 1 : 0;
  for (const auto& file : files) {
    fmt::print("{}\n", file.string());
    std::fflush(stdout);  // names the input that ends the process
    const auto fault = fault_of(file);
    if (fault.empty()) continue;
    fmt::print("  {}\n", fault);
    ++faults;
  }
  fmt::print("{} inputs, {} faults\n", files.size(), faults);
  return faults > 0 ? 1 : 0;
}
