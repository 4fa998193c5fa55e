// A mat pressed hot strand by strand, with temperatures and moisture contents that are given: against the column, to
// which it comes down where strands neither spread nor couple their strains; its energies, sets and bits.
#include "strandlab/hotpress/strands.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "default_press.hpp"
#include "strandlab/core/error.hpp"
#include "support/near.hpp"
#include "support/report.hpp"
#include "support/strands.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::hotpress {
namespace {

using strandlab::test::below;
using strandlab::test::SameBits;
using strandlab::test::strand_between;

constexpr int kRows = 6;
constexpr double kRow = .8, kWidth = 1.6;  // mm

// Crushing wood that does not couple its strains: confined it follows the law of a column.
wood::Material uncoupled() {
  auto wood = wood::library().front();
  wood.law = wood::Law::kCrushing;
  wood.nu_RL = wood.nu_TL = wood.nu_TR = 0;
  wood.crushing.c = 0;
  return wood;
}

Panel<2> stack(const wood::Material& wood) {
  Panel<2> panel;
  panel.length_mm = kWidth;
  panel.initial_thickness_mm = panel.top_mm = kRows * kRow;
  for (int row = 0; row < kRows; ++row) {
    auto strand = strand_between<2>(wood::in_strand_axes(wood, 0), Vec<2>(0, row * kRow),
                                    Vec<2>(kWidth, (row + 1) * kRow), {12, 6});
    strand.row = row;
    panel.strands.push_back(strand);
  }
  return panel;
}

StrandPress slow_press(const Panel<2>& panel, int threads = 1) {
  StrandPress how;
  mpm::Options options;
  options.friction = options.platen_friction = 0;
  options.threads = threads;
  how.setup = press::setup(panel, {3, 1, true}, mpm::Side::kRoller, options);
  how.speed_m_s = 4;
  how.cells = 12;
  return how;
}

// Hot, dry faces and a cool, moist core; two cells a row.
std::vector<transfer::CellState> warm() {
  std::vector<transfer::CellState> state;
  for (int i = 0; i < 2 * kRows; ++i) {
    const double s = std::abs((i / 2 + .5) / kRows - .5) * 2;  // 0 in the core, the same over a row
    state.push_back({40 + 120 * s, .10 - .07 * s, 1e5});
  }
  return state;
}

std::vector<Layer> layers(const wood::Material& wood) {
  return std::vector<Layer>(2 * kRows, layer_of(wood, 1e-3 * kRow / 2));
}

Move to(double height, double final_height) {
  Move move;
  move.height = height;
  move.final_height = final_height;
  return move;
}

// Closed in 20 s to .62 of its thickness, step by step, then held for 10, 100 and 1000 s, each in so many parts.
struct Held {
  double height, stress;  // m, Pa
};
template <class Mechanics>
std::vector<Held> press(Mechanics& mechanics, const std::vector<transfer::CellState>& state, int parts) {
  const double from = 1e-3 * kRows * kRow, end = .62 * from;
  constexpr int kSteps = 80;
  std::vector<Held> record;
  for (int k = 1; k <= kSteps; ++k) {
    auto move = to(from + (end - from) * k / kSteps, end);
    mechanics.move(move, state, 20. / kSteps);
    record.push_back({move.height, mechanics.stress()});
  }
  for (int k = 0; k < 3; ++k) {
    auto move = to(end, end);
    move.last = true;
    for (int n = 0; n < parts; ++n) mechanics.move(move, state, 10 * std::pow(10, k) / parts);
    record.push_back({end, mechanics.stress()});
  }
  return record;
}

// Points of a row are as warm as their place between the middles of the cells says; with the same state over a row and
// 12 cells a row's outer points are a little like its neighbours': the column takes the mean factors of each cell so.
TEST(Strands, FollowTheColumnAtGivenTemperatures) {
  const auto wood = uncoupled();
  const auto panel = stack(wood);
  StrandMechanics strands(panel, slow_press(panel));
  ColumnMechanics column(layers(wood), {}, {});
  const std::vector<transfer::CellState> even(12, {90, .07, 1e5});
  strands.condition(even);
  column.condition(even);
  const auto given = press(strands, even, 4), expected = press(column, even, 400);
  double worst = 0;
  for (std::size_t i = 8; i < given.size(); ++i)
    worst = std::max(worst, std::abs(given[i].stress / expected[i].stress - 1));
  report("stress of a stack of strands at 90 C and 7 %, closed in 20 s and held for 1110 s, against the column", worst,
         below(.02));
  const auto& last = strands.records().back();
  report("its balance of energy over the platens' work", std::abs(last.balance_error()), below(3e-5));
}

TEST(Strands, LayersFollowTheColumnBetweenHotFacesAndACoolCore) {
  const auto wood = uncoupled();
  const auto panel = stack(wood);
  StrandMechanics strands(panel, slow_press(panel));
  ColumnMechanics column(layers(wood), {}, {});
  strands.condition(warm());
  column.condition(warm());
  const auto given = press(strands, warm(), 4), expected = press(column, warm(), 400);
  double worst = 0;
  for (std::size_t i = 8; i < given.size(); ++i)
    worst = std::max(worst, std::abs(given[i].stress / expected[i].stress - 1));
  report("stress of a stack with faces of 160 C and a core of 40 C, against the column", worst, below(.05));
  double thickness = 0;
  const auto a = strands.thickness(), b = column.thickness();
  for (int row = 0; row < kRows; ++row) {
    const auto i = static_cast<std::size_t>(2 * row);
    thickness = std::max(thickness, std::abs((a[i] + a[i + 1]) / (b[i] + b[i + 1]) - 1));
  }
  report("thickness of its rows, against the column", thickness, below(.03));
}

// Held at a height while it gets hot: the elastic strain stays, so does the plastic one where nothing yields, and the
// stress falls as the stiffness. Cooled again, the stress stays; what would make it grow is locked in.
TEST(Strands, HeatRelaxesStressAndColdKeepsIt) {
  auto wood = uncoupled();
  wood.crushing.Y_R = 1e3;  // elastic
  const auto panel = stack(wood);
  auto how = slow_press(panel);
  how.rate.exponent = 0;
  StrandMechanics strands(panel, how);
  const std::vector<transfer::CellState> cold(12, {20, .12, 1e5}), hot(12, {120, .08, 1e5});
  strands.condition(cold);
  const double height = .98e-3 * kRows * kRow;
  auto move = to(height, height);
  move.last = true;
  strands.move(move, cold, 1);
  strands.move(move, cold, 1);
  const double before = strands.stress();
  strands.move(move, hot, 1);
  const double relaxed = strands.stress();
  strands.move(move, cold, 1);
  const double kept = strands.stress();
  const Softening softening;
  const double e = stiffness_factor(softening, 120, .08) / stiffness_factor(softening, 20, .12);
  report("stress after heating at a given height over that before, against the stiffnesses'", relaxed / before / e,
         strandlab::test::near(1, 1e-3));
  report("stress after cooling again over that hot", kept / relaxed, strandlab::test::near(1, 1e-3));
  // Unloaded, it springs back by the elastic strain of cold wood only.
  Move free;
  free.by_pressure = free.last = true;
  free.fastest = 1;
  for (int k = 0; k < 6; ++k) {
    strands.move(free, cold, 1);
  }
  const double strain = 1 - height / (1e-3 * kRows * kRow);
  report("strain that stays of a heated and cooled stack, over that given",
         (1 - strands.height_unloaded() / (1e-3 * kRows * kRow)) / strain, strandlab::test::near(1 - e, .02));
  report("balance of energy with what softening takes", std::abs(strands.records().back().balance_error()),
         below(1e-12).because("round-off"));
  EXPECT_GT(strands.records().back().softening_mJ, 0);
}

// Factors of 1 and no rate: the press as it is cold, bit for bit.
TEST(Strands, OfFactorOneArePressedAsColdOnes) {
  auto wood = wood::library().front();
  wood.law = wood::Law::kCrushing;
  auto cold = stack(wood), neutral = cold;
  for (auto& strand : neutral.strands) {
    strand.points.stiffness_factor.assign(strand.size(), 1);
    strand.points.yield_factor.assign(strand.size(), 1);
  }
  press::Schedule schedule;
  schedule.compactions = {.3};
  std::vector<Panel<2>> pressed;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& panel, int) { pressed.push_back(panel); };
  for (const auto* mat : {&cold, &neutral})
    press::press<2>(*mat, schedule, press::setup(*mat, {3, 1, true}, mpm::Side::kRoller, {}), sink);
  ASSERT_EQ(pressed.size(), 2U);
  for (std::size_t s = 0; s < pressed[0].strands.size(); ++s) {
    const auto &a = pressed[0].strands[s].points, &b = pressed[1].strands[s].points;
    EXPECT_THAT(a.x, SameBits(b.x));
    EXPECT_THAT(a.F, SameBits(b.F));
    EXPECT_THAT(a.stress, SameBits(b.stress));
    EXPECT_THAT(a.plastic, SameBits(b.plastic));
  }
}

