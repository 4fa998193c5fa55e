// Plots of a run, drawn by draw() (gnuplot.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "strandlab/glue/measured.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/report/gnuplot.hpp"
#include "strandlab/report/morphology.hpp"
#include "strandlab/report/result_tables.hpp"

namespace strandlab::report {

// Platen stress (mean of both platens) against compaction.
Plot stress_plot(const std::vector<press::Record>& records);
// Modulus of one test against 1/D_t, one line per compaction; `moduli` of other tests are left out. `references` are
// drawn over them (Plot::references), x in mm/MPa, y in MPa.
Plot compliance_plot(const std::vector<PanelModulus>& moduli, const std::string& test,
                     const std::vector<Curve>& references = {});
// Modulus of one test against 1/(1 - C), one line per compliance, called `name_of_glue`; x of `references` is
// 1/(1 - C).
Plot compaction_plot(const std::vector<PanelModulus>& moduli, const std::string& test,
                     const std::vector<Curve>& references = {},
                     const std::function<std::string(double)>& name_of_glue = glue::name_of_bond);
// Histograms of all states over each other.
Plot grain_angle_plot(const std::vector<Morphology>& states);
Plot thickness_strain_plot(const std::vector<Morphology>& states);

}  // namespace strandlab::report
