// Explicit material point method (GIMP) for stacks of anisotropic elastic-plastic bodies that touch, in 2 and 3
// dimensions. The engine knows bodies and rigid platens; it knows nothing of mats and presses.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::mpm {

// Part of a body's surface whose normals do not cancel: top, bottom, one end... A face point rides on a particle p: it
// is at x_p + F_p offset, with outward area vector cof(F_p) area. Faces are kept apart because the top and the bottom
// of a compacted strand reach the same node.
template <int Dim>
struct Face {
  std::string name;
  std::vector<int> particle;
  std::vector<Vec<Dim>> offset;          // mm, at formation
  std::vector<Vec<Dim>> area;            // mm (2D, per mm depth) or mm^2, outward, at formation
  Vec<Dim> traction = Vec<Dim>::Zero();  // MPa, applied to the face (dead load on the area at formation)
};

// A deformable body: particles plus surface points.
template <int Dim>
struct Body {
  std::string name;
  wood::StrandMaterial material;
  Lattice<Dim> lattice;  // of the particles; its spacing is a particle's domain at formation. No counts: any order
  Points<Dim> points;    // the particles' state
  std::vector<Face<Dim>> faces;
};

// The body of a strand: its lattice and its faces (top and bottom, the two ends, in 3D the two edges).
template <int Dim>
Body<Dim> body_of(const Strand<Dim>& strand);

// A line of glue as springs: one between a point of body a and a point of body b, each of which rides on a particle p
// at x_p + F_p offset. With [u] = u_b - u_a since the springs were set, body a is pulled by
// area (stiffness_n [u_n] + stiffness_t [u_t]) and body b by its opposite.
template <int Dim>
struct Spring {
  struct End {
    int body = 0, particle = 0;
    Vec<Dim> offset = Vec<Dim>::Zero();  // mm, at formation
  };
  End a, b;
  Vec<Dim> normal;                          // unit
  double area = 0;                          // mm (2D, per mm depth) or mm^2
  double stiffness_t = 0, stiffness_n = 0;  // MPa/mm
};

enum class Side { kFree, kRoller };

// Background grid: cells of size `cell`, a grid line through `origin` on each axis. Rollers sit on the planes lo and hi
// (these must be grid planes). A particle behind one, or a whole window outside a free side, stops the run
// (checks.hpp).
template <int Dim>
struct Grid {
  Vec<Dim> cell;                                 // mm
  Vec<Dim> origin;                               // mm
  Vec<Dim> lo, hi;                               // mm, the window; last axis: where platens may be
  std::array<std::array<Side, 2>, Dim> sides{};  // [axis][lo, hi]; the last axis is free (platens)
  bool follow_platens = false;  // cell height keeps its ratio to the platen gap; `cell` is for the gap hi - lo
};

// Rigid plane normal to the last axis. Moves with `velocity`.
struct Platen {
  double position = 0;  // mm
  double velocity = 0;  // mm/s
};

struct Options {
  int threads = 1;
  double courant = 0.4;
  double friction = 0.3;         // between bodies, Coulomb
  double platen_friction = 0.3;  // body on platen
  int filter_interval = 0;       // steps between XPIC(2) filterings of the particle velocities; 0: pure FLIP
  bool profile = false;          // measure Timing per phase
};

// Running totals, mJ (2D: per mm depth). Each from its own definition.
struct Energies {
  double kinetic = 0;   // of the particles, now
  double elastic = 0;   // stored, now
  double plastic = 0;   // dissipated: sum V0 tau : d eps_p
  double friction = 0;  // dissipated by slip against friction
  double contact = 0;   // lost in inelastic meetings (normal impulses)
  // Lost in the algorithm: to the velocity filter, to lumping when impulses pass from grid to particles, and because
  // forces change the grid's velocity over its mean in a step while stresses work on its last.
  double filter = 0;
  double platen_work = 0;    // done by the platens on the bodies
  double external_work = 0;  // done by tractions and gravity
};

// All of the engine's state that is not in the bodies; with them it continues to the same bits.
struct EngineState {
  long long step = 0;
  double time_s = 0;
  double time_step_s = 0;
  Platen bottom, top;
  // Totals. The engine leaves kinetic and elastic alone, since they follow from the bodies: a checkpoint holds them as
  // energies() gave them.
  Energies energies;
  // Nodes of several pairs, over all steps, whose velocities the last pass of contact still changed by a hundredth of
  // the first pass's change.
  long long unconverged_contacts = 0;
};

struct Timing {  // s, summed over threads; 0 unless Options::profile
  double weights = 0, surface = 0, scatter = 0, grid = 0, contact = 0, gather = 0, material = 0;
  double fields_per_node = 0;   // mean over nodes with mass
  double plastic_fraction = 0;  // particle-steps that yielded
};

template <int Dim>
class Engine {
 public:
  // Throws InputError for a grid that cannot be (rollers off the grid lines); of bodies outside the first step speaks.
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
  void scale_velocities(double factor);   // of all particles: 0 stops them, 1 - alpha dt drags on them
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
