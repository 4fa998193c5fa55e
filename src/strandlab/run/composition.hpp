// What a mat is made of, in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/panel/panel.hpp"

namespace strandlab::run {

// Weight of panel area, and the percentages of it by strand kind and by material.
std::vector<std::string> composition(const Weight& weight);

// Of a layup of a core between faces of one kind: the faces' share of weight, the mean over random mats, and what it
// would be with a row more or less on either side. Nothing of other layups and of mat files.
std::optional<std::string> remark_on_shares(const cases::Case& c);

}  // namespace strandlab::run
