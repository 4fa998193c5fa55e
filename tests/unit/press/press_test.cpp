// The press's schedule, records and snapshots, and what it refuses.
#include "strandlab/press/press.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "strandlab/core/error.hpp"

namespace strandlab {
namespace {

constexpr double kRow = 0.8;  // mm

// Rows of one strand each, `length` mm long, as the program makes them.
Panel<2> rows(int count, double length) {
  mat::Mat mat;
  mat.length_mm = length;
  mat.layer_thickness_mm = kRow;
  for (int row = 0; row < count; ++row) {
    mat::Layer layer;
    layer.role = "surface";
    layer.strands.emplace_back();
    layer.strands.back().x0_mm = 0;
    layer.strands.back().x1_mm = length;
    mat.layers.push_back(layer);
  }
  return make_panel(mat, {{"surface", wood::library().front(), 0}}, kRow / 6, 6);
}

press::Setup<2> small_setup(const Panel<2>& panel) {
  return press::setup(panel, {}, mpm::Side::kRoller, mpm::Options{});
}

press::Schedule schedule_to(std::vector<double> compactions) {
  press::Schedule s;
  s.compactions = std::move(compactions);
  return s;
}

std::string refusal(const press::Schedule& schedule) {
  const auto panel = rows(1, 2 * kRow);
  try {
    press::press<2>(panel, schedule, small_setup(panel), {});
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Schedule, SpeedMustBePositive) {
  for (double speed : {0.0, -16.0, std::nan("")}) {
    auto s = schedule_to({0, 0.1});
    s.speed_m_s = speed;
    const auto message = refusal(s);
    EXPECT_NE(message.find("speed"), std::string::npos) << message;
    EXPECT_NE(message.find("must be positive"), std::string::npos) << message;
  }
}

TEST(Schedule, CompactionsMustIncreaseFromZeroToBelowOne) {
  EXPECT_NE(refusal(schedule_to({})).find("no compactions"), std::string::npos);
  for (const auto& bad :
       std::vector<std::vector<double>>{{0, 1}, {0.2, 0.1}, {0.1, 0.1}, {-0.1, 0.1}, {std::nan("")}}) {
    const auto message = refusal(schedule_to(bad));
    EXPECT_NE(message.find("must increase"), std::string::npos) << message;
  }
}

// Grid of a mat: `cells_through_strand` cells through a row, whole cells between the sides, their width near aspect
// times their height.
TEST(Setup, CellsFitTheMat) {
  const auto panel = rows(4, 10);
  const auto s = press::setup(panel, press::Resolution{3, 2, true}, mpm::Side::kRoller, mpm::Options{});
  EXPECT_DOUBLE_EQ(s.grid.cell[1], kRow / 3);
  EXPECT_DOUBLE_EQ(s.grid.hi[1], 4 * kRow);
  const double cells = 10 / s.grid.cell[0];
  EXPECT_NEAR(cells, std::round(cells), 1e-12);
  EXPECT_NEAR(s.grid.cell[0] / (2 * kRow / 3), 1, 0.05);
  EXPECT_EQ(s.grid.follow, mpm::Follow::kPlatens);
  EXPECT_EQ(s.grid.sides[0][0], mpm::Side::kRoller);
  EXPECT_EQ(s.grid.sides[0][1], mpm::Side::kRoller);
}

// States are kept at every requested compaction: at most one step's closing beyond it, never short of it.
TEST(Press, KeepsTheStateAtEveryCompaction) {
  const auto panel = rows(2, 2 * kRow);
  const std::vector<double> asked{0, 0.03, 0.05, 0.08};
  std::vector<double> kept;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& p, int index) {
    EXPECT_EQ(index, static_cast<int>(kept.size()));
    kept.push_back(p.compaction());
  };
  const auto outcome = press::press<2>(panel, schedule_to(asked), small_setup(panel), sink);
  ASSERT_EQ(kept.size(), asked.size());
  EXPECT_EQ(kept[0], 0);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_GE(kept[i], asked[i] - 1e-12);
    EXPECT_LT(kept[i], asked[i] + 1e-3);
  }
  EXPECT_EQ(outcome.particles, 2u * 12 * 6);
  EXPECT_GT(outcome.steps, 0);
}

// With both platens moving, the mat stays where it is: its middle moves by less than a hundredth of the closing.
TEST(Press, SymmetricPlatensKeepTheMiddle) {
  const auto panel = rows(2, 2 * kRow);
  auto schedule = schedule_to({0, 0.1});
  schedule.symmetric = true;
  Panel<2> last;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& p, int) { last = p; };
  press::press<2>(panel, schedule, small_setup(panel), sink);
  EXPECT_NEAR(last.bottom_mm, 0.05 * 2 * kRow, 2e-3 * kRow);
  EXPECT_NEAR(0.5 * (last.bottom_mm + last.top_mm), kRow, 1e-9);
  double mean = 0;
  for (const auto& s : last.strands) {
    for (const auto& x : s.points.x) mean += x[1] / static_cast<double>(2 * s.size());
  }
  EXPECT_NEAR(mean, kRow, 0.01 * 0.1 * 2 * kRow);
}

