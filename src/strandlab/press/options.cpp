#include "strandlab/press/options.hpp"

namespace strandlab::press {

std::vector<Declaration<Schedule>> schedule_options() {
  using S = Schedule;
  return {declare("speed_m_s", "m/s", {.lo = 0, .hi = 1000, .lo_open = true},
                  "closing speed of the platens; up to 16 panels from 20 % compaction on hardly depend on it",
                  &S::speed_m_s),
          declare("symmetric", "", kAny, "both platens move, else only the top one", &S::symmetric),
          declare("ramp_time_fraction", "", {.lo = 0, .hi = 0.5}, "part of the pressing time spent on a smooth start",
                  &S::ramp_time_fraction),
          declare("record_interval_compaction", "", {.lo = 1e-6, .hi = 1}, "compaction between two lines of press.csv",
                  &S::record_interval_compaction)};
}

std::vector<Declaration<Resolution>> resolution_options() {
  using R = Resolution;
  return {declare("cells_through_strand", "", {.lo = 1, .hi = 32}, "cells through the thickness of a strand",
                  &R::cells_through_strand),
          declare("cell_aspect", "", {.lo = 0.25, .hi = 8}, "length of a cell over its height; 3D: 4 unless given",
                  &R::cell_aspect),
          declare("follow_platens", "", kAny, "the height of the cells follows the platens, in 3D the strands",
                  &R::follow_platens)};
}

}  // namespace strandlab::press
