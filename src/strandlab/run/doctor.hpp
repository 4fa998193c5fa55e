// What the machine has of what strandlab can use, and whether strandlab computes there what it should.
#pragma once

#include <string>
#include <vector>

namespace strandlab::run {

struct Diagnosis {
  enum class State { kGood, kMissing, kBad };  // missing: something optional
  State state = State::kGood;
  std::string what, found;  // "gnuplot", "/usr/bin/gnuplot"
  std::string use;          // what is lacking without it, and how to get it
};

// Presses and tests a small mat in memory. The largest relative difference of its stress, work and moduli from those
// kept with the source.
double self_test();
inline constexpr double kSelfTestLimit = 1e-9;  // instruction sets differ by 1e-13; other BLAS libraries by more

// In the order of a report; runs the self-test last, a second of work.
std::vector<Diagnosis> diagnose();

// One line each, aligned, "missing" and "WRONG" in front.
std::string text_of(const std::vector<Diagnosis>& list);

}  // namespace strandlab::run
