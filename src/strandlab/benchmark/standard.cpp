#include "strandlab/benchmark/standard.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "strandlab/core/members.hpp"
#include "strandlab/mat/form.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::benchmark {
namespace {

constexpr int kSteps = 120;                      // per measurement
constexpr double kFastPress = 64;                // m/s, to reach the mid-press state
constexpr double kSpeed = 16;                    // m/s, of the main job
const press::Resolution kUnitCells{3, 1, true};  // 1:1 cells, as the published figures of other codes

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // given in KiB
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

std::vector<StrandKind> kinds(bool yields) {
  StrandKind surface{"surface", wood::library()[0], 0}, core{"core", wood::library()[0], 90};
  for (auto* kind : {&surface, &core}) {
    if (yields) continue;
    kind->material.hill.Y_R = kind->material.hill.Y_T = kind->material.hill.S_RT = 1e6;  // MPa: never reached
  }
  return {surface, core};
}

mat::Mat main_job_mat() {
  const mat::StrandStatistics surface{150, 20, 15, 4.95}, core{25, 3, 10, 1};
  mat::Layup layup;
  for (int row = 0; row < 20; ++row) {
    if (row < 5 || row >= 15)
      layup.rows.push_back({"surface", surface});
    else
      layup.rows.push_back({"core", core});
  }
  return mat::form(layup, 1);
}

// One strand as thick as the whole mat: the same panel without contact.
mat::Mat one_body_mat(const mat::Mat& mat) {
  mat::Mat one;
  one.length_mm = mat.length_mm;
  one.layer_thickness_mm = mat.layer_thickness_mm * static_cast<double>(mat.layers.size());
  one.layers.push_back({"surface", {{0, mat.length_mm, {}, {}, {}}}, {}});
  return one;
}

template <int Dim>
mpm::Engine<Dim> engine_for(const Panel<Dim>& panel, const press::Setup<Dim>& setup, double speed) {
  std::vector<mpm::Body<Dim>> bodies;
  for (const auto& strand : panel.strands) bodies.push_back(mpm::body_of(strand));
  mpm::Engine<Dim> engine(bodies, setup.grid, setup.engine);
  engine.set_platens({panel.bottom_mm, 0}, {panel.top_mm, -speed * 1000});
  return engine;
}

// ns per particle-step over kSteps steps, median of `repeats`.
template <int Dim>
double measure(mpm::Engine<Dim>& engine, int repeats) {
  for (int i = 0; i < 20; ++i) engine.step();
  std::vector<double> ns;
  for (int r = 0; r < repeats; ++r) {
    const double start = now();
    for (int i = 0; i < kSteps; ++i) engine.step();
    ns.push_back(1e9 * (now() - start) / (static_cast<double>(engine.particles()) * kSteps));
  }
  return median(ns);
}

// A timed run of its own: the clock reads cost a few ns per particle-step themselves.
template <int Dim>
mpm::Phases phases(const Panel<Dim>& panel, press::Setup<Dim> setup, mpm::Timing& timing) {
  setup.engine.timed = true;
  auto engine = engine_for(panel, setup, kSpeed);
  for (int i = 0; i < kSteps; ++i) engine.step();
  timing = engine.timing();
  const double scale = 1e9 / static_cast<double>(engine.particle_steps());
  mpm::Phases ns = timing.phases;
  for_each_member(ns, [scale](double& phase) { phase *= scale; });
  return ns;
}

Panel<2> panel_of(const mat::Mat& mat, bool yields, int points_through) {
  return make_panel(mat, kinds(yields), 0.8 / 6, points_through);
}

// The mat at kMidPress compaction, pressed fast: a state to measure from, not a result.
Panel<2> mid_press(const mat::Mat& mat, int threads) {
  const auto panel = panel_of(mat, true, 6);
  mpm::Options options;
  options.threads = threads;
  const auto setup = press::setup<2>(panel, kUnitCells, mpm::Side::kRoller, options);
  press::Schedule schedule;
  schedule.speed_m_s = kFastPress;
  schedule.compactions = {kMidPress};
  Panel<2> pressed;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& state, int) { pressed = state; };
  press::press<2>(panel, schedule, setup, sink);
  return pressed;
}

