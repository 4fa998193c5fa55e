// What the press is told to do: phases one after the other, each until its target or time.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace strandlab::hotpress {

// The thickness a phase goes to, as it is stated.
struct Target {
  enum class Kind { kThickness, kDensity, kCompaction };
  Kind kind = Kind::kThickness;
  double value = 0;  // m; kg/m^3 of oven-dry mass; part of the mat's thickness as formed
};

struct Phase {
  enum class Kind { kClose, kHold, kVent, kOpen };
  Kind kind = Kind::kHold;
  std::string text;                   // as given
  std::optional<double> seconds;      // how long; closing under pressure: at most
  std::optional<double> from, until;  // s since first contact
  std::optional<double> speed;        // m/s, of closing by position
  std::optional<double> pressure;     // Pa: the platens' pressure is held, else their position
  std::optional<Target> target;
};

// A phase in words: close, hold, vent or open, then numbers with units in any order; words between them are for the
// reader. A time in s, after `until` or `from` since first contact; a thickness in mm, a density in kg/m3 (oven-dry) or
// a compaction in %; a pressure in MPa; a speed in mm/s.
//   close to 12 mm in 25 s           close to 640 kg/m3 at 0.5 mm/s     close at 4 MPa to 12 mm within 60 s
//   hold 215 s                       hold until 240 s at 3 MPa          vent 10 s          open 60 s
// Throws InputError saying what is wrong with it.
Phase parse_phase(const std::string& text);

// All phases, checked: closing comes first and opening last, each has what it needs, none begins before the one before
// it has ended. Throws InputError that names the phase.
std::vector<Phase> parse_schedule(const std::vector<std::string>& texts);

// Close to 640 kg/m3 (oven-dry) in 25 s, hold until 240 s, vent 10 s, open 60 s.
std::vector<std::string> default_schedule();

// What a target means for a mat.
struct MatSize {
  double dry_mass = 0;         // kg/m^2
  double thickness = 0;        // m, as formed, gaps and all
  double solid_thickness = 0;  // m, of its wood alone as formed: where a mat without gaps is first touched
  double full_thickness = 0;   // m, of its cell walls alone
};
double thickness_of(const Target& target, const MatSize& mat);  // m

// Throws InputError for targets that cannot be reached: at or above the thickness before, or with no pores left.
void check_targets(const std::vector<Phase>& phases, const MatSize& mat);

// A quantity against time (or another one): straight between points, constant beyond them.
struct Point {
  double at, value;
};
double interpolated(const std::vector<Point>& points, double at);
// "0 200, 60 190": pairs of numbers, the first of each increasing; a colon between them makes no difference. Throws
// InputError that shows what is allowed.
std::vector<Point> parse_points(const std::string& text);

}  // namespace strandlab::hotpress
