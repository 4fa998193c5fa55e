// Two elastic discs run into each other: when contact is first felt, whether they let go, and what is conserved.
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

constexpr double kCell = 0.25;    // mm
constexpr double kRadius = 2;     // mm, 8 cells
constexpr double kSpeed = 10000;  // mm/s, each: the discs flatten by about two cells

// Line of centres and place of the meeting point between grid lines.
struct Approach {
  double angle_deg, offset_cells;
  bool swapped;
};
void PrintTo(const Approach& a, std::ostream* out) {
  *out << a.angle_deg << " degrees, grid offset " << a.offset_cells << (a.swapped ? ", swapped" : "");
}

class Discs : public testing::TestWithParam<Approach> {
 protected:
  Discs() {
    const double angle = GetParam().angle_deg * M_PI / 180;
    axis_ = Vec<2>(std::cos(angle), std::sin(angle));
    const Vec<2> middle = Vec<2>::Constant(GetParam().offset_cells * kCell);
    const auto material = elastic_material(1000, 0.3);
    for (double side : {-1.0, 1.0}) {
      bodies_.push_back(
          disc(material, middle + side * (kRadius + kCell) * axis_, kRadius, kCell / 2, -side * kSpeed * axis_));
    }
    if (GetParam().swapped) std::swap(bodies_[0], bodies_[1]);
    mpm::Grid<2> grid;
    grid.cell = Vec<2>(kCell, kCell);
    grid.origin = Vec<2>::Zero();
    grid.lo = Vec<2>(-8, -8);
    grid.hi = Vec<2>(8, 8);
    engine_.emplace(bodies_, grid, mpm::Options{});
    gap0_ = (mean<2>(bodies_[0].points.x) - mean<2>(bodies_[1].points.x)).norm();
  }

  // Gap of the circles while the discs are not yet deformed, cells.
  double gap_cells() const {
    return ((mean<2>(bodies_[0].points.x) - mean<2>(bodies_[1].points.x)).norm() - gap0_) / kCell + 2;
  }
  double separation_speed() const {  // mm/s, negative while they approach
    const Vec<2> n = (mean<2>(bodies_[1].points.x) - mean<2>(bodies_[0].points.x)).normalized();
    return (mean<2>(bodies_[1].points.v) - mean<2>(bodies_[0].points.v)).dot(n);
  }
  void step() {
    engine_->step();
    engine_->write(bodies_);
  }

  Vec<2> axis_;
  std::vector<mpm::Body<2>> bodies_;
  std::optional<mpm::Engine<2>> engine_;
  double gap0_ = 0;
};

// Curved bodies whose nodes overlap long before the bodies do must not feel each other: the gap at the first impulse is
// within .04 cell of zero. The discs start two cells apart.
TEST_P(Discs, FeelEachOtherWhenTheyTouch) {
  const Vec<2> start = momentum(bodies_[0]);
  double before = gap_cells();
  for (int i = 0; i < 2000; ++i) {
    before = gap_cells();
    step();
    if ((momentum(bodies_[0]) - start).norm() > 1e-6 * start.norm()) break;
  }
  report("gap of two discs when the first impulse is felt, " + testing::PrintToString(GetParam()), before, within(0.04),
         "cells");
}

// Contact only pushes: the speed of separation never falls, is constant once the discs have parted, and the discs part
// with most of the speed they met with (the rest is their vibration; a real pair of discs keeps more than 90 %).
TEST_P(Discs, ReboundWithoutSticking) {
  double speed = separation_speed();
  const double approach = -speed;
  for (int i = 0; i < 4000 && gap_cells() < 2.5; ++i) {
    step();
    const double now = separation_speed();
    ASSERT_GT(now, speed - 1e-6 * approach) << "pulled back in step " << i;
    speed = now;
  }
  EXPECT_GT(gap_cells(), 1.5);
  report("speed of separation of two discs over that of approach, " + testing::PrintToString(GetParam()),
         speed / approach, between(0.93, 0.98));
}

TEST_P(Discs, KeepTheirMomentum) {
  const double scale = momentum(bodies_[0]).norm();
  const Vec<2> start = engine_->momentum();
  const double mass = engine_->mass();
  double worst = 0;
  for (int i = 0; i < 1500; ++i) {
    engine_->step();
    worst = std::max(worst, (engine_->momentum() - start).norm() / scale);
  }
  report("change of the momentum of two discs that meet, " + testing::PrintToString(GetParam()), worst,
         below(1e-12).because(test::kRoundOff));
  EXPECT_EQ(engine_->mass(), mass);
}

INSTANTIATE_TEST_SUITE_P(Contact, Discs,
                         testing::Values(Approach{0, 0, false}, Approach{0, 0.37, false}, Approach{0, 0.5, true},
                                         Approach{90, 0.25, false}, Approach{30, 0, false}, Approach{45, 0.37, true}));

}  // namespace
}  // namespace strandlab::contact_tests
