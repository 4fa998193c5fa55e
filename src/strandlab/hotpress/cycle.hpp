// A whole press cycle through the thickness of a mat: the press closes, heat and steam go in, wood softens and is
// crushed, resin cures, the press opens. Units are SI as in transfer/properties.hpp; times count from first contact.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/hotpress/column.hpp"
#include "strandlab/hotpress/log.hpp"
#include "strandlab/hotpress/mechanics.hpp"
#include "strandlab/hotpress/schedule.hpp"
#include "strandlab/hotpress/softening.hpp"
#include "strandlab/transfer/cure.hpp"
#include "strandlab/transfer/solver.hpp"

namespace strandlab::hotpress {

// How the mat resists: as a column of its layers without gaps (column.hpp); not at all, its density the same everywhere
// at all times, so that the press is moved by position only; or strand by strand (strands.hpp).
enum class Mechanics { kColumn, kUniform, kStrands };
const char* name(Mechanics mechanics);  // "column", "uniform", "strands"

// Wood of one material, bottom to top.
struct MatLayer {
  double dry_mass = 0;  // kg/m^2
  wood::Material material;
  Carried resin = Carried::kOfItsLayer;
};
struct PressedMat {
  std::vector<MatLayer> layers;
  double thickness = 0;  // m, as formed, with its gaps
  double length = 1;     // m, of the section; counts where it is cut into several columns
};

struct Settings {
  Mechanics mechanics = Mechanics::kColumn;
  std::vector<Phase> schedule = parse_schedule(default_schedule());
  std::optional<Log> log;                                            // followed in place of the schedule
  std::vector<Point> platen_top{{0, 200}}, platen_bottom{{0, 200}};  // s, C; a log's own temperatures come first
  double bottom_lead = 0;  // s: the bottom platen touches the mat so long before it is closed upon
  double moisture_face = .08, moisture_core = .05;  // kg/kg
  double face_fraction = .25;                       // of the dry mass, on each side
  int cells = 40;                                   // through the thickness, of equal dry mass
  int columns = 1;                                  // of cells along the section, of equal width
  bool open_ends = false;  // of several columns: the section is the panel's whole width, the room at both its ends
  double step = .25;       // s, until 30 s; twice that until 90 s; then four times
  double fastest = 5e-3;   // m/s, of closing under pressure
  double contact = 2000, room = 15;  // W/(m^2 K), heat transfer from platens and to the room
  double bond_strength = .17e6;      // Pa, of a hot bond fully cured: half of the internal bond of EN 300; judgement
  transfer::Resin resin_face = transfer::resins()[0], resin_core = transfer::resins()[1];
  wood::RateEffect rate;
  Softening softening;
  transfer::Constants constants;
};

// The mat's dry mass and thicknesses.
MatSize size_of(const PressedMat& mat);

// One cell at one time.
struct CellReading {
  double depth;                 // m, of its middle below the top face
  double T, M, gas;             // C, kg/kg, Pa above the room's
  double density;               // kg/m^3, oven-dry mass
  double cure_face, cure_core;  // degree of cure that each resin has, or would have, there
  bool face;                    // its wood carries the face resin
  double cure() const { return face ? cure_face : cure_core; }
};

struct Instant {
  double time = 0;                           // s
  std::string phase;                         // "close", "hold", ...
  double thickness = 0;                      // m, of the mat
  double gap = 0;                            // m, between the platens; in the open press the mat's thickness
  double pressure = 0, stress = 0;           // Pa, of the platens and of the wood alone; not a number without mechanics
  double platen_top = 0, platen_bottom = 0;  // C
  double gas_mean = 0;                       // Pa
  double heat = 0, water_out = 0;            // J/m^2 and kg/m^2 since the start
  std::string mark;                          // "closed", "held", "opened": ends of these phases
  // Bottom to top: temperature, moisture, gas and cure in the middle column; where there are several, depth and density
  // are means over all.
  std::vector<CellReading> cells;
  std::vector<CellReading> section;  // where there are several columns: all their cells, left to right
  const std::vector<CellReading>& all() const { return section.empty() ? cells : section; }
};

struct Cycle {
  Settings settings;
  MatSize mat;
  std::vector<Instant> record;        // after every step
  std::vector<double> dry_mass;       // kg/m^2, by cell as Instant::all() lists them
  double length = 0;                  // m, of the section
  double log_start = 0;               // s, first contact as a log counts time
  double thickness_unloaded = 0;      // m, at the end, elastic strains gone
  transfer::Amounts worst_balance{};  // largest relative error of a step, and of all steps
  std::vector<std::string> warnings;
};

// Who watches a cycle. What it throws ends the cycle.
struct Watch {
  // After every step. state() is the whole state of the cycle, its mechanics included, to go on from.
  std::function<void(const Instant& now, const std::function<std::vector<double>()>& state)> step;
  std::function<void(const Instant& now)> marked;  // at the ends of closing, of the hold and of the cycle
};

// Presses the mat, as a column or of uniform density. Throws InputError for a schedule or settings that cannot be
// followed, RunError where the solution fails.
Cycle press_hot(const Settings& settings, const PressedMat& mat, const Watch& watch = {});

// How long the cycle takes by its schedule or log, s. Closing under pressure may end before its time; closing at a
// given speed, for which a mat is needed, counts for nothing.
double duration(const Settings& settings);

// The same with the mat's mechanics of one's own, from the start or from a state that a watch was given.
Cycle press_hot(const Settings& settings, const PressedMat& mat, MatMechanics& mechanics, const Watch& watch,
                const std::vector<double>& resume = {});

}  // namespace strandlab::hotpress
