// What the commands that work on a case take from the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"

namespace CLI {
class App;
}

namespace strandlab::app {

struct CaseArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::string folder;
  bool force = false;

  cases::Case read() const { return cases::read_case(file, overrides); }
  // The run folder: -o, else runs/<case name>.
  std::filesystem::path run_folder(const cases::Case& c) const;
};

// CASE and --set; for commands that write results also -o and --force.
void add_case_arguments(CLI::App& command, CaseArguments& arguments);
void add_folder_arguments(CLI::App& command, CaseArguments& arguments);

}  // namespace strandlab::app
