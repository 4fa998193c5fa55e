// The closed-form models at the compactions and glue compliances of virtual tests, to compare the two.
#pragma once

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/report/gnuplot.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/theory/models.hpp"

namespace strandlab::report {

// A model's value for a test, in the row of theory.csv and the key of the plots.
struct TheoryModulus {
  double compaction = 0;
  std::string model;                   // "rule of mixtures", "laminated beam", "shear-lag"
  std::string test;                    // as in PanelModulus
  double compliance_t_mm_per_MPa = 0;  // 1/D_t; only the shear-lag model depends on it
  double modulus_MPa = 0;
};

// Whether a model's values follow the glue; the others are those of rows without any undulation, bonded perfectly.
bool depends_on_glue(const std::string& model);

// For each simulated modulus those of the models: tension by rule of mixtures and, where rows along the panel have gaps
// that strands bridge through glue, by shear-lag; bending as a laminated beam. Rows off the grain as the simulated
// ones, by `off_axis`. Throws as the models, and InputError for a test that is no vtest::TestKind.
std::vector<TheoryModulus> theory_moduli(const std::vector<theory::Row>& rows, const std::vector<PanelModulus>& moduli,
                                         wood::OffAxis off_axis);

// compaction, model, test, compliance_t_mm_per_MPa, modulus_MPa; one row per value.
files::CsvTable theory_table(const std::vector<TheoryModulus>& moduli);

// Reference curves of a test for report::plot_modulus_against_compliance: one per model and compaction, named once per
// model.
std::vector<Curve> theory_against_compliance(const std::vector<TheoryModulus>& moduli, const std::string& test);
// The same for report::plot_modulus_against_compaction, without the models that depend on the glue: one per model.
std::vector<Curve> theory_against_compaction(const std::vector<TheoryModulus>& moduli, const std::string& test);

}  // namespace strandlab::report
