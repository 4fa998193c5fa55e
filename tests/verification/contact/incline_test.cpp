// A block on a base under tilted gravity: Coulomb friction between bodies along every axis, in 2D and 3D.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "support/report.hpp"
#include "verification/contact/bodies.hpp"

namespace strandlab::contact_tests {
namespace {

constexpr double kInclineCell = 0.5;  // mm
constexpr double kFriction = 0.3;
constexpr double kGravity = 2e8;  // mm/s^2: strains nothing (0.1 MPa against 1000 MPa) and moves the block by cells
constexpr int kSettle = 400;      // steps over which gravity rises, longer than the block rings

// The base lies against the low side of axis `normal`: a roller or, for the last axis, the bottom platen.
struct Slope {
  int normal;
  std::vector<double> slide;  // direction of the fall line, in all axes
  bool swapped;               // block before base
};
void PrintTo(const Slope& s, std::ostream* out) {
  *out << "normal " << s.normal << ", along";
  for (double d : s.slide) *out << ' ' << d;
  *out << (s.swapped ? ", swapped" : "");
}

template <int Dim>
class Incline {
 public:
  Incline(const Slope& slope, double tan_angle, double gravity) : block_(slope.swapped ? 0 : 1), normal_(slope.normal) {
    for (int a = 0; a < Dim; ++a) slide_[a] = slope.slide[a];
    slide_.normalize();
    const double cosine = 1 / std::sqrt(1 + tan_angle * tan_angle);
    normal_gravity_ = gravity * cosine;
    slope_gravity_ = normal_gravity_ * tan_angle;
    const double size = Dim == 2 ? 16 : 6;  // of the window, mm; the base fills it and is 1 mm thick
    const double length = Dim == 2 ? 6 : 2;
    Vec<Dim> low = Vec<Dim>::Zero(), high = Vec<Dim>::Constant(size);
    high[normal_] = 1;
    const auto material = elastic_material(1000, 0.2);
    auto base = block<Dim>(material, low, high, kInclineCell / 2);
    for (int a = 0; a < Dim; ++a) {
      low[a] = 0.5 * (size - length) + (a == normal_ ? 0.0 : 0.13);
      high[a] = low[a] + length;
    }
    low[normal_] = 1;
    high[normal_] = 2;
    auto on_top = block<Dim>(material, low, high, kInclineCell / 2);
    for (std::size_t p = 0; p < base.points.size(); ++p) {
      bool under = base.points.x[p][normal_] > 1 - kInclineCell / 2;
      for (int a = 0; a < Dim; ++a)
        under = under && (a == normal_ || (base.points.x[p][a] > low[a] && base.points.x[p][a] < high[a]));
      if (under) under_block_.push_back(p);
    }
    for (std::size_t p = 0; p < on_top.points.size(); ++p) {
      if (on_top.points.x[p][normal_] < 1 + kInclineCell / 2) sole_.push_back(p);
    }
    bodies_ = {base, on_top};
    if (slope.swapped) std::swap(bodies_[0], bodies_[1]);
    mpm::Grid<Dim> grid;
    grid.cell = Vec<Dim>::Constant(kInclineCell);
    grid.origin = Vec<Dim>::Zero();
    grid.lo = Vec<Dim>::Zero();
    grid.hi = Vec<Dim>::Constant(size);
    for (int a = 0; a < Dim - 1; ++a) grid.sides[a] = {mpm::Side::kRoller, mpm::Side::kRoller};
    mpm::Options options;
    options.friction = kFriction;
    engine_.emplace(bodies_, grid, options);
    engine_->set_platens({0, 0}, {size, 0});
  }

  // Gravity first rises square to the slope, then tilts; both along half a cosine.
  void settle() {
    for (int i = 0; i < 2 * kSettle; ++i) {
      const auto rise = [](double s) { return 0.5 * (1 - std::cos(M_PI * std::clamp(s, 0.0, 1.0))); };
      Vec<Dim> g = rise(static_cast<double>(i - kSettle) / kSettle) * slope_gravity_ * slide_;
      g[normal_] = -rise(static_cast<double>(i) / kSettle) * normal_gravity_;
      engine_->set_gravity(g);
      engine_->step();
    }
    engine_->write(bodies_);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) engine_->step();
    engine_->write(bodies_);
  }
  double time() const { return engine_->state().time_s; }
  double friction_work() const { return engine_->energies().friction; }
  double speed() const { return mean<Dim>(moving().points.v).dot(slide_); }  // of the block, down the slope
  // Place of the block's sole against that of the base where the block stood at first, down the slope, mm.
  double place() const { return along(moving(), sole_) - along(resting(), under_block_); }
  double weight() const {  // square to the slope, N
    return particle_mass(moving()) * static_cast<double>(moving().points.size()) * normal_gravity_;
  }
  double normal_gravity() const { return normal_gravity_; }
  double slope_gravity() const { return slope_gravity_; }

