// Presses the mat of a case hot, strand by strand, and prints what it took: steps of the engine, its time, where they
// went, and what came out. Usage: hot_strands CASE [KEY=VALUE...]
#include <fmt/format.h>

#include <chrono>

#include "strandlab/case/case.hpp"
#include "strandlab/case/hotpress.hpp"
#include "strandlab/hotpress/answers.hpp"
#include "strandlab/hotpress/strands.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/run/form.hpp"

using namespace strandlab;

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const auto c = cases::read_case(argv[1], std::vector<std::string>(argv + 2, argv + argc));
  const auto formed = run::form(c);
  auto settings = cases::hotpress_settings(c);
  settings.mechanics = hotpress::Mechanics::kStrands;
  hotpress::StrandPress how;
  auto options = c.mpm;
  options.threads = 2;
  how.setup = press::setup(formed.panel, c.grid, c.sides, options);
  how.speed_m_s = c.schedule.speed_m_s;
  how.rate = settings.rate;
  how.softening = settings.softening;
  how.cells = settings.cells;
  hotpress::StrandMechanics strands(formed.panel, how);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::string last;
  hotpress::Watch watch;
  std::size_t exchanges = 0;
  watch.step = [&](const hotpress::Instant& now, const auto&) {
    if (strands.records().size() == exchanges) return;
    exchanges = strands.records().size();
    const auto& r = strands.records().back();
    const auto& core = now.cells[now.cells.size() / 2];
    fmt::print(
        "{:7.2f} s {:6} h {:7.4f} P {:6.3f} MPa  T {:5.1f} M {:5.2f} gas {:5.1f}  steps {:7} t {:6.3f} ms  kin {:.1e} "
        "imb {:5.1f} % bal {:6.2f} %  wall {:5.1f}\n",
        now.time, now.phase, 1e3 * now.thickness, 1e-6 * now.pressure, core.T, 100 * core.M, 1e-3 * core.gas,
        strands.engine().state().step, r.time_ms, r.kinetic_mJ / (r.internal_mJ() + 1e-12),
        100 * (r.force_top_N - r.force_bottom_N) / (.5 * (r.force_top_N + r.force_bottom_N) + 1e-9),
        100 * r.balance_error(), std::chrono::duration<double>(Clock::now() - start).count());
    std::fflush(stdout);
  };
  const auto cycle = hotpress::press_hot(settings, cases::pressed_mat(c, formed.mat), strands, watch);
  const auto a = hotpress::answers(cycle);
  const auto panel = strands.panel(std::vector<hotpress::StrandMechanics::Reading>(cycle.record.back().cells.size()));
  const auto profile = profile::density_profile(panel, 48);
  for (const double d : profile.density_kg_m3) fmt::print("{:.0f} ", d);
  const auto s = profile::summarise(profile);
  fmt::print(
      "\npeak pressure {:.3f} MPa; core 100 C at {:.1f} s; gas {:.1f} kPa; peak/mean {:.3f} core/mean {:.3f} peak at "
      "{:.2f} mm; "
      "springback {:.2f} %; particles {} steps {} ms {:.3f}\n",
      1e-6 * a.pressure_peak, a.core_100C.value_or(-1), 1e-3 * a.gas_peak, s.peak / s.mean, s.core / s.mean,
      s.peak_depth_mm, 100 * a.springback(), strands.engine().particles(), strands.engine().state().step,
      strands.records().back().time_ms);
  for (const auto& w : strands.warnings()) fmt::print("warning: {}\n", w);
}
