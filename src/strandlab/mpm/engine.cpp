#include "strandlab/mpm/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/core/members.hpp"
#include "strandlab/core/thread_team.hpp"
#include "strandlab/mpm/checks.hpp"
#include "strandlab/mpm/colouring.hpp"
#include "strandlab/mpm/fields.hpp"
#include "strandlab/mpm/loads.hpp"
#include "strandlab/mpm/particles.hpp"
#include "strandlab/mpm/rollers.hpp"
#include "strandlab/mpm/sums.hpp"
#include "strandlab/mpm/tiles.hpp"
#include "strandlab/mpm/time_step.hpp"
#include "strandlab/mpm/velocity_filter.hpp"

namespace strandlab::mpm {
namespace {

// Steps between updates of the time step, and between checks of all particles. Judgement: in 32 steps at Courant number
// 0.4 a wave crosses 13 cells while the platens close by a few thousandths of the mat; `courant` leaves 2.5 in reserve.
constexpr int kTimeStepInterval = 32;
constexpr double kFarInAStep = 0.1;  // cells; particles that move further in a step are checked after it. Judgement
// Cells that points may move before the patches are laid again: less than the kPatchDrift that patches allow, with room
// for one more step. Where patches are laid changes no bit of a result: a run that goes on from a checkpoint lays them
// at other steps (tests/verification/press/determinism_test.cpp). A step that filters looks at positions after it too.
constexpr double kMaxDrift = 0.45;
constexpr double kFilterDrift = 0.1;
// Change of the strands' mean stretch from which the cells' height follows it. Judgement: patches are laid again then.
constexpr double kStretchStep = 0.005;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double ticks() {
#if defined(__x86_64__)
  return static_cast<double>(__builtin_ia32_rdtsc());
#else
  return 1e9 * seconds();
#endif
}

}  // namespace

template <int Dim>
struct Engine<Dim>::Impl {
  Grid<Dim> grid;
  Options options;
  std::vector<Particles<Dim>> bodies;
  TilePlan plan;
  std::vector<TileResult> tile_results;
  Fields fields;
  std::vector<BodyView<Dim>> views;
  std::vector<PencilResult> pencil_results;
  Loads<Dim> loads;
  VelocityFilter filter;
  bool has_platens = false;
  wood::RateEffect rate{.exponent = 0};
  double seconds_per_second = 1;
  EngineState state;
  double first_time_step = 0;
  std::array<double, 3> furthest{};  // cells that a particle moved at most in the last step, per axis
  std::array<double, 3> drift{};     // cells that points may have moved since the patches were laid, per axis
  bool patches_valid = false;
  double force[2] = {0, 0};  // N, of the bottom and top platens
  Phases ticks_by_phase{};
  double timing_ticks = 0, timing_seconds = 0;
  double yield_visits = 0;
  long long particle_steps = 0;
  std::size_t particle_count = 0;
  const Kernels<Dim>* kernel = nullptr;
  ThreadTeam team;

  Impl(const std::vector<Body<Dim>>& input, const Grid<Dim>& g, const Options& o)
      : grid(g), options(o), kernel(&kernels<Dim>()), team(o.threads) {
    check_grid(grid);
    std::vector<ColouredTile> tiles;
    for (std::size_t b = 0; b < input.size(); ++b) {
      bodies.push_back(store_particles(input[b], static_cast<int>(b), tiles));
      particle_count += input[b].points.size();
    }
    plan = sort_by_colour(tiles);
    tile_results.resize(tiles.size());
    std::get<Tractions<Dim>>(loads) = Tractions<Dim>(input);
    state.time_step_s = first_time_step = time_step();
  }

  double stretch() const {  // of the cells' height against grid.cell
    if (grid.follow == Follow::kStrands) return state.cell_stretch;
    if (grid.follow == Follow::kNothing || !has_platens) return 1;
    return (state.top.position - state.bottom.position) / (grid.hi[Dim - 1] - grid.lo[Dim - 1]);
  }

