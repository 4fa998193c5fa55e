#include "strandlab/run/form.hpp"

#include <utility>

#include "strandlab/vtest/vtest.hpp"

namespace strandlab::run {

Formed form(cases::Case c) {
  auto mat = cases::make_mat(c);
  cases::settle_states(c, mat);
  auto panel = cases::make_panel(c, mat);
  vtest::check(panel, c.test);
  return {std::move(c), std::move(mat), std::move(panel)};
}

void refuse_untestable(const Formed& formed) {
  const auto& c = formed.c;
  if (c.sides == mpm::Side::kRoller) vtest::check_ends(formed.panel, c.schedule.compactions.back());
}

}  // namespace strandlab::run
