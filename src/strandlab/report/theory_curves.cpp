#include "strandlab/report/theory_curves.hpp"

#include <algorithm>
#include <map>

#include "strandlab/glue/bond.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::report {
namespace {

constexpr const char* kRuleOfMixtures = "rule of mixtures";
constexpr const char* kLaminatedBeam = "laminated beam";
constexpr const char* kShearLag = "shear-lag";

bool has_gaps_along(const std::vector<theory::Row>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const theory::Row& row) {
    return theory::runs_along(row) && theory::solid_fraction(row.statistics) < 1;
  });
}

Curve curve_of(const std::map<double, double>& points) {
  Curve curve;
  for (const auto& [x, y] : points) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

}  // namespace

bool depends_on_glue(const std::string& model) {
  return model == kShearLag;
}

std::vector<TheoryModulus> theory_moduli(const std::vector<theory::Row>& rows, const std::vector<PanelModulus>& moduli,
                                         wood::OffAxis off_axis) {
  const bool bridged = has_gaps_along(rows);
  std::vector<TheoryModulus> theory;
  for (const auto& m : moduli) {
    const auto add = [&](const char* model, double modulus) {
      theory.push_back({m.compaction, model, m.test, m.compliance_t_mm_per_MPa, modulus});
    };
    switch (vtest::closed_form(vtest::test_from_name(m.test))) {  // no default: the compiler asks for a new one
      case vtest::ClosedForm::kRuleOfMixtures: {
        add(kRuleOfMixtures, theory::tension_modulus_MPa(rows, m.compaction, off_axis));
        if (!bridged) break;
        const double compliance_t = glue::taken(m.compliance_t_mm_per_MPa);
        add(kShearLag, theory::shear_lag_panel_MPa(rows, {}, compliance_t, m.compaction, off_axis));
        break;
      }
      case vtest::ClosedForm::kLaminatedBeam:
        add(kLaminatedBeam, theory::bending_modulus_MPa(rows, m.compaction, off_axis));
        break;
    }
  }
  return theory;
}

files::CsvTable theory_table(const std::vector<TheoryModulus>& moduli) {
  files::CsvTable table({"compaction", "model", "test", "compliance_t_mm_per_MPa", "modulus_MPa"});
  for (const auto& m : moduli) table.add_row({m.compaction, m.model, m.test, m.compliance_t_mm_per_MPa, m.modulus_MPa});
  return table;
}

std::vector<Curve> theory_against_compliance(const std::vector<TheoryModulus>& moduli, const std::string& test) {
  std::map<std::string, std::map<double, std::map<double, double>>> points;
  for (const auto& m : moduli)
    if (m.test == test) points[m.model][m.compaction][m.compliance_t_mm_per_MPa] = m.modulus_MPa;
  std::vector<Curve> curves;
  for (const auto& [model, by_compaction] : points) {
    std::string name = model;
    for (const auto& [compaction, line] : by_compaction) {
      curves.push_back(curve_of(line));
      curves.back().name = name;
      name.clear();
    }
  }
  return curves;
}

std::vector<Curve> theory_against_compaction(const std::vector<TheoryModulus>& moduli, const std::string& test) {
  std::map<std::string, std::map<double, double>> points;
  for (const auto& m : moduli)
    if (m.test == test && !depends_on_glue(m.model)) points[m.model][1 / (1 - m.compaction)] = m.modulus_MPa;
  std::vector<Curve> curves;
  for (const auto& [model, line] : points) {
    curves.push_back(curve_of(line));
    curves.back().name = model;
  }
  return curves;
}

}  // namespace strandlab::report