// Records come at the interval asked for, in order, and cover the whole run.
TEST(Press, RecordsAtTheIntervalAskedFor) {
  const auto panel = rows(2, 2 * kRow);
  auto schedule = schedule_to({0, 0.1});
  schedule.record_interval_compaction = 0.01;
  const auto records = press::press<2>(panel, schedule, small_setup(panel), {}).records;
  ASSERT_GE(records.size(), 10u);
  ASSERT_LE(records.size(), 11u);
  for (std::size_t i = 1; i < records.size(); ++i) {
    EXPECT_NEAR(records[i].compaction, 0.01 * static_cast<double>(i), 1e-3);
    EXPECT_GT(records[i].time_ms, records[i - 1].time_ms);
    EXPECT_NEAR(records[i].stress_MPa, 0.5 * (records[i].force_top_N + records[i].force_bottom_N) / (2 * kRow), 1e-12);
  }
}

// The inertia watch: 16 m/s on two rows is quiet, 200 m/s is a shock and says so in plain words.
TEST(Press, WarnsOfTooFastPressing) {
  const auto panel = rows(4, 2 * kRow);
  auto schedule = schedule_to({0, 0.15});
  EXPECT_TRUE(press::press<2>(panel, schedule, small_setup(panel), {}).warnings.empty());
  schedule.speed_m_s = 200;
  const auto warnings = press::press<2>(panel, schedule, small_setup(panel), {}).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.front().find("press.speed_m_s"), std::string::npos) << warnings.front();
}

// Nodes where contact did not settle are told of at the end, those of before a restart among them.
TEST(Press, WarnsOfContactThatDidNotSettle) {
  const auto panel = rows(2, 2 * kRow);
  std::vector<press::Checkpoint<2>> checkpoints;
  press::Sink<2> sink;
  sink.checkpoint = [&](const press::Checkpoint<2>& c) { checkpoints.push_back(c); };
  const auto schedule = schedule_to({0, 0.02});
  const auto outcome = press::press<2>(panel, schedule, small_setup(panel), sink);
  EXPECT_TRUE(outcome.warnings.empty()) << outcome.warnings.front();
  ASSERT_FALSE(checkpoints.empty());
  checkpoints.front().engine.unconverged_contacts = 100000;
  const auto warnings = press::press<2>(panel, schedule, small_setup(panel), {}, checkpoints.front()).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("Contact did not settle at 100000 nodes"), std::string::npos) << warnings.front();
}

