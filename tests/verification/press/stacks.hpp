// Hand-made panels for the press tests: flat rows without gaps, lattices in 2D and 3D, and the closed forms they
// follow.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "strandlab/press/press.hpp"
#include "support/strands.hpp"

namespace strandlab::press_tests {

inline wood::Material poplar(bool yields) {
  wood::Material m = wood::library().front();
  if (!yields) m.hill.Y_L = m.hill.Y_R = m.hill.Y_T = m.hill.S_RT = m.hill.S_RL = m.hill.S_TL = 1e9;
  return m;
}

// A strand that fills low..high with the given numbers of points.
template <int Dim>
Strand<Dim> strand(const wood::Material& material, double angle_deg, int row, const Vec<Dim>& low, const Vec<Dim>& high,
                   const std::array<int, Dim>& points) {
  auto s = test::strand_between<Dim>(wood::in_strand_axes(material, angle_deg), low, high, points);
  s.kind = angle_deg == 0 ? "surface" : "core";
  s.row = row;
  s.angle_deg = angle_deg;
  return s;
}

// A confined strand (no strain along and across) under compaction C, compression positive, MPa, by Hill's law with
// Y_R = Y_T = Y, Y_L infinite. There the yield function is |s_R - s_T|/Y, and the flow moves strain from R to T:
// one unknown p = -eps_p_R = eps_p_T = alpha. Kirchhoff stress tau = C0 (eps - eps_p), Cauchy tau/J, and
//   |s_R - s_T| = Y + K p^n
// which is solved for p by bisection. The stiffness comes from the nine constants; nothing is taken from the engine.
class ConfinedStrand {
 public:
  explicit ConfinedStrand(const wood::Material& m) : material_(m) {
    Eigen::Matrix3d s;                                   // compliance of the normal strains, order L, R, T
    s << 1 / m.E_L, -m.nu_RL / m.E_R, -m.nu_TL / m.E_T,  //
        -m.nu_RL / m.E_R, 1 / m.E_R, -m.nu_TR / m.E_T,   //
        -m.nu_TL / m.E_T, -m.nu_TR / m.E_T, 1 / m.E_T;
    stiffness_ = s.inverse();
  }
  // -C_RR ln(1 - C)/(1 - C)
  double elastic(double C) const { return -stiffness_(1, 1) * std::log(1 - C) / (1 - C); }
  double hill(double C) const {
    double low = 0, high = 1;
    for (int i = 0; i < 200; ++i) {
      const double p = 0.5 * (low + high);
      const Eigen::Vector3d s = stress(C, p);
      const bool yields = s[2] - s[1] > material_.hill.Y_R + material_.hill.K * std::pow(p, material_.hill.n);
      (yields ? low : high) = p;
    }
    return -stress(C, low)[1];
  }

 private:
  Eigen::Vector3d stress(double C, double p) const {
    return stiffness_ * Eigen::Vector3d(0, std::log(1 - C) + p, -p) / (1 - C);
  }
  wood::Material material_;
  Eigen::Matrix3d stiffness_;
};

}  // namespace strandlab::press_tests
