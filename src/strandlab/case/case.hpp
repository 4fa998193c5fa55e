// A case: everything a user can decide about a panel, from the mat to the virtual tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/case/hotpress.hpp"
#include "strandlab/mat/form.hpp"
#include "strandlab/mat/plate_layup.hpp"
#include "strandlab/mpm/engine.hpp"
#include "strandlab/panel/panel.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::cases {

// [kinds.NAME]: a kind of strand as the case names it.
struct KindSettings {
  std::string name;
  std::string material = "poplar";  // built in, or one of [materials]
  double angle_deg = 0;
  mat::StrandStatistics statistics;               // mm
  mat::SizeStatistics sizes = {};                 // of whole strands, 3D
  double angle_spread_deg = 0, angle_kappa = 0;   // each strand's own angle, angles()
  std::optional<double> angle_sd_deg = {};        // none: 0; in 3D 25 where the two others are 0
  double thickness_mm = 0;                        // 0: layer_thickness_mm of the case
  double yield_factor = 1, stiffness_factor = 1;  // softening in the press, StrandKind
  wood::Law law = wood::Law::kCrushing;
};

// [materials.NAME]: a user's material, a built-in one with some constants changed.
struct MaterialSettings {
  std::string base = "poplar";
  std::string species;  // elastic constants that are not given follow from E_L by its ratios; empty: from the base
  wood::Material material;
};

// States at which the panel is kept, by one of three measures; the lists of the other two are empty.
struct KeptStates {
  std::vector<double> compactions;                          // increasing, < 1
  std::vector<double> densities_kg_m3{400, 480, 560, 640};  // increasing
  std::vector<double> thicknesses_mm;                       // decreasing
};

// Where a case says what only its use can judge, as messages open: "panel.toml:12: mat.file = \"x.json\"". Empty for
// a case that was not read.
struct CasePlaces {
  std::string rows, mat_file, bondline_file, bondline_group, states;
};

// Default of grid.cell_aspect in 3D: up to three times its height a cell's length shortens the time step.
inline constexpr double kPlateCellAspect = 4;
// Whether the rows of a plate are all of it, or its half from the middle plane up, which is pressed alone; then the
// kept panels are that half and its mirror image, or the half.
enum class PressedHalf { kWhole, kMirrored, kKept };

inline constexpr int kPointsPerCell = 2;  // material points per cell and axis, as press::Resolution has it

// The defaults are the main job: an OSB mat of 20 rows pressed to 640 kg/m3.
struct Case {
  Case();

  std::string name = "case";
  double length_mm = 100;
  double layer_thickness_mm = 0.8;
  std::vector<std::string> rows{"surface*5", "core*10", "surface*5"};  // bottom to top, "kind" or "kind*count"
  mat::PlateLayup plate;                                               // 3D: forming and width; a section has none
  std::string mat_file;                                                // absolute path; empty: random forming
  wood::OffAxis off_axis = wood::OffAxis::kExact;
  std::vector<KindSettings> kinds;
  std::vector<MaterialSettings> materials;
  std::vector<ResinSettings> resins;
  HotPressSettings hotpress;
  KeptStates states;
  press::Schedule schedule;  // its compactions are those of settle_states()
  PressedHalf half = PressedHalf::kWhole;
  mpm::Side sides = mpm::Side::kRoller;
  press::Resolution grid;
  mpm::Options mpm;  // its thread count is set from `threads` when a run starts
  vtest::Options test;
  std::string bondline_file, bondline_group;  // absolute path of a `strandlab bondline` result, and its group; or empty
  std::vector<std::string> bondline_groups;   // several groups in place of one
  int threads = 0;                            // 0: all cores
  std::uint64_t seed = 1;
  double checkpoint_interval_s = 30;
  bool pictures = true;
  CasePlaces places;
};

