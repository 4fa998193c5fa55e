// Weight fractions of the ready cases with densified strands and of their controls (docs/layups.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "strandlab/case/case.hpp"
#include "support/report.hpp"

namespace strandlab::cases {
namespace {

struct PanelCase {
  const char* name;
  double surface_rows, core_rows;
  double surface_solid;  // solid fraction <L>/(<L> + <G>) of a surface row; 25/35 in the core
  double surface_density;
  const char* published;  // fraction by weight in Le (2010), 3.6.4
};
void PrintTo(const PanelCase& panel, std::ostream* out) {
  *out << panel.name;
}

class WeightFraction : public testing::TestWithParam<PanelCase> {};

// Of the panel as formed: length x thickness x density summed here from the mat's own strands.
TEST_P(WeightFraction, IsExactForItsOwnGeometry) {
  const auto c = ready_case(GetParam().name);
  const auto mat = make_mat(c);
  double surface = 0, all = 0;
  for (const auto& layer : mat.layers) {
    for (const auto& strand : layer.strands) {
      const double density = layer.role == "surface" ? GetParam().surface_density : 350;
      const double mass = (strand.x1_mm - strand.x0_mm) * mat.layer_thickness_mm * density;
      all += mass;
      if (layer.role == "surface") surface += mass;
    }
  }
  const auto weight = weigh(c, mat);
  ASSERT_EQ(weight.by_kind[0].name, "surface");
  report(fmt::format("{}: weight fraction of surface strands, mat of seed 1; Le (2010): {}", GetParam().name,
                     GetParam().published),
         weight.by_kind[0].fraction, near(surface / all, 1e-14).because(test::kRoundOff));
  EXPECT_NEAR(weight.kg_per_m2, 1e-3 * all / mat.length_mm, 1e-12);
}

// Of a mat of 100 m: rows x solid fraction x density, by the renewal theorem.
TEST_P(WeightFraction, TendsToThatOfItsRows) {
  const auto& p = GetParam();
  auto c = ready_case(p.name);
  c.length_mm = 1e5;
  const double surface = p.surface_rows * p.surface_solid * p.surface_density, core = p.core_rows * 25 / 35 * 350;
  const double expected = surface / (surface + core), measured = weigh(c, make_mat(c)).by_kind[0].fraction;
  report(fmt::format("{}: weight fraction of surface strands, mat of 100 m, over that of its rows, {:.4f}", p.name,
                     expected),
         measured / expected, near(1, 0.005).because("a random mat: the deviation may pass through zero"));
}

INSTANTIATE_TEST_SUITE_P(Panels, WeightFraction,
                         testing::Values(PanelCase{"osb_vtc50", 10, 10, 150. / 165, 910, "about .75"},
                                         PanelCase{"rathi20_control", 4, 16, 150. / 165, 350, ".20"},
                                         PanelCase{"rathi20_vtc", 2, 19, 125. / 140, 910, ".197"},
                                         PanelCase{"rathi40_control", 8, 12, 150. / 165, 350, ".40"},
                                         PanelCase{"rathi40_vtc", 4, 14, 125. / 140, 910, ".400"}),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace strandlab::cases
