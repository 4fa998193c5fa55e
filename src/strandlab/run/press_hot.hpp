// Pressing a mat hot, strand by strand.
#pragma once

#include <optional>

#include "strandlab/run/press.hpp"

namespace strandlab::run {

// Of the engine for a case.
mpm::Options engine_options(const cases::Case& c);

// As run::press() for a case that presses hot. One panel is kept, at the case's one compaction: as the press opened, or
// as it was held (hotpress.kept).
PressOutcome press_hot(const Formed& formed, const press::Sink<2>& keep,
                       const std::optional<press::Checkpoint<2>>& resume, Observer& observer);

}  // namespace strandlab::run
