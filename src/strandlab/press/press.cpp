#include "strandlab/press/press.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>

#include "strandlab/core/error.hpp"
#include "strandlab/mpm/kernels.hpp"

namespace strandlab::press {
namespace {

constexpr double kMmPerM = 1000;
constexpr double kUnsettledLimit = 1e-4;  // nodes per step and particle where contact did not settle
constexpr const char* kSpeedGuide = "docs/user-guide.md, \"The speed of the press\"";

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Closing speed as a function of time: a cosine ramp from rest to full speed.
double closing_speed(double time_s, double speed, double ramp_s) {
  if (time_s >= ramp_s) return speed;
  return 0.5 * speed * (1 - std::cos(M_PI * time_s / ramp_s));
}

// What a speed was measured to cost on the OSB case (bench/press_speed; the table is in docs/user-guide.md).
std::string cost_of(double speed_m_s) {
  if (speed_m_s <= 16)
    return "For the OSB case 16 m/s was measured to change moduli from 400 kg/m3 on by less than 2 % against 1 m/s, "
           "stresses from 20 % compaction on by less than 5 %.";
  if (speed_m_s <= 64)
    return "For the OSB case 64 m/s was measured to change moduli by up to 27 % at 400 kg/m3 and 15 % from 480 on "
           "against slower presses, stresses from 20 % compaction on by up to a third.";
  return "What this costs has been measured up to 64 m/s only.";
}

void check(const Schedule& schedule) {
  if (!(schedule.speed_m_s > 0))
    throw InputError(fmt::format("press: speed {} m/s; it must be positive", schedule.speed_m_s));
  if (schedule.compactions.empty()) throw InputError("press: no compactions are asked for");
  double before = -1;
  for (double c : schedule.compactions) {
    if (!(c >= 0 && c < 1 && c > before)) {
      throw InputError(fmt::format("press: compaction {}; compactions must increase and lie in 0 <= C < 1", c));
    }
    before = c;
  }
}

template <int Dim>
class Press {
 public:
  Press(const Panel<Dim>& mat, const Schedule& schedule, const Setup<Dim>& setup, const Sink<Dim>& sink,
        const std::optional<Checkpoint<Dim>>& resume)
      : schedule_(schedule),
        judged_from_(judged_from(schedule)),
        sink_(sink),
        state_(resume ? *resume : Checkpoint<Dim>{}) {
    check(schedule);
    if (!resume) state_.panel = mat;
    std::vector<mpm::Body<Dim>> bodies;
    for (const auto& strand : state_.panel.strands) bodies.push_back(mpm::body_of(strand));
    engine_.emplace(bodies, setup.grid, setup.engine);
    if (resume)
      engine_->set_platens(resume->engine.bottom, resume->engine.top);
    else
      engine_->set_platens({mat.bottom_mm, 0}, {mat.top_mm, 0});
    if (resume) engine_->resume(resume->engine);
    const double distance = (schedule.half ? 2 : 1) * state_.panel.initial_thickness_mm * schedule.compactions.back();
    ramp_s_ = schedule.ramp_time_fraction * distance / (schedule.speed_m_s * kMmPerM);
    // A snapshot can fall inside a step; the step is shortened to nothing else, so the state is kept at the first step
    // at or beyond the requested compaction.
    transit_s_ = transit_time();
    // A checkpoint is written after the frames up to its compaction.
    while (resume && next_frame_ <= sink.frames && compaction() >= frame_compaction(next_frame_)) ++next_frame_;
  }

  Outcome<Dim> run() {
    const double start = wall_clock();
    double last_checkpoint = start, last_progress = start;
    long long checked_steps = 0;
    const long long first_step = engine_->state().step;
    good_step_ = first_step;
    good_compaction_ = compaction();
    last_good_ = sink_.checkpoint && first_step == 0 ? std::optional(checkpoint()) : std::nullopt;
    keep_frames();
    keep_snapshots();
    try {
      while (state_.snapshots_done < static_cast<int>(schedule_.compactions.size())) {
        stop_if_cancelled();
        advance();
        keep_frames();
        keep_snapshots();
        keep_good();
        if (++checked_steps % 32 != 0) continue;
        const double now = wall_clock();
        if (sink_.checkpoint && now - last_checkpoint > sink_.checkpoint_interval_s) {
          save();
          last_checkpoint = now;
        }
        if (sink_.progress && now - last_progress > 0.25) {
          report(now - start, first_step);
          last_progress = now;
        }
      }
    } catch (const RunError&) {
      if (sink_.checkpoint && last_good_) sink_.checkpoint(*last_good_);  // newer than any that was saved
      throw;
    }
    Outcome<Dim> outcome;
    outcome.records = state_.records;
    outcome.warnings = warnings();
    outcome.steps = engine_->state().step;
    outcome.wall_s = wall_clock() - start;
    outcome.particle_steps_per_s =
        outcome.wall_s > 0 ? static_cast<double>(engine_->particle_steps()) / outcome.wall_s : 0;
    outcome.timing = engine_->timing();
    outcome.bytes = engine_->bytes();
    outcome.particles = engine_->particles();
    outcome.most_fields = engine_->state().most_fields;
    return outcome;
  }

