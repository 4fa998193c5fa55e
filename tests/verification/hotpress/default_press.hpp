// The press cycle of the check values: poplar of 350 kg/m^3 without gaps, 7.68 kg/m^2 dry, pressed to 12 mm (640
// kg/m^3) in 25 s, moisture .08 in the outer quarters and .05 in the core, platens of 200 C, panel .6 m wide.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "strandlab/hotpress/cycle.hpp"

namespace strandlab::hotpress::test {

inline PressedMat poplar_mat(double dry_mass = 7.68) {
  return {{{dry_mass, wood::library().front()}}, dry_mass / 350};
}

inline Settings settings_of(Mechanics mechanics, int cells_of_half_mat, double step,
                            const std::vector<std::string>& schedule) {
  Settings s;
  s.mechanics = mechanics;
  s.cells = 2 * cells_of_half_mat;
  s.step = step;
  s.schedule = parse_schedule(schedule);
  return s;
}

inline const Instant& at(const Cycle& cycle, double time) {
  return *std::find_if(cycle.record.begin(), cycle.record.end(),
                       [time](const Instant& i) { return i.time > time - 1e-6; });
}

// The cell next to the mid-plane, and the outermost one.
inline const CellReading& core(const Instant& i) {
  return i.cells[i.cells.size() / 2];
}
inline const CellReading& face(const Instant& i) {
  return i.cells.back();
}

// When a quantity first reaches a value, straight between steps.
template <class Of>
double time_of(const Cycle& cycle, double value, Of of) {
  for (std::size_t i = 1; i < cycle.record.size(); ++i) {
    const double before = of(cycle.record[i - 1]), after = of(cycle.record[i]);
    if (before >= value || after < value) continue;
    const double t0 = cycle.record[i - 1].time, t1 = cycle.record[i].time;
    return t0 + (t1 - t0) * (value - before) / (after - before);
  }
  return NAN;
}

inline double core_100(const Cycle& cycle) {
  return time_of(cycle, 100, [](const Instant& i) { return core(i).T; });
}

// Of one resin, were it in all cells.
inline double least_cure(const Instant& i, bool pf) {
  double least = 1;
  for (const auto& c : i.cells) least = std::min(least, pf ? c.cure_face : c.cure_core);
  return least;
}

struct Peak {
  double value = 0, time = 0;
};
template <class Of>
Peak peak_of(const Cycle& cycle, Of of) {
  Peak peak;
  for (const auto& i : cycle.record)
    if (of(i) > peak.value) peak = {of(i), i.time};
  return peak;
}
inline Peak core_gas(const Cycle& cycle) {
  return peak_of(cycle, [](const Instant& i) { return 1e-3 * core(i).gas; });
}

inline const CellReading& densest(const Instant& i) {
  return *std::max_element(i.cells.begin(), i.cells.end(),
                           [](const auto& a, const auto& b) { return a.density < b.density; });
}

}  // namespace strandlab::hotpress::test
