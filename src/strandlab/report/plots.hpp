// Plots of a run as PNG, drawn by gnuplot. A machine without gnuplot still gets all its numbers: every function returns
// a sentence for the log instead of a picture, nothing when all went well.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/press/press.hpp"
#include "strandlab/report/gnuplot.hpp"
#include "strandlab/report/morphology.hpp"
#include "strandlab/report/result_tables.hpp"

namespace strandlab::report {

using Warning = std::optional<std::string>;

// Platen stress (mean of both platens) against compaction.
[[nodiscard]] Warning plot_stress(const std::vector<press::Record>& records, const std::filesystem::path& png);
// Modulus of one test against 1/D_t, one line per compaction; `moduli` of other tests are left out. `references` are
// drawn over them (Plot::references), x in mm/MPa, y in MPa.
[[nodiscard]] Warning plot_modulus_against_compliance(const std::vector<PanelModulus>& moduli, const std::string& test,
                                                      const std::filesystem::path& png,
                                                      const std::vector<Curve>& references = {});
// Modulus of one test against 1/(1 - C), one line per compliance; x of `references` is 1/(1 - C).
[[nodiscard]] Warning plot_modulus_against_compaction(const std::vector<PanelModulus>& moduli, const std::string& test,
                                                      const std::filesystem::path& png,
                                                      const std::vector<Curve>& references = {});
// Histograms of all states over each other.
[[nodiscard]] Warning plot_grain_angles(const std::vector<Morphology>& states, const std::filesystem::path& png);
[[nodiscard]] Warning plot_thickness_strains(const std::vector<Morphology>& states, const std::filesystem::path& png);

}  // namespace strandlab::report
