#include "strandlab/hotpress/mechanics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab::hotpress {
namespace {

constexpr double kSameHeight = 1e-12;  // part of it by which columns may differ
constexpr double kSameStress = 1e-10;  // and by which their mean stress may

double height_of(const std::vector<Column>& columns) {
  double highest = 0;
  for (const auto& column : columns) highest = std::max(highest, column.height());
  return highest;
}

}  // namespace

CellFactors factors_of(const Softening& softening, const std::vector<transfer::CellState>& state) {
  CellFactors factors;
  for (const auto& cell : state) {
    factors.stiffness.push_back(stiffness_factor(softening, cell.T, cell.M));
    factors.yield.push_back(yield_factor(softening, cell.T, cell.M));
  }
  return factors;
}

double MatMechanics::longest_step(double /*closing*/) const {
  return std::numeric_limits<double>::infinity();
}

std::vector<double> MatMechanics::dry_mass(double of_mat, int cells) const {
  return std::vector<double>(thickness().size(), of_mat / cells);
}

ColumnMechanics::ColumnMechanics(const std::vector<Layer>& layers, wood::RateEffect rate, const Softening& softening,
                                 int columns)
    : columns_(static_cast<std::size_t>(columns), Column(layers, rate)), softening_(softening) {}

void ColumnMechanics::for_each(const std::vector<transfer::CellState>& state,
                               void (Column::*act)(const std::vector<double>&, const std::vector<double>&)) {
  const auto rows = static_cast<std::ptrdiff_t>(state.size() / columns_.size());
  auto first = state.begin();
  for (auto& column : columns_) {
    const auto [e, g] = factors_of(softening_, {first, first + rows});
    (column.*act)(e, g);
    first += rows;
  }
}

void ColumnMechanics::condition(const std::vector<transfer::CellState>& state) {
  for_each(state, &Column::condition);
}

double ColumnMechanics::height_unloaded() const {
  double highest = 0;
  for (const auto& column : columns_) highest = std::max(highest, column.height_unloaded());
  return highest;
}

double ColumnMechanics::stress() const {
  double sum = 0;
  for (const auto& column : columns_) sum += column.stress();
  return sum / static_cast<double>(columns_.size());
}

std::vector<double> ColumnMechanics::thickness() const {
  std::vector<double> all;
  for (const auto& column : columns_) {
    const auto own = column.thickness();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void ColumnMechanics::visit(Numbers& numbers) {
  for (auto& column : columns_) column.visit(numbers);
}

void ColumnMechanics::press_to(double height, double seconds) {
  for (auto& column : columns_) column.press_to(height, seconds);
}

// Each column by itself; where they would then be of several heights, all at that height between them at which they
// bear the stress on average, by false position (Illinois): columns bear less the higher they are.
void ColumnMechanics::load(double stress, double seconds) {
  const auto before = columns_;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (auto& column : columns_) {
    column.load(stress, seconds);
    low = std::min(low, column.height());
    high = std::max(high, column.height());
  }
  const auto excess_at = [&](double height) {
    columns_ = before;
    press_to(height, seconds);
    return this->stress() - stress;
  };
  if (high - low <= kSameHeight * high) return;
  double above = excess_at(low), below = excess_at(high);
  for (int side = 0; high - low > kSameHeight * high;) {
    const double middle = high - below * (high - low) / (below - above), excess = excess_at(middle);
    if (std::abs(excess) <= kSameStress * stress || !(middle > low && middle < high)) return;
    if (excess > 0) {
      low = middle;
      above = excess;
      if (side > 0) below *= .5;
      side = 1;
    } else {
      high = middle;
      below = excess;
      if (side < 0) above *= .5;
      side = -1;
    }
  }
}

Moved ColumnMechanics::load(const Move& move, double seconds) {
  const auto before = columns_;
  load(move.stress, seconds);
  const double least = std::max(move.stop, height_of(before) - move.fastest * seconds);
  if (height_of(columns_) >= least) return {};
  columns_ = before;
  press_to(least, seconds);
  return {true, true, least == move.stop};
}

// The platens push and never pull; without them the gas stretches the wood. Columns that do not reach the height stay
// as they are without platens.
Moved ColumnMechanics::move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) {
  for_each(state, &Column::soften);
  if (move.by_pressure) return load(move, seconds);
  bool touches = false;
  for (auto& column : columns_) {
    const auto before = column;
    column.load(-move.gas, seconds);
    if (column.height() <= move.height) continue;
    column = before;
    column.press_to(move.height, seconds);
    touches = true;
  }
  return {touches};
}

Moved UniformMechanics::move(const Move& move, const std::vector<transfer::CellState>& /*state*/, double /*seconds*/) {
  if (!move.by_pressure) height_ = move.height;
  return {};
}

std::vector<double> UniformMechanics::thickness() const {
  return std::vector<double>(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(columns_), height_ / cells_);
}

double UniformMechanics::stress() const {
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace strandlab::hotpress
