// run.json: what the results of a run's steps are in it. RunFolder keeps the file.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "strandlab/panel/panel.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/plate.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/test.hpp"

namespace strandlab::run {

// What stands in run.json before any step: program, seed, machine, the mat's weight by kind and material. `record` is
// that of the folder; a date that it has stays.
void begin_record(nlohmann::json& record, const Formed& formed);
// The same of a plate.
void begin_record(nlohmann::json& record, const FormedPlate& formed);

// Speed, time, warnings of a pressing.
template <int Dim>
nlohmann::json summary(const press::Outcome<Dim>& outcome, int threads);

// One object per compaction.
nlohmann::json to_json(const std::vector<profile::Profile>& profiles);

// Moduli, plate stiffness and counts of a plate's tests, one object per compaction.
nlohmann::json to_json(const TestedPlate& tested);

// One object per compaction; what tested_from_json() reads gives the same bits again.
nlohmann::json to_json(const Tested& tested);
// Without the slips of glue points, which are in files of their own. Throws nlohmann::json::exception for what
// to_json() does not write.
Tested tested_from_json(const nlohmann::json& states);

}  // namespace strandlab::run
