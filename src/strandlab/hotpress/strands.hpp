// A mat pressed hot strand by strand: the material point press between the exchanges with heat and moisture.
//
// Every exchange moves the platens as the schedule says in the press's time, at the engine's own speed, while the
// points' factors of stiffness and yield go from those of the last temperatures to those of the next over its first
// half. Wood is slow and the engine is fast: yield follows the rate of the press's time. In a hold, heat goes on until
// some layer's factors have changed enough to matter; then the mat settles, damped.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "strandlab/glue/glue.hpp"
#include "strandlab/hotpress/mechanics.hpp"
#include "strandlab/press/press.hpp"

namespace strandlab::hotpress {

struct StrandPress {
  press::Setup<2> setup;
  double speed_m_s = 16;   // of the platens in the engine
  bool symmetric = false;  // both platens move, else the top one
  wood::RateEffect rate;
  Softening softening;
  int cells = 40;                     // of equal mass through a column, as the transfer has them
  int columns = 1;                    // of equal width along the section
  std::vector<Carried> resin;         // by strand; empty: all of their layers
  glue::CuringOptions curing;         // faces that are as near as to be glued have met
  double due = .15;                   // change of a layer's ln factor for which a mat at rest is settled anew
  std::function<void()> before_step;  // what it throws ends the pressing
};

class StrandMechanics final : public MatMechanics {
 public:
  static constexpr double kStiffest = 300;  // MPa, that control of pressure expects of a mat. Judgement

  // The mat as formed, its strands of crushing or of Hill's wood. Throws InputError for strands whose stiffness is
  // softened already (StrandKind::stiffness_factor): heat does that here.
  StrandMechanics(const Panel<2>& mat, const StrandPress& how);
  // Goes on from a checkpoint, whose engine and panel it takes; visit() then brings the rest.
  StrandMechanics(const press::Checkpoint<2>& checkpoint, const StrandPress& how);

  void condition(const std::vector<transfer::CellState>& state) override;
  Moved move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) override;
  // Of each column as much as lies in it of the mat as formed.
  std::vector<double> dry_mass(double of_mat, int cells) const override;
  std::vector<double> thickness() const override { return thickness_; }
  double stress() const override { return stress_; }
  double height_unloaded() const override;  // the gap: it opens until the platens feel nothing
  double longest_step(double closing) const override;
  void visit(Numbers& numbers) override;

  // What is told of a cell (column by column, bottom to top).
  struct Resin {
    double cure = 0, strength = 0;  // degree of cure; part of the strength of a bond that is fully cured
  };
  struct Reading {
    double T = 0, M = 0, gas = 0;  // C, kg/kg, kPa above the room's
    Resin face, core;              // as each has, or would have, cured there
    bool is_face = false;          // the layer's resin
  };
  // After each exchange: notes which faces have met since the last one. What their resin had of its strength before
  // they met is lost to the bond (precure).
  void meet(const std::vector<Reading>& cells);
  // The panel now, its points with temperature, moisture, gas pressure and cure between those of the cells; faces with
  // the strength that their resin has gained since they met another strand, those that have met none with nothing.
  Panel<2> panel(const std::vector<Reading>& cells) const;
  double precured() const;  // strength lost to precure, mean over the faces that have met
  press::Checkpoint<2> checkpoint() const;
  const std::vector<press::Record>& records() const { return records_; }  // one per exchange
  const mpm::Engine<2>& engine() const { return *engine_; }
  std::vector<std::string> warnings() const;  // of inertia and of the balance of energy

 private:
  struct Factors {
    std::vector<std::vector<double>> stiffness, yield;  // by strand, by point
  };
  // Where a point lies among the cells: between the middles of two columns, in each of them so many cells above its
  // bottom, by mass.
  struct Place {
    std::size_t column = 0;
    double next = 0;  // weight of the next column
    double here = 0, there = 0;
  };
  double gap() const;                 // mm
  double transit() const;             // s, of a wave through the mat as formed
  std::vector<Place> places() const;  // of all points
  template <class Of>
  double between_cells(const Place& place, const Of& of) const;
  double of_resin(std::size_t strand, const Place& place, const std::vector<Reading>& cells,
                  double Resin::*value) const;
  std::vector<std::size_t> face_points() const;  // of all points, in the order of met_
  std::vector<double> strength_of_faces(const std::vector<Reading>& cells) const;
  Factors factors_of_points(const std::vector<transfer::CellState>& state) const;
  void start();
  void soften(double part);  // of the way to the next factors
  void soften_by(double done);
  void feel(double seconds);  // adds to the impulses
  void read();                // panel and layers from the engine
  void watch_columns(const std::vector<double>& masses);
  void step(double closing_mm_s, double seconds_per_second);
  void close(double to_mm, double final_gap_mm, double seconds,
             double pressure_MPa = std::numeric_limits<double>::infinity());
  void press(const Move& move, double seconds);
  void settle(const Move& move, double seconds, double least_gap_mm = 0);
  void listen(double dt, double area, double wave);
  void judge(const Move& move, double gap_before_mm, double stress_before);
  bool opens(const Move& move) const;
  bool follows(const Move& move) const;
  void record();
  bool due(const Move& move, const std::vector<transfer::CellState>& state) const;

  StrandPress how_;
  Panel<2> panel_;
  std::optional<mpm::Engine<2>> engine_;
  bool conditioned_ = false;
  std::vector<double> thickness_;  // m, by cell
  std::vector<double> masses_;     // of the columns of the mat as formed, over their mean
  double moved_ = 0;               // of a column's mass, that strands have carried into it or out of it, at most
  double stress_ = 0;              // Pa
  CellFactors last_;               // at the last exchange
  // By point of a strand's bottom, then of its top face, strand by strand: its resin's strength at the last exchange,
  // and when it met another strand's face; kApart while it has not.
  static constexpr double kApart = -1;
  std::vector<double> strength_, met_;
  int stage_ = 0;  // of the way from those factors to the next
  Factors from_, to_;
  double waiting_ = 0;   // s of the press since the last exchange
  double velocity_ = 0;  // mm/s, of closing
  double wanted_ = 0;    // Pa, of the last exchange
  double held_ = 0;      // Pa, when the platens were last moved by position
  bool by_pressure_ = false;
  bool limited_ = false, at_stop_ = false;
  double now_ = 0, filtered_ = 0;  // MPa, of the last step under control and its mean over a part of a transit
  double modulus_ = kStiffest;     // MPa, of the mat while it last gave way under control

  double sum_s_ = 0, sum_top_ = 0, sum_bottom_ = 0;  // impulses of the part of an exchange that is read
  std::vector<press::Record> records_;
};

}  // namespace strandlab::hotpress