// Motion is large against a stress that has yet to rise; where it no longer is, the warning says from which compaction
// on: that of the last record with more than a tenth of the internal energy in motion.
TEST(Press, WarningsSayWhereInertiaNoLongerShows) {
  const auto panel = rows(4, 2 * kRow);
  auto schedule = schedule_to({0, 0.05, 0.3});
  schedule.speed_m_s = 60;
  const auto outcome = press::press<2>(panel, schedule, small_setup(panel), {});
  ASSERT_FALSE(outcome.warnings.empty());
  double last = 0;
  for (const auto& r : outcome.records) {
    if (r.compaction >= 0.05 && r.kinetic_mJ > 0.1 * r.internal_mJ()) last = r.compaction;
  }
  ASSERT_GT(last, 0.05);
  ASSERT_LT(last, 0.25);
  const auto told = fmt::format("(limit 10 %, kept from compaction {:.2f} on)", last);
  EXPECT_NE(outcome.warnings.front().find(told), std::string::npos) << outcome.warnings.front() << "\n" << told;
  // It says what that costs, and where more is written; and a state kept only after it is no reason to warn.
  EXPECT_NE(outcome.warnings.front().find("moduli"), std::string::npos) << outcome.warnings.front();
  EXPECT_NE(outcome.warnings.front().find("The speed of the press"), std::string::npos) << outcome.warnings.front();
  schedule.compactions = {0, 0.3};
  EXPECT_TRUE(press::press<2>(panel, schedule, small_setup(panel), {}).warnings.empty());
}

// States handed out by a pressing that fails: the mat slides out of its window sideways, at `speed_mm_s` along the
// panel between free sides and smooth platens.
std::vector<press::Checkpoint<2>> states_of_failing_press(double speed_mm_s, const press::Schedule& schedule,
                                                          double checkpoint_interval_s) {
  auto panel = rows(2, 2 * kRow);
  for (auto& s : panel.strands) s.points.v.assign(s.size(), Vec<2>(speed_mm_s, 0));
  mpm::Options smooth;
  smooth.friction = smooth.platen_friction = 0;
  std::vector<press::Checkpoint<2>> states;
  press::Sink<2> sink;
  sink.checkpoint_interval_s = checkpoint_interval_s;
  sink.checkpoint = [&](const press::Checkpoint<2>& c) { states.push_back(c); };
  try {
    press::press<2>(panel, schedule, press::setup(panel, {}, mpm::Side::kFree, smooth), sink);
    ADD_FAILURE() << "the mat stayed in the window";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("left the grid"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("strand in row"), std::string::npos) << e.what();
  }
  return states;
}

// When a step fails, the newest good state is handed out before the error leaves. Here half-way through the run.
TEST(Press, HandsOutTheLastGoodStateWhenAStepFails) {
  const auto states = states_of_failing_press(1e5, schedule_to({0, 0.3}), 1e9);
  ASSERT_EQ(states.size(), 2u);  // at the snapshot of C = 0, and the last good one
  EXPECT_GT(states.back().panel.compaction(), 0.01);
  EXPECT_GT(states.back().engine.step, 0);
  EXPECT_GT(states.back().records.size(), 9u);
}

// Whatever the interval of records, and with no snapshot before the failure.
TEST(Press, HandsOutTheLastGoodStateWithFewRecords) {
  auto schedule = schedule_to({0.3});
  schedule.record_interval_compaction = 0.2;
  const auto states = states_of_failing_press(1e5, schedule, 1e9);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_GT(states.back().panel.compaction(), 0.01);
}

// A failure in the first steps leaves the state at the start.
TEST(Press, HandsOutAStateWhenItFailsAtOnce) {
  const auto states = states_of_failing_press(1e7, schedule_to({0.3}), 1e9);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_LT(states.back().panel.compaction(), 0.01);
}

// A state handed out at the failure never replaces a newer one: here they are handed out every 32 steps.
TEST(Press, HandsOutNoOlderStateThanTheNewest) {
  const auto states = states_of_failing_press(1e5, schedule_to({0, 0.3}), 0);
  ASSERT_GT(states.size(), 3u);
  for (std::size_t i = 1; i < states.size(); ++i) EXPECT_GT(states[i].engine.step, states[i - 1].engine.step);
}

TEST(Record, BalanceIsWorkMinusAllTerms) {
  press::Record r;
  EXPECT_EQ(r.balance_error(), 0);
  r.platen_work_mJ = 10;
  r.elastic_mJ = 4;
  r.plastic_mJ = 3;
  r.friction_mJ = 1;
  r.contact_mJ = 0.5;
  r.filter_mJ = 0.25;
  r.kinetic_mJ = 0.25;
  EXPECT_DOUBLE_EQ(r.balance_error(), 0.1);
  EXPECT_DOUBLE_EQ(r.internal_mJ(), 7);
}

