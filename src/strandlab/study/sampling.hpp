// Values of a range, and samples of several.
#pragma once

#include <cstdint>
#include <vector>

namespace strandlab::study {

// From `from` on in equal steps up to `to`, which is the last where the steps lead there; rounded to 12 digits, so that
// .1 + 2 x .1 is .3. Needs a finite step that leads from `from` towards `to`.
std::vector<double> stepped(double from, double to, double step);
// `count` values, 2 or more, equally spaced, both ends among them.
std::vector<double> spaced(double from, double to, int count);

struct Interval {
  double from = 0, to = 0;
};

// Latin hypercube (McKay, Beckman & Conover, Technometrics 21 (1979) 239): each interval is cut into `samples` equal
// strata, and each stratum of each interval holds one sample, at random within it and in random order. By sample, one
// value per interval, rounded to 9 digits. The same seed gives the same samples on every machine; those of an interval
// do not depend on the intervals behind it.
std::vector<std::vector<double>> latin_hypercube(const std::vector<Interval>& intervals, int samples,
                                                 std::uint64_t seed);

}  // namespace strandlab::study
