// What a press cycle means to who runs the press: how long to press, how hot, how dense, and whether it may blow.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/hotpress/cycle.hpp"

namespace strandlab::hotpress {

inline constexpr double kCured = .9;        // degree of cure that counts as cured; judgement
inline constexpr double kRiskyGas = 100e3;  // Pa above the room's: MDF delaminated above it (Cai et al.)

// A resin in the layers that carry it.
struct ResinAnswer {
  std::string resin, layers;           // "pf", "face"
  std::optional<double> cured_at;      // s: least cured of these layers reaches kCured; nothing: not in this cycle
  std::optional<double> all_cured_at;  // s: the same were the resin in all layers
  double least_cure = 0;               // of these layers when the press opens
};

struct DensityAnswer {
  double mean = 0, peak = 0, peak_depth = 0, skin = 0, core = 0;  // kg/m^3, depth in m below the nearer face
};

// Values the cycle did not reach are absent. Of a section of several columns those of the middle one, but for densities
// (means) and the gas that may blow the panel (the worst of all).
struct Answers {
  std::optional<double> core_100C;                                    // s
  std::optional<double> plateau_start, plateau_length, plateau_mean;  // s, s, C: core rises by less than .1 K/s
  double gas_peak = 0, gas_peak_time = 0;                             // Pa, s: in the core
  double gas_at_opening = 0;                                          // Pa, the largest of all layers
  double pressure_peak = 0, pressure_peak_time = 0, stress_peak = 0;  // Pa, s; not numbers without mechanics
  std::vector<ResinAnswer> resins;                                    // face, core: where a layer carries it
  std::optional<double> press_time;                                   // s: both are cured
  double opening = 0;                                                 // s: when the press begins to open
  double thickness_closed = 0, thickness_opened = 0;                  // m
  std::optional<double> press_factor;                                 // s/m, press_time over the closed thickness
  DensityAnswer density;                                              // at the end of the hold
  double M_face = 0, M_core = 0, M_mean = 0;                          // when the press begins to open
  double heat = 0, water_out = 0;                                     // J/m^2, kg/m^2 when the press begins to open
  double precured = 0;  // part of the face layers whose resin gels before the press has closed
  // Gas pressure over the strength of the bond that holds it, the largest of all layers from when the press begins to
  // open. Relative: compare schedules by it.
  double blow = 0;
  double springback() const { return thickness_opened / thickness_closed - 1; }
};

// Throws std::invalid_argument for a cycle without a step.
Answers answers(const Cycle& cycle);

// A cycle as settled, and its answers with a mat three times and a third as permeable: gas pressure is known no better.
struct Band {
  Cycle cycle;
  Answers answers, permeable, tight;
};
// Presses three times. Throws as press_hot().
// `told`, where given, is called after every step with the number of the cycle, from 0 on, and its instant; what it
// throws ends the work.
inline constexpr int kCyclesOfBand = 3;  // permeability as set, three times it, a third of it
using Told = std::function<void(int cycle, const Instant& now)>;
Band press_in_band(const Settings& settings, const PressedMat& mat, const Told& told = nullptr);
// The band of a cycle that is there: heat and moisture go once more through the thicknesses it recorded.
Band in_band(Cycle cycle, const PressedMat& mat);

// "low" below .5, "watch" to 1, "blow likely" above.
const char* risk(double blow);

// What a user should be told, beside the cycle's own warnings.
std::vector<std::string> remarks(const Cycle& cycle, const Answers& answers);

}  // namespace strandlab::hotpress
