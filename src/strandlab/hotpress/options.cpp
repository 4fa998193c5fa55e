#include "strandlab/hotpress/options.hpp"

namespace strandlab::hotpress {

std::vector<Declaration<Softening>> softening_options() {
  using S = Softening;
  return {declare("r", "", {.lo = 0, .hi = 1, .lo_open = true},
                  "what heat leaves of stiffness and yield far above the softening point", &S::floor),
          declare("kappa_dry", "1/K", kNotNegative, "decay with temperature of dry wood", &S::kappa_dry),
          declare("kappa_wet", "1/K", kNotNegative, "of wood of more than about 10 %", &S::kappa_wet),
          declare("k_yield", "", kNotNegative, "fall of ln yield per % of moisture content", &S::k_yield),
          declare("k_stiffness", "", kNotNegative, "fall of ln stiffness per % of moisture content", &S::k_stiffness)};
}

std::vector<Declaration<LogColumns>> log_column_options() {
  using L = LogColumns;
  return {declare("time", "", kAny,
                  "column of time: its name or number, with its unit where the header has none, as in \"1 s\"; "
                  "\"\": found by its name",
                  &L::time),
          declare("position", "", kAny, "column of the gap between the platens, likewise", &L::position),
          declare("pressure", "", kAny, "column of the pressure on the mat, followed where there is no position",
                  &L::pressure),
          declare("platen_top", "", kAny, "column of the top platen's temperature", &L::platen_top),
          declare("platen_bottom", "", kAny, "column of the bottom platen's; as the top one where there is none",
                  &L::platen_bottom)};
}

}  // namespace strandlab::hotpress
