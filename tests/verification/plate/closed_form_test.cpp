// Plates whose answer is known in closed form, and a plate that is a section.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "plates.hpp"
#include "strandlab/vtest/plate_model.hpp"
#include "strandlab/vtest/vtest.hpp"
#include "support/report.hpp"

namespace strandlab::vtest {
namespace {

using test::kRoundOff;

constexpr double kPly = 0.8, kSide = 4;  // mm

// A laminate of plies without gaps that goes on for ever: strands whose lattices fill a window, the wood turned in
// them, and their opposite edges held together node by node. Points of springs across edges have three perfect bonds,
// one for each direction.
PlateModel laminate(const std::vector<double>& angles, double element_mm) {
  mat::PlateMat mat;
  mat.length_mm = mat.width_mm = kSide;
  mat.layer_thickness_mm = kPly;
  mat.sides = mat::PlateSides::kCut;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    auto& strand = layer.strands.emplace_back();
    strand.cx_mm = strand.cy_mm = kSide / 2;
    strand.length_mm = strand.width_mm = kSide;
  }
  auto panel = panel_of(mat);
  for (std::size_t k = 0; k < angles.size(); ++k)
    panel.strands[k].material = wood::in_strand_axes(wood::Material{}, angles[k]);
  auto mesh = statics::make_mesh(panel, std::vector<bool>(angles.size(), true), 2, element_mm);
  std::vector<glue::GluePoint<3>> points;  // from node to node, each with its share of the ply
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    const auto& below = mesh.strands[k];
    for (const auto corner : below.elements.face_corners(kTop<3>)) {
      const auto place = below.elements.place_of_corner(corner);
      auto& point = points.emplace_back();
      point.a.strand = static_cast<int>(k);
      point.b.strand = static_cast<int>(k) + 1;
      point.b.face = glue::StrandFace::kBottom;
      point.area = element_mm * element_mm;
      for (int a = 0; a < 2; ++a) {
        const int n = place[static_cast<std::size_t>(a)];
        point.a.place[a] = point.b.place[a] = n * below.points_per_element[a];
        if (n == 0 || n == below.elements.counts[static_cast<std::size_t>(a)]) point.area /= 2;
      }
      point.normal = Vec<3>::UnitZ();
    }
  }
  auto springs = statics::make_springs(mesh, points);
  const auto hold = [&](int a, int b) {
    for (int axis = 0; axis < 3; ++axis) {
      statics::Spring<3> spring;
      spring.area = 1;
      spring.nodes = {a, a, a, a, b, b, b, b};
      for (auto& jump : spring.jump) jump.setZero();
      spring.jump[2][axis] = -1;
      spring.jump[2][12 + axis] = 1;
      springs.push_back(spring);
    }
  };
  for (const auto& strand : mesh.strands) {
    const auto& counts = strand.elements.counts;
    for (int k = 0; k <= counts[2]; ++k) {
      for (int j = 0; j <= counts[1]; ++j) hold(strand.node(0, j, k), strand.node(counts[0], j, k));
      for (int i = 0; i < counts[0]; ++i) hold(strand.node(i, 0, k), strand.node(i, counts[1], k));
    }
  }
  statics::BondedPanel<3> bonded(mesh, std::move(springs), statics::penalty(mesh, element_mm, 100));
  return {Vec<2>(kSide, kSide), panel.thickness_mm(), 0, 0.1, std::move(mesh), std::move(points), std::move(bonded)};
}

// Stiffness of a ply in plane stress, of panel axes xx, yy, xy (Jones, Mechanics of Composite Materials, 2.6).
Eigen::Matrix3d plane_stress(double angle_deg) {
  const VoigtMatrix s = wood::in_strand_axes(wood::Material{}, angle_deg).stiffness.inverse();
  constexpr std::array<int, 3> kept{0, 1, 5};
  Eigen::Matrix3d in_plane;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      in_plane(i, j) = s(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]);
  }
  return in_plane.inverse();
}