// A checkpoint holds the energies of its moment: those of the record made in the same step. (The engine's running
// totals leave out kinetic and elastic energy, which follow from the particles.)
TEST(Checkpoint, HoldsTheEnergiesOfItsMoment) {
  press::Sink<2> sink;
  std::vector<press::Checkpoint<2>> checkpoints;
  sink.checkpoint = [&](const press::Checkpoint<2>& c) { checkpoints.push_back(c); };
  const auto panel = rows(2, 2 * kRow);
  press::press<2>(panel, schedule_to({0.02, 0.05}), small_setup(panel), sink);
  ASSERT_EQ(checkpoints.size(), 2U);
  for (const auto& c : checkpoints) {
    const auto& e = c.engine.energies;
    const auto& r = c.records.back();
    EXPECT_GT(e.elastic, 0);
    EXPECT_EQ(e.kinetic, r.kinetic_mJ);
    EXPECT_EQ(e.elastic, r.elastic_mJ);
    EXPECT_EQ(e.plastic, r.plastic_mJ);
    EXPECT_EQ(e.platen_work, r.platen_work_mJ);
  }
}

// Frames come at even compactions, do not change the pressing, and those beyond a checkpoint come again after a resume.
TEST(Frames, AreEvenAndComeAgainAfterAResume) {
  const auto panel = rows(2, 2 * kRow);
  const auto schedule = schedule_to({0, 0.03, 0.08});
  const auto setup = small_setup(panel);
  const auto plain = press::press<2>(panel, schedule, setup, {});
  std::vector<Panel<2>> frames;
  std::vector<press::Checkpoint<2>> checkpoints;
  press::Sink<2> sink;
  sink.frames = 8;
  sink.frame = [&](const Panel<2>& p, int index) {
    EXPECT_EQ(index, static_cast<int>(frames.size()));
    frames.push_back(p);
  };
  sink.checkpoint = [&](const press::Checkpoint<2>& c) { checkpoints.push_back(c); };
  const auto filmed = press::press<2>(panel, schedule, setup, sink);
  ASSERT_EQ(frames.size(), 9U);
  EXPECT_EQ(filmed.steps, plain.steps);
  EXPECT_EQ(filmed.records.back().stress_MPa, plain.records.back().stress_MPa);
  const double step = 1.5 * 0.08 / static_cast<double>(filmed.steps);  // compaction of one time step at full speed
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_GE(frames[k].compaction(), 0.01 * static_cast<double>(k) - 1e-9);
    EXPECT_LE(frames[k].compaction(), 0.01 * static_cast<double>(k) + step);
  }
  ASSERT_GE(checkpoints.size(), 2U);  // at the snapshots: the second is at 3 %
  std::vector<int> again;
  sink.frame = [&](const Panel<2>& p, int index) {
    again.push_back(index);
    EXPECT_EQ(p.strands[1].points.x, frames[static_cast<std::size_t>(index)].strands[1].points.x) << "frame " << index;
  };
  press::press<2>(panel, schedule, setup, sink, checkpoints[1]);
  EXPECT_EQ(again, (std::vector<int>{4, 5, 6, 7, 8}));
}

// Stopped before its 40th step, a pressing hands out the state as it is and ends by Cancelled.
TEST(Press, StopsWhenItIsCancelled) {
  const auto panel = rows(1, 2 * kRow);
  int asked = 0;
  std::vector<press::Checkpoint<2>> checkpoints;
  press::Sink<2> sink;
  sink.cancelled = [&] { return ++asked == 40; };
  sink.checkpoint = [&](const press::Checkpoint<2>& c) { checkpoints.push_back(c); };
  EXPECT_THROW(press::press<2>(panel, schedule_to({0.02}), small_setup(panel), sink), Cancelled);
  EXPECT_EQ(asked, 40);
  ASSERT_EQ(checkpoints.size(), 1U);
  EXPECT_EQ(checkpoints[0].engine.step, 39);
}

}  // namespace
}  // namespace strandlab
