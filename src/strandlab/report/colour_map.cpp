#include "strandlab/report/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace strandlab::report {
namespace {

constexpr Colour rgb(unsigned hex) {
  return {static_cast<double>(hex >> 16U) / 255, static_cast<double>(hex >> 8U & 255U) / 255,
          static_cast<double>(hex & 255U) / 255};
}

constexpr std::array kViridisFromLight{rgb(0xfde725), rgb(0xaadc32), rgb(0x5cc863), rgb(0x27ad81), rgb(0x21908d),
                                       rgb(0x2c718e), rgb(0x3b518b), rgb(0x472c7a), rgb(0x440154)};
constexpr std::array kBlueWhiteRed{rgb(0x053061), rgb(0x2166ac), rgb(0x4393c3), rgb(0x92c5de),
                                   rgb(0xd1e5f0), rgb(0xf7f7f7), rgb(0xfddbc7), rgb(0xf4a582),
                                   rgb(0xd6604d), rgb(0xb2182b), rgb(0x67001f)};

template <std::size_t N>
Colour interpolate(const std::array<Colour, N>& stops, double t) {
  if (std::isnan(t)) return {0.5, 0.5, 0.5};
  const double place = std::clamp(t, 0.0, 1.0) * (N - 1);
  const auto i = std::min(static_cast<std::size_t>(place), N - 2);
  const double f = place - static_cast<double>(i);
  const Colour &a = stops[i], &b = stops[i + 1];
  return {a.red + f * (b.red - a.red), a.green + f * (b.green - a.green), a.blue + f * (b.blue - a.blue)};
}

}  // namespace

Colour sequential(double t) {
  return interpolate(kViridisFromLight, t);
}
Colour diverging(double t) {
  return interpolate(kBlueWhiteRed, t);
}

}  // namespace strandlab::report
