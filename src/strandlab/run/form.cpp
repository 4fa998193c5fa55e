#include "strandlab/run/form.hpp"

#include <utility>

#include "strandlab/vtest/vtest.hpp"

namespace strandlab::run {

Formed form(const cases::Case& c) {
  auto mat = cases::make_mat(c);
  auto panel = cases::make_panel(c, mat);
  vtest::check(panel, c.test);
  return {c, std::move(mat), std::move(panel)};
}

void refuse_untestable(const Formed& formed) {
  const auto& c = formed.c;
  if (c.sides == mpm::Side::kRoller) vtest::check_ends(formed.panel, c.schedule.compactions.back());
}

}  // namespace strandlab::run
