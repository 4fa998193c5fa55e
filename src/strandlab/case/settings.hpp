// What a user may choose of a case itself, besides the options of the rooms.
#pragma once

#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/core/declaration.hpp"

namespace strandlab::cases {

std::vector<Declaration<Case>> mat_settings();
std::vector<Declaration<KindSettings>> kind_settings();
std::vector<Declaration<KeptStates>> state_settings();
std::vector<Declaration<Case>> side_settings();      // of the mat in the press
std::vector<Declaration<Case>> half_settings();      // of the mat of a plate
std::vector<Declaration<Case>> bondline_settings();  // a measured result in place of compliances
std::vector<Declaration<Case>> run_settings();
std::vector<Declaration<HotPressSettings>> hot_press_settings();
std::vector<Declaration<ResinSettings>> resin_settings();

}  // namespace strandlab::cases
