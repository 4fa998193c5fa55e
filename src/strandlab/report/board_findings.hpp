// What a run's numbers say of the board itself: pressure, density profile, stiffness and what it costs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "strandlab/glue/measured.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/report/findings.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/report/theory_curves.hpp"

namespace strandlab::report {

inline constexpr double kHotPressMPa = 6;  // what hot presses of panel mills give at most
inline constexpr double kFlatProfile =
    .05;  // outer quarters over the core, less one: below it a profile is flat. Judgement

// "Bending by end rotation" of "Bending by end rotation (...)": what a virtual test is called in a sentence.
std::string short_label(const std::string& test);

// Highest mean stress of the platens, MPa; 0 without records.
double highest_stress_MPa(const std::vector<press::Record>& records);

// The pressure the platens had to bear, and how much of their work the wood would give back.
std::vector<Finding> pressure_findings(const std::vector<press::Record>& records);

// Whether the last profile is flat, and its peak and core; nothing without profiles.
std::vector<Finding> profile_findings(const std::vector<profile::Profile>& profiles);

// The glue that stands for a list of them: the middle one of those that are not perfect, a perfect bond without any.
double middle_glue(const std::vector<double>& compliances_t_mm_per_MPa);

// Of the last state that has moduli, for each of its tests: what glue costs beside a perfect bond, and what undulation
// and gaps cost beside a flat laminate of the same density (the closed-form models; shear-lag is none of a flat one).
// `name_of_glue` is what a compliance is called.
std::vector<Finding> stiffness_findings(const std::vector<PanelModulus>& moduli,
                                        const std::vector<TheoryModulus>& theory,
                                        const std::function<std::string(double)>& name_of_glue = glue::name_of_bond);

}  // namespace strandlab::report
