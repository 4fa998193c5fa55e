// [hotpress] and [resins.NAME] of a case: the hot press as a user states it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "strandlab/hotpress/log.hpp"
#include "strandlab/hotpress/softening.hpp"

namespace strandlab::mat {
struct Mat;
}
namespace strandlab::hotpress {
struct Settings;
struct PressedMat;
enum class Carried;
}  // namespace strandlab::hotpress

namespace strandlab::cases {

struct Case;

// [resins.NAME]: a resin with constants of the user's own.
struct ResinSettings {
  std::string name;
  double E_kJ_mol = 0, A_1_s = 0;  // 0: not given
  double n = 1, gel = .5;
};

struct HotPressSettings {
  bool given = false;  // the case has [hotpress]
  std::string mechanics = "strands";
  std::string kept = "opened";  // state of the panel that is kept and tested: "opened" or "closed"
  double platen_C = 200;
  std::string platen_program, platen_bottom_program;  // "0 200, 60 190"; empty: platen_C; as the top
  double bottom_lead_s = 0;
  std::vector<std::string> schedule = hotpress::default_schedule();
  double moisture_face = .08, moisture_core = .05, face_fraction = .25;
  double panel_width_mm = 600;
  int cells = 40, columns = 1;
  double step_s = .25;
  double max_mm_per_s = 5;
  double rate_exponent = .04;
  std::string resin_face = "pf", resin_core = "pmdi";
  std::vector<std::string> face_kinds;  // kinds of strand that carry the face resin; empty: those in face_fraction
  hotpress::Softening softening;
  double K400_m2 = 5e-12, slope = .0072, in_plane_ratio = 30;
  std::string permeability_table;  // "350 1.1e-11, 640 9.4e-14"; empty: the formula
  std::string log_file;            // absolute path; empty: the schedule
  hotpress::LogColumns log_columns;
};

// Says what is wrong between the keys of [hotpress]: calls `fail` with the key ("hotpress.schedule") and the message.
void check_hotpress(const Case& c, const std::function<void(const std::string& key, const std::string& message)>& fail);

// What the hot press needs to know of a case; defaults where it has no [hotpress]. Reads the log it names. Throws
// InputError.
hotpress::Settings hotpress_settings(const Case& c);

// Which resin a kind of strand carries.
hotpress::Carried carried_resin(const Case& c, const std::string& kind);

// Whether the mat is pressed hot strand by strand: the case has [hotpress] and mechanics = "strands".
bool presses_hot(const Case& c);

// Compaction at which the press of such a case has closed on this mat. Throws InputError for a schedule that cannot be
// followed.
double closed_compaction(const Case& c, const mat::Mat& mat);

// The mat's rows as layers of one material each, by their mass.
hotpress::PressedMat pressed_mat(const Case& c, const mat::Mat& mat);

// Built-in resins and those of the case.
std::vector<std::string> resin_names(const Case& c);

}  // namespace strandlab::cases
