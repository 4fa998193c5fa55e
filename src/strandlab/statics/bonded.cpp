#include "strandlab/statics/bonded.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "strandlab/core/stopwatch.hpp"

namespace strandlab::statics {

template <int Dim>
void Solution<Dim>::add(double factor, const Solution<Dim>& other) {
  for (std::size_t i = 0; i < displacement.size(); ++i) displacement[i] += factor * other.displacement[i];
  for (std::size_t k = 0; k < excess.size(); ++k) excess[k] += factor * other.excess[k];
}

template <int Dim>
double penalty(const Mesh<Dim>& mesh, double element_length, double times) {
  double stiffest = 0;
  for (const auto& c : mesh.stiffness) stiffest = std::max(stiffest, c.diagonal().maxCoeff());
  return times * stiffest / element_length;
}

template <int Dim>
BondedPanel<Dim>::BondedPanel(const Mesh<Dim>& mesh, std::vector<Spring<Dim>> springs, double penalty)
    : parts_(mesh, std::move(springs)), penalty_(penalty) {}

template <int Dim>
void BondedPanel<Dim>::glue(const glue::Bond& bond, SolveTimes& times) {
  bonds_.clear();
  for (const auto& spring : parts_.springs())
    bonds_.push_back(glue::stiffness(glue::at_point(bond, spring.quality, spring.lacking), penalty_));
  {
    const Stopwatch watch(times.assemble);
    stiffness_ = parts_.with(bonds_);
  }
  if (cholesky_) return;
  const Stopwatch watch(times.analyse);
  cholesky_ = std::make_unique<Cholesky>(stiffness_, Dim == 2 ? Ordering::kMinimumDegree : Ordering::kDissection);
}

template <int Dim>
double BondedPanel<Dim>::energy(const Solution<Dim>& s) const {
  return parts_.wood_energy(s.displacement) + parts_.glue_energy(s.displacement, bonds_) +
         0.5 * parts_.traction_work(s.excess, s.displacement);
}

template <int Dim>
std::vector<double> BondedPanel<Dim>::forces(const Solution<Dim>& s) const {
  auto f = multiply(stiffness_, s.displacement);
  parts_.add_traction_forces(s.excess, f);
  return f;
}

// Hands the tractions of perfect bonds' penalty springs over to the excess; returns the largest of them, relative to
// the largest excess: of a panel the largest force, since the corners of its contacts leave points of any area, whose
// tractions settle late and matter little.
template <int Dim>
double BondedPanel<Dim>::hand_over(Solution<Dim>& s) const {
  double change = 0, largest = std::numeric_limits<double>::min();
  const auto opening = jumps(s);
  for (std::size_t k = 0; k < opening.size(); ++k) {
    const auto& spring = parts_.springs()[k];
    const auto& bond = bonds_[k];
    Vec<Dim> more = Vec<Dim>::Zero();
    for (int d = 0; d < Dim - 1; ++d) {
      if (bond.perfect_t) more[d] = spring.tangential(bond) * opening[k][d];
    }
    if (bond.perfect_n) more[Dim - 1] = spring.normal(bond) * opening[k][Dim - 1];
    s.excess[k] += more;
    const double weight = Dim == 2 ? 1 : spring.area;
    change = std::max(change, weight * more.cwiseAbs().maxCoeff());
    largest = std::max(largest, weight * s.excess[k].cwiseAbs().maxCoeff());
  }
  return change / largest;
}

// Solves load cases by the method of multipliers (Hestenes, J. Optim. Theory Appl. 4 (1969) 303): what a perfect
// bond's penalty spring carries is handed over to its traction until the spring is idle, so that the penalty leaves no
// trace; each step refines the linear solution too. One factor serves all.
template <int Dim>
std::vector<Solution<Dim>> BondedPanel<Dim>::respond(const LowerMatrix& matrix, const Supports& supports,
                                                     const std::vector<std::vector<double>>& rhs) {
  constexpr int kLeastSteps = 2, kMostSteps = Dim == 2 ? 10 : 20;
  constexpr double kSettled = Dim == 2 ? 1e-4 : 1e-6;  // tractions (3D: forces) change by less than this of the largest
  // Or no longer fall by this from step to step: round-off. The springs of a panel's small glue points are soft and
  // hand over slowly.
  constexpr double kStalled = Dim == 2 ? 0.5 : 1;
  std::vector<Solution<Dim>> solutions;
  for (auto& displacement : cholesky_->solve(rhs)) {
    auto& s = solutions.emplace_back(Solution<Dim>{std::move(displacement), {}});
    s.excess.assign(jumps(s).size(), Vec<Dim>::Zero());
  }
  std::vector<double> previous(rhs.size(), 1.0);
  std::vector<std::size_t> open(rhs.size());  // load cases that have not settled
  std::iota(open.begin(), open.end(), 0);
  for (int step = 1; step <= kMostSteps && !open.empty(); ++step) {
    std::vector<std::vector<double>> residuals;
    std::vector<std::size_t> still_open;
    for (const auto k : open) {
      auto& s = solutions[k];
      const double change = hand_over(s);
      std::vector<double> held(rhs[k].size(), 0.0);
      parts_.add_traction_forces(s.excess, held);
      auto& residual = residuals.emplace_back(multiply(matrix, s.displacement));
      for (std::size_t i = 0; i < held.size(); ++i)
        residual[i] = rhs[k][i] - residual[i] - (supports.fixed[i] ? 0.0 : held[i]);
      const bool settled = step >= kLeastSteps && (change < kSettled || change > kStalled * previous[k]);
      if (!settled) still_open.push_back(k);
      previous[k] = change;
    }
    const auto corrections = cholesky_->solve(residuals);
    for (std::size_t n = 0; n < open.size(); ++n) {
      auto& u = solutions[open[n]].displacement;
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += corrections[n][i];
    }
    open = std::move(still_open);
  }
  return solutions;
}

template <int Dim>
std::vector<Solution<Dim>> BondedPanel<Dim>::solve(const Supports& supports, const std::vector<LoadCase>& loads,
                                                   SolveTimes& times, const std::function<void()>& before_solve) {
  // Of a section one by one, whose bits do not depend on what else is asked; of a panel all at once.
  const std::size_t together = Dim == 2 ? 1 : loads.size();
  if (before_solve) before_solve();
  LowerMatrix matrix;
  {
    const Stopwatch watch(times.factor);
    matrix = constrained(stiffness_, supports);
    cholesky_->factorise(matrix);
  }
  const Stopwatch watch(times.solve);
  std::vector<Solution<Dim>> solutions;
  for (std::size_t k = 0; k < loads.size(); k += together) {
    if (k > 0 && before_solve) before_solve();
    std::vector<std::vector<double>> rhs;
    for (std::size_t n = k; n < k + together; ++n)
      rhs.push_back(right_hand_side(stiffness_, supports, loads[n].forces, loads[n].given));
    for (auto& solution : respond(matrix, supports, rhs)) solutions.push_back(std::move(solution));
  }
  return solutions;
}

template struct Solution<2>;
template struct Solution<3>;
template double penalty(const Mesh<2>&, double, double);
template double penalty(const Mesh<3>&, double, double);
template class BondedPanel<2>;
template class BondedPanel<3>;

}  // namespace strandlab::statics