  std::array<int, 2> periods() const {
    std::array<int, 2> cells{};
    for (int a = 0; a < Dim - 1; ++a) {
      if (grid.sides[a][0] == Side::kPeriodic)
        cells[a] = static_cast<int>(std::lround((grid.hi[a] - grid.lo[a]) / grid.cell[a]));
    }
    return cells;
  }

  Step<Dim> this_step() const {
    Step<Dim> step{};
    for (int a = 0; a < Dim; ++a) {
      step.origin[a] = grid.origin[a];
      step.cell[a] = grid.cell[a];
      for (int side = 0; side < 2; ++side) {
        step.wall[a][side] = kNoWall;
        if (a < Dim - 1 && grid.sides[a][side] == Side::kRoller) {
          step.wall[a][side] =
              static_cast<int>(std::lround(((side == 0 ? grid.lo[a] : grid.hi[a]) - grid.origin[a]) / grid.cell[a]));
        }
      }
    }
    const int y = Dim - 1;
    if (grid.follow != Follow::kNothing && has_platens) {
      const double s = stretch();
      step.cell[y] = grid.cell[y] * s;
      step.origin[y] = state.bottom.position + (grid.origin[y] - grid.lo[y]) * s;
    }
    for (int a = 0; a < Dim; ++a) step.inverse_cell[a] = 1 / step.cell[a];
    step.dt = state.time_step_s;
    step.transit = state.time_step_s / options.courant;
    step.rate = {rate.exponent, rate.floor / rate.reference, std::pow(rate.floor / rate.reference, rate.exponent),
                 1 / (seconds_per_second * state.time_step_s * rate.reference)};
    step.platen[0] = {has_platens, state.bottom.position, state.bottom.velocity};
    step.platen[1] = {has_platens, state.top.position, state.top.velocity};
    return step;
  }

  double time_step() const { return options.courant * step_limit(bodies, this_step()).time_s; }

  bool filter_due() const { return options.filter_interval > 0 && (state.step + 1) % options.filter_interval == 0; }
  bool patches_stale() const {
    return !patches_valid || *std::max_element(drift.begin(), drift.end()) > (filter_due() ? kFilterDrift : kMaxDrift);
  }

  // Patches around a particle that has flown off would not fit into memory.
  void check_particles() const {
    check_inside(bodies, grid, state);
    check_stretch(bodies, state);
  }

  void make_patches() {
    const Step<Dim> step = this_step();
    check_colouring(plan, bodies, step, state);
    lay_patches(bodies, step, periods(), state, fields);
    pencil_results.resize(fields.table.pencils.size());
    views = views_of(bodies, fields);
    drift = {};
    patches_valid = true;
  }

  void step() {
    const double t0 = options.timed ? seconds() : 0, c0 = options.timed ? ticks() : 0;
    // When particles are checked depends on the step and their motion alone, not on where patches were laid: a run that
    // goes on from a checkpoint fails where an undisturbed one does.
    if (state.step % kTimeStepInterval == 0) {
      follow_strands();
      update_time_step();
      check_particles();
    }
    if (patches_stale()) make_patches();
    const Step<Dim> step = this_step();
    scatter(step);
    apply(loads, bodies, step, fields);
    fold(step, fields);
    update_grid(step);
    unfold(step, fields);
    book(loads, bodies, step, fields, state.energies.external_work);
    gather(step);
    if (filter_due()) state.energies.filter += filter.apply(step, fields, bodies);
    advance(step);
    if (*std::max_element(furthest.begin(), furthest.end()) > kFarInAStep) check_particles();
    if (options.timed) {
      timing_seconds += seconds() - t0;
      timing_ticks += ticks() - c0;
    }
  }

  // A step whose nodes take their velocity from outside.
  void impose(double dt, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity) {
    state.time_step_s = dt;
    check_particles();
    if (patches_stale()) make_patches();
    const Step<Dim> step = this_step();
    const double filtered_before = state.energies.filter;
    scatter(step);
    impose_velocity(step, velocity, fields);
    gather(step);
    state.energies.filter = filtered_before;
    advance(step);
    state.time_step_s = time_step();  // for steps that follow
  }

  void follow_strands() {
    if (grid.follow != Follow::kStrands) return;
    const double now = mean_thickness_stretch(bodies);
    if (std::abs(now / state.cell_stretch - 1) < kStretchStep) return;
    state.cell_stretch = now;
    patches_valid = false;
  }

