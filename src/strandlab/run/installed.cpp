#include "strandlab/run/installed.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace strandlab::run {

std::optional<std::filesystem::path> installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / program;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

}  // namespace strandlab::run