statics::PlateStiffness laminate_theory(const std::vector<double>& angles) {
  statics::PlateStiffness abd = statics::PlateStiffness::Zero();
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double z0 = kPly * (static_cast<double>(k) - 0.5 * static_cast<double>(angles.size())), z1 = z0 + kPly;
    const auto q = plane_stress(angles[k]);
    abd.topLeftCorner<3, 3>() += (z1 - z0) * q;
    abd.topRightCorner<3, 3>() += (z1 * z1 - z0 * z0) / 2 * q;
    abd.bottomRightCorner<3, 3>() += (z1 * z1 * z1 - z0 * z0 * z0) / 3 * q;
  }
  abd.bottomLeftCorner<3, 3>() = abd.topRightCorner<3, 3>().transpose();
  return abd;
}

// Plies without gaps strain alike and do not slip, whatever glues them: classical laminate theory.
TEST(Laminate, HasTheStiffnessOfLaminateTheory) {
  const std::vector<double> angles{0, 25, -40, 90};
  auto model = laminate(angles, 2);
  const auto loads = statics::plate_loads(model.mesh, model.middle());
  for (const double compliance : {0.0, 0.0105}) {
    PlateResult result;
    statics::SolveTimes times;
    model.bonded.glue({compliance, 0}, times);
    test_torus(model, loads, {times, nullptr}, result);
    const auto name = "[0 25 -40 90] without gaps, 1/D_t = " + test::number(compliance);
    report(name + ": plate stiffness against laminate theory",
           largest_difference(result.tensors[0].abd, laminate_theory(angles)), below(1e-6).because(kRoundOff));
  }
}

// Compliances in series: h G^-1 = sum t [C44 C45; C45 C55]^-1 + (n - 1)/D_t I.
Eigen::Matrix2d planar_shear(const std::vector<double>& angles, double compliance_t) {
  const auto n = static_cast<double>(angles.size());
  Eigen::Matrix2d compliance = (n - 1) * compliance_t * Eigen::Matrix2d::Identity();
  for (const double angle : angles) {
    const auto c = wood::in_strand_axes(wood::Material{}, angle).stiffness;
    Eigen::Matrix2d shear;  // xz, yz
    shear << c(4, 4), c(3, 4), c(3, 4), c(3, 3);
    compliance += kPly * shear.inverse();
  }
  return n * kPly * compliance.inverse();
}

TEST(Laminate, ShearsAndStretchesBetweenPlatesAsCompliancesInSeries) {
  const auto measured = [](const std::vector<double>& angles, double compliance) {
    auto model = laminate(angles, 2);
    PlateResult result;
    statics::SolveTimes times;
    model.bonded.glue({compliance, 0}, times);
    test_glued_plates(model, {times, nullptr}, result);
    return result.moduli;  // G_xz, G_yz, E_z
  };
  const std::vector<double> cross{0, 90, 90, 0};
  for (const auto& [compliance, expected] : {std::pair{0.0, 190.18}, {0.0105, 66.22}, {0.05, 19.182}}) {
    const auto found = measured(cross, compliance);
    EXPECT_NEAR(planar_shear(cross, compliance)(0, 0) / expected, 1, 1e-4);  // the closed form against its number
    report("[0 90 90 0] between plates, 1/D_t = " + test::number(compliance) + ": G_xz over compliances in series",
           found[0].modulus_MPa / planar_shear(cross, compliance)(0, 0), near(1, 1e-6).because(kRoundOff));
    report("[0 90 90 0] between plates, 1/D_t = " + test::number(compliance) + ": E_z", found[2].modulus_MPa,
           near(1219.68, 0.01), "MPa");
  }
  const std::vector<double> oblique{0, 25, -40, 90};
  const auto found = measured(oblique, 0.0105);
  report("[0 25 -40 90] between plates, 1/D_t = .0105: G_xz", found[0].modulus_MPa, near(69.931, 1e-3), "MPa");
  report("[0 25 -40 90] between plates, 1/D_t = .0105: G_yz", found[1].modulus_MPa, near(62.900, 1e-3), "MPa");
}

