// The same bits on any number of threads and across a restart, and what must never drift in a pressing: mass, sign of
// plastic work.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "support/near.hpp"
#include "support/report.hpp"
#include "verification/press/stacks.hpp"

namespace strandlab::press_tests {
namespace {

// Four rows of an OSB-like mat, 16 mm long: gaps, core rows, ends that meet.
Panel<2> small_mat(const wood::Material& wood = poplar(true), double core_angle_deg = 90) {
  Panel<2> panel;
  constexpr double kRow = 0.8;
  panel.length_mm = 16;
  panel.initial_thickness_mm = panel.top_mm = 4 * kRow;
  struct Piece {
    int row;
    double x0, x1, angle;
  };
  for (const auto& p : std::vector<Piece>{{0, 0, 9.3, 0},
                                          {0, 11.1, 16, 0},
                                          {1, 0, 3.7, 90},
                                          {1, 5.2, 10.4, 90},
                                          {1, 10.4, 16, 90},
                                          {2, 1.1, 6.2, 90},
                                          {2, 8.0, 12.9, 90},
                                          {2, 14.0, 16, 90},
                                          {3, 0, 5.5, 0},
                                          {3, 7.7, 16, 0}}) {
    panel.strands.push_back(strand<2>(wood, p.angle == 0 ? 0 : core_angle_deg, p.row, Vec<2>(p.x0, p.row * kRow),
                                      Vec<2>(p.x1, (p.row + 1) * kRow),
                                      {static_cast<int>(std::lround((p.x1 - p.x0) * 7.5)), 6}));
  }
  return panel;
}

const std::vector<double> kCompactions{0, 0.0137, 0.0811, 0.1537, 0.25, 0.3};
constexpr double kFast = 64;  // m/s: bits do not mind inertia

struct Pressed {
  std::vector<Panel<2>> snapshots;
  std::vector<press::Checkpoint<2>> checkpoints;
  press::Outcome<2> outcome;
};

Pressed run(int threads, double speed_m_s, int filter_interval, const std::vector<double>& compactions,
            const std::optional<press::Checkpoint<2>>& resume = std::nullopt) {
  const auto panel = small_mat();
  mpm::Options options;
  options.threads = threads;
  options.filter_interval = filter_interval;
  press::Schedule schedule;
  schedule.speed_m_s = speed_m_s;
  schedule.compactions = compactions;
  Pressed result;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& p, int) { result.snapshots.push_back(p); };
  sink.checkpoint = [&](const press::Checkpoint<2>& c) { result.checkpoints.push_back(c); };
  sink.checkpoint_interval_s = 1e9;  // at snapshots only: steps that no interval of the engine knows of
  result.outcome = press::press<2>(panel, schedule, press::setup(panel, {}, mpm::Side::kRoller, options), sink, resume);
  return result;
}

using test::SameBits;

void expect_same(const Panel<2>& a, const Panel<2>& b) {
  ASSERT_EQ(a.strands.size(), b.strands.size());
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.top_mm, b.top_mm);
  for (std::size_t s = 0; s < a.strands.size(); ++s) {
    for_each_field<2>([&](const auto& field) {
      EXPECT_THAT(a.strands[s].points.*field.values, SameBits(b.strands[s].points.*field.values))
          << field.name << " of strand " << s;
    });
  }
}

void expect_same(const std::vector<press::Record>& a, const std::vector<press::Record>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].compaction, b[i].compaction);
    EXPECT_EQ(a[i].stress_MPa, b[i].stress_MPa) << "record " << i;
    EXPECT_EQ(a[i].platen_work_mJ, b[i].platen_work_mJ) << "record " << i;
    EXPECT_EQ(a[i].friction_mJ, b[i].friction_mJ) << "record " << i;
    EXPECT_EQ(a[i].contact_mJ, b[i].contact_mJ) << "record " << i;
    EXPECT_EQ(a[i].plastic_mJ, b[i].plastic_mJ) << "record " << i;
    EXPECT_EQ(a[i].kinetic_mJ, b[i].kinetic_mJ) << "record " << i;
  }
}