  void update_time_step() {
    state.time_step_s = time_step();
    if (state.time_step_s > 1e-4 * first_time_step) return;
    const auto limit = step_limit(bodies, this_step());
    const std::string where =
        limit.body ? fmt::format("{} at ({})", limit.body->name, text<Dim>(limit.body->position(limit.particle)))
                   : "no particle";
    throw RunError(fmt::format("{}: the time step fell to {:.3g} s from {:.3g} s, for {}", moment(state),
                               state.time_step_s, first_time_step, where));
  }

  void scatter(const Step<Dim>& step) {
    std::fill(tile_results.begin(), tile_results.end(), TileResult{});
    clear(fields.nodes);
    clear(fields.surface);
    for (std::size_t colour = 0; colour + 1 < plan.colour_begin.size(); ++colour) {
      const int begin = plan.colour_begin[colour], end = plan.colour_begin[colour + 1];
      team.for_each(end - begin, 2, [&](int i) {
        const int t = begin + i;
        kernel->scatter(plan.tiles[t], views[plan.tiles[t].body], step, fields.nodes.data(), fields.surface.data(),
                        bodies[plan.tiles[t].body].lanes.data(), options.timed, tile_results[t]);
      });
    }
  }

  void clear(AlignedArray& array) {
    constexpr std::size_t kChunk = 1 << 15;
    const auto chunks = static_cast<int>((array.size() + kChunk - 1) / kChunk);
    team.for_each(chunks, 1, [&](int c) {
      const std::size_t begin = c * kChunk, end = std::min(array.size(), begin + kChunk);
      std::fill(array.data() + begin, array.data() + end, 0.0);
    });
  }

  void update_grid(const Step<Dim>& step) {
    GridView<Dim> view{};
    view.nodes = fields.nodes.data();
    view.surface = fields.surface.data();
    view.fields = fields.table.fields.data();
    view.row_start = fields.table.row_start.data();
    view.slots = fields.table.slots.data();
    view.friction = options.friction;
    view.platen_friction[0] = options.smooth_bottom ? 0 : options.platen_friction;
    view.platen_friction[1] = options.platen_friction;
    const auto count = static_cast<int>(fields.table.pencils.size());
    const double start = options.timed ? ticks() : 0;
    team.for_each(count, 8, [&](int p) {
      pencil_results[p] = PencilResult{};
      kernel->update_grid(fields.table.pencils[p], step, view, options.timed, pencil_results[p]);
    });
    PencilResult total{};
    for (const auto& r : pencil_results) {
      add(total, r);
      state.most_fields = std::max(state.most_fields, r.most_fields);
    }
    if (total.overflow > 0) {
      const auto where =
          std::find_if(pencil_results.begin(), pencil_results.end(), [](auto& r) { return r.overflow > 0; });
      const int column = fields.table.pencils[where - pencil_results.begin()].index[0];
      throw RunError(fmt::format("{}: more than {} bodies meet at one grid node near x = {:.4f} mm", moment(state),
                                 kMaxFields, step.origin[0] + column * step.cell[0]));
    }
    state.energies.friction += total.friction;
    state.energies.contact += total.contact;
    state.energies.platen_work += total.platen_work;
    state.energies.filter += total.kinetic_change + total.force_change;
    state.unconverged_contacts += total.unconverged;
    for (int k = 0; k < 2; ++k) force[k] = total.platen_impulse[k] / step.dt;
    if (options.timed) {
      const double all = (ticks() - start) * (options.threads > 1 ? options.threads : 1);
      ticks_by_phase.contact += total.contact_ticks;
      ticks_by_phase.grid += all - total.contact_ticks;
    }
  }

