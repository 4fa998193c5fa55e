// What a press cycle costs: the default cycle of 240 s in 40 cells, heat and moisture alone and with the column.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "strandlab/hotpress/cycle.hpp"

namespace {

using namespace strandlab;

// CPU seconds, the best of five.
double cost(hotpress::Mechanics mechanics, std::size_t& steps) {
  hotpress::Settings s;
  s.mechanics = mechanics;
  s.schedule = hotpress::parse_schedule({"close to 12 mm in 25 s", "hold until 240 s"});
  const hotpress::PressedMat mat{{{7.68, wood::library().front()}}, 7.68 / 350};
  double best = 1e300;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::clock();
    steps = hotpress::press_hot(s, mat).record.size();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

}  // namespace

int main() {
  std::size_t steps = 0;
  const double uniform = cost(hotpress::Mechanics::kUniform, steps), column = cost(hotpress::Mechanics::kColumn, steps);
  fmt::print("press cycle of 240 s, 40 cells, {} steps: {:.3f} s heat and moisture alone, {:.3f} s with the column\n",
             steps, uniform, column);
}
