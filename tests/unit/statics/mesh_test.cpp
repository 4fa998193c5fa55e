#include "strandlab/statics/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/statics/stiffness.hpp"
#include "unit/statics/bonds.hpp"

namespace strandlab::statics {
namespace {

// Two strands of poplar on top of each other, the upper one shorter.
Panel<2> two_strands() {
  mat::Mat mat;
  mat.length_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const double x1 : {20.0, 13.37}) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    layer.strands.emplace_back().x1_mm = x1;
  }
  return make_panel(mat, {{"surface", wood::Material{}, 0}}, 0.8 / 6, 6);
}

Vec<2> rigid(const Vec<2>& x) {
  return {0.3 - 1e-3 * x[1], -0.2 + 1e-3 * x[0]};
}

std::vector<double> sample(const Mesh<2>& mesh, Vec<2> (*field)(const Vec<2>&)) {
  std::vector<double> u;
  for (const auto& node : mesh.nodes) {
    u.push_back(field(node)[0]);
    u.push_back(field(node)[1]);
  }
  return u;
}

// The nodes at x = 0, where both strands end.
std::vector<bool> end_nodes(const Mesh<2>& mesh) {
  std::vector<bool> at_end;
  for (const auto& node : mesh.nodes) at_end.push_back(node[0] < 1e-9);
  return at_end;
}

// Strand ends and faces are where the mat put them, for coarser and finer elements than the lattice and for ones that
// do not divide it.
TEST(Mesh, KeepsEndsAndFacesExact) {
  const auto panel = two_strands();
  for (const int through : {1, 3, 4, 6, 12}) {
    const auto mesh = make_mesh(panel, {true, true}, through);
    const auto& upper = mesh.strands[1];
    EXPECT_NEAR((mesh.nodes[upper.node(0, 0)] - Vec<2>(0, 0.8)).norm(), 0, 1e-12);
    EXPECT_NEAR((mesh.nodes[upper.node(upper.along(), upper.through())] - Vec<2>(13.37, 1.6)).norm(), 0, 1e-12);
    EXPECT_EQ(upper.through(), through);
    EXPECT_NEAR(13.37 / upper.along(), 0.8 / through, 0.1 * 0.8 / through);  // elements are about square
    double total = 0;
    for (const auto& e : mesh.elements) {
      total += area({mesh.nodes[e[0]], mesh.nodes[e[1]], mesh.nodes[e[2]], mesh.nodes[e[3]]});
    }
    EXPECT_NEAR(total, 0.8 * (20 + 13.37), 1e-10);
  }
}

// A strand flattened to 80 % holds the same wood in less height: stiffness C0/0.8.
TEST(Mesh, ScalesStiffnessByTheVolumeLost) {
  auto panel = two_strands();
  const auto before = make_mesh(panel, {true, true}, 3);
  for (auto& strand : panel.strands) {
    for (auto& x : strand.points.x) x[1] *= 0.8;
    for (auto& F : strand.points.F) F(1, 1) = 0.8;
  }
  const auto after = make_mesh(panel, {true, true}, 3);
  for (std::size_t e = 0; e < before.stiffness.size(); ++e) {
    EXPECT_LT((after.stiffness[e] - before.stiffness[e] / 0.8).norm(), 1e-9 * before.stiffness[e].norm());
  }
}

// The grain follows F a0: a strand sheared by tan 0.2 has its grain at 0.2 rad.
TEST(Mesh, TurnsMaterialAxesWithTheGrain) {
  auto panel = two_strands();
  for (auto& F : panel.strands[0].points.F) F(1, 0) = std::tan(0.2);
  const auto mesh = make_mesh(panel, {true, false}, 3);
  const auto expected = in_section(panel.strands[0].material.stiffness, Vec<2>(std::cos(0.2), std::sin(0.2)));
  const auto& e = mesh.elements[40];
  const double now = area({mesh.nodes[e[0]], mesh.nodes[e[1]], mesh.nodes[e[2]], mesh.nodes[e[3]]});
  const double formed = 0.8 / 3 * 20 / mesh.strands[0].along();
  EXPECT_LT((mesh.stiffness[40] * now / formed - expected).norm(), 1e-9 * expected.norm());
}