TEST(Strands, SoftenedAlreadyAreRefused) {
  auto panel = stack(uncoupled());
  panel.strands[2].stiffness_factor = .5;
  EXPECT_THROW(StrandMechanics(panel, slow_press(panel)), InputError);
}

StrandMechanics::Reading reading(double strength) {
  StrandMechanics::Reading cell;
  cell.face = {.7, strength};
  cell.core = {.2, .5 * strength};
  cell.is_face = true;
  return cell;
}

// Three rows, the upper one half a row above the others: while they are apart its resin gains .3 of the strength of a
// bond. What the faces gain afterwards is their bond; outer faces meet nothing. Rows that touch from the start lose
// nothing.
TEST(Strands, LoseToTheBondWhatTheirResinHadBeforeTheyMet) {
  auto panel = stack(uncoupled());
  panel.strands.resize(3);
  for (auto& x : panel.strands[2].points.x) x[1] += .5 * kRow;
  panel.initial_thickness_mm = panel.top_mm = 3.5 * kRow;
  StrandMechanics strands(panel, slow_press(panel));
  const std::vector<transfer::CellState> even(12, {20, .12, 1e5});
  strands.condition(even);
  const auto all = [](double strength) { return std::vector<StrandMechanics::Reading>(12, reading(strength)); };
  strands.meet(all(0));
  strands.meet(all(.3));
  strands.move(to(3.2e-3 * kRow, 2.9e-3 * kRow), even, 1);
  strands.meet(all(.3));  // still apart
  strands.move(to(2.9e-3 * kRow, 2.9e-3 * kRow), even, 1);
  strands.meet(all(.5));
  EXPECT_NEAR(strands.precured(), .5 * .3, 1e-12);
  const auto pressed = strands.panel(all(.9));
  for (int s = 0; s < 3; ++s) {
    const auto& strand = pressed.strands[static_cast<std::size_t>(s)];
    const double bottom[] = {0, .9, .6}, top[] = {.9, .6, 0};
    for (int i = 0; i < strand.lattice.counts[0]; ++i) {
      const auto quality = [&](int row) { return strand.points.bond_quality[strand.lattice.point({i, row})]; };
      EXPECT_NEAR(quality(0), bottom[s], 1e-12) << s;
      EXPECT_NEAR(quality(strand.lattice.counts[1] - 1), top[s], 1e-12) << s;
      EXPECT_NEAR(quality(2), .9, 1e-12) << s;
    }
  }
  const auto glued = glue::cure(pressed, {});
  ASSERT_FALSE(glued.empty());
  for (const auto& point : glued) EXPECT_NEAR(point.quality, point.a.strand == 0 ? .9 : .6, 1e-12);
}

