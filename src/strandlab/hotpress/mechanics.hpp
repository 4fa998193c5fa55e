// How a mat resists the press during a cycle: what cycle.hpp asks of it. Units are SI; cells are those of the
// transfer's grid, column by column, bottom to top.
#pragma once

#include <memory>
#include <vector>

#include "strandlab/core/numbers.hpp"
#include "strandlab/hotpress/column.hpp"
#include "strandlab/hotpress/softening.hpp"
#include "strandlab/transfer/solver.hpp"

namespace strandlab::hotpress {

// Which of the two resins wood carries: that of the layer it lies in, that of the faces, or that of the core.
enum class Carried { kOfItsLayer, kFace, kCore };

// Where the press shall go in a step: to a height (m), or under a stress of the wood (Pa) that may not close it below a
// stop or faster than `fastest`.
struct Move {
  bool by_pressure = false;
  double height = 0, final_height = 0;  // m, by position; that at which the platens come to rest
  double stress = 0, stop = 0;          // by pressure
  double fastest = 0;                   // m/s
  double gas = 0;                       // Pa, mean excess of the gas in the mat
  bool last = false;                    // of its phase: the mat must be brought up to date
};

// How the move ended.
struct Moved {
  bool touches = true;                    // the platens touch the mat
  bool limited = false, at_stop = false;  // the stress was not reached: closing too fast, or at its stop
};

class MatMechanics {
 public:
  MatMechanics() = default;
  MatMechanics(const MatMechanics&) = delete;
  MatMechanics& operator=(const MatMechanics&) = delete;
  virtual ~MatMechanics() = default;

  // Wood of these temperatures and moisture contents before the first load, by cell.
  virtual void condition(const std::vector<transfer::CellState>& state) = 0;
  // Moves in `seconds`, with temperatures and moisture contents as at the start of that time.
  virtual Moved move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) = 0;

  // kg/m^2, by cell, of a mat of so much on average: the same in all unless said.
  virtual std::vector<double> dry_mass(double of_mat, int cells) const;
  virtual std::vector<double> thickness() const = 0;  // m, by cell
  virtual double stress() const = 0;                  // Pa, of the wood; not a number where there is none
  virtual double height_unloaded() const = 0;         // m, elastic strains gone
  virtual double longest_step(double closing) const;  // s, while the press closes at so many m/s; no limit unless said
  virtual void visit(Numbers& numbers) = 0;           // its state
};

// Factors of stiffness and of yield of the cells.
struct CellFactors {
  std::vector<double> stiffness, yield;
};
CellFactors factors_of(const Softening& softening, const std::vector<transfer::CellState>& state);

// Columns of layers in series (column.hpp), side by side between the same platens.
class ColumnMechanics : public MatMechanics {
 public:
  ColumnMechanics(const std::vector<Layer>& layers, wood::RateEffect rate, const Softening& softening, int columns = 1);
  void condition(const std::vector<transfer::CellState>& state) override;
  Moved move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) override;
  std::vector<double> thickness() const override;
  double stress() const override;           // mean over the columns
  double height_unloaded() const override;  // of the highest
  void visit(Numbers& numbers) override;

 private:
  void press_to(double height, double seconds);
  void load(double stress, double seconds);  // on average
  Moved load(const Move& move, double seconds);
  void for_each(const std::vector<transfer::CellState>& state,
                void (Column::*act)(const std::vector<double>& stiffness, const std::vector<double>& yield));
  std::vector<Column> columns_;
  Softening softening_;
};

// No resistance: of uniform thickness, moved by position only.
class UniformMechanics : public MatMechanics {
 public:
  UniformMechanics(double height, int cells, int columns = 1) : height_(height), cells_(cells), columns_(columns) {}
  void condition(const std::vector<transfer::CellState>& /*state*/) override {}
  Moved move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) override;
  std::vector<double> thickness() const override;
  double stress() const override;
  double height_unloaded() const override { return height_; }
  void visit(Numbers& numbers) override { numbers(height_); }

 private:
  double height_;
  int cells_;  // through the thickness
  int columns_;
};

}  // namespace strandlab::hotpress
