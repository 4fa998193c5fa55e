// Overrides of the command line, --set key.path=value: one per line of the input.
#include <sstream>
#include <string>
#include <vector>

#include "harness.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/case/write.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines{std::string(fuzz::text_of(data, size))};
  std::vector<std::string> overrides;
  for (std::string line; std::getline(lines, line);) overrides.push_back(line);
  cases::Case c;
  const std::string file = "[kinds.core]\nangle_deg = 90\n[materials.aspen]\nE_L_MPa = 11000\n";
  if (!fuzz::takes([&] { c = cases::case_from_text(file, "case.toml", overrides); })) return 0;
  const auto text = cases::resolved_text(c);
  fuzz::require(cases::resolved_text(cases::case_from_text(text, "resolved.toml")) == text,
                "a resolved case reads back");
  return 0;
}
