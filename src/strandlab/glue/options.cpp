#include "strandlab/glue/options.hpp"

namespace strandlab::glue {

std::vector<Declaration<CuringOptions>> curing_options() {
  std::vector<Declaration<CuringOptions>> list{
      declare("max_gap_mm", "mm", kPositive, "strand faces closer than this are glued", &CuringOptions::max_gap_mm)};
  using C = Coverage;
  for (const auto& option :
       {declare("coverage", "", {.lo = 0, .hi = 1, .lo_open = true},
                "part of the strands' faces that resin covers; 1/D_t given is that of faces covered whole", &C::mean),
        declare("spot_mm", "mm", {.lo = 0, .hi = 1e3},
                "length of spots of resin, laid at random; 0: evenly spread, every stretch has the coverage",
                &C::spot_mm),
        declare("coverage_classes", "", {.lo = 0, .hi = 1, .lo_open = true, .increasing = true},
                "coverages, up to 1, of measured 1/D_t", &C::classes),
        declare("coverage_compliances_mm_per_MPa", "mm/MPa", kNotNegative,
                "1/D_t measured there: what that of faces covered whole grows by where they are not", &C::compliances)})
    list.push_back(within<CuringOptions>(
        [](auto& options) -> auto& { return options.coverage; }, option));
  return list;
}

}  // namespace strandlab::glue
