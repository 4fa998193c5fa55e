#include "strandlab/glue/options.hpp"

namespace strandlab::glue {

std::vector<Declaration<CuringOptions>> curing_options() {
  return {
      declare("max_gap_mm", "mm", kPositive, "strand faces closer than this are glued", &CuringOptions::max_gap_mm)};
}

}  // namespace strandlab::glue
