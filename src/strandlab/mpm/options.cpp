#include "strandlab/mpm/options.hpp"

namespace strandlab::mpm {

const char* name(Side side) {
  return side == Side::kFree ? "free" : "roller";
}

std::vector<std::string> side_names() {
  return {name(Side::kRoller), name(Side::kFree)};
}

Side side_from_name(const std::string& text) {
  return text == name(Side::kFree) ? Side::kFree : Side::kRoller;
}

std::vector<Declaration<Options>> contact_options() {
  return {declare("friction", "", {.lo = 0, .hi = 10}, "Coulomb friction between strands", &Options::friction),
          declare("platen_friction", "", {.lo = 0, .hi = 10}, "Coulomb friction between strands and platens",
                  &Options::platen_friction)};
}

std::vector<Declaration<Options>> step_options() {
  return {declare("courant", "", {.lo = 0, .hi = 0.9, .lo_open = true},
                  "time step over the time a wave takes through a cell", &Options::courant),
          declare("filter_interval_steps", "steps", {.lo = 0, .hi = 1e9},
                  "steps between XPIC(2) filterings of velocity; 0: none", &Options::filter_interval)};
}

}  // namespace strandlab::mpm
