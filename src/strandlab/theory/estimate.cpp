#include "strandlab/theory/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::theory {
namespace {

struct StrandSize {
  double length_mm = 0, gap_mm = 0;
};

// First row that runs along, its strands stand for the panel in the table; null where there is none.
const Row* first_along(const std::vector<Row>& rows) {
  const auto at = std::find_if(rows.begin(), rows.end(), runs_along);
  return at == rows.end() ? nullptr : &*at;
}

std::vector<StrandSize> strand_sizes(const Question& q) {
  const Row* along = first_along(q.rows);
  const StrandSize own = along ? StrandSize{along->statistics.length_mm, along->statistics.gap_mm} : StrandSize{};
  const auto lengths = q.lengths_mm.empty() ? std::vector<double>{own.length_mm} : q.lengths_mm;
  const auto gaps = q.gaps_mm.empty() ? std::vector<double>{own.gap_mm} : q.gaps_mm;
  for (double length : q.lengths_mm)
    if (!(length > 0) || !std::isfinite(length))
      throw InputError(fmt::format("strand length {:g} mm must be positive", length));
  for (double gap : q.gaps_mm)
    if (!(gap >= 0) || !std::isfinite(gap)) throw InputError(fmt::format("gap {:g} mm must not be negative", gap));
  if (!along && (!q.lengths_mm.empty() || !q.gaps_mm.empty()))
    throw InputError("strand length and gap vary the rows whose grain runs along the section; this panel has none");
  std::vector<StrandSize> sizes;
  for (double length : lengths)
    for (double gap : gaps) sizes.push_back({length, gap});
  return sizes;
}

// Rows with the varied strand length and gap in those that run along; own sizes stay where nothing varies.
std::vector<Row> varied_rows(const Question& q, const StrandSize& size) {
  std::vector<Row> rows = q.rows;
  for (Row& row : rows) {
    if (!runs_along(row)) continue;
    if (!q.lengths_mm.empty()) row.statistics.length_mm = size.length_mm;
    if (!q.gaps_mm.empty()) row.statistics.gap_mm = size.gap_mm;
    if (row.statistics.gap_mm > 0 && !(row.statistics.length_mm > 0))
      throw InputError("gaps in rows that one strand fills need a strand length too");
  }
  return rows;
}

void at_compaction(const Question& q, const std::vector<Row>& rows, Estimate at, std::vector<Estimate>& out) {
  const auto add = [&](const char* model, double modulus, std::optional<double> compliance_t = std::nullopt) {
    at.model = model;
    at.modulus_MPa = modulus;
    at.compliance_t = compliance_t;
    out.push_back(at);
  };
  at.density_kg_m3 = density_kg_m3(rows, at.compaction);
  add("tension", tension_modulus_MPa(rows, at.compaction, q.off_axis));
  add("bending", bending_modulus_MPa(rows, at.compaction, q.off_axis));
  if (first_along(rows))
    for (double compliance_t : q.compliances_t)
      add("shear_lag", shear_lag_panel_MPa(rows, q.matrix, compliance_t, at.compaction, q.off_axis), compliance_t);
  const auto core = std::find_if_not(rows.begin(), rows.end(), runs_along);
  if (core == rows.end()) return;
  const auto with_core = [&](double modulus) {
    return random_core_modulus_MPa(rows, modulus, at.compaction, q.off_axis);
  };
  add("random_core_quasi_isotropic", with_core(quasi_isotropic_modulus_MPa(core->material)));
  add("random_core_off_axis", with_core(off_axis_average_MPa(core->material)));
  add("random_core_plane_strain", with_core(plane_strain_average_MPa(core->material)));
}

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> kModels{
      {"tension",
       "rule of mixtures: all rows stretch alike, strands straight, glue perfect, gaps only dilute; too stiff once "
       "gaps "
       "transfer load through compliant glue or strands undulate (high compaction)"},
      {"bending",
       "laminated beam: plane sections, straight rows, perfect glue, no shear deformation; too stiff for compliant "
       "glue, "
       "undulating strands and spans below about 20 thicknesses"},
      {"shear_lag",
       "shear-lag strands, glue lines 1/D_t, gaps filled by a matrix that carries load; an upper estimate where gaps "
       "are "
       "empty; not for strands shorter than about 10 thicknesses"},
      {"modulus_at_density",
       "tension modulus proportional to density: only compaction changes the density; not across wood species, layups "
       "or "
       "strand sizes, nor beyond the cell wall's 1500 kg/m3"},
      {"random_core_quasi_isotropic",
       "core as a laminate of all grain angles alike, shear coupling balanced between rows; too stiff where few core "
       "rows "
       "cannot balance each other"},
      {"random_core_off_axis",
       "core rows free to shear, modulus averaged over angles; a lower estimate, since neighbours hinder the shear"},
      {"random_core_plane_strain",
       "core rows held in plane strain, modulus averaged over angles, as in section simulations with exact off-axis "
       "stiffness; too stiff for a real panel, which can strain across"}};
  return kModels;
}

std::vector<Estimate> estimate(const Question& q) {
  for (const Row& row : q.rows)
    if (!(row.thickness_mm > 0))
      throw InputError(fmt::format("row thickness {:g} mm must be positive", row.thickness_mm));
  std::vector<Estimate> result;
  for (const StrandSize& size : strand_sizes(q)) {
    const std::vector<Row> rows = varied_rows(q, size);
    Estimate at;
    at.length_mm = size.length_mm;
    at.gap_mm = size.gap_mm;
    for (double compaction : q.compactions) {
      at.compaction = compaction;
      at_compaction(q, rows, at, result);
    }
    for (double density : q.densities_kg_m3) {
      at.model = "modulus_at_density";
      at.density_kg_m3 = density;
      at.modulus_MPa = modulus_at_density_MPa(rows, density, q.off_axis);
      at.compaction = 1 - density_kg_m3(rows, 0) / density;
      result.push_back(at);
    }
  }
  return result;
}

std::vector<Row> default_osb() {
  const auto& library = wood::library();
  const auto poplar = std::find_if(library.begin(), library.end(), [](const auto& m) { return m.name == "poplar"; });
  const Row surface{*poplar, 0, {150, 20, 15, 4.95}}, core{*poplar, 90, {25, 3, 10, 1}};
  std::vector<Row> rows(20, surface);
  std::fill(rows.begin() + 5, rows.begin() + 15, core);
  return rows;
}

}  // namespace strandlab::theory