  void gather(const Step<Dim>& step) {
    const auto count = static_cast<int>(plan.tiles.size());
    team.for_each(count, 2, [&](int t) {
      kernel->gather(plan.tiles[t], views[plan.tiles[t].body], step, fields.nodes.data(),
                     bodies[plan.tiles[t].body].lanes.data(), options.timed, tile_results[t]);
    });
    long long yielding = 0;
    furthest = {};
    for (int t = 0; t < count; ++t) {
      // All of the result: another member stops the compiler here.
      const auto& [plastic, kinetic_change, stress_change, moved, yields, bad, ticks] = tile_results[t];
      state.energies.plastic += plastic;
      state.energies.filter -= kinetic_change + stress_change;
      yielding += yields;
      for (int a = 0; a < 3; ++a) furthest[a] = std::max(furthest[a], moved[a]);
      if (bad) throw particle_failure(bodies[plan.tiles[t].body], bad - 1, state);
      add(ticks_by_phase, ticks);
    }
    for (int a = 0; a < 3; ++a) drift[a] += furthest[a];
    yield_visits += static_cast<double>(yielding);
    particle_steps += static_cast<long long>(particle_count);
  }

  void advance(const Step<Dim>& step) {
    ++state.step;
    state.time_s += step.dt;
    if (!has_platens) return;
    const double before = stretch();
    state.bottom.position += state.bottom.velocity * step.dt;
    state.top.position += state.top.velocity * step.dt;
    const double bottom = std::abs(state.bottom.velocity) * step.dt * step.inverse_cell[Dim - 1];
    const double top = std::abs(state.top.velocity) * step.dt * step.inverse_cell[Dim - 1];
    if (grid.follow == Follow::kPlatens)  // its lines, and images with them, move by at most the platens' displacement
      drift[Dim - 1] += std::max(bottom, top) + (before - stretch()) / before;
    else  // images of particles that a platen comes nearer to move twice as far; the grid may move with the bottom
      drift[Dim - 1] += 2 * std::max(bottom, top) + bottom;
  }
};

template <int Dim>
Engine<Dim>::Engine(const std::vector<Body<Dim>>& bodies, const Grid<Dim>& grid, const Options& options)
    : impl_(std::make_unique<Impl>(bodies, grid, options)) {}
template <int Dim>
Engine<Dim>::~Engine() = default;
template <int Dim>
Engine<Dim>::Engine(Engine&&) noexcept = default;
template <int Dim>
Engine<Dim>& Engine<Dim>::operator=(Engine&&) noexcept = default;

template <int Dim>
void Engine<Dim>::set_platens(const Platen& bottom, const Platen& top) {
  impl_->state.bottom = bottom;
  impl_->state.top = top;
  impl_->has_platens = true;
  impl_->patches_valid = false;
}
template <int Dim>
void Engine<Dim>::set_platen_velocities(double bottom, double top) {
  impl_->state.bottom.velocity = bottom;
  impl_->state.top.velocity = top;
}
template <int Dim>
void Engine<Dim>::set_gravity(const Vec<Dim>& g) {
  std::get<Gravity<Dim>>(impl_->loads).set(g);
}
template <int Dim>
void Engine<Dim>::set_traction(int body, int face, const Vec<Dim>& traction) {
  const auto& bodies = impl_->bodies;
  if (body < 0 || body >= static_cast<int>(bodies.size()) || face < 0 ||
      face >= static_cast<int>(bodies[static_cast<std::size_t>(body)].faces.size())) {
    throw InputError(fmt::format("traction on face {} of body {}, which is not there", face, body));
  }
  std::get<Tractions<Dim>>(impl_->loads).set(static_cast<std::size_t>(body), static_cast<std::size_t>(face), traction);
}
template <int Dim>
void Engine<Dim>::set_springs(const std::vector<Spring<Dim>>& springs) {
  std::get<Springs<Dim>>(impl_->loads).set(springs, impl_->bodies);
}
template <int Dim>
void Engine<Dim>::scale_velocities(double factor) {
  impl_->state.energies.damping += (1 - factor * factor) * kinetic_energy(impl_->bodies);
  mpm::scale_velocities(impl_->bodies, factor);
}
template <int Dim>
void Engine<Dim>::soften(int body, const std::vector<double>& stiffness, const std::vector<double>& yield) {
  if (body < 0 || body >= static_cast<int>(impl_->bodies.size()))
    throw InputError(fmt::format("softening of body {}, which is not there", body));
  auto& particles = impl_->bodies[static_cast<std::size_t>(body)];
  if (particles.condition.size() == 0)
    throw InputError(fmt::format("softening of {}, whose points have no factors", particles.name));
  const std::size_t count = particles.where.size();
  if (stiffness.size() != count || yield.size() != count) {
    throw InputError(fmt::format("softening of {}: {} and {} factors for {} particles", particles.name,
                                 stiffness.size(), yield.size(), count));
  }
  impl_->state.energies.softening += mpm::soften(particles, stiffness, yield);
}
template <int Dim>
void Engine<Dim>::set_rate_effect(const wood::RateEffect& effect, double seconds_per_second) {
  impl_->rate = effect;
  impl_->seconds_per_second = seconds_per_second;
}
template <int Dim>
void Engine<Dim>::resume(const EngineState& state) {
  impl_->state = state;
  impl_->patches_valid = false;
}
template <int Dim>
void Engine<Dim>::step() {
  impl_->step();
}
template <int Dim>
void Engine<Dim>::impose(double time_step_s, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity) {
  impl_->impose(time_step_s, velocity);
}
template <int Dim>
const EngineState& Engine<Dim>::state() const {
  return impl_->state;
}
template <int Dim>
Energies Engine<Dim>::energies() const {
  Energies e = impl_->state.energies;
  e.kinetic = kinetic_energy(impl_->bodies);
  e.elastic = elastic_energy(impl_->bodies);
  return e;
}
template <int Dim>
double Engine<Dim>::spring_energy() const {
  return std::get<Springs<Dim>>(impl_->loads).energy();
}
template <int Dim>
double Engine<Dim>::mean_motion_energy() const {
  return mpm::mean_motion_energy(impl_->bodies);
}
template <int Dim>
Vec<Dim> Engine<Dim>::momentum() const {
  return mpm::momentum(impl_->bodies);
}
template <int Dim>
double Engine<Dim>::mass() const {
  return mpm::mass(impl_->bodies);
}
template <int Dim>
double Engine<Dim>::grid_mass() const {
  return mpm::grid_mass(impl_->fields);
}
template <int Dim>
double Engine<Dim>::bottom_force() const {
  return impl_->force[0];
}
template <int Dim>
double Engine<Dim>::top_force() const {
  return impl_->force[1];
}
template <int Dim>
Timing Engine<Dim>::timing() const {
  Timing t{.phases = impl_->ticks_by_phase};
  const double scale = impl_->timing_ticks > 0 ? impl_->timing_seconds / impl_->timing_ticks : 0;
  for_each_member(t.phases, [scale](double& phase) { phase *= scale; });
  if (impl_->particle_steps > 0) t.plastic_fraction = impl_->yield_visits / static_cast<double>(impl_->particle_steps);
  t.fields_per_node = fields_per_node(impl_->fields);
  return t;
}
template <int Dim>
long long Engine<Dim>::particle_steps() const {
  return impl_->particle_steps;
}
template <int Dim>
std::size_t Engine<Dim>::particles() const {
  return impl_->particle_count;
}
template <int Dim>
std::size_t Engine<Dim>::stored_nodes() const {
  return impl_->fields.nodes.size() / kRecord;
}
template <int Dim>
std::size_t Engine<Dim>::bytes() const {
  return mpm::bytes(impl_->bodies) + mpm::bytes(impl_->fields) + impl_->filter.bytes();
}
template <int Dim>
void Engine<Dim>::write(std::vector<Body<Dim>>& bodies) const {
  for (std::size_t b = 0; b < bodies.size(); ++b) copy_out(impl_->bodies[b], bodies[b].points);
}
template <int Dim>
void Engine<Dim>::write(Panel<Dim>& panel) const {
  for (std::size_t b = 0; b < panel.strands.size(); ++b) copy_out(impl_->bodies[b], panel.strands[b].points);
  panel.time_s = impl_->state.time_s;
  if (impl_->has_platens) {
    panel.bottom_mm = impl_->state.bottom.position;
    panel.top_mm = impl_->state.top.position;
  }
}

template class Engine<2>;
template class Engine<3>;

}  // namespace strandlab::mpm
