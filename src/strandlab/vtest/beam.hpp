// A panel bent on supports: forces on short pads, deflections of cross sections. Per mm of depth throughout.
#pragma once

#include <vector>

#include "strandlab/vtest/load_cases.hpp"

namespace strandlab::vtest {

class Beam {
 public:
  explicit Beam(const statics::Mesh& mesh) : mesh_(mesh) {}

  // Adds the nodal forces of a pad pressed on the panel: a vertical force (N, positive up) spread over `width` mm
  // around x as 1 + cos, on the topmost (or lowest) wood at each place. Its resultant is `force` at x, exactly. Throws
  // InputError where there is no wood under the pad.
  enum class Face { kTop, kBottom };
  void add_pad(Face face, double x, double width, double force, std::vector<double>& forces) const;

  // Adds `factor` times the deflection of the cross section at x, the mean of u_y over its wood (Cowper, J. Appl. Mech.
  // 33 (1966) 335), as a linear form of the displacements. Throws InputError where there is no wood.
  void add_deflection(double x, double factor, std::vector<double>& form) const;

 private:
  const statics::Mesh& mesh_;
};

// Supports that only take away rigid motion: a node at either end of the panel held in y, one of them in x. Loads in
// balance leave no reaction there.
statics::Supports rigid_motion_supports(const statics::Mesh& mesh, const statics::LowerMatrix& stiffness);

// Loads in balance and what is read off, per mm of depth: 1 N in all on the panel, downwards.
struct BeamTest {
  std::vector<double> forces;      // N, nodal
  std::vector<double> deflection;  // mm, linear form: midspan against the supports, positive down
  std::vector<double> gauge;       // mm, the same against two sections `gauge_length` apart; empty for three points
  double span = 0, arm = 0;        // mm; arm: support to the next load
  double gauge_length = 0;         // mm
};

// Load in the middle of the span, which is in the middle of the panel.
BeamTest three_point(const Section& section, const statics::Mesh& mesh, double span, double pad);
// Loads at the thirds of the span. The gauge stays a thickness clear of the loads.
BeamTest four_point(const Section& section, const statics::Mesh& mesh, double span, double pad);

// Bernoulli's modulus (MPa) that gives the deflection between supports, or over the gauge, which bends without shear:
// E = P a (3 S^2 - 4 a^2)/(48 I w), a = S/2 for three points; E = P a l^2/(16 I w).
double apparent_modulus(const BeamTest& test, const Section& section, double deflection);
double gauge_modulus(const BeamTest& test, const Section& section, double deflection);

// Modulus without shear from apparent ones at two spans: 1/E_app = 1/E + const/S^2 (EN 408, variable span).
double modulus_without_shear(double long_span, double long_modulus, double short_span, double short_modulus);

}  // namespace strandlab::vtest
