// Yield that knows how fast wood is strained.
#pragma once

namespace strandlab::wood {

// Yield stresses grow as (max(rate, floor)/reference)^exponent with the rate of plastic strain: straight lines of
// relaxation in log stress against log time. .04 is 8.8 % a decade.
struct RateEffect {
  double exponent = .04;                  // n; 0: none
  double reference = 1e-3, floor = 1e-7;  // 1/s
};

}  // namespace strandlab::wood
