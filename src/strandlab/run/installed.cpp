#include "strandlab/run/installed.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
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

std::string first_line_of(const std::filesystem::path& program, const std::string& arguments) {
  std::string quoted;
  for (const char c : program.string()) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  const auto command = "timeout 3 '" + quoted + "' " + arguments + " 2>&1 </dev/null";
  const auto close = [](std::FILE* pipe) { ::pclose(pipe); };
  const std::unique_ptr<std::FILE, decltype(close)> pipe(::popen(command.c_str(), "r"), close);
  std::array<char, 101> text{};
  if (!pipe || std::fgets(text.data(), text.size(), pipe.get()) == nullptr) return "";
  std::string line = text.data();
  line.resize(std::min(line.find("Copyright"), line.find_last_not_of(" \n") + 1));
  line.resize(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace strandlab::run
