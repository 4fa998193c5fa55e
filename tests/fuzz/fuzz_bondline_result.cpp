// Results of `strandlab bondline`, which cases name in glue.from_bondline.
#include "harness.hpp"
#include "strandlab/bondline/analysis.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  fuzz::takes([&] { bondline::group_compliance(file.path(), "PF 25 %"); });
  return 0;
}
