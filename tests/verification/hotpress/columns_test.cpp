// A whole press cycle of a section cut into several columns of cells: heat and gas also go along it.
#include <gtest/gtest.h>

#include "default_press.hpp"
#include "support/report.hpp"

namespace strandlab::hotpress {
namespace {

using namespace test;
using strandlab::test::below;
using strandlab::test::between;

const std::vector<std::string> kByPosition{"close to 12 mm in 25 s", "hold until 120 s", "vent 5 s", "open 5 s"};
const std::vector<std::string> kByPressure{"close at 3 MPa to 12 mm within 40 s", "hold 60 s at 3 MPa to 12 mm",
                                           "vent 5 s", "open 5 s"};

Cycle in_columns(Mechanics mechanics, int columns, const std::vector<std::string>& schedule, bool open_ends = false) {
  auto settings = settings_of(mechanics, 5, .5, schedule);
  settings.columns = columns;
  settings.open_ends = open_ends;
  auto mat = poplar_mat();
  mat.length = .6;
  return press_hot(settings, mat);
}

const CellReading& cell(const Instant& i, const Cycle& cycle, int column, int row) {
  return i.all()[static_cast<std::size_t>(column * cycle.settings.cells + row)];
}

// Columns that are alike and closed at the ends are one column; under pressure they share it.
TEST(HotColumns, EqualOnesAreOne) {
  struct {
    Mechanics mechanics;
    const std::vector<std::string>& schedule;
  } const ways[]{
      {Mechanics::kUniform, kByPosition}, {Mechanics::kColumn, kByPosition}, {Mechanics::kColumn, kByPressure}};
  double T = 0, rest = 0;
  for (const auto& way : ways) {
    const auto one = in_columns(way.mechanics, 1, way.schedule), three = in_columns(way.mechanics, 3, way.schedule);
    ASSERT_EQ(one.record.size(), three.record.size());
    for (std::size_t i = 0; i < one.record.size(); ++i) {
      const auto &a = one.record[i], &b = three.record[i];
      if (!std::isnan(a.pressure)) rest = std::max(rest, std::abs(a.pressure - b.pressure) / 3e6);
      rest = std::max(rest, std::abs(a.gas_mean - b.gas_mean) / 1e5);
      for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 10; ++row) {
          const auto &x = a.cells[static_cast<std::size_t>(row)], &y = cell(b, three, column, row);
          T = std::max(T, std::abs(x.T - y.T));
          rest = std::max(rest, std::abs(x.density / y.density - 1));
        }
      }
    }
  }
  report("three equal columns, temperature against one", T, below(1e-10).because(strandlab::test::kRoundOff), "K");
  report("three equal columns, pressure, gas and density against one, relative", rest,
         below(1e-12).because(strandlab::test::kRoundOff));
}

// The section as the whole width of a panel of .6 m. The sink that a single column has in place of its edges is exact
// for the steady flow of a gas generated evenly; so close is the middle of the section while gas is generated. Edges
// are cooler and at lower pressure, as Garcia et al. (2001) measured, and both halves alike.
TEST(HotColumns, OpenEndsAreTheEdgesOfThePanel) {
  const auto one = in_columns(Mechanics::kColumn, 1, kByPosition);
  const auto wide = in_columns(Mechanics::kColumn, 11, kByPosition, true);
  const auto gas = core_gas(one), middle = core_gas(wide);
  report("gas in the middle of an open section over that of a column with a sink", middle.value / gas.value,
         between(.9, 1.1));
  report("core at 100 C, middle of an open section less a column with a sink", core_100(wide) - core_100(one),
         between(-1., 1.), "s");
  double uneven = 0;
  for (const auto& i : wide.record) {
    for (int column = 0; column < 5; ++column)
      for (int row = 0; row < 10; ++row)
        uneven = std::max(uneven, std::abs(cell(i, wide, column, row).T - cell(i, wide, 10 - column, row).T));
  }
  report("temperature of its two halves", uneven, below(1.5e-10).because(strandlab::test::kRoundOff), "K");
  const auto& held = at(wide, 100);
  for (int column = 0; column < 5; ++column) {
    const auto &outer = cell(held, wide, column, 5), &inner = cell(held, wide, column + 1, 5);
    EXPECT_LT(outer.T, inner.T + 1e-9) << column;
    EXPECT_LT(outer.gas, inner.gas + 1e-3) << column;
  }
  EXPECT_LT(cell(held, wide, 0, 5).gas, .5 * cell(held, wide, 5, 5).gas);
  for (const double error : wide.worst_balance) EXPECT_LT(error, 1e-10);
}

// Gas in the middle with 7 and 21 columns of the open section: steep towards its ends, where the coarser ones are too
// wide, it is level in the middle.
TEST(HotColumns, MoreOfThemChangeLittleInTheMiddle) {
  const auto gas = [](int columns) {
    return core_gas(in_columns(Mechanics::kUniform, columns, kByPosition, true)).value;
  };
  report("gas in the middle of an open section, 7 columns over 21", gas(7) / gas(21), between(.98, 1.02));
}

}  // namespace
}  // namespace strandlab::hotpress
