#include "strandlab/run/theory_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/bond.hpp"
#include "strandlab/mat/cut.hpp"

namespace strandlab::run {
namespace {

theory::Row row_of_kind(const std::vector<StrandKind>& kinds, const std::string& name) {
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const StrandKind& k) { return k.name == name; });
  if (kind == kinds.end()) throw InputError(fmt::format("the case has no strand kind \"{}\"", name));
  return {kind->material, kind->angle_deg, {}, 0, 0};
}

mat::StrandStatistics statistics_of(const mat::Layer& layer, double length_mm) {
  double wood = 0;
  for (const auto& strand : layer.strands) wood += strand.x1_mm - strand.x0_mm;
  if (wood >= length_mm) return {0, 0, 0, 0};
  if (layer.strands.empty()) return {0, 0, length_mm, 0};
  const double mean = wood / static_cast<double>(layer.strands.size());
  return {mean, 0, mean * (length_mm / wood - 1), 0};
}

std::vector<theory::Piece> pieces_of(const mat::Mat& mat, std::size_t layer, const std::vector<StrandKind>& kinds) {
  const auto& kind = find_kind(kinds, mat.layers[layer].role, layer);
  std::vector<theory::Piece> pieces;
  for (const auto& strand : mat.layers[layer].strands) {
    pieces.push_back({find_material(kind, strand, kinds, layer), strand.angle_deg.value_or(kind.angle_deg),
                      strand.x1_mm - strand.x0_mm});
  }
  return pieces;
}

}  // namespace

std::vector<theory::Row> theory_rows(const cases::Case& c, const mat::Mat& mat) {
  const auto kinds = cases::strand_kinds(c);
  std::vector<theory::Row> rows;
  if (c.mat_file.empty()) {
    const auto layup = cases::layup(c);
    for (const auto& given : layup.rows) {
      rows.push_back(row_of_kind(kinds, given.kind));
      const auto angles = given.angles.value_or(mat::AngleDistribution{});
      rows.back().statistics = mat::in_section(given.statistics, angles);
      rows.back().thickness_mm = given.thickness_mm.value_or(layup.layer_thickness_mm);
      rows.back().angle_spread_deg = angles.spread_deg;
      rows.back().angle_sd_deg = angles.sd_deg;
    }
    return rows;
  }
  const auto woods = cases::kinds_and_materials(c);
  for (std::size_t i = 0; i < mat.layers.size(); ++i) {
    rows.push_back(row_of_kind(kinds, mat.layers[i].role));
    rows.back().statistics = statistics_of(mat.layers[i], mat.length_mm);
    rows.back().thickness_mm = mat.thickness_of(i);
    rows.back().pieces = pieces_of(mat, i, woods);
  }
  return rows;
}

theory::Question theory_question(cases::Case c, theory::Question question, std::vector<double> compactions,
                                 std::vector<double> compliances_t) {
  const auto mat = cases::make_mat(c);
  if (compactions.empty()) cases::settle_states(c, mat);
  question.rows = theory_rows(c, mat);
  question.compactions = compactions.empty() ? c.schedule.compactions : std::move(compactions);
  question.compliances_t = compliances_t.empty() ? c.test.compliance_t_mm_per_MPa : std::move(compliances_t);
  for (double& compliance_t : question.compliances_t) compliance_t = glue::taken(compliance_t);
  return question;
}

}  // namespace strandlab::run
