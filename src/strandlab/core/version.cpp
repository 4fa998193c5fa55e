#include "strandlab/core/version.hpp"

namespace strandlab {
const char* version() {
  return STRANDLAB_VERSION;
}
}  // namespace strandlab
