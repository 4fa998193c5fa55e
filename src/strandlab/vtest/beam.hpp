// A panel bent on supports, in its middle: forces on short pads without horizontal restraint, deflections of cross
// sections. Per mm of depth throughout; loads of 1 N in all.
#pragma once

#include <vector>

#include "strandlab/vtest/model.hpp"

namespace strandlab::vtest {

// Span and width of the pads, mm, for the thickness of the panel.
double span_mm(const Model& model, const Options& options);
double pad_mm(const Model& model, const Options& options);

// Refuses spans, pads and panels that cannot be bent on supports. Throws InputError.
void check_span(const Panel<2>& panel, const Options& options);
// The span, and a thickness beyond either support.
double length_for_span_mm(const Options& options, double thickness_mm);

// Takes away rigid motion only: a node at either end of the panel held in y, one of them in x. Loads in balance leave
// no reaction there.
statics::Supports rigid_motion_supports(const Model& model);

// Loads in balance and what is read off.
struct BeamTest {
  std::vector<double> forces;      // N, nodal
  std::vector<double> deflection;  // mm, linear form: midspan against the supports, positive down
  double span = 0, arm = 0;        // mm; arm: support to the next load
};

// Supports that bear half of 1 N each, no load yet. Throws InputError where there is no wood over a support.
BeamTest supported(const Model& model, double span, double arm, double pad);
// Adds a load (N, downwards) on the panel, `offset` mm from the middle. Throws InputError where there is no wood.
void add_load(const Model& model, double offset, double pad, double load, BeamTest& test);

// The deflection in the middle against the mean of two sections `length` apart, positive down, as a linear form of the
// displacements. A section's deflection is the mean of u_y over its wood (Cowper, J. Appl. Mech. 33 (1966) 335). Throws
// InputError where there is no wood.
std::vector<double> sag(const Model& model, double length);

// The loads as a load case, and the unit forces on the deflection.
statics::LoadCase force_load(const BeamTest& test);
statics::LoadCase deflection_load(const BeamTest& test);

// Energy that one state's forces spend on another's displacements, mJ.
double mutual_energy(const statics::BondedPanel<2>& panel, const statics::Solution<2>& a,
                     const statics::Solution<2>& b);

// Bernoulli's modulus of the deflection between supports, E = P a (3 S^2 - 4 a^2)/(48 I w) (a = S/2 for three points),
// from solutions of the two load cases: w from their mutual energy, and read off for the modulus from the reaction.
void apparent(const Model& model, const BeamTest& test, const statics::Solution<2>& loaded,
              const statics::Solution<2>& deflection, Modulus& modulus);

}  // namespace strandlab::vtest
