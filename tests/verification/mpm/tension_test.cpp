// Homogeneous tension of an isotropic block by dynamics, plane strain: E/(1 - nu^2).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/report.hpp"
#include "verification/mpm/single_block.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kBarE = 11000, kNu = 0.33;  // MPa; E/(1 - nu^2) = 12344 MPa
constexpr double kBarLength = 16, kHeight = 4, kBarCell = 0.5;
constexpr double kStress = 1;  // MPa, a strain of 8e-5

int face_named(const Body<2>& body, const std::string& name) {
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    if (body.faces[f].name == name) return static_cast<int>(f);
  }
  ADD_FAILURE() << "no face " << name;
  return 0;
}

// Mean position along x of a face's points.
double mean_x(const Body<2>& body, int face) {
  const auto& f = body.faces[face];
  double sum = 0;
  for (std::size_t i = 0; i < f.particle.size(); ++i) {
    sum += (body.points.x[f.particle[i]] + body.points.F[f.particle[i]] * f.offset[i])[0];
  }
  return sum / static_cast<double>(f.particle.size());
}

// Pulls a free block, its corner at `shift` cells off the grid lines on both axes, by its end faces with a traction
// that rises smoothly over 20 wave transits, and returns stress over strain, averaged over 4 more.
double modulus(double shift) {
  const Vec<2> corner = Vec<2>::Constant(shift * kBarCell);
  std::vector<Body<2>> bodies{block<2>(isotropic(kBarE, kNu, 500), {64, 16}, {kBarCell / 2, kBarCell / 2}, corner)};
  Body<2>& body = bodies[0];
  const int left = face_named(body, "left end"), right = face_named(body, "right end");
  Engine<2> engine(bodies, open_grid<2>(kBarCell, -2, 20), {});
  const double transit = kBarLength / std::sqrt(kBarE / body.material.density), ramp = 20 * transit;
  const double length = mean_x(body, right) - mean_x(body, left);
  double sum = 0, samples = 0;
  while (engine.state().time_s < ramp + 4 * transit) {
    const double t = std::min(engine.state().time_s / ramp, 1.0);
    const double stress = 0.5 * kStress * (1 - std::cos(M_PI * t));
    engine.set_traction(0, left, {-stress, 0});
    engine.set_traction(0, right, {stress, 0});
    engine.step();
    if (t < 1) continue;
    engine.write(bodies);
    sum += (mean_x(body, right) - mean_x(body, left)) / length - 1;
    ++samples;
  }
  const double E = kStress / (sum / samples), stored = kBarLength * kHeight * kStress * kStress / (2 * E);
  const Energies e = engine.energies();
  EXPECT_NEAR(e.external_work, stored, 0.01 * stored) << "offset " << shift;
  EXPECT_NEAR(e.elastic, stored, 0.01 * stored) << "offset " << shift;
  return E;
}

TEST(Tension, PlaneStrainModulus) {
  const double exact = kBarE / (1 - kNu * kNu);
  for (double shift : {0.0, 0.15, 0.25, 0.37, 0.5, 0.8}) {
    const double E = modulus(shift);
    report(fmt::format("tension by dynamics, block {} cells off the grid lines: modulus against E/(1 - nu^2)", shift),
           E, near(exact, 5e-4 * exact), "MPa");
  }
}

}  // namespace
}  // namespace strandlab::mpm