const Pressed& reference() {
  static const Pressed r = run(1, kFast, 50, kCompactions);
  return r;
}

TEST(Determinism, TwoThreadsGiveTheSameBits) {
  const std::vector<double> part{0, 0.0137, 0.0811};
  const Pressed one = run(1, kFast, 50, part), two = run(2, kFast, 50, part);
  ASSERT_EQ(two.snapshots.size(), part.size());
  for (std::size_t i = 0; i < part.size(); ++i) expect_same(two.snapshots[i], one.snapshots[i]);
  expect_same(two.outcome.records, one.outcome.records);
}

// From every checkpoint, which lie at arbitrary steps, the rest of the run is the run without a stop, bit for bit.
TEST(Determinism, RestartsGiveTheSameBits) {
  const auto& checkpoints = reference().checkpoints;
  ASSERT_EQ(checkpoints.size(), kCompactions.size());
  for (std::size_t k = 0; k + 1 < checkpoints.size(); ++k) {
    SCOPED_TRACE("from step " + std::to_string(checkpoints[k].engine.step));
    const Pressed rest = run(1, kFast, 50, kCompactions, checkpoints[k]);
    expect_same(rest.snapshots.back(), reference().snapshots.back());
    expect_same(rest.outcome.records, reference().outcome.records);
    EXPECT_EQ(rest.outcome.warnings, reference().outcome.warnings);
    EXPECT_EQ(rest.outcome.steps, reference().outcome.steps);
  }
}

// The engine alone, stopped after 1, 17, 45 and 333 steps: bodies and EngineState are all there is.
void expect_goes_on(const Panel<2>& panel) {
  const auto setup = press::setup(panel, {}, mpm::Side::kRoller, mpm::Options{});
  std::vector<mpm::Body<2>> bodies;
  for (const auto& s : panel.strands) bodies.push_back(mpm::body_of(s));
  auto engine = mpm::Engine<2>(bodies, setup.grid, setup.engine),
       stopped = mpm::Engine<2>(bodies, setup.grid, setup.engine);
  for (auto* e : {&engine, &stopped}) e->set_platens({0, 0}, {panel.top_mm, -32000});
  auto copy = bodies;
  for (int step = 0; step < 500; ++step) {
    for (int stop : {1, 17, 45, 333}) {
      if (step != stop) continue;
      stopped.write(copy);
      const auto state = stopped.state();
      stopped = mpm::Engine<2>(copy, setup.grid, setup.engine);
      stopped.set_platens(state.bottom, state.top);
      stopped.resume(state);
    }
    engine.step();
    stopped.step();
  }
  engine.write(bodies);
  stopped.write(copy);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for_each_field<2>([&](const auto& field) {
      EXPECT_THAT(bodies[b].points.*field.values, SameBits(copy[b].points.*field.values))
          << field.name << " of " << bodies[b].name;
    });
  }
  EXPECT_EQ(engine.energies().friction, stopped.energies().friction);
  EXPECT_GT(engine.energies().plastic, 0);
  EXPECT_EQ(engine.energies().plastic, stopped.energies().plastic);
  EXPECT_EQ(engine.state().time_s, stopped.state().time_s);
}

TEST(Determinism, EngineGoesOnFromItsStateToTheSameBits) {
  expect_goes_on(small_mat());
}

// Strands that crush, of four and of six stress components: the radius of the yield surface, which no file keeps,
// follows from the history variable to the bit.
TEST(Determinism, EngineOfCrushingStrandsGoesOnToTheSameBits) {
  auto wood = poplar(true);
  wood.law = wood::Law::kCrushing;
  expect_goes_on(small_mat(wood));
  expect_goes_on(small_mat(wood, 30));
}

