// Elementary functions that have the same bits on every machine. They use + - * /, square root, scaling by powers of
// two and the exact remainder only, which IEEE 754 rounds alike everywhere; those of the C libraries differ in the last
// bit. The source file is compiled without contraction to fused operations.
#pragma once

namespace strandlab {

// Natural logarithm of a positive, finite number; error about 1e-16 of 1 or of the result, whichever is larger.
double portable_log(double x);
// Exponential function for |x| <= 700, relative error about 2e-16.
double portable_exp(double x);

struct CosSin {
  double cos = 1, sin = 0;
};
// Cosine and sine of an angle in degrees, finite: within 2 units in the last place, exact at multiples of 90 degrees.
CosSin cos_sin_degrees(double angle_deg);

}  // namespace strandlab
