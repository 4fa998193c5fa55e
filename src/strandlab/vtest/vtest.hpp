// Virtual tests of a pressed panel: tension and bending moduli with imperfect glue lines (small strain, linear,
// static).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/glue/glue.hpp"
#include "strandlab/panel/panel.hpp"
#include "strandlab/vtest/kinds/list.hpp"

namespace strandlab::vtest {

// Closed form of the room theory that answers a test: rows that stretch alike, or that bend as one beam.
enum class ClosedForm { kRuleOfMixtures, kLaminatedBeam };

const char* name(TestKind kind);   // "tension", "bending_3_point", ... (kinds/list.hpp)
const char* label(TestKind kind);  // for people: "Bending (end rotation)"
ClosedForm closed_form(TestKind kind);
std::vector<std::string> test_names();             // of all kinds
TestKind test_from_name(const std::string& name);  // throws InputError with the allowed names
std::string allowed_tests();                       // those names, comma-separated

inline constexpr int kMostElements = 48;  // through a strand

struct Options {
  std::vector<TestKind> kinds{TestKind::kTension, TestKind::kBendingEndRotation};
  std::vector<double> compliance_t_mm_per_MPa{0.0};  // 1/D_t of the glue lines (glue/bond.hpp)
  double compliance_n_mm_per_MPa = 0;                // 1/D_n
  int elements_through_strand = 3;
  double element_length_mm = 1;   // of plates (plate.hpp); in a section elements are as long as they are thick
  glue::CuringOptions curing;     // point_spacing_mm = 0: as the elements
  double span_to_thickness = 20;  // of 3- and 4-point bending: 20 in EN 310, 24 in ASTM D1037
  double pad_to_thickness = 0.5;  // width of their supports and loads
  double perfect_bond =
      100;  // penalty that finds a perfect bond's tractions, in units of wood stiffness / element length
};

struct Modulus {
  TestKind kind = TestKind::kTension;
  double compliance_t_mm_per_MPa = 0;
  double modulus_MPa = 0;           // from the energy
  double reaction_modulus_MPa = 0;  // from the reaction (on supports: from the deflection); agrees to 1e-6
  std::optional<double> shear_free_modulus_MPa{};  // 3- and 4-point bending
};

// A glue point in the tension test: how far strand b has slid along strand a per unit of mean strain, positive along
// the normal from a to b turned clockwise (with x where b lies on a).
struct GlueSlip {
  int a = 0, b = 0;  // strands, order in the panel
  Vec<2> position;   // mm, in the middle of the glue line
  double slip_mm_per_strain = 0;
};

struct Result {
  std::vector<Modulus> moduli;  // by kind within compliance
  std::vector<GlueSlip> slips;  // in tension with the softest glue, in the order of glue::cure(); empty without tension
  double slip_compliance_t_mm_per_MPa = 0;  // of that glue
  int strands = 0;                          // of the specimen
  int floating_strands = 0;                 // of these, not glued to both loaded ends: left out
  double glued_fraction = 0;                // glued length over face length of facing rows
  int unknowns = 0;
  double assemble_s = 0, analyse_s = 0, factor_s = 0, solve_s = 0;  // wall time, all compliances together
  std::vector<std::string> warnings;                                // plain sentences
};

// Refuses options that no panel of this mat could be tested with, before it is pressed. Throws InputError.
void check(const Panel<2>& mat, const Options& options);
// The part of it that tests of sections and of plates have in common.
void check_bonds_and_elements(const std::vector<double>& compliances_t, double compliance_n, int elements_through);

// Refuses a mat between rollers of which glue can connect the two ends at no compaction up to this one: there would be
// nothing to test. Throws InputError with the remedies.
void check_ends(const Panel<2>& mat, double compaction);

// Moduli of the panel, frozen as it lies between the platens: small strain, linear, plane strain, material axes as
// pressed; locked-in stress, geometric stiffness and springback are ignored.
// Strands that free sides let beyond the end planes x = 0 and x = L are cut there, with a warning.
// The file of each test (kinds/) says how it holds and loads the panel and how the modulus follows, with U the energy
// of wood and glue lines, h the platen gap, I = b h^3/12 and w the deflection of the cross section at midspan against
// those over the supports. Throws InputError for options it cannot use, for a panel of which no strands connect both
// ends, and for one shorter than needed_length_mm() or in parts that no glue connects where it is bent on supports;
// RunError for an inverted element. `before_solve`, where given, is called before each solution of the equations; what
// it throws ends the tests and passes through.
Result measure(const Panel<2>& panel, const Options& options, const std::function<void()>& before_solve = nullptr);

// Length that a panel of this thickness must have for the tests asked for: 3- and 4-point bending need the span and one
// thickness beyond either support; 0 without them.
double needed_length_mm(const Options& options, double thickness_mm);

// How much the curing gap matters: the largest relative change (signed) of any modulus asked for when it is halved and
// doubled.
struct GapSensitivity {
  double halved = 0, doubled = 0;
};
// Three measurements; throws what measure() throws, also when half the gap leaves nothing that connects the ends.
GapSensitivity gap_sensitivity(const Panel<2>& panel, const Options& options,
                               const std::function<void()>& before_solve = nullptr);

}  // namespace strandlab::vtest