 private:
  const mpm::Body<Dim>& moving() const { return bodies_[static_cast<std::size_t>(block_)]; }
  const mpm::Body<Dim>& resting() const { return bodies_[static_cast<std::size_t>(1 - block_)]; }
  double along(const mpm::Body<Dim>& body, const std::vector<std::size_t>& particles) const {
    double sum = 0;
    for (std::size_t p : particles) sum += body.points.x[p].dot(slide_);
    return sum / static_cast<double>(particles.size());
  }

  int block_, normal_;
  Vec<Dim> slide_;
  double normal_gravity_, slope_gravity_;
  std::vector<mpm::Body<Dim>> bodies_;
  std::vector<std::size_t> sole_, under_block_;
  std::optional<mpm::Engine<Dim>> engine_;
};

template <int Dim>
std::string slope_name(const Slope& slope) {
  return std::to_string(Dim) + "D, " + testing::PrintToString(slope);
}

// Newton and Coulomb: a = g (sin - mu cos), and friction takes mu times the weight on the slope times the slip. tan =
// 0.6, mu = 0.3.
template <int Dim>
void expect_slides(const Slope& slope, int steps) {
  Incline<Dim> incline(slope, 0.6, kGravity);
  incline.settle();
  const double t0 = incline.time(), v0 = incline.speed(), s0 = incline.place(), w0 = incline.friction_work();
  incline.run(steps);
  const double acceleration = (incline.speed() - v0) / (incline.time() - t0);
  const double expected = incline.slope_gravity() - kFriction * incline.normal_gravity();
  report("acceleration down a slope over g (sin - mu cos), " + slope_name<Dim>(slope), acceleration / expected,
         Dim == 3            ? near(1, 1e-4).because("one limit for all directions")
         : slope.normal == 1 ? near(1, 5e-4)
                             : near(1, 3e-3));
  const double slip = incline.place() - s0;
  EXPECT_GT(slip, 0.25 * kInclineCell);
  const double work = (incline.friction_work() - w0) / (kFriction * incline.weight() * slip);
  report("friction work over mu weight slip, " + slope_name<Dim>(slope), work,
         near(1, Dim == 3            ? 4e-3
                 : slope.normal == 1 ? 0.02
                                     : 5e-4));
}

// tan = 0.2 < mu: the particles next to the slope may shear by what elasticity gives (below 1e-4 cell here), and not
// slip.
template <int Dim>
void expect_sticks(const Slope& slope, int steps, double limit) {
  Incline<Dim> incline(slope, 0.2, 0.25 * kGravity);
  const double start = incline.place();
  incline.settle();
  EXPECT_LT(std::abs(incline.place() - start), limit * kInclineCell);
  incline.run(steps);
  const double slip = std::abs(incline.place() - start) / kInclineCell;
  report("slip below the angle of friction, " + slope_name<Dim>(slope), slip, below(limit), "cells");
}

class Incline2D : public testing::TestWithParam<Slope> {};
TEST_P(Incline2D, SlidesAsCoulombSays) {
  expect_slides<2>(GetParam(), 1500);
}
TEST_P(Incline2D, SticksBelowTheAngleOfFriction) {
  expect_sticks<2>(GetParam(), 1500, GetParam().normal == 1 ? 3e-5 : 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Contact, Incline2D,
                         testing::Values(Slope{1, {1, 0}, false}, Slope{1, {1, 0}, true}, Slope{1, {-1, 0}, false},
                                         Slope{0, {0, 1}, false}, Slope{0, {0, 1}, true}, Slope{0, {0, -1}, false}));

class Incline3D : public testing::TestWithParam<Slope> {};
TEST_P(Incline3D, SlidesAsCoulombSays) {
  expect_slides<3>(GetParam(), 600);
}
TEST_P(Incline3D, SticksBelowTheAngleOfFriction) {
  expect_sticks<3>(GetParam(), 100, 3e-5);
}
INSTANTIATE_TEST_SUITE_P(Contact, Incline3D,
                         testing::Values(Slope{2, {1, 0, 0}, false}, Slope{2, {0, 1, 0}, true},
                                         Slope{2, {1, -1, 0}, false}, Slope{1, {1, 0, 0}, false},
                                         Slope{1, {0, 0, 1}, true}, Slope{0, {0, 1, 0}, false},
                                         Slope{0, {0, 0, -1}, true}));

}  // namespace
}  // namespace strandlab::contact_tests
