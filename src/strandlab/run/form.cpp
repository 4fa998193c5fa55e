#include "strandlab/run/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
  for (const auto* kind : cases::row_kinds(formed.c))
    longest = std::max(longest, cases::in_section(formed.c, *kind).length_mm);
  const double length = formed.mat.length_mm;
  if (length >= kFewStrands * longest) return std::nullopt;
  return fmt::format(
      "the mat is {:g} mm long, {:.2g} lengths of its longest strands: moduli scatter between seeds; the mean of four "
      "seeds scatters half as much, a mat of {:g} mm holds {:g} lengths",
      length, length / longest, kFewStrands * longest, kFewStrands);
}

std::vector<std::string> remarks_on_widths(const cases::Case& c) {
  constexpr double kWide_mm = 50;  // judgement: strands are 5 to 30 mm wide
  std::vector<std::string> remarks;
  if (!c.mat_file.empty()) return remarks;
  for (const auto& kind : c.kinds) {
    const auto kinds = cases::row_kinds(c);
    const bool used = std::find(kinds.begin(), kinds.end(), &kind) != kinds.end();
    const auto& s = kind.statistics;
    const bool crosses = std::abs(std::remainder(kind.angle_deg, 180.0)) > 45;
    if (!used || !crosses || s.width_mm > 0 || !(s.length_mm > kWide_mm)) continue;
    remarks.push_back(
        fmt::format("kinds.{0}: strands at {1:g} degrees are cut across their grain, and length_mm = {2:g} is what the "
                    "section shows, their width; if that is the length of whole strands, give kinds.{0}.width_mm too",
                    kind.name, kind.angle_deg, s.length_mm));
  }
  return remarks;
}

void refuse_untestable(const Formed& formed) {
  const auto& c = formed.c;
  if (c.sides == mpm::Side::kRoller) vtest::check_ends(formed.panel, c.schedule.compactions.back());
}

}  // namespace strandlab::run