TEST(Strands, CarryTheResinOfTheirKindOrOfTheirLayer) {
  const auto panel = stack(uncoupled());
  auto how = slow_press(panel);
  const auto cures = [&] {
    StrandMechanics strands(panel, how);
    std::vector<StrandMechanics::Reading> cells(12, reading(.4));
    for (std::size_t i = 6; i < 12; ++i) cells[i].is_face = false;
    std::vector<double> cure;
    for (const auto& strand : strands.panel(cells).strands) cure.push_back(strand.points.cure[strand.size() / 2]);
    return cure;
  };
  EXPECT_THAT(cures(), testing::ElementsAre(.7, .7, .7, .2, .2, .2));
  how.resin = {Carried::kFace, Carried::kCore, Carried::kCore, Carried::kOfItsLayer, Carried::kFace, Carried::kCore};
  EXPECT_THAT(cures(), testing::ElementsAre(.7, .2, .2, .2, .7, .2));
}

// ---- Whole cycles of a small mat ------------------------------------------------------------------------------------

const std::vector<std::string> kShort{"close to 60 % in 4 s", "hold until 8 s", "vent 2 s", "open 2 s"};

PressedMat mat_of(const wood::Material& wood) {
  PressedMat mat;
  mat.thickness = 1e-3 * kRows * kRow;
  mat.length = 1e-3 * kWidth;
  mat.layers = {{mat.thickness * wood.density_kg_m3, wood}};
  return mat;
}

