// What a run's page says in words and numbers, from the case and run.json.
#pragma once

#include <nlohmann/json.hpp>

#include "strandlab/case/case.hpp"
#include "strandlab/report/sheet.hpp"

namespace strandlab::run {

// The sheet of a run: its record, and its mat (mat.json) or null where none is formed yet. What steps that are not done
// would tell is left out.
report::Sheet sheet_of(const cases::Case& c, const nlohmann::json& record, const nlohmann::json& mat);

}  // namespace strandlab::run
