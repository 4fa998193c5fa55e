// What a plate's stiffness must not depend on, and how it must depend on the glue.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "plates.hpp"
#include "strandlab/core/eigenvalues.hpp"
#include "strandlab/core/error.hpp"
#include "support/report.hpp"

namespace strandlab::vtest {
namespace {

using test::kRoundOff;

statics::PlateStiffness stiffness_of(const mat::PlateMat& mat, double compliance_t, double element = 1) {
  return measure(panel_of(mat), options(element, {compliance_t})).tensors[0].abd;
}

// A 0/90 mat turned by 45 degrees is a torus mat of two copies, by atan(1/2) one of five: lattices, glue, areas, wood
// and loads are turned, and the stiffness must be the turned one.
TEST(PlateInvariance, ATurnedMatHasTheTurnedStiffness) {
  const auto straight = stiffness_of(small_mat(), 0.0105);
  for (const auto& [p, q] : {std::pair{1, 1}, {2, 1}}) {
    const auto found = stiffness_of(turned_mat(small_mat(), p, q), 0.0105);
    report("small mat turned by atan(" + std::to_string(q) + "/" + std::to_string(p) +
               "), 1 mm: off the turned stiffness by",
           largest_difference(found, turned(straight, std::atan2(q, p))), below(1e-9).because(kRoundOff));
  }
}

TEST(PlateInvariance, TurnedReferenceMatsNightly) {
  for (const double compliance : {0.0, 0.0105}) {
    const auto straight = stiffness_of(reference_plate("per_a"), compliance, 2);
    for (const std::string name : {"per_a_45", "per_a_26"}) {
      const double angle = reference_moduli()[name]["angle_deg"].get<double>() * std::numbers::pi / 180;
      report(name + ", 2 mm, 1/D_t = " + test::number(compliance) + ": off per_a's stiffness, turned, by",
             largest_difference(stiffness_of(reference_plate(name), compliance, 2), turned(straight, angle)),
             below(1e-6).because("coordinates of the turned mat are on a raster of 1e-6 mm"));
    }
  }
}

mat::PlateMat changed(mat::PlateMat mat, const std::function<void(mat::PlateStrand&)>& change) {
  for (auto& layer : mat.layers) std::for_each(layer.strands.begin(), layer.strands.end(), change);
  return mat;
}

TEST(PlateInvariance, NothingDependsOnWhereTheWindowBegins) {
  const auto mat = small_mat();
  const auto shifted = changed(mat, [](auto& s) {
    s.cx_mm = std::fmod(s.cx_mm + 7.3, 12);
    s.cy_mm = std::fmod(s.cy_mm + 4.1, 12);
  });
  report("small mat shifted on its torus: stiffness changes by",
         largest_difference(stiffness_of(shifted, 0.0105), stiffness_of(mat, 0.0105)), below(1e-9).because(kRoundOff));
}

TEST(PlateInvariance, NothingDependsOnTheOrderOfStrands) {
  auto mat = small_mat();
  const auto expected = stiffness_of(mat, 0);
  for (auto& layer : mat.layers) std::reverse(layer.strands.begin(), layer.strands.end());
  report("small mat, strands of each layer in reverse order: stiffness changes by",
         largest_difference(stiffness_of(mat, 0), expected), below(1e-9).because(kRoundOff));
}

// x for y: e_xx and e_yy, k_xx and k_yy change places.
TEST(PlateInvariance, ATransposedMatHasTheTransposedStiffness) {
  const auto transposed = changed(small_mat(), [](auto& s) {
    std::swap(s.cx_mm, s.cy_mm);
    s.angle_deg = 90 - *s.angle_deg;
  });
  Eigen::PermutationMatrix<6> swap;
  swap.indices() << 1, 0, 2, 4, 3, 5;
  const statics::PlateStiffness expected = swap.transpose() * stiffness_of(small_mat(), 0.0105) * swap;
  report("small mat transposed: off the transposed stiffness by",
         largest_difference(stiffness_of(transposed, 0.0105), expected), below(1e-9).because(kRoundOff));
}

// Turned upside down A and D stay, B changes its sign.
TEST(PlateInvariance, AMatUpsideDownHasTheOppositeCoupling) {
  auto mat = small_mat();
  const auto straight = stiffness_of(mat, 0);
  std::reverse(mat.layers.begin(), mat.layers.end());
  auto expected = straight;
  expected.topRightCorner<3, 3>() *= -1;
  expected.bottomLeftCorner<3, 3>() *= -1;
  report("small mat mirrored through its mid-plane, 1/D_t = 0: off A, -B, D by",
         largest_difference(stiffness_of(mat, 0), expected), below(1e-9).because(kRoundOff));
}

// Contacts of strands at any angle leave glue points of any area along their edges; perfect bonds there do not depend
// on the penalty that finds their tractions.
TEST(PlateInvariance, PerfectBondsDoNotDependOnTheirPenalty) {
  auto o = options(2, {0});
  const auto panel = panel_of(reference_plate("rot_a"));
  const auto usual = measure(panel, o).tensors[0].abd;
  o.perfect_bond *= 10;
  report("rot_a, 2 mm, 1/D_t = 0, ten times the penalty: stiffness changes by",
         largest_difference(measure(panel, o).tensors[0].abd, usual), below(1e-4).because("what a bond must keep to"));
}

// Moduli fall as the glue gets softer, from a perfect bond, which is the limit of stiff ones; the plate is stable.
TEST(PlateInvariance, SofterGlueMakesASofterPlate) {
  const std::vector<double> compliances{0, 1e-6, 1e-3, 0.0105, 0.05, 1};
  const auto result = measure(panel_of(small_mat()), options(1, compliances));
  report("small mat, 1/D_t = 1e-6 mm/MPa: stiffness off that of a perfect bond by",
         largest_difference(result.tensors[1].abd, result.tensors[0].abd), below(1e-3));
  for (std::size_t k = 0; k < compliances.size(); ++k) {
    EXPECT_GT(eigenvalues(result.tensors[k].abd)[0], 0);
    if (k == 0) continue;
    for (const char* name : {"plate_E_x", "plate_E_y", "plate_G_xy", "plate_Eb_x", "plate_Eb_y", "plate_Gb_xy"}) {
      EXPECT_LT(modulus(result, name, compliances[k]), modulus(result, name, compliances[k - 1])) << name;
    }
    const statics::PlateStiffness less = result.tensors[k - 1].abd - result.tensors[k].abd;  // for every plate strain
    EXPECT_GT(eigenvalues(less)[0], 0);
  }
}

// No plate is stiffer than its strands side by side, coverage times stiffness in its plane (Voigt's bound).
TEST(PlateInvariance, NoPlateIsStifferThanItsStrands) {
  const auto mat = small_mat();
  const auto c = wood::stiffness(wood::Material{});
  double bound = 0;  // of A_11, N/mm
  for (const auto& layer : mat.layers) {
    for (const auto& strand : layer.strands) {
      const double covered = strand.length_mm * strand.width_mm / (12 * 12);
      bound += 0.8 * covered * (*strand.angle_deg == 0 ? c(0, 0) : c(1, 1));
    }
  }
  report("small mat, 1/D_t = 0: A_11 over Voigt's bound", stiffness_of(mat, 0)(0, 0) / bound, between(0, 1));
}

// Strands that nothing holds together across the window are no plate; a strand on its own is left out.
TEST(PlateConnection, SaysAcrossWhichAxisAPanelIsNotConnected) {
  mat::PlateMat mat;
  mat.length_mm = mat.width_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const double cx : {5.0, 15.0}) {  // a strip along x: two strands, overlapping on both sides
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    auto& strand = layer.strands.emplace_back();
    strand.cx_mm = cx;
    strand.cy_mm = 10;
    strand.length_mm = 14;
    strand.width_mm = 4;
  }
  const auto message = [&](const mat::PlateMat& m) -> std::string {
    try {
      measure(panel_of(m), options(2, {0.0105}));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(mat).find("not connected across y:"), std::string::npos) << message(mat);
  auto along_y = mat;
  for (auto& layer : along_y.layers) {
    std::swap(layer.strands[0].cx_mm, layer.strands[0].cy_mm);
    layer.strands[0].angle_deg = 90;
  }
  EXPECT_NE(message(along_y).find("not connected across x:"), std::string::npos) << message(along_y);

  auto with_a_free_strand = small_mat();
  const auto expected = measure(panel_of(with_a_free_strand), options(1, {0.0105}));
  auto& top = with_a_free_strand.layers.emplace_back();
  top.role = "surface";
  auto& strand = top.strands.emplace_back();
  strand = with_a_free_strand.layers[0].strands[0];
  with_a_free_strand.layers.insert(with_a_free_strand.layers.begin() + 3, mat::PlateLayer{"surface", {}, {}, {}});
  const auto found = measure(panel_of(with_a_free_strand), options(1, {0.0105}));
  EXPECT_EQ(found.floating_strands, 1);
  // In-plane stiffness is about another middle, but no other.
  const Eigen::Matrix3d in_plane = expected.tensors[0].abd.topLeftCorner<3, 3>();
  const Eigen::Matrix3d change = found.tensors[0].abd.topLeftCorner<3, 3>() - in_plane;
  EXPECT_LT(change.norm(), 1e-9 * in_plane.norm());
}

}  // namespace
}  // namespace strandlab::vtest
