// Plan files of studies: any text is a plan or is refused; each cell has a value for each key that varies.
#include "harness.hpp"
#include "strandlab/study/plan.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  study::Plan plan;
  if (!fuzz::takes([&] { plan = study::plan_from_text(std::string(fuzz::text_of(data, size)), "plan.toml", "."); }))
    return 0;
  const auto keys = study::varied_keys(plan).size();
  for (const auto& cell : study::cells_of(plan))
    fuzz::require(study::values_of(plan, cell).size() == keys, "a value for each key");
  return 0;
}
