// Phases of a press cycle, its limits and its answers, on coarse cells and steps.
#include "strandlab/hotpress/cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/hotpress/answers.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::hotpress {
namespace {

const PressedMat kMat{{{7.68, wood::library().front()}}, .025};

Settings quick(const std::vector<std::string>& schedule) {
  Settings s;
  s.cells = 10;
  s.step = 1;
  s.schedule = parse_schedule(schedule);
  return s;
}

const Instant& end_of(const Cycle& cycle, const std::string& phase) {
  return *std::find_if(cycle.record.rbegin(), cycle.record.rend(), [&](const Instant& i) { return i.phase == phase; });
}

TEST(Cycle, ClosingUnderPressureEndsAtItsTarget) {
  const auto cycle = press_hot(quick({"close at 6 MPa to 12 mm within 60 s", "hold 20 s"}), kMat);
  const auto& closed = end_of(cycle, "close");
  EXPECT_NEAR(closed.thickness, .012, 1e-12);
  EXPECT_LT(closed.time, 60);
  EXPECT_EQ(closed.mark, "closed");
  EXPECT_NEAR(end_of(cycle, "hold").time, closed.time + 20, 1e-9);
  for (const auto& i : cycle.record) {
    EXPECT_LT(i.pressure, 6e6 * (1 + 1e-12));
  }
  for (const auto& warning : cycle.warnings) EXPECT_EQ(warning.find("never reached"), std::string::npos) << warning;
}

TEST(Cycle, ClosingUnderTooLittlePressureIsToldOf) {
  const auto cycle = press_hot(quick({"close at 2 MPa to 12 mm within 30 s", "hold 5 s"}), kMat);
  EXPECT_GT(end_of(cycle, "close").thickness, .012);
  EXPECT_DOUBLE_EQ(end_of(cycle, "close").pressure, 2e6);
  ASSERT_EQ(cycle.warnings.size(), 1u);
  EXPECT_NE(cycle.warnings[0].find("never reached its target"), std::string::npos);
}

TEST(Cycle, ClosingUnderPressureIsNotFasterThanThePress) {
  auto s = quick({"close at 50 MPa to 12 mm within 60 s"});
  s.fastest = 1e-3;
  const auto cycle = press_hot(s, kMat);
  double before = 7.68 / 350;
  for (const auto& i : cycle.record) {
    EXPECT_GE(i.thickness, before - 1e-3 - 1e-12);
    before = i.thickness;
  }
  EXPECT_NEAR(before, .012, 1e-12);
}

// A pressure that is held may close the press no further than its stop; a pressure that falls opens it.
TEST(Cycle, HoldingAPressureStopsAtItsTarget) {
  const auto cycle =
      press_hot(quick({"close to 12 mm in 25 s", "hold 60 s at 6 MPa to 11.5 mm", "hold 60 s at 1 MPa"}), kMat);
  double least = 1;
  for (const auto& i : cycle.record) least = std::min(least, i.thickness);
  EXPECT_NEAR(least, .0115, 1e-12);
  EXPECT_GT(cycle.record.back().thickness, least);
  EXPECT_DOUBLE_EQ(cycle.record.back().pressure, 1e6);
}

TEST(Cycle, VentingAndOpening) {
  const auto cycle = press_hot(quick({"close to 12 mm in 25 s", "hold until 100 s", "vent 10 s", "open 10 s"}), kMat);
  const auto& held = end_of(cycle, "hold");
  EXPECT_EQ(held.mark, "held");
  EXPECT_NEAR(end_of(cycle, "vent").time, 110, 1e-9);
  EXPECT_NEAR(end_of(cycle, "vent").pressure, 0, 1e-6 * held.pressure);
  EXPECT_EQ(cycle.record.back().mark, "opened");
  EXPECT_EQ(cycle.record.back().pressure, 0);
  const auto a = answers(cycle);
  EXPECT_DOUBLE_EQ(a.opening, 100);
  EXPECT_GT(a.springback(), 0);
  EXPECT_LT(a.springback(), .02);
  EXPECT_LT(cycle.record.back().cells[0].gas, .1 * held.cells[0].gas);  // both faces are open to the room
}

// Without opening the panel's own thickness is that of its plastic strains.
TEST(Cycle, WithoutOpeningTheUnloadedThicknessIsRead) {
  const auto cycle = press_hot(quick({"close to 12 mm in 25 s", "hold until 60 s"}), kMat);
  EXPECT_EQ(cycle.record.back().mark, "held");
  EXPECT_DOUBLE_EQ(answers(cycle).thickness_opened, cycle.thickness_unloaded);
}

// The bottom face is heated first: the lighter, unheated top is colder when the press touches it.
TEST(Cycle, BottomPlatenLeads) {
  auto s = quick({"close to 12 mm in 25 s"});
  s.bottom_lead = 20;
  const auto cycle = press_hot(s, kMat);
  EXPECT_LT(cycle.record.front().time, -18);
  const auto touched =
      std::find_if(cycle.record.begin(), cycle.record.end(), [](const auto& i) { return i.time > -1e-9; });
  EXPECT_EQ(touched->phase, "lead");
  EXPECT_NEAR(touched->time, 0, 1e-9);
  EXPECT_GT(touched->cells.front().T, 60);
  EXPECT_LT(touched->cells.back().T, 25);
  EXPECT_NEAR(cycle.record.back().time, 25, 1e-9);
}

TEST(Cycle, PlatensFollowTheirProgram) {
  auto s = quick({"close to 12 mm in 25 s", "hold until 60 s"});
  s.platen_top = {{0, 200}, {60, 140}};
  const auto cycle = press_hot(s, kMat);
  EXPECT_DOUBLE_EQ(cycle.record.back().platen_top, 140);
  EXPECT_LT(cycle.record.back().cells.back().T, cycle.record.back().cells.front().T - 20);
}

// Moisture of a cell that lies half in the face: the mean of both.
TEST(Cycle, MoistureByMass) {
  auto s = quick({"close to 20 mm in 1 s"});
  s.cells = 10;
  s.moisture_face = .10;
  s.moisture_core = .02;
  const auto cycle = press_hot(s, kMat);
  const auto& cells = cycle.record.front().cells;
  EXPECT_NEAR(cells[1].M, .10, 1e-3);
  EXPECT_NEAR(cells[2].M, .06, 1e-3);
  EXPECT_NEAR(cells[3].M, .02, 1e-3);
  EXPECT_TRUE(cells[1].face);
  EXPECT_FALSE(cells[3].face);
}

// Layers of two woods: mass and thickness are theirs.
TEST(Cycle, LayersOfTwoWoods) {
  auto heavy = wood::library().front();
  heavy.density_kg_m3 = 700;
  const PressedMat mat{{{2, heavy}, {4, wood::library().front()}, {2, heavy}}, .02};
  const auto size = size_of(mat);
  EXPECT_DOUBLE_EQ(size.dry_mass, 8);
  EXPECT_DOUBLE_EQ(size.solid_thickness, 4. / 700 + 4. / 350);
  auto s = quick({"close to 17 mm in 1 s"});
  const auto cycle = press_hot(s, mat);
  EXPECT_GT(cycle.record.back().cells[0].density, 690);
  EXPECT_LT(cycle.record.back().cells[5].density, 360);
}

TEST(Cycle, FollowsALogOfPositions) {
  auto s = quick({"close to 12 mm in 25 s"});
  s.log = Log{
      {{100, .030}, {110, 7.68 / 350}, {135, .012}, {200, .012}, {201, .020}, {210, .020}}, {}, {{0, 190}}, {{0, 180}}};
  const auto cycle = press_hot(s, kMat);
  EXPECT_NEAR(cycle.log_start, 110, 1e-9);
  EXPECT_NEAR(end_of(cycle, "close").thickness, .012, 1e-12);
  EXPECT_NEAR(end_of(cycle, "hold").time, 90, 1e-9);
  EXPECT_NEAR(cycle.record.back().time, 100, 1e-9);
  EXPECT_DOUBLE_EQ(cycle.record.back().platen_bottom, 180);
  EXPECT_NEAR(cycle.record.back().gap, .020, 1e-12);  // the press has left the panel
  EXPECT_LT(cycle.record.back().thickness, .0125);
  EXPECT_EQ(cycle.record.back().pressure, 0);
}

TEST(Cycle, FollowsALogOfPressures) {
  auto s = quick({"close to 12 mm in 25 s"});
  s.log = Log{{}, {{5, 0}, {15, 5e6}, {60, 5e6}, {100, 0}}, {}, {}};
  const auto cycle = press_hot(s, kMat);
  EXPECT_NEAR(cycle.log_start, 5, 1e-12);
  EXPECT_NEAR(end_of(cycle, "close").pressure, 5e6, 1);
  EXPECT_NEAR(answers(cycle).pressure_peak, 5e6, 1);
}

TEST(Cycle, WhatCannotBePressed) {
  const auto refusal = [](const Settings& s, const PressedMat& mat) {
    return test::message_of<InputError>([&] { press_hot(s, mat); });
  };
  auto s = quick({"close to 12 mm in 25 s"});
  EXPECT_EQ(refusal(s, {{}, .01}), "the mat has no mass to press");
  s.step = 0;
  EXPECT_EQ(refusal(s, kMat), "a time step of 0 s; it must be greater than 0");
  s = quick({"close at 3 MPa to 12 mm within 25 s"});
  s.mechanics = Mechanics::kUniform;
  EXPECT_NE(refusal(s, kMat).find("a uniform mat has none"), std::string::npos);
  s = quick({"close at 30 MPa to 12 mm within 60 s", "hold until 1 s"});
  EXPECT_NE(refusal(s, kMat).find("phases overlap: it ends at 1 s, but the one before it took until"),
            std::string::npos);
  s = quick({"close to 12 mm in 25 s"});
  s.log = Log{{{0, .03}, {10, .025}}, {}, {}, {}};
  EXPECT_NE(refusal(s, kMat).find("the log's smallest gap is 25 mm; this mat is 21.94 mm of wood"), std::string::npos);
  s.log = Log{{}, {{0, 0}, {10, 0}}, {}, {}};
  EXPECT_EQ(refusal(s, kMat), "the log's pressure is nowhere greater than 0");
}

TEST(Cycle, ExtremesAreToldOf) {
  const auto told = [](const Settings& s, const std::string& words) {
    const auto cycle = press_hot(s, kMat);
    return std::any_of(cycle.warnings.begin(), cycle.warnings.end(),
                       [&](const auto& w) { return w.find(words) != std::string::npos; });
  };
  auto s = quick({"close to 12 mm in 25 s"});
  EXPECT_FALSE(told(s, ""));
  s.platen_top = {{0, 230}};
  EXPECT_TRUE(told(s, "platens of 230 C"));
  s.platen_top = {{0, 200}};
  s.moisture_core = .27;
  EXPECT_TRUE(told(s, "above 0.25 sorption is extrapolated"));
  EXPECT_TRUE(told(quick({"close to 6.5 mm in 25 s"}), "permeability of"));
}

TEST(Cycle, RemarksOnCureGasAndPrecure) {
  const auto told = [](const Settings& s, const std::string& words) {
    const auto cycle = press_hot(s, kMat);
    const auto list = remarks(cycle, answers(cycle));
    return std::any_of(list.begin(), list.end(), [&](const auto& w) { return w.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(told(quick({"close to 12 mm in 25 s", "hold until 40 s"}), "pmdi in the core layers is cured to"));
  EXPECT_FALSE(told(quick({"close to 12 mm in 25 s", "hold until 200 s"}), ""));
  EXPECT_TRUE(told(quick({"close to 12 mm in 100 s", "hold until 200 s"}), "precure: pf"));
  auto tight = quick({"close to 12 mm in 25 s", "hold until 100 s"});
  tight.constants.permeability_400 /= 100;
  EXPECT_TRUE(told(tight, "MDF delaminated above 100 kPa"));
}

// All of the mat is face: there is no core resin to wait for.
TEST(Answers, OneResin) {
  auto s = quick({"close to 12 mm in 25 s", "hold until 200 s"});
  s.face_fraction = .5;
  const auto a = answers(press_hot(s, kMat));
  ASSERT_EQ(a.resins.size(), 1u);
  EXPECT_EQ(a.resins[0].resin, "pf");
  EXPECT_EQ(a.press_time, a.resins[0].cured_at);
}

TEST(Answers, RiskInWords) {
  EXPECT_STREQ(risk(.3), "low");
  EXPECT_STREQ(risk(.7), "watch");
  EXPECT_STREQ(risk(1.2), "blow likely");
  EXPECT_THROW(answers(Cycle{}), std::invalid_argument);
}

}  // namespace
}  // namespace strandlab::hotpress