// A brick wall: three layers t/2, t, t/2 of strands along x, 40 mm from one to the next, gaps of 2 mm, those of the
// middle layer half-way between the others', seams between edges staggered. Stress passes from strand to strand by
// shear lag,
//   E_x = E P/(2 (l + 2 coth(beta l/2)/beta + 2 g)), l = P/2 - g, beta^2 = 4 D/(E t), 1/D = 1/D_t + t/(3 G)
// (E = 10000 MPa, no Poisson effects, t = .8 mm, P = 40 mm, g = 2 mm).
TEST(BrickWall, StretchesByShearLag) {
  wood::Material isotropic;
  isotropic.E_L = isotropic.E_R = isotropic.E_T = 10000;
  isotropic.G_RL = isotropic.G_TL = isotropic.G_RT = 5000;
  isotropic.nu_RL = isotropic.nu_TL = isotropic.nu_TR = 0;
  mat::PlateMat mat;
  mat.length_mm = 40;
  mat.width_mm = 4;
  mat.layer_thickness_mm = 0.4;
  for (int k = 0; k < 3; ++k) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    if (k == 1) layer.thickness_mm = 0.8;
    auto& strand = layer.strands.emplace_back();
    strand.cx_mm = k == 1 ? 0 : 20;
    strand.cy_mm = k == 1 ? 0 : 2;
    strand.length_mm = 38;
    strand.width_mm = 4;
  }
  const std::vector<double> compliances{0.01, 0.05, 0.2};
  const auto result = measure(panel_of(mat, isotropic), options(1, compliances));
  for (const auto& [compliance, closed] : {std::pair{0.01, 6390.2}, {0.05, 4004.4}, {0.2, 1711.8}}) {
    report("brick wall, bricks of 1 mm, 1/D_t = " + test::number(compliance) + ": E_x over shear lag",
           modulus(result, "plate_E_x", compliance) / closed, near(1, 3e-3));
  }
}

// One strand that fills a cut window is stretched, bent and sheared as wood is: E_L or E_T, and G_TL.
TEST(PlaneEnds, OfOneStrandGiveItsOwnModuli) {
  mat::PlateMat mat;
  mat.length_mm = 12;
  mat.width_mm = 8;
  mat.layer_thickness_mm = 0.8;
  mat.sides = mat::PlateSides::kCut;
  for (int k = 0; k < 2; ++k) {  // two, since a panel is what glue holds together
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    auto& strand = layer.strands.emplace_back();
    strand.cx_mm = 6;
    strand.cy_mm = 4;
    strand.length_mm = 12;
    strand.width_mm = 8;
  }
  const wood::Material poplar;
  const auto result = measure(panel_of(mat), options(2, {0}));
  const auto over = [&](const char* name, double expected) { return modulus(result, name, 0) / expected; };
  report("strand in a cut window: tension along x over E_L", over("tension_x", poplar.E_L),
         near(1, 1e-6).because(kRoundOff));
  report("strand in a cut window: tension along y over E_T", over("tension_y", poplar.E_T),
         near(1, 1e-6).because(kRoundOff));
  report("strand in a cut window: bending along x over E_L", over("bending_x", poplar.E_L),
         near(1, 1e-6).because(kRoundOff));
  report("strand in a cut window: bending along y over E_T", over("bending_y", poplar.E_T),
         near(1, 1e-6).because(kRoundOff));
  report("strand in a cut window: given shear over G_TL", over("shear_xy_given", poplar.G_TL),
         near(1, 1e-6).because(kRoundOff));
}