// Clausius: plastic strain only dissipates; alpha never falls. Friction and inelastic meetings only take energy over an
// interval.
TEST(Press, PlasticWorkIsPositive) {
  double before = 0;
  for (const auto& r : reference().outcome.records) {
    EXPECT_GE(r.plastic_mJ, before);
    before = r.plastic_mJ;
  }
  EXPECT_GT(before, 0);
  const auto& snapshots = reference().snapshots;
  for (std::size_t k = 1; k < snapshots.size(); ++k) {
    for (std::size_t s = 0; s < snapshots[k].strands.size(); ++s) {
      const auto &now = snapshots[k].strands[s].points.plastic, &then = snapshots[k - 1].strands[s].points.plastic;
      for (std::size_t p = 0; p < now.size(); ++p) ASSERT_GE(now[p], then[p]);
    }
  }
}

// The grid carries the mass: density times the strands' areas, whatever has happened to them.
TEST(Press, MassIsThatOfTheStrands) {
  const auto panel = small_mat();
  double area = 0;
  for (const auto& s : panel.strands) area += s.lattice.extent(0) * s.lattice.extent(1);
  const double expected = 350e-12 * area;
  std::vector<mpm::Body<2>> bodies;
  for (const auto& s : reference().snapshots.back().strands) bodies.push_back(mpm::body_of(s));
  auto grid = press::setup(panel, {}, mpm::Side::kRoller, mpm::Options{}).grid;
  mpm::Engine<2> engine(bodies, grid, mpm::Options{});
  engine.set_platens({0, 0}, {reference().snapshots.back().top_mm, 0});
  engine.step();
  report("mass of a pressed mat on the grid over that of the strands, less 1", engine.grid_mass() / expected - 1,
         within(1e-14).because(test::kRoundOff));
}

// Work of the platens against the sum of all terms, each computed from its own definition, at every record, with the
// velocity filter and without.
TEST(Press, EnergyBalances) {
  for (int filter_interval : {0, 50}) {
    const auto records = run(1, 16, filter_interval, {0, 0.3}).outcome.records;
    double worst = 0;
    for (const auto& r : records) {
      if (r.compaction > 0.005) worst = std::max(worst, std::abs(r.balance_error()));
    }
    report(
        "energy balance of a pressing to 30 %, " +
            (filter_interval ? "filter every " + std::to_string(filter_interval) + " steps" : std::string("no filter")),
        worst, below(5e-4));
    EXPECT_GT(records.back().friction_mJ, 0);
    EXPECT_GT(records.back().elastic_mJ, 0);
  }
}

// Meetings with platens and among strands only take energy. Core strands with a free end, which the platens fold over,
// at a coarse and a fine time step: what contact has taken does not come back, but for the slow return of overlaps.
TEST(Press, ContactNeverGivesEnergyBack) {
  Panel<2> panel;
  panel.length_mm = 20;
  panel.initial_thickness_mm = panel.top_mm = 0.8;
  panel.strands.push_back(strand<2>(poplar(true), 90, 0, Vec<2>(0.6, 0), Vec<2>(20, 0.8), {97, 6}));
  for (double courant : {0.4, 0.1}) {
    mpm::Options options;
    options.courant = courant;
    press::Schedule schedule;
    schedule.compactions = {0, 0.25};
    const auto setup = press::setup(panel, press::Resolution{3, 1.5, true}, mpm::Side::kRoller, options);
    const auto records = press::press<2>(panel, schedule, setup, {}).records;
    double taken = 0, back = 0;
    for (const auto& r : records) {
      taken = std::max(taken, r.contact_mJ);
      back = std::max(back, taken - r.contact_mJ);
    }
    report("energy that contact gives back, over the platens' work, Courant number " + testing::PrintToString(courant),
           back / records.back().platen_work_mJ, below(courant == 0.4 ? 5e-4 : 2e-4));
  }
}

}  // namespace
}  // namespace strandlab::press_tests