 private:
  double gap() const { return engine_->state().top.position - engine_->state().bottom.position; }
  double compaction() const { return 1 - gap() / state_.panel.initial_thickness_mm; }

  // Time a wave needs through the mat's thickness: the platens' forces are compared over two of these.
  double transit_time() const {
    double slowest = 0;
    for (const auto& strand : state_.panel.strands) {
      const double stiffness = strand.stiffness_factor * strand.material.stiffness(2, 2);
      slowest = std::max(slowest, std::sqrt(strand.material.density / stiffness));
    }
    return slowest * state_.panel.initial_thickness_mm;
  }

  void advance() {
    const double v = closing_speed(engine_->state().time_s, schedule_.speed_m_s * kMmPerM, ramp_s_);
    if (schedule_.half)
      engine_->set_platen_velocities(0, -0.5 * v);
    else if (schedule_.symmetric)
      engine_->set_platen_velocities(0.5 * v, -0.5 * v);
    else
      engine_->set_platen_velocities(0, -v);
    engine_->step();
    auto& sum = state_.pending;
    const double dt = engine_->state().time_step_s;
    sum.time_ms += dt;  // the weight of the sums
    sum.force_top_N += engine_->top_force() * dt;
    sum.force_bottom_N += engine_->bottom_force() * dt;
    watch_balance(dt);
    if (compaction() >= static_cast<double>(state_.records.size()) * schedule_.record_interval_compaction) record();
  }

  // Largest difference of the platens' forces, each averaged over two transits.
  void watch_balance(double dt) {
    state_.balance_time_s += dt;
    state_.balance_top += engine_->top_force() * dt;
    state_.balance_bottom += engine_->bottom_force() * dt;
    if (state_.balance_time_s < 2 * transit_s_) return;
    const double top = state_.balance_top, bottom = state_.balance_bottom;
    if (compaction() >= judged_from_ && top + bottom > 0) {
      state_.worst_imbalance = std::max(state_.worst_imbalance, std::abs(top - bottom) / (0.5 * (top + bottom)));
    }
    state_.balance_time_s = state_.balance_top = state_.balance_bottom = 0;
  }

  void record() {
    Record r = state_.pending;
    const double span = r.time_ms;
    if (span > 0) {
      r.force_top_N /= span;
      r.force_bottom_N /= span;
    }
    const double area = state_.panel.length_mm * state_.panel.depth_mm;
    // The engine's forces are per mm of depth in a section.
    if (Dim == 2) {
      r.force_top_N *= state_.panel.depth_mm;
      r.force_bottom_N *= state_.panel.depth_mm;
    }
    r.stress_MPa = 0.5 * (r.force_top_N + r.force_bottom_N) / area;
    r.compaction = compaction();
    r.time_ms = 1e3 * engine_->state().time_s;
    set_energies(r, engine_->energies());
    if (r.compaction >= judged_from_ && r.internal_mJ() > 0) {
      state_.worst_kinetic = std::max(state_.worst_kinetic, engine_->mean_motion_energy() / r.internal_mJ());
    }
    state_.records.push_back(r);
    state_.pending = {};
  }

  // The state to fall back on when a later step fails: every hundredth of the run, but not so often that the copies
  // cost time, and at least every few hundred steps, as the smooth start and slow runs need many.
  void keep_good() {
    constexpr long long kFewestSteps = 100, kMostSteps = 500;
    if (!sink_.checkpoint) return;
    const long long steps = engine_->state().step - good_step_;
    const bool far = compaction() - good_compaction_ >= 0.01 * schedule_.compactions.back();
    if (steps < kFewestSteps || (!far && steps < kMostSteps)) return;
    last_good_ = checkpoint();
    good_step_ = engine_->state().step;
    good_compaction_ = compaction();
  }

