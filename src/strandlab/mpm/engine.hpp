// Explicit material point method (GIMP) for stacks of anisotropic elastic-plastic bodies that touch, in 2 and 3
// dimensions. The engine knows bodies and rigid platens; it knows nothing of mats and presses.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "strandlab/mpm/body.hpp"
#include "strandlab/mpm/phases.hpp"
#include "strandlab/mpm/spring.hpp"
#include "strandlab/mpm/state.hpp"
#include "strandlab/panel/panel.hpp"
#include "strandlab/wood/rate_effect.hpp"

namespace strandlab::mpm {

enum class Side { kFree, kRoller, kPeriodic };

// What the height of the cells follows: the platens' gap, or the strands, the mean over all points of their stretch
// through the thickness. Between them lie the voids of an open mat, which closes long before its strands do.
enum class Follow { kNothing, kPlatens, kStrands };

// Background grid: cells of size `cell`, a grid line through `origin` on each axis. Rollers sit on the planes lo and hi
// (these must be grid planes). Of periodic sides, both of an axis, the grid repeats after hi - lo, whole cells: bodies
// keep their positions, which go on beyond the window, and meet the images of others and their own. A particle behind a
// roller, or a whole window outside another side, stops the run (checks.hpp).
template <int Dim>
struct Grid {
  Vec<Dim> cell;                                 // mm
  Vec<Dim> origin;                               // mm
  Vec<Dim> lo, hi;                               // mm, the window; last axis: where platens may be
  std::array<std::array<Side, 2>, Dim> sides{};  // [axis][lo, hi]; the last axis is free (platens)
  Follow follow = Follow::kNothing;              // `cell` is for the gap hi - lo, and for strands as formed
};

struct Options {
  int threads = 1;
  double courant = 0.4;
  double friction = 0.3;         // between bodies, Coulomb
  double platen_friction = 0.3;  // body on platen
  bool smooth_bottom = false;    // no friction on the bottom platen: it is a plane of symmetry
  int filter_interval = 0;       // steps between XPIC(2) filterings of the particle velocities; 0: pure FLIP
  bool timed = false;            // measure Timing per phase
};

struct Timing {                 // 0 unless Options::timed
  Phases phases{};              // s, summed over threads
  double fields_per_node = 0;   // mean over nodes with mass
  double plastic_fraction = 0;  // particle-steps that yielded
};

template <int Dim>
class Engine {
 public:
  // Throws InputError for a grid that cannot be (rollers off the grid lines, a period of broken cells); of bodies
  // outside the first step speaks.
  Engine(const std::vector<Body<Dim>>& bodies, const Grid<Dim>& grid, const Options& options);
  ~Engine();
  Engine(Engine&&) noexcept;
  Engine& operator=(Engine&&) noexcept;

  void set_platens(const Platen& bottom, const Platen& top);  // positions and velocities for the steps to come
  void set_platen_velocities(double bottom, double top);      // mm/s
  void set_gravity(const Vec<Dim>& g);                        // mm/s^2
  // MPa, on a face as Body has them. Throws InputError for a body or face that is not there.
  void set_traction(int body, int face, const Vec<Dim>& traction);
  // Unstretched from now on, in place of those set before. Their stretch is not part of EngineState. The time step does
  // not know them: it must be below 2/omega of a spring between two nodes. Throws InputError for a body or particle
  // that is not there, a normal that is no unit vector, or a negative area or stiffness.
  void set_springs(const std::vector<Spring<Dim>>& springs);
  void scale_velocities(double factor);  // of all particles: 0 stops them, 1 - alpha dt drags on them
  // The wood of a body gets softer or stiffer: factors of stiffness and of yield over those of its material, by
  // particle. Where it gets softer its elastic strain stays and its stress falls; where it gets stiffer its stress
  // stays, and the elastic strain that this no longer needs is locked in. Throws InputError for a body that is not
  // there, whose points had no factors from the start, or other numbers of them.
  void soften(int body, const std::vector<double>& stiffness, const std::vector<double>& yield);
  // Yield of such bodies follows the rate of plastic strain, a second of the engine standing for so many seconds. None
  // unless set.
  void set_rate_effect(const wood::RateEffect& effect, double seconds_per_second);
  void resume(const EngineState& state);  // state of a run whose bodies were given to the constructor

  // One time step. Throws RunError (step, time, body, position) when a particle leaves the grid, inverts (det F <= 0)
  // or its stress is not finite, or the time step underflows; the bodies then hold the failed state.
  void step();

  // One step of the given length in which the grid moves with a given velocity (mm/s at a point in mm) and not by its
  // forces: particles move, deform and are stressed as in step(). Rollers, contact and platens do not act, and of the
  // energies only the plastic one is booked. For prescribed deformations.
  void impose(double time_step_s, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity);

  const EngineState& state() const;
  Energies energies() const;                       // with kinetic and elastic evaluated now
  double spring_energy() const;                    // mJ, stored in the springs now
  double mean_motion_energy() const;               // mJ, kinetic energy of each body's mean velocity
  Vec<Dim> momentum() const;                       // t mm/s, of the particles
  double mass() const;                             // t, of the particles
  double grid_mass() const;                        // t, on the nodes of the last step, what rollers fold included
  double bottom_force() const, top_force() const;  // N (per mm depth in 2D), pressing positive, of the last step
  Timing timing() const;
  long long particle_steps() const;
  std::size_t particles() const;
  std::size_t stored_nodes() const, bytes() const;  // of grid fields; of everything

  // Copies the particles' state out, into bodies as given to the constructor (strands of a panel alike).
  void write(std::vector<Body<Dim>>& bodies) const;
  void write(Panel<Dim>& panel) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace strandlab::mpm
