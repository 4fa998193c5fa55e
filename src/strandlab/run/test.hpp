// The third step: virtual tests of pressed panels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/report/findings.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/observer.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::run {

// Why a panel has no moduli: nothing connects its ends, say, or the tests failed on it.
struct NotTestable {
  std::string reason;
  bool failed = false;  // a RunError, else an InputError
};

// How much the moduli hang on glue.max_gap_mm, with the softest glue.
struct GapSensitivity {
  double compliance_t_mm_per_MPa = 0;  // of that glue
  vtest::GapSensitivity change;        // when the gap is halved and doubled
};

// The panel at one compaction.
struct TestedState {
  double compaction = 0;
  vtest::Result result;                           // without moduli where it is not testable
  std::optional<NotTestable> not_testable;        //
  std::optional<GapSensitivity> gap_sensitivity;  // none where half or twice the gap leaves nothing to test
  double wall_s = 0;
};

using Tested = std::vector<TestedState>;  // by compaction

// Tests a panel as its case says. A panel that cannot be tested is a result. Throws statics::OutOfMemory, and Cancelled
// when the observer stops it.
TestedState test(const cases::Case& c, const Panel<2>& panel, double compaction, Observer& observer);

// Tests all panels of a formed mat, one per compaction. Throws as above, and InputError or RunError where none is
// testable.
Tested test(const Formed& formed, const std::vector<Panel<2>>& panels, Observer& observer);

// Tells that the test of the panel at compactions[index] begins.
void tell_progress(const cases::Case& c, std::size_t index, Observer& observer);

// One panel without moduli is a result; that none has any is an error: InputError, or RunError where the last failed.
void refuse_if_none_is_testable(const Tested& tested);

std::vector<report::PanelModulus> moduli_of(const Formed& formed, const Tested& tested);
// What moduli, models of them and the mat's length say, in plain words.
std::vector<report::Finding> findings_of(const Formed& formed, const Tested& tested);

}  // namespace strandlab::run