TEST(Mesh, LeavesOutStrandsThatAreNotKept) {
  const auto mesh = make_mesh(two_strands(), {false, true}, 3);
  ASSERT_EQ(mesh.strands.size(), 1U);
  EXPECT_EQ(mesh.mesh_of_strand, (std::vector<int>{-1, 0}));
}

// A glue point's place on the mesh is its place on the face.
TEST(Mesh, LocatesGluePoints) {
  const auto panel = two_strands();
  const auto mesh = make_mesh(panel, {true, true}, 4);
  for (const auto& point : glue::cure(panel, {})) {
    for (const auto* side : {&point.a, &point.b}) {
      const auto place = locate(mesh, *side);
      const Vec<2> position = (1 - place.xi) * mesh.nodes[place.first] + place.xi * mesh.nodes[place.second];
      EXPECT_NEAR((position - side->position).norm(), 0, 1e-9);
    }
  }
}

// A rigid motion stretches no glue, even where the glue line is 0.09 mm thick and elements of the two faces do not
// match.
TEST(Springs, DoNotFeelARigidMotion) {
  auto panel = two_strands();
  for (auto& x : panel.strands[1].points.x) x[1] += 0.09;
  const auto mesh = make_mesh(panel, {true, true}, 3);
  const PanelStiffness stiffness(mesh, make_springs(mesh, glue::cure(panel, {}), end_nodes(mesh)));
  const auto u = sample(mesh, rigid);
  EXPECT_LT(stiffness.glue_energy(u, everywhere(stiffness, {100, 100})), 1e-24);
  // Round-off of sums of K u^2 ~ 1e4 N/mm x (0.3 mm)^2, of either sign; a strain of 1e-3 would store 0.1 mJ.
  EXPECT_NEAR(stiffness.wood_energy(u), 0, 1e-9);
}

// A slip s between two strands stores D_t s^2/2 times the glued length, and an opening D_n s^2/2.
TEST(Springs, StoreTheEnergyOfAJump) {
  const auto panel = two_strands();
  const auto mesh = make_mesh(panel, {true, true}, 3);
  const PanelStiffness stiffness(mesh, make_springs(mesh, glue::cure(panel, {}), end_nodes(mesh)));
  std::vector<double> slip(static_cast<std::size_t>(mesh.dofs()), 0.0), opening = slip;
  for (std::size_t n = static_cast<std::size_t>(mesh.strands[1].first_node); n < mesh.nodes.size(); ++n) {
    slip[2 * n] = 0.01;
    opening[2 * n + 1] = 0.01;
  }
  EXPECT_NEAR(stiffness.glue_energy(slip, everywhere(stiffness, {70, 300})), 0.5 * 70 * 1e-4 * 13.37, 1e-9);
  EXPECT_NEAR(stiffness.glue_energy(opening, everywhere(stiffness, {70, 300})), 0.5 * 300 * 1e-4 * 13.37, 1e-9);
}

// Energy by elements and springs is u.K u/2 of the assembled matrix.
TEST(PanelStiffness, AssemblesWhatItsEnergySays) {
  const auto panel = two_strands();
  const auto mesh = make_mesh(panel, {true, true}, 3);
  const PanelStiffness stiffness(mesh, make_springs(mesh, glue::cure(panel, {}), end_nodes(mesh)));
  const auto u =
      sample(mesh, [](const Vec<2>& x) { return Vec<2>(0.01 * std::sin(x[0] + 3 * x[1]), 0.02 * std::cos(2 * x[0])); });
  const glue::BondStiffness glue{70, 300};
  const auto force = multiply(stiffness.with(everywhere(stiffness, glue)), u);
  double work = 0;
  for (std::size_t i = 0; i < u.size(); ++i) work += 0.5 * force[i] * u[i];
  EXPECT_NEAR(work / (stiffness.wood_energy(u) + stiffness.glue_energy(u, everywhere(stiffness, glue))), 1, 1e-12);
}

