// Moduli of flat reference mats against an independent finite-element program (its meshes are matching grids of bricks
// of the same kind; glue is integrated over whole facets).
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "plates.hpp"
#include "support/report.hpp"

namespace strandlab::vtest {
namespace {

using test::kRoundOff;

constexpr const char* kSixDigits = "the reference is given in six digits";
constexpr const char* kOtherRule =
    "one glue point per corner against whole facets, and another mesh; the reference's own limit is good to about 1 %";

// Largest relative difference of moduli from a table of the reference's, with its names.
double largest_difference_of(const PlateResult& result, const nlohmann::json& table, double compliance_t,
                             const std::vector<std::pair<std::string, std::string>>& names) {
  double largest = 0;
  for (const auto& [ours, theirs] : names) {
    const auto& entry = table.at(theirs);
    const double expected = entry.is_object() ? entry.at("limit").get<double>() : entry.get<double>();
    largest = std::max(largest, std::abs(modulus(result, ours, compliance_t) / expected - 1));
  }
  return largest;
}

const std::vector<std::pair<std::string, std::string>> kStretch{
    {"plate_E_x", "E_x"}, {"plate_E_y", "E_y"}, {"plate_Eb_x", "Eb_x"}, {"plate_Eb_y", "Eb_y"}};
const std::vector<std::pair<std::string, std::string>> kShear{{"plate_G_xy", "G_xy"}, {"plate_Gb_xy", "Gb_xy"}};
const std::vector<std::pair<std::string, std::string>> kCut{
    {"tension_x", "E_x"}, {"tension_y", "E_y"}, {"bending_x", "Eb_x"}, {"bending_y", "Eb_y"}};
const std::vector<std::pair<std::string, std::string>> kCutShear{{"shear_xy_given", "G_xy_given"}};

const nlohmann::json& raster(const std::string& mat, const std::string& compliance, const std::string& mesh) {
  return reference_moduli()[mat]["moduli"]["raster"]["1/Dt=" + compliance][mesh];
}

// The reference merges the nodes of a perfect bond where the strands' meshes match: multipliers at one point per corner
// do the same.
TEST(PlateReference, APerfectBondOfMatchingMeshesMeetsMergedNodes) {
  auto o = options(2, {0});
  o.glued_plates = true;
  const auto result = measure(panel_of(reference_plate("per_a")), o);
  const auto& expected = raster("per_a", "0", "h=2,nz=2");
  report("per_a, 2 mm, 1/D_t = 0: plate stiffness against the reference's, over the root of the diagonals",
         largest_difference(result.tensors[0].abd, abd(expected["ABD"])), below(1e-5).because(kSixDigits));
  report("per_a, 2 mm, 1/D_t = 0: G_xz and G_yz between glued plates against the reference",
         largest_difference_of(result, expected, 0, {{"plates_G_xz", "G_xz"}, {"plates_G_yz", "G_yz"}}),
         below(1e-5).because(kSixDigits));
  report("per_a, 2 mm: plate stiffness by energy and by stress resultants differ by",
         largest_difference(result.tensors[0].abd_resultants, result.tensors[0].abd), below(1e-6).because(kRoundOff));
  const statics::PlateStiffness transposed = result.tensors[0].abd_resultants.transpose();
  report("per_a, 2 mm: plate stiffness by stress resultants is symmetric to",
         largest_difference(transposed, result.tensors[0].abd_resultants), below(1e-8).because(kRoundOff));
}

TEST(PlateReference, CompliantGlueOfShortStrandsIsNearTheLimitOfFineMeshes) {
  const auto result = measure(panel_of(reference_plate("per_a")), options(2, {0.0105, 0.05}));
  for (const auto& [text, compliance] : {std::pair{"0.0105", 0.0105}, {"0.05", 0.05}}) {
    const auto& limit = raster("per_a", text, "limit_h_to_0");
    report(std::string("per_a, 2 mm, 1/D_t = ") + text +
               ": E_x, E_y, E_bx, E_by off the reference's limit of fine meshes by",
           largest_difference_of(result, limit, compliance, kStretch), below(0.015).because(kOtherRule));
    report(std::string("per_a, 2 mm, 1/D_t = ") + text + ": G_xy and G_b off the reference's limit of fine meshes by",
           largest_difference_of(result, limit, compliance, kShear), below(0.025).because(kOtherRule));
  }
}

TEST(PlateReference, FinerMeshesAreNearerNightly) {
  auto o = options(1, {0, 0.0105, 0.05});
  o.glued_plates = true;
  const auto result = measure(panel_of(reference_plate("per_a")), o);
  report("per_a, 1 mm, 1/D_t = 0: plate stiffness against the reference on the same mesh",
         largest_difference(result.tensors[0].abd, abd(raster("per_a", "0", "h=1,nz=2")["ABD"])),
         below(1e-5).because(kSixDigits));
  for (const auto& [text, compliance] : {std::pair{"0.0105", 0.0105}, {"0.05", 0.05}}) {
    const auto& limit = raster("per_a", text, "limit_h_to_0");
    report(std::string("per_a, 1 mm, 1/D_t = ") + text + ": E_x, E_y, E_bx, E_by off the limit of fine meshes by",
           largest_difference_of(result, limit, compliance, kStretch), below(0.015).because(kOtherRule));
    report(std::string("per_a, 1 mm, 1/D_t = ") + text + ": G_xy and G_b off the limit of fine meshes by",
           largest_difference_of(result, limit, compliance, kShear), below(0.025).because(kOtherRule));
    report(std::string("per_a, 1 mm, 1/D_t = ") + text + ": G_xz and G_yz off the limit of fine meshes by",
           largest_difference_of(result, limit, compliance, {{"plates_G_xz", "G_xz"}, {"plates_G_yz", "G_yz"}}),
           below(0.025).because(kOtherRule));
  }
}

TEST(PlateReference, PlaneEndsOfACutMatNightly) {
  const auto result = measure(panel_of(reference_plate("cut_a")), options(2, {0, 0.0105, 0.05}));
  for (const auto& [text, compliance] : {std::pair{"0", 0.0}, {"0.0105", 0.0105}, {"0.05", 0.05}}) {
    const auto& same = raster("cut_a", text, "h=2,nz=2");
    report(std::string("cut_a, 2 mm, 1/D_t = ") + text + ": tension and bending along x and y against the same mesh",
           largest_difference_of(result, same, compliance, kCut), below(0.005).because(kOtherRule));
    report(std::string("cut_a, 2 mm, 1/D_t = ") + text + ": shear given on four sides against the same mesh",
           largest_difference_of(result, same, compliance, kCutShear), below(0.015).because(kOtherRule));
  }
}

// Strands at any angle: a second program of the reference, with lattices of its own and glue at 6 x 6 points a facet.
// Its bending moduli at 1 mm are 3 % above its own limit.
TEST(PlateReference, StrandsAtAnyAngleNightly) {
  const auto result = measure(panel_of(reference_plate("rot_a")), options(1, {0.0105, 0.05}));
  for (const auto& [text, compliance] : {std::pair{"0.0105", 0.0105}, {"0.05", 0.05}}) {
    const auto& second = reference_moduli()["rot_a"]["moduli"]["own_lattices"][std::string("1/Dt=") + text];
    const std::string name = std::string("rot_a, 1 mm, 1/D_t = ") + text;
    report(name + ": E_x, E_y, E_bx, E_by against the second program on the same mesh",
           largest_difference_of(result, second["h=1,nz=2"], compliance, kStretch), below(0.02).because(kOtherRule));
    report(name + ": G_xy and G_b against the second program on the same mesh",
           largest_difference_of(result, second["h=1,nz=2"], compliance, kShear), below(0.03).because(kOtherRule));
    report(
        name + ": E_x, E_y off the second program's limit by",
        largest_difference_of(result, second["limit_h_to_0"], compliance, {{"plate_E_x", "E_x"}, {"plate_E_y", "E_y"}}),
        below(0.02).because(kOtherRule));
    report(name + ": G_xy off the second program's limit by",
           largest_difference_of(result, second["limit_h_to_0"], compliance, {{"plate_G_xy", "G_xy"}}),
           below(0.03).because(kOtherRule));
    report(name + ": E_bx, E_by off the second program's limit by",
           largest_difference_of(result, second["limit_h_to_0"], compliance,
                                 {{"plate_Eb_x", "Eb_x"}, {"plate_Eb_y", "Eb_y"}}),
           below(0.05).because(kOtherRule));
  }
}

// The same mat at 2 mm against that program's mesh of 2 mm.
TEST(PlateReference, StrandsAtAnyAngle) {
  const auto result = measure(panel_of(reference_plate("rot_a")), options(2, {0.0105}));
  const auto& same = reference_moduli()["rot_a"]["moduli"]["own_lattices"]["1/Dt=0.0105"]["h=2,nz=2"];
  report("rot_a, 2 mm, 1/D_t = .0105: all six moduli against the second program on the same mesh",
         std::max(largest_difference_of(result, same, 0.0105, kStretch),
                  largest_difference_of(result, same, 0.0105, kShear)),
         below(0.04).because(kOtherRule));
}

}  // namespace
}  // namespace strandlab::vtest
