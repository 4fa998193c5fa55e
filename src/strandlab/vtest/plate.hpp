// Virtual tests of plates (3D panels): the plate stiffness of a periodic panel, panels between glued plates, and tests
// with plane ends of panels whose strands end at the window (small strain, linear, static).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/glue.hpp"
#include "strandlab/panel/panel.hpp"
#include "strandlab/statics/element.hpp"

namespace strandlab::vtest {

struct PlateOptions {
  std::vector<double> compliance_t_mm_per_MPa{0.0};  // 1/D_t of the glue lines (glue/bond.hpp)
  double compliance_n_mm_per_MPa = 0;                // 1/D_n
  int elements_through_strand = 2;
  double element_length_mm = 1;  // along and across strands, as formed
  glue::CuringOptions curing;    // point_spacing_mm = 0: as the elements
  double perfect_bond =
      1000;  // penalty that finds a perfect bond's tractions, in units of wood stiffness / element length
  bool glued_plates = true;  // of periodic panels: also between plates
};

// One modulus, by the names of moduli.csv. With h the platen gap, ABD the plate stiffness and S its inverse:
//   plate_E_x, plate_E_y, plate_G_xy           1/(h S11), 1/(h S22), 1/(h S33): free to bend and shear
//   plate_Eb_x, plate_Eb_y, plate_Gb_xy        12/(h^3 S44), 12/(h^3 S55), 12/(h^3 S66)
//   plates_G_xz, plates_G_yz, plates_E_z       between rigid plates glued to both faces
//   tension_x, tension_y                       plane ends, sides free: 2 U L/(q^2 b h) for a stretch q
//   bending_x, bending_y                       end rotation theta at no axial force: 2 U L/(I theta^2), I = b h^3/12
//   shear_xy_given                             u_x = g y/2, u_y = g x/2 on all four sides: 2 U/(g^2 V), an upper bound
struct PlateModulus {
  std::string test;
  double compliance_t_mm_per_MPa = 0;
  double modulus_MPa = 0;           // from the energy
  double reaction_modulus_MPa = 0;  // from the stress resultants or reactions; agrees to 1e-6
};

// Plate stiffness: (N, M) from (e, k) as statics::PlateStrain, N/mm, N and N mm, the middle half-way between the
// platens.
struct PlateTensor {
  double compliance_t_mm_per_MPa = 0;
  statics::PlateStiffness abd;             // from the energy
  statics::PlateStiffness abd_resultants;  // from the stress resultants
};

struct PlateResult {
  std::vector<PlateModulus> moduli;  // by test within compliance
  std::vector<PlateTensor> tensors;  // by compliance; of periodic panels
  int strands = 0;
  int floating_strands = 0;   // of these, not part of the largest piece that glue holds together: left out
  double glued_area_mm2 = 0;  // of all strands
  double glued_fraction = 0;  // of the area of all strands' faces
  int unknowns = 0;
  double assemble_s = 0, analyse_s = 0, factor_s = 0, solve_s = 0;  // wall time, all compliances together
  std::vector<std::string> warnings;                                // plain sentences
};

// Refuses options that no panel of this mat could be tested with, before it is pressed. Throws InputError.
void check(const Panel<3>& mat, const PlateOptions& options);

// What the tests of a panel will take: unknowns; memory and time of one thread by fits to CHOLMOD's factors of such
// panels.
struct PlateSize {
  long unknowns = 0;
  double memory_GB = 0;
  double seconds_per_compliance = 0;
};
PlateSize size_of_tests(const Panel<3>& panel, const PlateOptions& options);

// Of a panel of which no glue holds strands together all the way across x and y: there is nothing to test.
struct NotConnected : InputError {
  using InputError::InputError;
};

// Moduli of the panel, frozen as it lies between the platens; a periodic one as part of an endless plate, the plate
// strains acting on it everywhere and its strands free to move beyond them. Throws InputError for options it cannot
// use, NotConnected, RunError for an inverted element. `before_solve`, where given, is called before each solution of
// the equations; what it throws ends the tests and passes through.
PlateResult measure(const Panel<3>& panel, const PlateOptions& options,
                    const std::function<void()>& before_solve = nullptr);

}  // namespace strandlab::vtest