// Where both faces end on a plane that is turned as a whole, u_x = -theta y, a thick glue line is at rest whatever the
// faces' slopes do: nothing is locked there.
TEST(Springs, LetAnEndPlaneTurnAsAWhole) {
  auto panel = two_strands();
  for (auto& x : panel.strands[1].points.x) x[1] += 0.05;
  const auto mesh = make_mesh(panel, {true, true}, 3);
  const auto springs = make_springs(mesh, glue::cure(panel, {}), end_nodes(mesh));
  const auto& corner = springs.front();
  Eigen::Matrix<double, 8, 1> u;
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(mesh.nodes[corner.nodes[i]][0], 0, 1e-12);
    u.segment<2>(2 * i) = Vec<2>(-0.01 * mesh.nodes[corner.nodes[i]][1], 0.3);
  }
  EXPECT_NEAR(corner.jump[0].dot(u), 0, 1e-15);
  EXPECT_NEAR(corner.jump[1].dot(u), 0, 1e-15);
}

// A bottom corner pushed up beyond the strand's middle folds the elements there; their nodes are moved until no element
// is, and the strand away from the corner stays as it is.
TEST(Mesh, StraightensFoldedCorners) {
  auto panel = two_strands();
  auto& strand = panel.strands[0];
  strand.points.x[0] += Vec<2>(0.45, 0.3);
  strand.points.x[1] += Vec<2>(0.1, 0.2);
  const auto mesh = make_mesh(panel, {true, true}, 6);
  EXPECT_GT(mesh.straightened, 0);
  const auto reference = make_mesh(two_strands(), {true, true}, 6);
  EXPECT_EQ(reference.straightened, 0);
  for (const auto& e : mesh.elements) {
    EXPECT_NO_THROW(incompatible_element<2>({mesh.nodes[e[0]], mesh.nodes[e[1]], mesh.nodes[e[2]], mesh.nodes[e[3]]},
                                            PlaneStiffness::Identity()));
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (reference.nodes[n][0] < 3) continue;
    EXPECT_NEAR((mesh.nodes[n] - reference.nodes[n]).norm(), 0, 1e-12);
  }
}

TEST(Mesh, StraightensFoldedCornersOfPlates) {
  const auto plate = [] {
    const Lattice<3> lattice{{12, 8, 6}, {0.5, 0.5, 0.8 / 6}};
    Panel<3> panel;
    panel.length_mm = panel.depth_mm = 20;
    panel.initial_thickness_mm = panel.top_mm = 0.8;
    panel.strands.push_back(
        formed_strand<3>(lattice, turned(lattice, {10, 10, 0.4}, 30), wood::in_strand_axes(wood::Material{}, 0)));
    return panel;
  };
  auto panel = plate();
  panel.strands[0].points.x[0] += Vec<3>(0.6, 0.5, 0.4);
  panel.strands[0].points.x[1] += Vec<3>(0.2, 0.1, 0.3);
  const auto mesh = make_mesh(panel, {true}, 3, 0.5), reference = make_mesh(plate(), {true}, 3, 0.5);
  EXPECT_GT(mesh.straightened, 0);
  EXPECT_EQ(reference.straightened, 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) EXPECT_GT(volume(mesh.corners(e)), 0);
  double moved_far_away = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if ((reference.nodes[n] - reference.nodes[0]).norm() > 4)
      moved_far_away = std::max(moved_far_away, (mesh.nodes[n] - reference.nodes[n]).norm());
  }
  EXPECT_EQ(moved_far_away, 0);
}

// A strand turned inside out cannot be meshed.
TEST(Mesh, SaysWhichStrandIsTooDistorted) {
  auto panel = two_strands();
  for (auto& x : panel.strands[1].points.x) x[0] = 20 - x[0];
  for (auto& F : panel.strands[1].points.F) F(0, 0) = -1;
  try {
    make_mesh(panel, {true, true}, 3);
    FAIL() << "no RunError";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("strand 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace strandlab::statics