struct Stop {
  press::Checkpoint<2> checkpoint;
  std::vector<double> state;
};
struct Whole {
  Cycle cycle;
  Panel<2> panel;
  std::vector<press::Record> records;
  std::vector<Stop> stops;
};

wood::Material crushing_wood() {
  auto wood = wood::library().front();
  wood.law = wood::Law::kCrushing;
  return wood;
}

Whole pressed(const Panel<2>& panel, int threads, double step, const Stop* from,
              const std::vector<std::string>& schedule, const std::optional<Log>& log, int columns) {
  auto how = slow_press(panel, threads);
  how.speed_m_s = 16;
  how.columns = columns;
  StrandMechanics strands = from ? StrandMechanics(from->checkpoint, how) : StrandMechanics(panel, how);
  Whole all;
  Watch watch;
  std::size_t exchanges = 0;
  std::vector<StrandMechanics::Reading> cells;
  watch.step = [&](const Instant& now, const std::function<std::vector<double>()>& state) {
    cells.assign(12 * static_cast<std::size_t>(columns),
                 reading(.1 * std::max(0., now.time - 2)));  // as if resin set while the press closes
    if (strands.records().size() == exchanges) return;
    exchanges = strands.records().size();
    strands.meet(cells);
    if (exchanges % 9 == 4) all.stops.push_back({strands.checkpoint(), state()});
  };
  auto settings = test::settings_of(Mechanics::kStrands, 6, step, schedule);
  settings.log = log;
  settings.columns = columns;
  all.cycle = press_hot(settings, mat_of(crushing_wood()), strands, watch, from ? from->state : std::vector<double>());
  all.panel = strands.panel(cells);
  all.records = strands.records();
  return all;
}
Whole whole(int threads, double step, const Stop* from = nullptr, const std::vector<std::string>& schedule = kShort,
            const std::optional<Log>& log = {}) {
  return pressed(stack(crushing_wood()), threads, step, from, schedule, log, 1);
}

