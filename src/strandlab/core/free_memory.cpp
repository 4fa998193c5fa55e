#include "strandlab/core/free_memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace strandlab {
namespace {

namespace fs = std::filesystem;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The number after `name` in a file of lines "name number"; `otherwise` where there is none.
double entry(const fs::path& file, const std::string& name, double otherwise) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(name + " ", 0) == 0) return std::strtod(line.c_str() + name.size(), nullptr);
  }
  return otherwise;
}

// The one number in a file; `otherwise` for none ("max").
double number_in(const fs::path& file, double otherwise) {
  std::ifstream in(file);
  double number = otherwise;
  return in >> number ? number : otherwise;
}

double available_on_machine() {
  return entry("/proc/meminfo", "MemAvailable:", kNoLimit / 1024) * 1024;  // kB
}

double left_of_address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
  const double used = number_in("/proc/self/statm", 0) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

// A group's files that could be dropped at once do not count as used.
double left_in_group(const fs::path& group, const char* limit, const char* used, const char* droppable) {
  const double most = number_in(group / limit, kNoLimit);
  return std::max(0.0, most - number_in(group / used, 0) + entry(group / "memory.stat", droppable, 0));
}

// The least over the process's group and the groups above it; "0::/path" for version 2, "N:memory:/path" for 1.
double left_in_groups() {
  double least = kNoLimit;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const bool second = line.rfind("0::", 0) == 0;
    const auto first = line.find(":memory:");
    if (!second && first == std::string::npos) continue;
    const fs::path root = second ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    for (fs::path below = line.substr(second ? 3 : first + 8);; below = below.parent_path()) {
      const auto group = root / below.relative_path();
      least = std::min(least, second ? left_in_group(group, "memory.max", "memory.current", "inactive_file")
                                     : left_in_group(group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                                     "total_inactive_file"));
      if (below.empty() || below == below.parent_path()) break;
    }
  }
  return least;
}

}  // namespace

double free_memory_bytes() {
  return std::min({available_on_machine(), left_of_address_space(), left_in_groups()});
}

}  // namespace strandlab