// Four crossed strands of 12 x 12 mm, eight particles per cell.
Panel<3> crossed_strands() {
  Panel<3> panel;
  constexpr double kSide = 12, kThickness = 0.8, kSpacing = kThickness / 6;
  panel.length_mm = panel.depth_mm = kSide;
  panel.initial_thickness_mm = panel.top_mm = 4 * kThickness;
  const auto points = static_cast<int>(std::lround(kSide / kSpacing));
  const Lattice<3> lattice{{points, points, 6}, Vec<3>::Constant(kSpacing)};
  for (int row = 0; row < 4; ++row) {
    const double angle = row % 2 ? 90 : 0;
    auto s =
        formed_strand<3>(lattice, {{0, 0, row * kThickness}}, wood::in_strand_axes(kinds(false)[0].material, angle));
    s.kind = "surface";
    s.row = row;
    s.angle_deg = angle;
    panel.strands.push_back(std::move(s));
  }
  return panel;
}

double static_solve(const Panel<2>& panel, int elements) {
  vtest::Options options;
  options.elements_through_strand = elements;
  options.compliance_t_mm_per_MPa = {0.0021, 0.0105, 0.0163};
  const auto r = vtest::measure(panel, options);
  return (r.assemble_s + r.factor_s + r.solve_s) / static_cast<double>(options.compliance_t_mm_per_MPa.size());
}

}  // namespace

std::vector<int> thread_counts(int most) {
  if (most == 0) most = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> counts{1};
  for (int n = 2; n < most; n *= 2) counts.push_back(n);
  if (most > 1) counts.push_back(most);
  return counts;
}

std::vector<Result> run(const std::vector<int>& threads, int repeats,
                        const std::function<void(const std::string&)>& say) {
  const auto mat = main_job_mat();
  const auto elastic = panel_of(mat, false, 6);
  say("pressing the mat to the middle of the press");
  const auto pressed = mid_press(mat, *std::max_element(threads.begin(), threads.end()));
  const auto one_body = panel_of(one_body_mat(mat), false, 120);
  const auto crossed = crossed_strands();
  say("static solves");
  const double coarse = static_solve(elastic, 3), fine = static_solve(elastic, 6);
  std::vector<Result> results;
  for (int n : threads) {
    say(fmt::format("{} thread{}", n, n > 1 ? "s" : ""));
    Result r;
    r.threads = n;
    r.machine = machine_limits(n);
    mpm::Options options;
    options.threads = n;
    const auto setup = press::setup<2>(elastic, kUnitCells, mpm::Side::kRoller, options);
    auto engine = engine_for(elastic, setup, kSpeed);
    r.elastic_ns_per_particle_step = measure(engine, repeats);
    r.bytes_per_particle = static_cast<double>(engine.bytes()) / static_cast<double>(engine.particles());
    auto pressing = engine_for(pressed, setup, kSpeed);
    r.press_ns_per_particle_step = measure(pressing, repeats);
    auto single = engine_for(one_body, setup, kSpeed);
    r.one_body_ns_per_particle_step = measure(single, repeats);
    auto setup3 = press::setup<3>(crossed, kUnitCells, mpm::Side::kRoller, options);
    auto engine3 = engine_for(crossed, setup3, kSpeed);
    r.elastic_3d_ns_per_particle_step = measure(engine3, std::min(repeats, 3));
    mpm::Timing timing;
    r.elastic_phases = phases(elastic, setup, timing);
    r.press_phases = phases(pressed, setup, timing);
    r.plastic_fraction = timing.plastic_fraction;
    r.fields_per_node = timing.fields_per_node;
    r.static_solve_s = coarse;
    r.static_solve_fine_s = fine;
    r.peak_memory_mb = peak_memory_mb();
    results.push_back(r);
  }
  return results;
}

}  // namespace strandlab::benchmark
