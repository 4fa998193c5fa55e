#include "strandlab/run/press_hot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "strandlab/case/hotpress.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/hotpress/cycle.hpp"
#include "strandlab/hotpress/strands.hpp"

namespace strandlab::run {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kClosing = .6;  // of the frames and of the progress; the rest is what follows

double elapsed_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

hotpress::Settings settings_of(const cases::Case& c) {
  auto settings = cases::hotpress_settings(c);
  settings.mechanics = hotpress::Mechanics::kStrands;
  return settings;
}

hotpress::StrandPress strand_press(const Formed& formed, const hotpress::Settings& settings, Observer& observer) {
  const auto& c = formed.c;
  hotpress::StrandPress how;
  how.setup = press::setup(formed.panel, c.grid, c.sides, engine_options(c));
  how.speed_m_s = c.schedule.speed_m_s;
  how.symmetric = c.schedule.symmetric;
  how.rate = settings.rate;
  how.softening = settings.softening;
  how.cells = settings.cells;
  how.columns = settings.columns;
  for (const auto& strand : formed.panel.strands) how.resin.push_back(cases::carried_resin(c, strand.kind));
  how.curing = c.test.curing;
  how.before_step = [&observer] { stop_if_cancelled(observer); };
  return how;
}

// When the cycle ends, s.
double end_of(const hotpress::Settings& settings) {
  double end = 0;
  for (const auto& phase : settings.schedule) end = phase.until ? *phase.until : end + phase.seconds.value_or(0);
  return settings.log ? 0 : end;
}

class HotPress {
 public:
  HotPress(const Formed& formed, const press::Sink<2>& keep, const std::optional<press::Checkpoint<2>>& resume,
           Observer& observer)
      : formed_(formed),
        keep_(keep),
        observer_(observer),
        settings_(settings_of(formed.c)),
        strands_(mechanics(resume)) {
    exchanges_ = strands_.records().size();
    if (!resume) return;
    if (resume->cycle.size() < kOwn) throw InputError("the checkpoint of a hot press has no state of its cycle");
    state_ = resume->cycle;
    Numbers own(std::vector<double>(state_.end() - kOwn, state_.end()));
    state_.resize(state_.size() - kOwn);
    visit(own);
  }

  PressOutcome run() {
    hotpress::Watch watch;
    watch.step = [this](const hotpress::Instant& now, const auto& state) { after_step(now, state); };
    watch.marked = [this](const hotpress::Instant& now) { marked(now); };
    try {
      auto cycle = hotpress::press_hot(settings_, mat(), strands_, watch, state_);
      return outcome(std::move(cycle));
    } catch (...) {
      if (keep_.checkpoint && last_) keep_.checkpoint(*last_);
      throw;
    }
  }

 private:
  static constexpr int kOwn = 4;
  void visit(Numbers& numbers) {
    numbers(next_frame_);
    numbers(closed_at_);
    numbers(kept_);
    numbers(closed_);
  }

  hotpress::StrandMechanics mechanics(const std::optional<press::Checkpoint<2>>& resume) const {
    const auto how = strand_press(formed_, settings_, observer_);
    return resume ? hotpress::StrandMechanics(*resume, how) : hotpress::StrandMechanics(formed_.panel, how);
  }
  hotpress::PressedMat mat() const { return cases::pressed_mat(formed_.c, formed_.mat); }

  std::vector<hotpress::StrandMechanics::Reading> readings(const hotpress::Instant& now) const {
    const auto of = [](const transfer::Resin& resin, double cure) {
      return hotpress::StrandMechanics::Resin{cure, transfer::bond_strength(resin, cure)};
    };
    std::vector<hotpress::StrandMechanics::Reading> list;
    for (const auto& cell : now.all()) {
      list.push_back({cell.T, cell.M, 1e-3 * cell.gas, of(settings_.resin_face, cell.cure_face),
                      of(settings_.resin_core, cell.cure_core), cell.face});
    }
    return list;
  }
  Panel<2> panel_at(const hotpress::Instant& now) const { return strands_.panel(readings(now)); }

  double fraction(const hotpress::Instant& now) const {
    const double to = formed_.c.schedule.compactions.back();
    const double compaction = 1 - 1e3 * now.thickness / formed_.panel.initial_thickness_mm;
    if (!closed_) return kClosing * std::clamp(compaction / to, 0., 1.);
    const double left = end_of(settings_) - closed_at_;
    return kClosing + (1 - kClosing) * (left > 0 ? std::clamp((now.time - closed_at_) / left, 0., 1.) : 1);
  }

