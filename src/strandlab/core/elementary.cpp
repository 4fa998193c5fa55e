#include "strandlab/core/elementary.hpp"

#include <cmath>

namespace strandlab {
namespace {

constexpr double kLn2 = 0.693147180559945309417232;
constexpr double kRadiansPerDegree = 0.017453292519943295769237;

// 1 - z/((n + 1)(n + 2)) (1 - z/((n + 3)(n + 4)) (1 - ...)), `terms` factors: the tail of the series of sine or cosine
// after the power n, over its first term.
double alternating_series(double z, int n, int terms) {
  double sum = 1;
  for (int k = 2 * terms - 1; k >= 1; k -= 2) sum = 1 - z / ((n + k) * (n + k + 1)) * sum;
  return sum;
}

}  // namespace

// Exact scaling and the series ln m = 2 artanh s, s = (m - 1)/(m + 1), |s| <= 0.172.
double portable_log(double x) {
  constexpr double kSqrtHalf = 0.707106781186547524400844;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < kSqrtHalf) {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1), s2 = s * s;
  double series = 0;
  for (int k = 12; k >= 0; --k) series = series * s2 + 1.0 / (2 * k + 1);
  return exponent * kLn2 + 2 * s * series;
}

// exp(x) = 2^n exp(r), |r| <= ln(2)/2: ln 2 in two parts, of which n times the first is exact (Cody & Waite, Software
// Manual for the Elementary Functions, 1980, ch. 6), and the Taylor series of exp(r).
double portable_exp(double x) {
  constexpr double kLn2High = 0.693359375, kLn2Low = -2.121944400546905827679e-4;
  const double n = std::floor(x / kLn2 + 0.5);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  double series = 1;
  for (int k = 16; k >= 1; --k) series = 1 + r / k * series;
  return std::ldexp(series, static_cast<int>(n));
}

// The angle less a whole number of quarter turns is exact and within 45 degrees. There the Taylor series of sine and
// cosine; the latter as (1 - x^2/2) + x^4/24 (...), with what the first difference lost.
CosSin cos_sin_degrees(double angle_deg) {
  int quarters = 0;
  const double x = std::remquo(angle_deg, 90.0, &quarters) * kRadiansPerDegree;
  const double z = x * x, half = 0.5 * z;
  const double s = x - x * (z / 6) * alternating_series(z, 3, 7);
  const double first = 1 - half;
  const double c = first + (((1 - first) - half) + z * (z / 24) * alternating_series(z, 4, 7));
  switch (quarters & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s + 0.0, c};
    case 2:
      return {-c, -s + 0.0};
    default:
      return {s + 0.0, -c};
  }
}

}  // namespace strandlab