  void stop_if_cancelled() {
    if (!sink_.cancelled || !sink_.cancelled()) return;
    if (sink_.checkpoint) save();
    throw Cancelled();
  }

  // What was saved needs no copy to fall back on.
  void save() {
    sink_.checkpoint(checkpoint());
    last_good_.reset();
    good_step_ = engine_->state().step;
    good_compaction_ = compaction();
  }

  double frame_compaction(int index) const {
    return schedule_.compactions.back() * index / std::max(1, sink_.frames) - 1e-12;
  }

  // A mat that is not pressed has one frame.
  void keep_frames() {
    if (!sink_.frame) return;
    const int last = schedule_.compactions.back() > 0 ? sink_.frames : 0;
    while (next_frame_ <= last && compaction() >= frame_compaction(next_frame_)) {
      engine_->write(state_.panel);
      sink_.frame(state_.panel, next_frame_++);
    }
  }

  void keep_snapshots() {
    while (state_.snapshots_done < static_cast<int>(schedule_.compactions.size()) &&
           compaction() >= schedule_.compactions[state_.snapshots_done] - 1e-12) {
      engine_->write(state_.panel);
      const int index = state_.snapshots_done++;
      if (sink_.snapshot) sink_.snapshot(state_.panel, index);
      if (sink_.checkpoint) save();
    }
  }

  Checkpoint<Dim> checkpoint() {
    engine_->write(state_.panel);
    state_.engine = engine_->state();
    state_.engine.energies = engine_->energies();
    return state_;
  }

  void report(double elapsed, long long first_step) {
    Progress p;
    p.compaction = compaction();
    p.target = schedule_.compactions.back();
    p.step = engine_->state().step;
    p.particle_steps_per_s = static_cast<double>(engine_->particle_steps()) / elapsed;
    const double steps_left = (schedule_.half ? 2 : 1) * (p.target - p.compaction) * state_.panel.initial_thickness_mm /
                              (schedule_.speed_m_s * kMmPerM * engine_->state().time_step_s);
    p.eta_s = steps_left * elapsed / static_cast<double>(std::max<long long>(1, p.step - first_step));
    sink_.progress(p);
  }

  // Compaction beyond which the records keep to the limit of motion; all of the motion counts here.
  double quiet_from() const {
    double last = 0;
    for (const auto& r : state_.records) {
      if (r.compaction >= judged_from_ && r.kinetic_mJ > kKineticLimit * r.internal_mJ()) last = r.compaction;
    }
    return last;
  }

  // Compaction beyond which the platens' forces of the records, averaged over two transits, keep to their limit.
  double even_from() const {
    double last = 0, time_ms = 0, top = 0, bottom = 0, before_ms = 0;
    for (const auto& r : state_.records) {
      const double span = r.time_ms - before_ms;
      before_ms = r.time_ms;
      time_ms += span;
      top += r.force_top_N * span;
      bottom += r.force_bottom_N * span;
      if (1e-3 * time_ms < 2 * transit_s_) continue;
      if (r.compaction >= judged_from_ && std::abs(top - bottom) > kForceLimit * 0.5 * (top + bottom))
        last = r.compaction;
      time_ms = top = bottom = 0;
    }
    return last;
  }

  // Inertia shows early, while gaps close at little stress: a limit that is met later on is met "from compaction C on".
  std::string limit(double value, double met_from) const {
    const bool met = met_from > 0 && met_from < 0.95 * state_.records.back().compaction;
    return fmt::format("limit {:.0f} %{}", 100 * value,
                       met ? fmt::format(", kept from compaction {:.2f} on", met_from) : "");
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> w;
    if (state_.worst_kinetic > kKineticLimit) {
      w.push_back(fmt::format(
          "The press closed too fast: the energy of the strands' motion reached {:.1f} % of the internal "
          "energy ({}). {} Lower press.speed_m_s ({}).",
          100 * state_.worst_kinetic, limit(kKineticLimit, quiet_from()), cost_of(schedule_.speed_m_s), kSpeedGuide));
    }
    if (state_.worst_imbalance > kForceLimit) {
      w.push_back(fmt::format(
          "The two platens felt forces that differed by up to {:.0f} % ({}): the mat was not pressed "
          "evenly. {} Lower press.speed_m_s ({}).",
          100 * state_.worst_imbalance, limit(kForceLimit, even_from()), cost_of(schedule_.speed_m_s), kSpeedGuide));
    }
    if (const auto count = engine_->state().unconverged_contacts;
        static_cast<double>(count) >
        kUnsettledLimit * static_cast<double>(engine_->state().step) * static_cast<double>(engine_->particles())) {
      w.push_back(fmt::format(
          "Contact did not settle at {} nodes (summed over {} steps): their velocities still changed by more "
          "than 1 % after {} passes. For the OSB case, with a twelfth of the number that is warned of, settling all "
          "was "
          "measured to change moduli by less than .1 %. Lower grid.courant or press.speed_m_s ({}).",
          count, engine_->state().step, mpm::kContactPasses, kSpeedGuide));
    }
    if (!state_.records.empty() && std::abs(state_.records.back().balance_error()) > kBalanceLimit) {
      w.push_back(fmt::format("The energy balance is off by {:.1f} % of the platens' work.",
                              100 * state_.records.back().balance_error()));
    }
    return w;
  }

