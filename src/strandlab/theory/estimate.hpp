// All closed-form models over lists of what a user may want to vary: what `strandlab theory` prints and plots overlay.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/theory/models.hpp"

namespace strandlab::theory {

// A model and, in one line, what it assumes and when it stops being valid.
struct Model {
  const char* name;
  const char* validity;
};
// "tension", "bending", "shear_lag", "modulus_at_density", "random_core_quasi_isotropic", "random_core_off_axis",
// "random_core_plane_strain".
const std::vector<Model>& models();

struct Question {
  std::vector<Row> rows;  // bottom to top
  std::vector<double> compactions{0};
  std::vector<double> compliances_t{0};  // 1/D_t, mm/MPa
  std::vector<double> lengths_mm;        // of the strands that run along; empty: as the rows have it
  std::vector<double> gaps_mm;           // between them; empty: as the rows have it
  std::vector<double> densities_kg_m3;   // of modulus_at_density
  Matrix matrix;
  OffAxis off_axis = OffAxis::kUncoupled;
};

struct Estimate {
  std::string model;
  double compaction = 0;
  double density_kg_m3 = 0;
  std::optional<double> compliance_t;  // mm/MPa, where the model knows it
  double length_mm = 0, gap_mm = 0;    // of the first row that runs along (0: no such row, or full rows)
  double modulus_MPa = 0;
};

// Every model at every combination of the lists it depends on; models of random cores only where a row does not run
// along. Throws InputError for a list entry out of range.
std::vector<Estimate> estimate(const Question& question);

// The default OSB: 20 rows of unmodified poplar, a quarter of them surface rows on either side.
std::vector<Row> default_osb();

}  // namespace strandlab::theory
