#include "strandlab/run/observer.hpp"

#include <fmt/format.h>

namespace strandlab::run {

std::string line_of(const Progress& progress) {
  return fmt::format("{:<6} {:3.0f} %  {}", progress.step, 100 * progress.fraction, progress.detail);
}

}  // namespace strandlab::run
