// Virtual tests of panels whose rows differ in thickness.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {
namespace {

struct Ply {
  const char* kind;
  double thickness_mm;
};

std::vector<StrandKind> kinds() {
  return {{"along", wood::library()[0], 0}, {"across", wood::library()[0], 90}, {"dense", wood::library()[1], 0}};
}

mat::Mat laminate(const std::vector<Ply>& plies) {
  mat::Mat mat;
  mat.length_mm = 12;
  mat.layer_thickness_mm = 0.8;
  for (const auto& ply : plies) mat.layers.push_back({ply.kind, {{0, 12, {}, {}, {}}}, {}, ply.thickness_mm});
  return mat;
}

Panel<2> panel_of(const mat::Mat& mat) {
  return make_panel(mat, kinds(), mat::thinnest_layer(mat) / 6, 6);
}

// Plane-strain modulus of a ply, free through the thickness: C11 - C13^2/C33.
double ply_modulus(const Ply& ply) {
  for (const auto& kind : kinds()) {
    if (kind.name != ply.kind) continue;
    const auto C = wood::in_strand_axes(kind.material, kind.angle_deg).stiffness;
    return C(0, 0) - C(0, 2) * C(0, 2) / C(2, 2);
  }
  return 0;
}

// Without gaps all plies stretch alike, so the tension modulus is their mean by thickness, and bending is that of a
// laminated beam about its neutral axis; both exact in plane strain, whatever the glue.
TEST(Thickness, LaminatesAreExact) {
  const std::vector<Ply> plies{{"dense", 1.3}, {"along", 0.8}, {"across", 2.1}, {"along", 0.5}};
  double height = 0, stretch = 0, moment = 0, stiffness = 0;
  for (const auto& ply : plies) {
    const double t = ply.thickness_mm, y = height + t / 2, E = ply_modulus(ply);
    stretch += E * t;
    moment += E * t * y;
    stiffness += E * t * (t * t / 12 + y * y);
    height += t;
  }
  const double tension = stretch / height;
  const double bending = (stiffness - moment * moment / stretch) * 12 / (height * height * height);
  Options options;
  options.compliance_t_mm_per_MPa = {0, 0.05};
  for (const auto& m : measure(panel_of(laminate(plies)), options).moduli) {
    EXPECT_NEAR(m.modulus_MPa, m.kind == TestKind::kTension ? tension : bending, 0.1) << name(m.kind);
    EXPECT_NEAR(m.reaction_modulus_MPa, m.modulus_MPa, 1e-5 * m.modulus_MPa) << name(m.kind);
  }
}

// Turned upside down a panel with gaps and rows of different thickness has the same moduli.
TEST(Thickness, AMirroredPanelHasTheSameModuli) {
  auto mat = laminate({{"dense", 1.1}, {"across", 0.6}, {"along", 0.8}, {"along", 1.4}});
  mat.layers[0].strands = {{0, 5, {}, {}, {}}, {5.7, 12, {}, {}, {}}};
  mat.layers[2].strands = {{0, 8, {}, {}, {}}, {8.5, 12, {}, {}, {}}};
  auto mirrored = mat;
  std::reverse(mirrored.layers.begin(), mirrored.layers.end());
  Options options;
  options.compliance_t_mm_per_MPa = {0, 0.0105};
  const auto a = measure(panel_of(mat), options), b = measure(panel_of(mirrored), options);
  ASSERT_EQ(a.moduli.size(), b.moduli.size());
  EXPECT_NEAR(a.glued_fraction, b.glued_fraction, 1e-9);
  for (std::size_t i = 0; i < a.moduli.size(); ++i)
    EXPECT_NEAR(a.moduli[i].modulus_MPa / b.moduli[i].modulus_MPa, 1, 2e-6) << name(a.moduli[i].kind);
}

// Softening acts in the press alone: the panel is tested cold.
TEST(Thickness, SofteningDoesNotReachTheTests) {
  auto soft = kinds();
  for (auto& kind : soft) kind.yield_factor = kind.stiffness_factor = 0.5;
  const auto mat = laminate({{"along", 0.8}, {"dense", 1.2}});
  const auto warm = make_panel(mat, soft, 0.8 / 6, 6), cold = make_panel(mat, kinds(), 0.8 / 6, 6);
  const auto a = measure(warm, {}), b = measure(cold, {});
  for (std::size_t i = 0; i < a.moduli.size(); ++i) EXPECT_EQ(a.moduli[i].modulus_MPa, b.moduli[i].modulus_MPa);
}

}  // namespace
}  // namespace strandlab::vtest
