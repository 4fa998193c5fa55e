#include "strandlab/lattice/lattice.hpp"

#include <numbers>

namespace strandlab {

std::vector<std::size_t> outline(const Lattice<2>& lattice) {
  const auto [along, through] = lattice.counts;
  std::vector<std::size_t> around;
  around.reserve(2 * static_cast<std::size_t>(along + through));
  for (int i = 0; i < along; ++i) around.push_back(lattice.corner({i, 0}));
  for (int j = 0; j < through; ++j) around.push_back(lattice.corner({along, j}));
  for (int i = along; i > 0; --i) around.push_back(lattice.corner({i, through}));
  for (int j = through; j > 0; --j) around.push_back(lattice.corner({0, j}));
  return around;
}

Placement<3> turned(const Lattice<3>& lattice, const Vec<3>& centre, double angle_deg) {
  const double quarters = std::round(angle_deg / 90), rest = (angle_deg - 90 * quarters) * std::numbers::pi / 180;
  double c = std::cos(rest), s = std::sin(rest);
  for (int k = (static_cast<int>(quarters) % 4 + 4) % 4; k > 0; --k) c = -std::exchange(s, c);
  Placement<3> placement;
  placement.axes << c, -s, 0,  //
      s, c, 0,                 //
      0, 0, 1;
  Vec<3> half;
  for (int a = 0; a < 3; ++a) half[a] = 0.5 * lattice.extent(a);
  placement.corner = centre - placement.axes * half;
  return placement;
}

}  // namespace strandlab
