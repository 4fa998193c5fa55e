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

// Presses and tests a small mat in memory, by the kernels of the instruction set in use.
struct SelfTest {
  std::string bits;             // of all points' positions, velocities and stresses as pressed, a fingerprint
  std::vector<double> numbers;  // stress (MPa) and work (mJ) at the end of the pressing, then the moduli (MPa)

  bool same_bits = false;  // as those kept with the source for this instruction set, of the program that g++ 12 builds
  double difference = 0;   // of the numbers from those kept with the source, the largest, relative
};
SelfTest self_test();
inline constexpr double kSelfTestLimit =
    1e-9;  // instruction sets differ by 5e-14; the rest is for other BLAS libraries and compilers: judgement

// In the order of a report; runs the self-test last, a second of work.
std::vector<Diagnosis> diagnose();

// One line each, aligned, "missing" and "WRONG" in front.
std::string text_of(const std::vector<Diagnosis>& list);

}  // namespace strandlab::run
