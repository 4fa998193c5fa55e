// The tables a run leaves: press.csv and moduli.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/vtest/plate.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::report {

// A modulus of moduli.csv.
struct PanelModulus {
  double compaction = 0;
  std::string test;                                // "tension", ...
  double compliance_t_mm_per_MPa = 0;              // 1/D_t
  double modulus_MPa = 0;                          // from the energy
  double reaction_modulus_MPa = 0;                 // from the reaction
  std::optional<double> shear_free_modulus_MPa{};  // of 3- and 4-point bending
  double density_kg_m3 = 0;                        // of the panel at that compaction
};

// compaction, time_ms, stress_MPa, force_top_N, force_bottom_N, kinetic_mJ, internal_mJ, plastic_mJ, elastic_mJ,
// friction_mJ, contact_mJ, filter_mJ, of a hot press softening_mJ and damping_mJ, platen_work_mJ; one row per record.
files::CsvTable press_table(const std::vector<press::Record>& records);

// compaction, test, compliance_t_mm_per_MPa, modulus_MPa, reaction_modulus_MPa, shear_free_modulus_MPa (nan but for 3-
// and 4-point bending), density_kg_m3; one row per modulus.
files::CsvTable moduli_table(const std::vector<PanelModulus>& moduli);

// compaction, compliance_t_mm_per_MPa, ABD_11, ABD_12, ... ABD_66: the plate stiffness row by row, (N_xx, N_yy, N_xy,
// M_xx, M_yy, M_xy) from (e_xx, e_yy, g_xy, k_xx, k_yy, k_xy), N/mm, N and N mm; one row per compaction and compliance.
struct PlateState {
  double compaction = 0;
  vtest::PlateResult result;
};
files::CsvTable plate_table(const std::vector<PlateState>& states);

// compliance_t_mm_per_MPa, strand_a, strand_b (order in the panel, from 0), x_mm, y_mm, slip_mm_per_strain; one row per
// glue point, in the order of the test. Rounded to 1e-4 mm.
files::CsvTable slip_table(const vtest::Result& result);

}  // namespace strandlab::report
