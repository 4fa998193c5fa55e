// Heat, moisture and gas in a mat of cells, marched in time. Units as in properties.hpp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "strandlab/core/numbers.hpp"
#include "strandlab/transfer/balance.hpp"

namespace strandlab::transfer {

// Cells of constant dry mass: `rows` of them from the bottom to the top of each column; cell = column * rows + row.
struct Grid {
  int rows = 40, columns = 1;
  double column_width = 1;       // m, along the panel; counts where there are several
  std::vector<double> dry_mass;  // kg per m^2 of panel, by cell
  int cells() const { return rows * columns; }
};

// Two cells that touch: b is above a, or right of it.
struct Face {
  int a = 0, b = 0;
};
// Faces between cells: those through the thickness first, in the order of cells, then those along the panel.
std::vector<Face> faces_of(const Grid& grid);

struct CellState {
  double T, M, p_a;  // C, kg/kg, partial pressure of air in Pa
};

struct Boundary {
  enum class Kind { kClosed, kPlaten, kOpen };  // closed: nothing passes, a plane of symmetry
  Kind kind = Kind::kClosed;
  double T = 20;                // C, of the platen or the room
  double heat_transfer = 2000;  // W/(m^2 K), of the contact or of the room's air; inf: none in the way
  double p = 101325;            // Pa, open
  double humidity = .5;         // relative, open
};
Boundary platen(double T, double contact = 2000);
Boundary open_to(const Constants& k, double heat_transfer = 15);  // the room of the constants

// What is given at a time.
struct Conditions {
  std::vector<double> thickness;  // m, by cell
  Boundary bottom, top;
  Boundary left, right;  // ends of the section, closed or open
};
using ConditionsAt = std::function<Conditions(double time)>;  // s

using Amounts = std::array<double, 3>;  // by Row: kg water, kg air, J per m^2 of panel

// Balances are checked after each step: throws RunError where one of them is off by more than 1e-6 of what there is.
void check_balances(const Amounts& relative_errors, double time);

class Elimination;

class Solver {
 public:
  // Throws InputError for sizes that do not fit, masses or thicknesses that are not positive, and moisture contents
  // outside 0 to 0.5.
  Solver(Constants constants, Grid grid, std::vector<CellState> start, const Conditions& at_start);

  Solver(Solver&&) noexcept;
  ~Solver();

  // From time() to time() + seconds, in halves (and so on) where Newton's method does not converge. Throws RunError
  // where that does not help, or a balance is off.
  void step(double seconds, const ConditionsAt& conditions);

  void visit(Numbers& numbers);  // its state

  double time() const { return time_; }  // s
  const Constants& constants() const { return constants_; }
  const Grid& grid() const { return grid_; }
  const std::vector<double>& thickness() const { return thickness_; }  // m
  const std::vector<CellState>& state() const { return state_; }
  Cell<double> cell(int number) const;

  Amounts content() const;                                 // of the mat, now
  const Amounts& received() const { return received_; }    // through all boundaries and edges since the start
  const Amounts& balance_error() const { return error_; }  // of the last step, relative
  const Amounts& worst_balance_error() const { return worst_error_; }
  Amounts drift() const;  // content now - content at the start - received, relative: the errors of all steps

 private:
  struct Stage;
  bool try_step(double seconds, const ConditionsAt& conditions);
  void step_in_parts(double seconds, const ConditionsAt& conditions, int halvings);
  bool solve_stage(Stage& stage) const;
  Amounts scale() const;

  Constants constants_;
  Grid grid_;
  std::vector<Face> faces_;
  std::unique_ptr<Elimination> elimination_;  // its memory, for all steps
  std::vector<CellState> state_;
  std::vector<double> thickness_;
  Eigen::VectorXd holds_;  // by 3 * cell + Row
  double time_ = 0;
  Amounts start_{}, received_{}, error_{}, worst_error_{};
};

}  // namespace strandlab::transfer