// A section mat as a plate one element deep, nothing moving across: plane strain, so the moduli of the section. Glue
// points are the section's, each as two across.
TEST(PlateOfASection, HasTheModuliOfTheSection) {
  mat::Mat mat;
  mat.length_mm = 20;
  mat.layer_thickness_mm = 0.8;
  struct Piece {
    double x0, x1;
    int row;
  };
  for (const auto& [x0, x1, row] : std::vector<Piece>{
           {0, 12.3, 0}, {13.1, 20, 0}, {0, 3.4, 1}, {4.1, 9.9, 1}, {10.4, 20, 1}, {0, 6.7, 2}, {7, 20, 2}}) {
    while (static_cast<int>(mat.layers.size()) <= row)
      mat.layers.emplace_back().role = mat.layers.size() == 1 ? "core" : "surface";
    auto& strand = mat.layers[static_cast<std::size_t>(row)].strands.emplace_back();
    strand.x0_mm = x0;
    strand.x1_mm = x1;
  }
  const auto section = make_panel(mat, kinds_of({}), 0.8 / 6, 6);
  Options o;
  o.compliance_t_mm_per_MPa = {0, 0.0105, 0.05};
  const auto expected = measure(section, o);

  const double depth = statics::element_length(section, 3);
  Panel<3> plate;
  for (const auto& strand : section.strands) {
    const auto& [along, through] = strand.lattice.counts;
    const Vec<2> corner = strand.points.x.front() - 0.5 * strand.lattice.spacing;
    auto s = formed_strand<3>({{along, 1, through}, {strand.lattice.spacing[0], depth, strand.lattice.spacing[1]}},
                              {Vec<3>(corner[0], 0, corner[1])}, strand.material);
    plate.strands.push_back(std::move(s));
  }
  auto mesh = statics::make_mesh(plate, std::vector<bool>(plate.strands.size(), true), 3, depth);
  auto curing = o.curing;
  curing.point_spacing_mm = depth;
  std::vector<glue::GluePoint<3>> points;
  for (const auto& point : glue::cure(section, curing)) {
    const auto across = [&](const glue::FacePoint<2>& side, double place) {
      glue::FacePoint<3> p;
      p.strand = side.strand;
      p.face = side.face;
      p.place = Vec<2>(side.segment + side.xi, place);
      p.position = Vec<3>(side.position[0], place * depth, side.position[1]);
      return p;
    };
    for (const double place : {0.25, 0.75}) {
      points.push_back({across(point.a, place), across(point.b, place), Vec<3>(point.normal[0], 0, point.normal[1]),
                        0.5 * depth * point.area, point.gap});
    }
  }
  statics::BondedPanel<3> bonded(mesh, statics::make_springs(mesh, points), statics::penalty(mesh, depth, 100));
  statics::SolveTimes times;
  const auto dofs = static_cast<std::size_t>(mesh.dofs());
  for (std::size_t k = 0; k < o.compliance_t_mm_per_MPa.size(); ++k) {
    bonded.glue({o.compliance_t_mm_per_MPa[k], 0}, times);
    statics::Supports supports{std::vector<char>(dofs, 0), 1e4};
    statics::LoadCase load{std::vector<double>(dofs, 0.0), std::vector<double>(dofs, 0.0)};
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      supports.fixed[3 * n + 1] = 1;
      const double x = mesh.nodes[n][0];
      if (x > 1e-9 && x < 20 - 1e-9) continue;
      supports.fixed[3 * n] = 1;
      load.given[3 * n] = x > 1 ? 1 : 0;
    }
    supports.fixed[2] = 1;
    const auto solution = bonded.solve(supports, {load}, times).front();
    const double tension = 2 * bonded.energy(solution) * 20 / (depth * section.thickness_mm());
    report("plate of a section, 1/D_t = " + test::number(o.compliance_t_mm_per_MPa[k]) +
               ": tension modulus over the section's",
           tension / expected.moduli[2 * k].modulus_MPa, near(1, 1e-8).because(kRoundOff));
  }
}

}  // namespace
}  // namespace strandlab::vtest
