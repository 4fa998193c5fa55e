#include "strandlab/run/form.hpp"

#include <fmt/format.h>

#include <algorithm>
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

std::vector<KeptState> kept_states(const Formed& formed) {
  std::vector<KeptState> states;
  for (const double compaction : formed.c.schedule.compactions) {
    states.push_back({compaction, formed.mat.thickness_mm() * (1 - compaction),
                      cases::density_kg_m3(formed.c, formed.mat, compaction)});
  }
  return states;
}

std::optional<std::string> remark_on_length(const Formed& formed) {
  constexpr double kFewStrands = 3;  // judgement
  if (!formed.c.mat_file.empty()) return std::nullopt;
  double longest = 0;
  for (const auto& row : cases::layup(formed.c).rows) longest = std::max(longest, row.statistics.length_mm);
  const double length = formed.mat.length_mm;
  if (length >= kFewStrands * longest) return std::nullopt;
  return fmt::format(
      "the mat is {:g} mm long, {:.2g} lengths of its longest strands: moduli scatter between seeds; the mean of four "
      "seeds scatters half as much, a mat of {:g} mm holds {:g} lengths",
      length, length / longest, kFewStrands * longest, kFewStrands);
}

void refuse_untestable(const Formed& formed) {
  const auto& c = formed.c;
  if (c.sides == mpm::Side::kRoller) vtest::check_ends(formed.panel, c.schedule.compactions.back());
}

}  // namespace strandlab::run