// Reads a case file and applies overrides ("key.path=value", TOML values or bare words). Throws InputError with file,
// line, key, what was given and what is allowed for anything a run could not use; relative mat.file and
// glue.from_bondline count from the case file. With glue.from_bondline the glue compliance is that of glue.group there.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
// The same, its glue lines as the case's numbers have them: the result of glue.from_bondline is not read. For a case
// that was written out in full.
Case read_written_case(const std::filesystem::path& file);
// The same from the text of a case; `source` stands for the file in messages.
Case case_from_text(const std::string& text, const std::string& source, const std::vector<std::string>& overrides = {});
// The case with some keys changed, "key.path=value" each, checked together as a case that is read; `source` opens
// messages. Throws as above.
Case changed(const Case& c, const std::vector<std::string>& assignments, const std::string& source);

// Ready cases of `strandlab init`: "osb", "osl", "plywood", "lvl", ... Throws InputError for another name.
const std::vector<std::string>& ready_cases();
Case ready_case(const std::string& name);
// What it is: lines of text, the first a title.
std::string ready_case_title(const std::string& name);

// A case with mat.width_mm: its keys are those of a plate, in three dimensions. What else this header has for mats and
// panels is for sections; plate.hpp has that of plates.
inline bool is_plate(const Case& c) {
  return c.plate.width_mm > 0;
}
// How the angles of the strands of a kind are distributed.
mat::AngleDistribution angles(const Case& c, const KindSettings& kind);
// The kind of each row, bottom to top. Throws InputError for a row that names no kind.
std::vector<const KindSettings*> row_kinds(const Case& c);

// Lengths of a kind's strands as a section shows them (mat/cut.hpp).
mat::StrandStatistics in_section(const Case& c, const KindSettings& kind);

// A material by its name, of the case or built in. Throws InputError, with the nearest name, where there is none.
wood::Material find_material(const Case& c, const std::string& name);

// Rows of the layup with the statistics, thickness and angles of their kinds. Throws InputError for a row that names no
// kind.
mat::Layup layup(const Case& c);
// The kinds of strands; those that are pressed hot without the factors that stand in for heat.
std::vector<StrandKind> strand_kinds(const Case& c);
// The same and a kind for each of the case's materials: a strand of a mat file may name any of them, also one that no
// kind uses.
std::vector<StrandKind> kinds_and_materials(const Case& c);
// The mat of a case: read from its mat file, else formed with its seed. Throws InputError for a bad mat file, for rows
// that would make a panel beyond the memory that is free, and for a plate's (plate.hpp).
mat::Mat make_mat(const Case& c);
// Its kinds of strand, in their order.
std::vector<std::string> kind_names(const Case& c);
// Its weight and what it is made of.
Weight weigh(const Case& c, const mat::Mat& mat);
// What a glue line of the case is called: the group of the bond-line result that gave its compliance, else
// glue::name_of_bond().
std::string name_of_glue(const Case& c, double compliance_t_mm_per_MPa);
// Density of its panel of area at a compaction, voids included, kg/m^3.
double density_kg_m3(const Case& c, const mat::Mat& mat, double compaction);
// Makes c.schedule.compactions those at which the mat has the case's states: as given, or to 1e-4 those of its
// densities or thicknesses; for a mat that is pressed hot the one at which its schedule has closed. Throws InputError
// for a state that the mat is beyond as formed, and for two states that round to one compaction.
void settle_states(Case& c, const mat::Mat& mat);
// The same of a mat that is pressed cold, of that density (kg/m^3) and thickness as formed.
void settle_states(Case& c, double formed_kg_m3, double thickness_mm);
// One line for each of the case's materials whose constants follow from a species' ratios: which, from what, and where
// the ratios are from; or of which only E_L was changed: which constants did not follow it.
std::vector<std::string> derived_constants(const Case& c);
// The panel before pressing of a case whose states are settled, with the material points of the case's grid. Throws
// InputError when it does not fit into the memory that is free.
Panel<2> make_panel(const Case& c, const mat::Mat& mat);

}  // namespace strandlab::cases
