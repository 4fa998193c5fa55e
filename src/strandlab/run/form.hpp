// The first step: the mat of a case, and the panel it makes before pressing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"

namespace strandlab::run {

// What the other steps start from.
struct Formed {
  cases::Case c;  // with the compactions at which this mat has the states asked for
  mat::Mat mat;
  Panel<2> panel;
};

// Forms (or reads) the mat. Throws InputError for a mat that cannot be formed or read, does not fit into memory, or
// that the tests of the case could not be made of.
Formed form(cases::Case c);

// A state at which the panel is kept, as it was solved for this mat.
struct KeptState {
  double compaction = 0, thickness_mm = 0, density_kg_m3 = 0;
};
std::vector<KeptState> kept_states(const Formed& formed);

// Says that a mat formed at random is shorter than three of its longest strands, and what to do: it cuts most of them,
// so that moduli scatter between seeds more than those of a panel. Nothing where it is not.
std::optional<std::string> remark_on_length(const Formed& formed);

// Of each kind whose strands lie across and are longer in the section than strands are wide: that length_mm is taken
// for their width there, and which key changes it. Nothing for a mat file.
std::vector<std::string> remarks_on_widths(const cases::Case& c);

// Refuses a mat that no glue can connect from end to end: pressed, there would be nothing to test. Throws InputError.
void refuse_untestable(const Formed& formed);

}  // namespace strandlab::run
