#include "strandlab/run/composition.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strandlab::run {
namespace {

std::string percentages(const std::vector<WeightShare>& shares) {
  std::string text;
  for (const auto& share : shares)
    text += fmt::format("{}{} {:.1f} %", text.empty() ? "" : ", ", share.name, 100 * share.fraction);
  return text;
}

}  // namespace

std::vector<std::string> composition(const Weight& weight) {
  return {fmt::format("weight: {:.4g} kg/m2; by kind: {}; by material: {}", weight.kg_per_m2,
                      percentages(weight.by_kind), percentages(weight.by_material))};
}

std::optional<std::string> remark_on_shares(const cases::Case& c) {
  if (!c.mat_file.empty()) return std::nullopt;
  const auto rows = cases::row_kinds(c);
  const auto* face = rows.front();
  const auto faces = static_cast<int>(
      std::find_if(rows.begin(), rows.end(), [&](const auto* kind) { return kind != face; }) - rows.begin());
  const auto core = static_cast<int>(rows.size()) - 2 * faces;
  if (core < 1) return std::nullopt;
  const auto* middle = rows[static_cast<std::size_t>(faces)];
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    if (rows[static_cast<std::size_t>(i)] != (i < faces || i >= faces + core ? face : middle)) return std::nullopt;
  }
  const auto weight_of_row = [&c](const cases::KindSettings& kind) {
    const auto s = cases::in_section(c, kind);
    const double wood = s.gap_mm > 0 ? s.length_mm / (s.length_mm + s.gap_mm) : 1;
    const double thickness = kind.thickness_mm > 0 ? kind.thickness_mm : c.layer_thickness_mm;
    return wood * thickness * cases::find_material(c, kind.material).density_kg_m3;
  };
  const double a = weight_of_row(*face), b = weight_of_row(*middle);
  std::string text;
  for (const int more : {-1, 0, 1}) {
    const int outer = faces + more, inner = core - 2 * more;
    if (outer < 1 || inner < 1) continue;
    text += fmt::format("{}{} + {} + {} rows {:.1f} %", text.empty() ? "" : ", ", outer, inner, outer,
                        100 * 2 * outer * a / (2 * outer * a + inner * b));
  }
  return fmt::format("{} by weight, mean over random mats: {}", face->name, text);
}

}  // namespace strandlab::run
