#include "strandlab/transfer/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "strandlab/core/error.hpp"
#include "strandlab/transfer/linear.hpp"

namespace strandlab::transfer {
namespace {

// SDIRK2 of Alexander (1977): L-stable and stiffly accurate, so that what a cell holds at the end of a step is the
// solution of its last stage.
constexpr double kGamma = 1 - 1 / std::numbers::sqrt2;

const std::array<double, 3> kUnknownScale{1, .01, 1e4};  // K, kg/kg, Pa
constexpr double kConverged = 1e-9;  // of a cell's residual over its scale; round-off of air in thin cells is near
constexpr double kLargestT = 25, kLargestM = .05;  // of one update, K and kg/kg
// Newton's method may also find a root of the equations that no wood can be at: moisture or air less than nothing.
constexpr double kLeastAir = -1, kLeastMoisture = -1e-6, kMostMoisture = 1;  // Pa, kg/kg
constexpr double kColdest = -50, kHottest = 400;                             // C
constexpr int kMostIterations = 30, kMostHalvings = 14;
constexpr double kBalanceLimit = 1e-6;

// What a residual is small against: what the cell holds, or what one of its size usually does.
double row_scale(int row, double holds, double dry_mass, double thickness) {
  const double usual = row == kEnergy  ? 1e3 * dry_mass
                       : row == kWater ? .01 * dry_mass + .05 * thickness
                                       : .5 * thickness;
  return std::max(std::abs(holds), usual);
}

Eigen::VectorXd row_scales(const Grid& grid, const std::vector<double>& thickness, const Eigen::VectorXd& holds) {
  Eigen::VectorXd scales(holds.size());
  for (int i = 0; i < grid.cells(); ++i) {
    for (int row = 0; row < 3; ++row)
      scales[3 * i + row] = row_scale(row, holds[3 * i + row], grid.dry_mass[i], thickness[i]);
  }
  return scales;
}

// Newton's system for the scaled update, its rows over their scales.
BlockSystem scaled_system(const std::vector<Face>& faces, const Equations& at, const Eigen::VectorXd& residual,
                          double weight, const Eigen::VectorXd& scales) {
  const Eigen::Vector3d columns(kUnknownScale[0], kUnknownScale[1], kUnknownScale[2]);
  const auto scaled = [&](int cell, const Block& block) -> Block {
    return scales.segment<3>(3 * cell).cwiseInverse().asDiagonal() * block * columns.asDiagonal();
  };
  BlockSystem system;
  for (std::size_t i = 0; i < at.holds_by_own.size(); ++i)
    system.diagonal.push_back(scaled(static_cast<int>(i), at.holds_by_own[i] - weight * at.receives_by_own[i]));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    system.a_by_b.push_back(scaled(faces[f].a, -weight * at.a_by_b[f]));
    system.b_by_a.push_back(scaled(faces[f].b, -weight * at.b_by_a[f]));
  }
  system.right = residual.cwiseQuotient(scales);
  return system;
}

void add_update(std::vector<CellState>& state, const Eigen::VectorXd& update) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto scaled = update.segment<3>(3 * static_cast<Eigen::Index>(i));
    state[i].T += std::clamp(kUnknownScale[0] * scaled[0], -kLargestT, kLargestT);
    state[i].M += std::clamp(kUnknownScale[1] * scaled[1], -kLargestM, kLargestM);
    state[i].p_a += kUnknownScale[2] * scaled[2];
  }
}

bool can_be(const CellState& s) {
  return s.T > kColdest && s.T < kHottest && s.M > kLeastMoisture && s.M < kMostMoisture && s.p_a > kLeastAir;
}

void check_sizes(const Grid& grid, std::size_t states, const Conditions& conditions) {
  const auto n = static_cast<std::size_t>(std::max(0, grid.rows) * std::max(0, grid.columns));
  if (n > 0 && grid.dry_mass.size() == n && states == n && conditions.thickness.size() == n) return;
  throw InputError(fmt::format("{} x {} cells with {} dry masses, {} states and {} thicknesses", grid.columns,
                               grid.rows, grid.dry_mass.size(), states, conditions.thickness.size()));
}

void check_cells(const Grid& grid, const std::vector<CellState>& state, const Conditions& conditions) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (!(grid.dry_mass[i] > 0) || !(conditions.thickness[i] > 0)) {
      throw InputError(fmt::format("cell {} has dry mass {} kg/m2 and thickness {} m; both must be greater than 0", i,
                                   grid.dry_mass[i], conditions.thickness[i]));
    }
    if (!(state[i].M >= 0 && state[i].M <= .5))
      throw InputError(fmt::format("cell {} has moisture content {}; it must be from 0 to 0.5", i, state[i].M));
  }
}

}  // namespace

Boundary platen(double T, double contact) {
  return {Boundary::Kind::kPlaten, T, contact};
}

Boundary open_to(const Constants& k, double heat_transfer) {
  return {Boundary::Kind::kOpen, k.ambient_temperature, heat_transfer, k.ambient_pressure, k.ambient_humidity};
}

