// Tables of double-lap-shear specimens, and load-displacement records: from any bytes to the result file.
#include "harness.hpp"
#include "strandlab/bondline/analysis.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  fuzz::takes([&] { bondline::to_json(bondline::analyse(bondline::read_specimens(file.path()), {}), "table.csv"); });
  fuzz::takes([&] { bondline::fit_stiffness(bondline::read_record(file.path()), {}); });
  return 0;
}