  void after_step(const hotpress::Instant& now, const std::function<std::vector<double>()>& state) {
    if (strands_.records().size() > exchanges_) strands_.meet(readings(now));
    exchanges_ = strands_.records().size();
    const double done = fraction(now);
    if (keep_.frame && next_frame_ <= keep_.frames && done >= static_cast<double>(next_frame_) / keep_.frames) {
      const auto panel = panel_at(now);
      for (; next_frame_ <= keep_.frames && done >= static_cast<double>(next_frame_) / keep_.frames; ++next_frame_)
        keep_.frame(panel, next_frame_);
    }
    observer_.progress({"press", done, line(now)});
    if (!keep_.checkpoint) return;
    last_ = checkpoint(state());
    if (elapsed_since(saved_) < keep_.checkpoint_interval_s) return;
    keep_.checkpoint(*last_);
    saved_ = Clock::now();
  }

  std::string line(const hotpress::Instant& now) const {
    const auto& core = now.cells[now.cells.size() / 2];
    return fmt::format("{:.0f} s {}  {:.2f} mm  {:.2f} MPa  core {:.0f} C", now.time, now.phase, 1e3 * now.gap,
                       1e-6 * now.pressure, core.T);
  }

  press::Checkpoint<2> checkpoint(std::vector<double> state) {
    auto checkpoint = strands_.checkpoint();
    Numbers own;
    visit(own);
    state.insert(state.end(), own.list().begin(), own.list().end());
    checkpoint.cycle = std::move(state);
    checkpoint.snapshots_done = kept_ ? 1 : 0;
    return checkpoint;
  }

  // The panel as held is that of the last hold, or of the closing where there is none.
  void marked(const hotpress::Instant& now) {
    if (now.mark == "closed") {
      closed_ = true;
      closed_at_ = now.time;
    }
    const bool opened = now.mark == "opened";
    if ((formed_.c.hotpress.kept == "opened") != opened) return;
    kept_ = true;
    if (keep_.snapshot) keep_.snapshot(panel_at(now), 0);
  }

  PressOutcome outcome(hotpress::Cycle cycle) {
    if (keep_.frame && next_frame_ <= keep_.frames) {  // a cycle that ends early
      const auto panel = panel_at(cycle.record.back());
      for (; next_frame_ <= keep_.frames; ++next_frame_) keep_.frame(panel, next_frame_);
    }
    if (keep_.checkpoint && last_) {
      auto last = checkpoint(std::vector<double>(last_->cycle.begin(), last_->cycle.end() - kOwn));
      keep_.checkpoint(last);
    }
    PressOutcome outcome;
    outcome.records = strands_.records();
    outcome.steps = strands_.engine().state().step;
    outcome.wall_s = elapsed_since(start_);
    outcome.particles = strands_.engine().particles();
    outcome.particle_steps_per_s =
        outcome.wall_s > 0 ? static_cast<double>(strands_.engine().particle_steps()) / outcome.wall_s : 0;
    outcome.timing = strands_.engine().timing();
    outcome.bytes = strands_.engine().bytes();
    outcome.warnings = strands_.warnings();
    outcome.cycle = hotpress::in_band(std::move(cycle), mat());
    const auto add = [&](const std::vector<std::string>& more) {
      outcome.warnings.insert(outcome.warnings.end(), more.begin(), more.end());
    };
    add(outcome.cycle->cycle.warnings);
    add(hotpress::remarks(outcome.cycle->cycle, outcome.cycle->answers));
    for (const auto& warning : outcome.warnings) observer_.warn(warning);
    return outcome;
  }

  const Formed& formed_;
  press::Sink<2> keep_;
  Observer& observer_;
  hotpress::Settings settings_;
  hotpress::StrandMechanics strands_;
  std::vector<double> state_;  // to go on from
  std::optional<press::Checkpoint<2>> last_;

  std::size_t exchanges_ = 0;
  int next_frame_ = 0;
  double closed_at_ = 0;
  bool kept_ = false, closed_ = false;
  Clock::time_point start_ = Clock::now(), saved_ = Clock::now();
};

}  // namespace

PressOutcome press_hot(const Formed& formed, const press::Sink<2>& keep,
                       const std::optional<press::Checkpoint<2>>& resume, Observer& observer) {
  for (const auto& kind : formed.c.kinds) {
    if (kind.law == wood::Law::kHill)
      observer.warn(
          fmt::format("kinds.{} has law = \"hill\", under which no density profile emerges by yielding; use "
                      "law = \"crushing\" in a hot press",
                      kind.name));
  }
  return HotPress(formed, keep, resume, observer).run();
}

}  // namespace strandlab::run