void check_balances(const Amounts& relative_errors, double time) {
  static const char* names[] = {"water", "air", "energy"};
  for (int row = 0; row < 3; ++row) {
    if (std::abs(relative_errors[row]) <= kBalanceLimit) continue;
    throw RunError(fmt::format("balance of {} at {:.6g} s is off by {:.3g} of what there is (at most {:g})", names[row],
                               time, relative_errors[row], kBalanceLimit));
  }
}

// holds(y) - target - weight receives(y) = 0
struct Solver::Stage {
  Conditions conditions;
  Eigen::VectorXd target;
  double weight = 0;             // s
  std::vector<CellState> state;  // the guess, then the solution
  Equations at;                  // the solution
};

Solver::Solver(Constants constants, Grid grid, std::vector<CellState> start, const Conditions& at_start)
    : constants_(std::move(constants)), grid_(std::move(grid)), faces_(faces_of(grid_)), state_(std::move(start)) {
  check_sizes(grid_, state_.size(), at_start);
  check_cells(grid_, state_, at_start);
  elimination_ = std::make_unique<Elimination>(grid_);
  thickness_ = at_start.thickness;
  holds_ = values_at(constants_, grid_, state_, at_start).holds;
  start_ = content();
}

Solver::Solver(Solver&&) noexcept = default;
Solver::~Solver() = default;

void Solver::visit(Numbers& numbers) {
  for (auto& cell : state_) {
    for (auto* number : {&cell.T, &cell.M, &cell.p_a}) numbers(*number);
  }
  numbers(thickness_);
  for (auto& held : holds_) numbers(held);
  numbers(time_);
  for (auto* amounts : {&start_, &received_, &error_, &worst_error_}) {
    for (auto& amount : *amounts) numbers(amount);
  }
  if (grid_.columns > 1) numbers(grid_.dry_mass);
}

void Solver::step(double seconds, const ConditionsAt& conditions) {
  step_in_parts(seconds, conditions, 0);
}

void Solver::step_in_parts(double seconds, const ConditionsAt& conditions, int halvings) {
  if (try_step(seconds, conditions)) return;
  if (halvings == kMostHalvings) {
    throw RunError(
        fmt::format("heat and moisture: no solution at {:.6g} s, not even with a step of {:.2g} s", time_, seconds));
  }
  step_in_parts(seconds / 2, conditions, halvings + 1);
  step_in_parts(seconds / 2, conditions, halvings + 1);
}

bool Solver::try_step(double seconds, const ConditionsAt& conditions) {
  Stage first{conditions(time_ + kGamma * seconds), holds_, kGamma * seconds, state_, {}};
  if (!solve_stage(first)) return false;
  Stage last{conditions(time_ + seconds),
             holds_ + (1 - kGamma) * seconds * first.at.receives,
             kGamma * seconds,
             first.state,
             {}};
  if (!solve_stage(last)) return false;

  const auto before = content();
  state_ = last.state;
  thickness_ = last.conditions.thickness;
  holds_ = last.at.holds;
  time_ += seconds;
  const auto after = content(), size = scale();
  for (int row = 0; row < 3; ++row) {
    const double crossed = seconds * ((1 - kGamma) * first.at.crossing[row] + kGamma * last.at.crossing[row]);
    received_[row] += crossed;
    error_[row] = (after[row] - before[row] - crossed) / size[row];
    worst_error_[row] = std::max(worst_error_[row], std::abs(error_[row]));
  }
  check_balances(error_, time_);
  return true;
}

// Newton's method; the update of the last iteration is made too, so that the residual left is round-off.
bool Solver::solve_stage(Stage& stage) const {
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const auto at = equations_at(constants_, grid_, stage.state, stage.conditions);
    const Eigen::VectorXd residual = stage.target + stage.weight * at.receives - at.holds;
    const auto scales = row_scales(grid_, stage.conditions.thickness, at.holds);
    const double worst = residual.cwiseQuotient(scales).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(worst)) return false;
    const auto update = elimination_->solve(faces_, scaled_system(faces_, at, residual, stage.weight, scales));
    if (update.size() == 0) return false;
    add_update(stage.state, update);
    if (worst > kConverged) continue;
    if (!std::all_of(stage.state.begin(), stage.state.end(), can_be)) return false;
    stage.at = values_at(constants_, grid_, stage.state, stage.conditions);
    return true;
  }
  return false;
}

Cell<double> Solver::cell(int number) const {
  const auto& s = state_[number];
  return cell_at<double>(constants_, grid_.dry_mass[number], thickness_[number], s.T, s.M, s.p_a);
}

Amounts Solver::content() const {
  Amounts sum{};
  for (int i = 0; i < grid_.cells(); ++i) {
    for (int row = 0; row < 3; ++row) sum[row] += holds_[3 * i + row] / grid_.columns;
  }
  return sum;
}

Amounts Solver::scale() const {
  const auto scales = row_scales(grid_, thickness_, holds_);
  Amounts sum{};
  for (int i = 0; i < grid_.cells(); ++i) {
    for (int row = 0; row < 3; ++row) sum[row] += scales[3 * i + row] / grid_.columns;
  }
  return sum;
}

Amounts Solver::drift() const {
  const auto now = content(), size = scale();
  Amounts drift{};
  for (int row = 0; row < 3; ++row) drift[row] = (now[row] - start_[row] - received_[row]) / size[row];
  return drift;
}

}  // namespace strandlab::transfer