void expect_same(const Whole& a, const Whole& b) {
  ASSERT_EQ(a.cycle.record.size(), b.cycle.record.size());
  for (std::size_t i = 0; i < a.cycle.record.size(); ++i) {
    const auto &x = a.cycle.record[i], &y = b.cycle.record[i];
    EXPECT_EQ(x.time, y.time) << i;
    EXPECT_EQ(x.pressure, y.pressure) << i;
    EXPECT_EQ(x.mark, y.mark) << i;
    for (std::size_t c = 0; c < x.all().size(); ++c) {
      EXPECT_EQ(x.all()[c].T, y.all()[c].T) << i << " " << c;
      EXPECT_EQ(x.all()[c].density, y.all()[c].density) << i << " " << c;
    }
  }
  ASSERT_EQ(a.records.size(), b.records.size());
  EXPECT_EQ(a.records.back().softening_mJ, b.records.back().softening_mJ);
  for (std::size_t s = 0; s < a.panel.strands.size(); ++s) {
    for_each_field<2>([&](const auto& field) {
      EXPECT_THAT(a.panel.strands[s].points.*field.values, SameBits(b.panel.strands[s].points.*field.values))
          << field.name << " of strand " << s;
    });
  }
}

const Whole& undisturbed() {
  static const Whole all = whole(1, .25);
  return all;
}

TEST(HotCycle, ThreeThreadsGiveTheSameBits) {
  expect_same(whole(3, .25), undisturbed());
}

TEST(HotCycle, GoesOnFromAnyExchangeToTheSameBits) {
  ASSERT_GE(undisturbed().stops.size(), 4U);
  for (const auto& stop : undisturbed().stops) {
    SCOPED_TRACE("from step " + std::to_string(stop.checkpoint.engine.step));
    expect_same(whole(1, .25, &stop), undisturbed());
  }
}

TEST(HotCycle, BalancesItsEnergyAndSpringsBackALittle) {
  double worst = 0;
  for (const auto& r : undisturbed().records) {
    if (r.compaction > .1) worst = std::max(worst, std::abs(r.balance_error()));
  }
  report("energy of a hot cycle over the platens' work, worst exchange", worst, below(4e-4));
  const auto& record = undisturbed().cycle.record;
  const auto held = std::find_if(record.begin(), record.end(), [](const auto& i) { return i.mark == "held"; });
  const double springback = record.back().thickness / held->thickness - 1;
  EXPECT_GT(springback, 0);
  EXPECT_LT(springback, .02);
}

Instant marked(const Cycle& cycle, const std::string& mark) {
  return *std::find_if(cycle.record.begin(), cycle.record.end(), [&](const auto& i) { return i.mark == mark; });
}

// The scheme is of first order in the exchange's time. So slow a closing that the step, not the hundredth of the gap
// that an exchange closes at most, says how many exchanges there are.
TEST(HotCycle, HalfTheStepChangesLittle) {
  const std::vector<std::string> slow{"close to 60 % in 60 s", "hold until 70 s", "vent 2 s", "open 2 s"};
  const auto whole_step = whole(1, .25, nullptr, slow), half_step = whole(1, .125, nullptr, slow);
  EXPECT_GT(half_step.records.size(), 3 * whole_step.records.size() / 2);
  double T = 0, density = 0;
  for (const char* mark : {"closed", "opened"}) {
    const auto a = marked(whole_step.cycle, mark), b = marked(half_step.cycle, mark);
    for (std::size_t c = 0; c < a.cells.size(); ++c) {
      T = std::max(T, std::abs(a.cells[c].T - b.cells[c].T));
      density = std::max(density, std::abs(a.cells[c].density / b.cells[c].density - 1));
    }
  }
  report("temperature of any layer when closed and opened, half the step", T, below(.09), "K");
  report("density of any layer, half the step", density, below(.005));
}

