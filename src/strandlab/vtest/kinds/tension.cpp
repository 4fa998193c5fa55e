// Tension: end planes kept plane and free to move through the thickness, E = 2 U/(eps^2 L b h), with
// the energy U of wood and glue lines of Le (2010), Eq. 3.4.
#include "strandlab/vtest/end_planes.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {
namespace {

Setup set_up_tension(const Model& model, const Options&) {
  return {{end_displacement(model, 1, 0)}, [&model](const Solutions& s) {
            const auto& section = model.section;
            const double factor = section.length / section.thickness;  // for a stretch of 1 mm
            Modulus modulus{TestKind::kTension};
            modulus.modulus_MPa = 2 * model.bonded.energy(*s[0]) * factor;
            modulus.reaction_modulus_MPa = right_resultant(section, model.bonded.forces(*s[0])).force * factor;
            return modulus;
          }};
}

// Slips of the stretch of 1 mm.
std::vector<GlueSlip> slips_in_tension(const Model& model, const Solutions& s) {
  const auto jumps = model.bonded.jumps(*s[0]);
  std::vector<GlueSlip> slips;
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const auto& p = model.points[k];
    slips.push_back({p.a.strand, p.b.strand, 0.5 * (p.a.position + p.b.position), -jumps[k][0] * model.section.length});
  }
  return slips;
}

}  // namespace

template <>
const VirtualTest& test<TestKind::kTension>() {
  static constexpr VirtualTest kTest{.name = "tension",
                                     .label = "Tension",
                                     .closed_form = ClosedForm::kRuleOfMixtures,
                                     .supports = end_plane_supports,
                                     .set_up = set_up_tension,
                                     .slips = slips_in_tension};
  return kTest;
}

}  // namespace strandlab::vtest