  Schedule schedule_;
  double judged_from_;
  Sink<Dim> sink_;
  Checkpoint<Dim> state_;
  std::optional<mpm::Engine<Dim>> engine_;
  std::optional<Checkpoint<Dim>> last_good_;  // newer than what was saved
  long long good_step_ = 0;                   // of the newest state that was saved or kept
  double good_compaction_ = 0;
  double ramp_s_ = 0, transit_s_ = 0;
  int next_frame_ = 0;
};

}  // namespace

double Record::balance_error() const {
  const double terms =
      kinetic_mJ + elastic_mJ + plastic_mJ + friction_mJ + contact_mJ + filter_mJ + softening_mJ + damping_mJ;
  return platen_work_mJ != 0 ? (platen_work_mJ - terms) / platen_work_mJ : 0;
}

void set_energies(Record& record, const mpm::Energies& e) {
  record.kinetic_mJ = e.kinetic;
  record.elastic_mJ = e.elastic;
  record.plastic_mJ = e.plastic;
  record.friction_mJ = e.friction;
  record.contact_mJ = e.contact;
  record.filter_mJ = e.filter;
  record.softening_mJ = e.softening;
  record.damping_mJ = e.damping;
  record.platen_work_mJ = e.platen_work;
}

double judged_from(const Schedule& schedule) {
  for (const double compaction : schedule.compactions) {
    if (compaction > 0) return std::max(compaction, kJudgedFrom);
  }
  return kJudgedFrom;
}

template <int Dim>
Setup<Dim> setup(const Panel<Dim>& mat, const Resolution& resolution, mpm::Side sides, const mpm::Options& engine) {
  Setup<Dim> s;
  s.engine = engine;
  const int y = Dim - 1;
  s.grid.lo.setZero();
  s.grid.hi[0] = mat.length_mm;
  if (Dim == 3) s.grid.hi[1] = mat.depth_mm;
  s.grid.lo[y] = 0;
  s.grid.hi[y] = mat.initial_thickness_mm;
  s.grid.origin = s.grid.lo;
  const double height = thinnest_strand(mat) / resolution.cells_through_strand;
  s.grid.cell[y] = height;
  for (int a = 0; a < y; ++a) {  // whole cells between the rollers
    const double width = s.grid.hi[a] - s.grid.lo[a];
    s.grid.cell[a] = width / std::max(1.0, std::round(width / (height * resolution.cell_aspect)));
    s.grid.sides[a] = {sides, sides};
  }
  s.grid.sides[y] = {mpm::Side::kFree, mpm::Side::kFree};
  // Mats of plates are open, those of sections are not.
  if (resolution.follow_platens) s.grid.follow = Dim == 3 ? mpm::Follow::kStrands : mpm::Follow::kPlatens;
  return s;
}

template <int Dim>
Outcome<Dim> press(const Panel<Dim>& mat, const Schedule& schedule, const Setup<Dim>& setup, const Sink<Dim>& sink,
                   const std::optional<Checkpoint<Dim>>& resume) {
  return Press<Dim>(mat, schedule, setup, sink, resume).run();
}

template Setup<2> setup<2>(const Panel<2>&, const Resolution&, mpm::Side, const mpm::Options&);
template Setup<3> setup<3>(const Panel<3>&, const Resolution&, mpm::Side, const mpm::Options&);
template Outcome<2> press<2>(const Panel<2>&, const Schedule&, const Setup<2>&, const Sink<2>&,
                             const std::optional<Checkpoint<2>>&);
template Outcome<3> press<3>(const Panel<3>&, const Schedule&, const Setup<3>&, const Sink<3>&,
                             const std::optional<Checkpoint<3>>&);

}  // namespace strandlab::press