// The press is told 4 MPa: it closes at its fastest until it feels them; then the mat creeps, and wood and gas together
// bear what was told. The instants before the first that has reached it are left out.
TEST(HotCycle, ClosesUnderPressureAndHoldsIt) {
  const std::vector<std::string> schedule{"close at 4 MPa to 75 % within 1.5 s", "hold 1 s at 4 MPa", "open 2 s"};
  const auto all = whole(1, .25, nullptr, schedule);
  ASSERT_GE(all.stops.size(), 2U);
  expect_same(whole(1, .25, &all.stops[all.stops.size() / 2], schedule), all);
  double worst = 0, fastest = 0, before = 1e-3 * kRows * kRow;
  bool reached = false;
  double last = 0;
  for (const auto& i : all.cycle.record) {
    if (i.phase == "open") break;
    fastest = std::max(fastest, (before - i.thickness) / (i.time - last));
    before = i.thickness;
    last = i.time;
    reached = reached || i.stress + i.gas_mean > .98 * 4e6;
    if (reached) worst = std::max(worst, std::abs((i.stress + i.gas_mean) / 4e6 - 1));
  }
  EXPECT_TRUE(reached);
  report("stress and gas over the pressure told, worst instant", worst, below(.05));
  report("closing speed over the fastest allowed", fastest / 5e-3,
         between(.5, 1.005));  // the engine ends a step a little late
  const double springback = all.cycle.record.back().thickness / before - 1;
  report("springback from under pressure", springback, between(0, .01));
}

// A log of positions that closes, holds and opens: until it opens the mat feels what it feels when a schedule moves the
// press so; then it follows the platens as far as it springs back, as thick as when the pressure is let off slowly.
TEST(HotCycle, FollowsALogUntilThePressIsOpen) {
  const double mat = 1e-3 * kRows * kRow;
  Log log;
  log.position = {{0, mat}, {4, .4 * mat}, {8, .4 * mat}, {10, 1.2 * mat}, {12, 1.2 * mat}};
  const auto cycle = whole(1, .25, nullptr, kShort, log).cycle;
  const auto held = marked(cycle, "held"), same = marked(undisturbed().cycle, "held"), opened = cycle.record.back();
  report("pressure at the end of the hold, log over schedule", held.pressure / same.pressure, between(.95, 1.05));
  report("thickness of the open panel, log over schedule",
         opened.thickness / undisturbed().cycle.record.back().thickness, between(.999, 1.001));
  EXPECT_NEAR(opened.gap, 1.2 * mat, 1e-9);
  EXPECT_EQ(opened.pressure, 0);
}

// ---- Several columns along the mat ----------------------------------------------------------------------------------

Whole strands_in_columns(const Panel<2>& panel, int columns, int threads = 1, const Stop* from = nullptr) {
  return pressed(panel, threads, .25, from, kShort, {}, columns);
}

// Rows that fill the mat are the same in every column.
TEST(HotColumnsOfStrands, OfEvenRowsAreOne) {
  const auto three = strands_in_columns(stack(crushing_wood()), 3);
  double T = 0, density = 0;
  ASSERT_EQ(three.cycle.record.size(), undisturbed().cycle.record.size());
  for (std::size_t i = 0; i < three.cycle.record.size(); ++i) {
    const auto &a = undisturbed().cycle.record[i], &b = three.cycle.record[i];
    ASSERT_EQ(b.section.size(), 36U);
    for (std::size_t c = 0; c < b.section.size(); ++c) {
      T = std::max(T, std::abs(a.cells[c % 12].T - b.section[c].T));
      density = std::max(density, std::abs(a.cells[c % 12].density / b.section[c].density - 1));
    }
  }
  report("three columns of even rows, temperature against one", T, below(1.4e-9).because(strandlab::test::kRoundOff),
         "K");
  report("three columns of even rows, density against one, relative", density,
         below(1e-12).because(strandlab::test::kRoundOff));
}

// The third row ends in the middle of the mat (of three columns: of the middle one), at its left or its right.
Panel<2> with_a_short_row(bool left) {
  auto panel = stack(crushing_wood());
  auto& strand = panel.strands[2];
  const double from = left ? 0 : .5 * kWidth;
  strand = strand_between<2>(strand.material, Vec<2>(from, 2 * kRow), Vec<2>(from + .5 * kWidth, 3 * kRow), {6, 6});
  strand.row = 2;
  return panel;
}

const Whole& uneven() {
  static const Whole all = strands_in_columns(with_a_short_row(true), 3);
  return all;
}

