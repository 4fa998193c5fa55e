// A whole press cycle with the same density everywhere: heat, moisture, gas and cure alone. Numbers of an independent
// program with the same scheme (numpy) for the same cells and steps.
#include <gtest/gtest.h>

#include <array>

#include "default_press.hpp"
#include "support/report.hpp"

namespace strandlab::hotpress {
namespace {

using namespace test;

// Core T (C), M (%), gas (kPa), face T, M at 15, 30, 60, 90, 120, 180, 240 s.
struct UniformReference {
  int cells;
  std::array<std::array<double, 5>, 7> rows;
  double gas_peak, core_100, pf, pmdi;  // kPa, s; pf, pmdi: when the least cured cell has .9
  double mean_M, water, heat;           // %, kg and kJ per m^2 of half the mat
};
const std::array<double, 7> kUniformTimes{15, 30, 60, 90, 120, 180, 240};

Cycle uniform_cycle(int cells) {
  return press_hot(settings_of(Mechanics::kUniform, cells, .25, {"close to 12 mm in 25 s", "hold until 240 s"}),
                   poplar_mat());
}

class UniformCycle : public testing::TestWithParam<UniformReference> {};

TEST_P(UniformCycle, TemperatureMoistureGasAndCure) {
  const auto& p = GetParam();
  const auto cycle = uniform_cycle(p.cells);
  const std::array<double, 5> digit{1e-3, 1e-4, 1e-3, 1e-3, 1e-4};
  for (std::size_t i = 0; i < kUniformTimes.size(); ++i) {
    const auto& now = at(cycle, kUniformTimes[i]);
    const std::array<double, 5> row{core(now).T, 100 * core(now).M, 1e-3 * core(now).gas, face(now).T,
                                    100 * face(now).M};
    for (std::size_t j = 0; j < row.size(); ++j)
      EXPECT_NEAR(row[j], p.rows[i][j], .6 * digit[j]) << kUniformTimes[i] << " " << j;
  }
  EXPECT_NEAR(core_gas(cycle).value, p.gas_peak, .0006);
  EXPECT_NEAR(core_gas(cycle).time, 108, .5);
  EXPECT_NEAR(core_100(cycle), p.core_100, .006);
  EXPECT_NEAR(time_of(cycle, .9, [](const Instant& i) { return least_cure(i, true); }), p.pf, .006);
  EXPECT_NEAR(time_of(cycle, .9, [](const Instant& i) { return least_cure(i, false); }), p.pmdi, .006);
  double mean = 0;
  for (const auto& c : cycle.record.back().cells) mean += 100 * c.M / static_cast<double>(2 * p.cells);
  EXPECT_NEAR(mean, p.mean_M, 6e-5);
  EXPECT_NEAR(cycle.record.back().water_out / 2, p.water, 6e-6);
  EXPECT_NEAR(1e-3 * cycle.record.back().heat / 2, p.heat, 6e-3);
  for (const double error : cycle.worst_balance) EXPECT_LT(error, 1e-10);
  report("uniform density, core at 90 s, cells: " + std::to_string(p.cells), core(at(cycle, 90)).T,
         p.cells == 20 ? "123.128" : "123.303", "C");
  report("uniform density, largest relative error of a balance, cells: " + std::to_string(p.cells),
         *std::max_element(cycle.worst_balance.begin(), cycle.worst_balance.end()), "< 1e-10");
}

INSTANTIATE_TEST_SUITE_P(Cells, UniformCycle,
                         testing::Values(UniformReference{20,
                                                          {{{20.044, 5.0000, .530, 175.265, .8326},
                                                            {29.022, 5.0019, 2.878, 183.361, .7170},
                                                            {90.442, 5.1783, 8.180, 189.618, .6426},
                                                            {123.128, 7.3044, 51.250, 192.707, .7818},
                                                            {122.570, 8.0025, 57.792, 193.992, .7832},
                                                            {122.197, 7.1872, 44.372, 195.412, .7022},
                                                            {129.472, 4.8135, 34.481, 196.206, .6494}}},
                                                          59.134,
                                                          64.17,
                                                          123.75,
                                                          83.37,
                                                          2.4942,
                                                          .15157,
                                                          908.22},
                                         UniformReference{40,
                                                          {{{20.034, 5.0000, .531, 184.933, .6558},
                                                            {28.748, 5.0018, 2.884, 188.977, .6240},
                                                            {89.677, 5.1632, 8.125, 193.118, .5890},
                                                            {123.303, 7.2425, 51.282, 195.160, .7355},
                                                            {122.654, 7.9724, 57.881, 196.012, .7452},
                                                            {122.178, 7.1939, 44.372, 196.958, .6759},
                                                            {129.449, 4.8175, 34.471, 197.486, .6293}}},
                                                          59.241,
                                                          64.49,
                                                          123.79,
                                                          83.52,
                                                          2.4926,
                                                          .15163,
                                                          908.35},
                                         UniformReference{80,
                                                          {{{20.031, 5.0000, .531, 189.749, .5848},
                                                            {28.633, 5.0018, 2.886, 191.782, .5826},
                                                            {89.312, 5.1581, 8.098, 194.870, .5640},
                                                            {123.382, 7.2141, 51.291, 196.390, .7135},
                                                            {122.699, 7.9566, 57.926, 197.025, .7270},
                                                            {122.183, 7.1923, 44.372, 197.732, .6632},
                                                            {129.448, 4.8175, 34.465, 198.126, .6195}}},
                                                          59.293,
                                                          64.65,
                                                          123.78,
                                                          83.61,
                                                          2.4918,
                                                          .15166,
                                                          908.40}));

// Cure of the least cured cell; it is not the core's but that of the wet layer beside it, which is cooler for a while.
TEST(UniformCycle, LeastCure) {
  const auto cycle = uniform_cycle(20);
  const std::array<double, 4> times{60, 90, 120, 180};
  const std::array<double, 4> pf{.02559, .58419, .88062, .99382}, pmdi{.16404, .96036, .99928, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(least_cure(at(cycle, times[i]), true), pf[i], 6e-6);
    EXPECT_NEAR(least_cure(at(cycle, times[i]), false), pmdi[i], 6e-6);
  }
  EXPECT_GT(core(at(cycle, 120)).cure_face, .9);
}

// Air squeezed out of the core while the press closes, and the wet front that runs inward: its largest moisture content
// is 14.6 % at 30 to 40 s, in the mean over the steps; it goes up and down by .2 as the front runs from cell to cell.
TEST(UniformCycle, TransientOfClosing) {
  const auto cycle = uniform_cycle(20);
  EXPECT_NEAR(1e-3 * core(at(cycle, 25)).gas, 7.08, .006);
  double sum = 0;
  int steps = 0;
  for (const auto& now : cycle.record) {
    if (now.time < 30 || now.time > 40) continue;
    double wettest = 0;
    for (const auto& cell : now.cells) wettest = std::max(wettest, cell.M);
    sum += wettest;
    ++steps;
  }
  EXPECT_NEAR(100 * sum / steps, 14.6, .06);
}

// The press is opened at 120 s, both faces to the room: excess pressure is gone within a second and the core flashes.
TEST(UniformCycle, Opening) {
  const auto cycle =
      press_hot(settings_of(Mechanics::kUniform, 20, .25, {"close to 12 mm in 25 s", "hold until 120 s", "open 60 s"}),
                poplar_mat());
  const std::array<double, 6> after{1, 2, 5, 10, 30, 60};
  const std::array<std::array<double, 5>, 6> rows{{{113.057, 7.2953, 3.434, 177.009, .4392},
                                                   {112.560, 7.2729, 1.225, 169.205, .3350},
                                                   {112.277, 7.2888, .885, 156.538, .3053},
                                                   {111.893, 7.3005, .709, 144.294, .3327},
                                                   {110.854, 7.1384, .427, 120.561, .4314},
                                                   {109.127, 6.5507, .247, 104.553, .5257}}};
  const std::array<double, 5> digit{1e-3, 1e-4, 1e-3, 1e-3, 1e-4};
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto& now = at(cycle, 120 + after[i]);
    const std::array<double, 5> row{core(now).T, 100 * core(now).M, 1e-3 * core(now).gas, face(now).T,
                                    100 * face(now).M};
    for (std::size_t j = 0; j < row.size(); ++j) EXPECT_NEAR(row[j], rows[i][j], .6 * digit[j]) << after[i] << " " << j;
  }
  for (const double error : cycle.worst_balance) EXPECT_LT(error, 1e-10);
}

// 9, 12 and 18 mm: core at 100 C after 41.6, 64.2, 127.9 s, largest gas pressure 85.2, 59.1, 33.5 kPa; 2.4 m wide: 281
// kPa.
TEST(UniformCycle, ThicknessAndWidth) {
  const auto pressed = [](double mm, double width, double until) {
    auto s =
        settings_of(Mechanics::kUniform, 20, .5,
                    {"close to " + std::to_string(mm) + " mm in 25 s", "hold until " + std::to_string(until) + " s"});
    s.constants.panel_width = width;
    return press_hot(s, poplar_mat(.64 * mm));
  };
  const std::array<std::array<double, 3>, 3> rows{{{9, 41.6, 85.2}, {12, 64.2, 59.1}, {18, 127.9, 33.5}}};
  for (const auto& [mm, core_at, gas] : rows) {
    const auto cycle = pressed(mm, .6, 240);
    EXPECT_NEAR(core_100(cycle), core_at, .06) << mm;
    EXPECT_NEAR(core_gas(cycle).value, gas, .06) << mm;
  }
  const auto wide = pressed(12, 2.4, 240);
  EXPECT_NEAR(core_100(wide), 71.6, .06);
  EXPECT_NEAR(core_gas(wide).value, 281, .6);
}

}  // namespace
}  // namespace strandlab::hotpress
