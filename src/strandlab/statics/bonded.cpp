#include "strandlab/statics/bonded.hpp"

#include <algorithm>
#include <limits>
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
    bonds_.push_back(glue::stiffness(glue::unfinished(bond, spring.quality), penalty_));
  {
    const Stopwatch watch(times.assemble);
    stiffness_ = parts_.with(bonds_);
  }
  if (cholesky_) return;
  const Stopwatch watch(times.analyse);
  cholesky_ = std::make_unique<Cholesky>(stiffness_);
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
// the largest excess.
template <int Dim>
double BondedPanel<Dim>::hand_over(Solution<Dim>& s) const {
  double change = 0, largest = std::numeric_limits<double>::min();
  const auto opening = jumps(s);
  for (std::size_t k = 0; k < opening.size(); ++k) {
    Vec<Dim> more;
    for (int d = 0; d < Dim; ++d) {
      const auto& bond = bonds_[k];
      const bool normal = d == Dim - 1;
      more[d] =
          (normal ? bond.perfect_n : bond.perfect_t) ? (normal ? bond.normal : bond.tangential) * opening[k][d] : 0;
    }
    s.excess[k] += more;
    change = std::max(change, more.cwiseAbs().maxCoeff());
    largest = std::max(largest, s.excess[k].cwiseAbs().maxCoeff());
  }
  return change / largest;
}

// Solves one load case by the method of multipliers (Hestenes, J. Optim. Theory Appl. 4 (1969) 303): what a perfect
// bond's penalty spring carries is handed over to its traction until the spring is idle, so that the penalty leaves no
// trace; each step refines the linear solution too. One factor serves all.
template <int Dim>
Solution<Dim> BondedPanel<Dim>::respond(const LowerMatrix& matrix, const Supports& supports,
                                        const std::vector<double>& rhs) {
  constexpr int kLeastSteps = 2, kMostSteps = 10;
  constexpr double kSettled = 1e-4;  // tractions change by less than this of the largest
  constexpr double kStalled = 0.5;   // or no longer fall by this from step to step: round-off
  Solution<Dim> s{cholesky_->solve(rhs), {}};
  s.excess.assign(jumps(s).size(), Vec<Dim>::Zero());
  double previous = 1;
  for (int step = 1; step <= kMostSteps; ++step) {
    const double change = hand_over(s);
    std::vector<double> held(rhs.size(), 0.0);
    parts_.add_traction_forces(s.excess, held);
    auto residual = multiply(matrix, s.displacement);
    for (std::size_t i = 0; i < held.size(); ++i)
      residual[i] = rhs[i] - residual[i] - (supports.fixed[i] ? 0.0 : held[i]);
    const auto correction = cholesky_->solve(residual);
    for (std::size_t i = 0; i < held.size(); ++i) s.displacement[i] += correction[i];
    if (step >= kLeastSteps && (change < kSettled || change > kStalled * previous)) break;
    previous = change;
  }
  return s;
}

template <int Dim>
std::vector<Solution<Dim>> BondedPanel<Dim>::solve(const Supports& supports, const std::vector<LoadCase>& loads,
                                                   SolveTimes& times, const std::function<void()>& before_solve) {
  if (before_solve) before_solve();
  LowerMatrix matrix;
  {
    const Stopwatch watch(times.factor);
    matrix = constrained(stiffness_, supports);
    cholesky_->factorise(matrix);
  }
  const Stopwatch watch(times.solve);
  std::vector<Solution<Dim>> solutions;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (k > 0 && before_solve) before_solve();
    const auto rhs = right_hand_side(stiffness_, supports, loads[k].forces, loads[k].given);
    solutions.push_back(respond(matrix, supports, rhs));
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