// A column's cells hold what lies in it of the mat as formed: 6, 5.5 and 5 rows; the profile that is told is the mean
// of their mass over the mean of their thickness.
TEST(HotColumnsOfStrands, HoldWhatLiesInThem) {
  const auto& cycle = uneven().cycle;
  const double mean = mat_of(crushing_wood()).layers.front().dry_mass;
  const double rows[] = {6, 5.5, 5};
  ASSERT_EQ(cycle.dry_mass.size(), 36U);
  for (std::size_t c = 0; c < 36; ++c) EXPECT_NEAR(cycle.dry_mass[c], mean / 12 * rows[c / 12] / 5.5, 1e-12) << c;
  for (const auto& i : cycle.record) {
    double thickness = 0;
    for (const auto& cell : i.cells) thickness += mean / 12 / cell.density;
    EXPECT_NEAR(thickness, i.thickness, 1e-12);
    EXPECT_EQ(i.cells[6].T, i.section[18].T);
  }
  const auto held = marked(cycle, "held");
  EXPECT_GT(held.section[6].density, held.section[30].density);
  for (const double error : cycle.worst_balance) EXPECT_LT(error, 1e-10);
}

// Up to the round-off that contact amplifies: to 2e-4 of a density in one column.
TEST(HotColumnsOfStrands, AMatTurnedRoundTurnsItsColumns) {
  const auto turned = strands_in_columns(with_a_short_row(false), 3);
  double T = 0, density = 0;
  ASSERT_EQ(turned.cycle.record.size(), uneven().cycle.record.size());
  for (std::size_t i = 0; i < turned.cycle.record.size(); ++i) {
    for (std::size_t c = 0; c < 36; ++c) {
      const auto &a = uneven().cycle.record[i].section[c],
                 &b = turned.cycle.record[i].section[12 * (2 - c / 12) + c % 12];
      T = std::max(T, std::abs(a.T - b.T));
      density = std::max(density, std::abs(a.density / b.density - 1));
    }
  }
  report("mat turned left to right, temperature", T, below(.1), "K");
  report("mat turned left to right, density, relative", density, below(4e-3));
}

TEST(HotColumnsOfStrands, ThreadsAndARestartGiveTheSameBits) {
  expect_same(strands_in_columns(with_a_short_row(true), 3, 3), uneven());
  ASSERT_GE(uneven().stops.size(), 2U);
  expect_same(strands_in_columns(with_a_short_row(true), 3, 1, &uneven().stops[uneven().stops.size() / 2]), uneven());
}

// Linear between the middles of three columns, at 1/6, 1/2 and 5/6 of the mat, constant beyond them.
TEST(HotColumnsOfStrands, GivePointsWhatLiesBetweenTheirMiddles) {
  const auto panel = stack(crushing_wood());
  auto how = slow_press(panel);
  how.columns = 3;
  const StrandMechanics strands(panel, how);
  std::vector<StrandMechanics::Reading> cells(36, reading(.5));
  for (std::size_t c = 0; c < 36; ++c) cells[c].T = 20 + 30 * static_cast<double>(c / 12);
  for (const auto& strand : strands.panel(cells).strands) {
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const double place = strand.points.x[p][0] / kWidth;
      EXPECT_NEAR(strand.points.temperature[p], 20 + 90 * (std::clamp(place, 1. / 6, 5. / 6) - 1. / 6), 1e-9);
    }
  }
}

TEST(HotColumnsOfStrands, NeedWoodInEachOfThem) {
  auto panel = stack(crushing_wood());
  panel.length_mm *= 2;
  auto how = slow_press(panel);
  how.columns = 4;
  EXPECT_THAT(strandlab::test::message_of<InputError>([&] { StrandMechanics(panel, how); }),
              testing::HasSubstr("column 3 of 4 along the mat has no wood in it: hotpress.columns must be less"));
}

}  // namespace
}  // namespace strandlab::hotpress
