#include "strandlab/hotpress/mechanics.hpp"

#include <algorithm>
#include <limits>

namespace strandlab::hotpress {

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

ColumnMechanics::ColumnMechanics(const std::vector<Layer>& layers, wood::RateEffect rate, const Softening& softening)
    : column_(layers, rate), softening_(softening) {}

void ColumnMechanics::condition(const std::vector<transfer::CellState>& state) {
  const auto [e, g] = factors_of(softening_, state);
  column_.condition(e, g);
}

Moved ColumnMechanics::load(const Move& move, double seconds) {
  const auto before = column_;
  column_.load(move.stress, seconds);
  const double least = std::max(move.stop, before.height() - move.fastest * seconds);
  if (column_.height() >= least) return {};
  column_ = before;
  column_.press_to(least, seconds);
  return {true, true, least == move.stop};
}

// The platens push and never pull; without them the gas stretches the wood.
Moved ColumnMechanics::move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) {
  const auto [e, g] = factors_of(softening_, state);
  column_.soften(e, g);
  if (move.by_pressure) return load(move, seconds);
  const auto before = column_;
  column_.load(-move.gas, seconds);
  if (column_.height() <= move.height) return {false};
  column_ = before;
  column_.press_to(move.height, seconds);
  return {};
}

Moved UniformMechanics::move(const Move& move, const std::vector<transfer::CellState>& /*state*/, double /*seconds*/) {
  if (!move.by_pressure) height_ = move.height;
  return {};
}

std::vector<double> UniformMechanics::thickness() const {
  return std::vector<double>(static_cast<std::size_t>(cells_), height_ / cells_);
}

double UniformMechanics::stress() const {
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace strandlab::hotpress
