// Pressing a mat: platens, schedule, the record of the run and its snapshots.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/mpm/engine.hpp"
#include "strandlab/panel/panel.hpp"

namespace strandlab::press {

// Limits beyond which a pressing is warned of. Judgement; what moduli and stress lose on either side of them is in
// docs/user-guide.md, "The speed of the press".
inline constexpr double kJudgedFrom = 0.05;    // compaction from which inertia is judged; before, gaps close unloaded
inline constexpr double kKineticLimit = 0.10;  // energy of the strands' mean motion over internal energy
inline constexpr double kForceLimit = 0.30;    // difference of the platens' forces over their mean
inline constexpr double kBalanceLimit = 0.01;  // error of the energy balance over the platens' work

struct Schedule {
  double speed_m_s = 16;             // closing speed of the platens
  double ramp_time_fraction = 0.02;  // of the pressing time, smooth start from rest
  bool symmetric = false;            // both platens move; else the top one
  bool half = false;  // the mat is the upper half of a symmetric one: its bottom platen is the middle plane, and stands
  std::vector<double> compactions{0, 0.1, 0.2, 0.3, 0.4};  // increasing, < 1: the state is kept at each
  double record_interval_compaction = 0.001;
};

// Compaction from which a pressing's inertia is judged: that of the first state kept of the pressed mat, if not below
// kJudgedFrom. What the strands do before it leaves no trace in the states.
double judged_from(const Schedule& schedule);

// One line of press.csv. Stresses are compression positive, energies are totals since the start.
struct Record {
  double compaction = 0;
  double time_ms = 0;
  double stress_MPa = 0;  // mean of both platens over the last record interval
  double force_top_N = 0, force_bottom_N = 0;
  double kinetic_mJ = 0, elastic_mJ = 0, plastic_mJ = 0, friction_mJ = 0, contact_mJ = 0, filter_mJ = 0;
  double softening_mJ = 0, damping_mJ = 0;  // of a hot press only
  double platen_work_mJ = 0;
  double internal_mJ() const { return elastic_mJ + plastic_mJ; }
  double balance_error() const;  // (work - all terms)/work, 0 at rest
};

// The energies of a record.
void set_energies(Record& record, const mpm::Energies& energies);

// Everything needed to go on with bit-identical results.
template <int Dim>
struct Checkpoint {
  Panel<Dim> panel;
  mpm::EngineState engine;  // step, time step, accumulated energies...
  std::vector<Record> records;
  Record pending;  // sums of the record interval in progress
  int snapshots_done = 0;
  // Watch on inertia: platen impulses over the current two transits, and the worst of each measure so far.
  double balance_time_s = 0, balance_top = 0, balance_bottom = 0;
  double worst_imbalance = 0, worst_kinetic = 0;
  std::vector<double> cycle;  // state of a hot press's cycle (hotpress/cycle.hpp); empty: a cold press
};

struct Progress {
  double compaction = 0, target = 0;
  long long step = 0;
  double particle_steps_per_s = 0;
  double eta_s = 0;
};

// Where press() hands what it makes; the caller decides about files and terminals. All optional.
template <int Dim>
struct Sink {
  std::function<void(const Panel<Dim>&, int index)> snapshot;  // at compactions[index]
  std::function<void(const Checkpoint<Dim>&)>
      checkpoint;  // every checkpoint_interval_s of wall time and at each snapshot
  // Frames of a film: frame k of 0..frames is the first state at or beyond k/frames of the last compaction. After a
  // resume the frames beyond the checkpoint are handed over again, with the same bits.
  std::function<void(const Panel<Dim>&, int index)> frame;
  int frames = 0;
  std::function<void(const Progress&)> progress;  // a few times a second
  std::function<bool()> cancelled;                // asked before every step; true ends the pressing
  double checkpoint_interval_s = 30;
};

template <int Dim>
struct Outcome {
  std::vector<Record> records;
  std::vector<std::string> warnings;  // "platen speed too high...", in plain words
  long long steps = 0;
  double wall_s = 0;
  double particle_steps_per_s = 0;
  mpm::Timing timing;
  std::size_t particles = 0;
  std::size_t bytes = 0;  // held by the engine
  int most_fields = 0;    // velocity fields that met at a node of the grid
};

// Cells of the background grid. Particles: two per cell and axis (make_panel with spacing_along = cell/2).
struct Resolution {
  int cells_through_strand = 3;  // the thinnest one; platens and strand faces may lie anywhere between grid lines
  double cell_aspect = 1;        // length of a cell along the panel over its height
  // The cells' height stays proportional to the platen gap; in 3D to the strands' mean stretch through their thickness.
  bool follow_platens = true;
};

template <int Dim>
struct Setup {
  mpm::Grid<Dim> grid;
  mpm::Options engine;
};

// The grid of a mat: platens at its faces, sides as given, whole cells between the sides. For half a mat
// (Schedule::half) Options::smooth_bottom is for the caller to set.
template <int Dim>
Setup<Dim> setup(const Panel<Dim>& mat, const Resolution& resolution, mpm::Side sides, const mpm::Options& engine);

// Presses a mat (or goes on from `resume`) through the schedule. Throws RunError with the newest good state, at most
// 500 steps old and never older than one handed out before, handed to the checkpoint sink when a particle leaves the
// grid, inverts, turns non-finite or the time step underflows. Throws Cancelled, with the state as it is handed to the
// checkpoint sink, when the sink's cancelled() says so.
template <int Dim>
Outcome<Dim> press(const Panel<Dim>& mat, const Schedule& schedule, const Setup<Dim>& setup, const Sink<Dim>& sink,
                   const std::optional<Checkpoint<Dim>>& resume = std::nullopt);

}  // namespace strandlab::press
