// Random numbers that are the same on every machine.
#pragma once

#include <array>
#include <cstdint>

namespace strandlab {

// Philox4x32-10 of Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11 (2011): four random
// words from a counter and a key.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

// Standard normal deviate whose distribution function is p (0 < p < 1): Wichura (1988), Applied Statistics 37, 477-484,
// algorithm AS 241 (PPND16), relative accuracy about 1e-16.
// The same bits on every machine, as those of elementary.hpp: the source file is compiled without contraction to fused
// operations.
double normal_quantile(double p);

// An independent sequence of random numbers for each (seed, stream): the place in the sequence is a counter, so the
// numbers of one stream do not depend on what others have drawn.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

  std::uint64_t bits();  // 64 random bits
  double uniform();      // in the open interval (0, 1), on a grid of 2^-52
  double normal();       // standard normal by inversion, between kNormalLimit and its negative
  // Normal (mean, sd) truncated to positive values; needs 0 <= sd <= mean and mean > 0. Draws until a value is
  // positive, which is as exact as inverting the truncated distribution and needs no distribution function; sd <= mean
  // keeps rejections below 16 %.
  double positive_normal(double mean, double sd);

 private:
  std::uint64_t seed_, stream_;
  std::uint64_t block_ = 0;               // of 128 bits, next to be made
  std::array<std::uint32_t, 4> words_{};  // the current block
  int left_ = 0;                          // 64-bit halves of it not yet used
};

inline constexpr double kNormalLimit = 8.3;  // |normal()| <= |normal_quantile(2^-53)| = 8.21

}  // namespace strandlab
