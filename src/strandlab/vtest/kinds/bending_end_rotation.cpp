// Bending by end rotation: the end plane x = L is turned by theta at no axial force, E_b = 2 U L/(I theta^2).
// Le (2010), Eq. 4.1, for a rotation in place of a couple.
#include "strandlab/vtest/end_planes.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {
namespace {

// Solutions of a stretch of 1 mm and of a rotation of 1 rad; the stretch that takes the axial force off the rotation is
// added to it.
Modulus end_rotation_modulus(const Model& model, const statics::Solution<2>& stretch,
                             const statics::Solution<2>& rotation) {
  const auto& section = model.section;
  const double q = -right_resultant(section, model.bonded.forces(rotation)).force /
                   right_resultant(section, model.bonded.forces(stretch)).force;
  auto bent = rotation;
  bent.add(q, stretch);
  const double factor = section.length / section.second_moment();
  Modulus modulus{TestKind::kBendingEndRotation};
  modulus.modulus_MPa = 2 * model.bonded.energy(bent) * factor;
  modulus.reaction_modulus_MPa = right_resultant(section, model.bonded.forces(bent)).moment * factor;
  return modulus;
}

Setup set_up_end_rotation(const Model& model, const Options&) {
  return {{end_displacement(model, 1, 0), end_displacement(model, 0, 1)},
          [&model](const Solutions& s) { return end_rotation_modulus(model, *s[0], *s[1]); }};
}

}  // namespace

template <>
const VirtualTest& test<TestKind::kBendingEndRotation>() {
  static constexpr VirtualTest kTest{.name = "bending_end_rotation",
                                     .label = "Bending (end rotation)",
                                     .closed_form = ClosedForm::kLaminatedBeam,
                                     .supports = end_plane_supports,
                                     .set_up = set_up_end_rotation};
  return kTest;
}

}  // namespace strandlab::vtest
