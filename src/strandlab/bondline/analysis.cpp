#include "strandlab/bondline/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::bondline {
namespace {

// Index of a grouping column among the factors; -1 is the column "group".
int factor_index(const SpecimenTable& table, const std::string& column) {
  if (column == "group") return -1;
  const auto at = std::find(table.factors.begin(), table.factors.end(), column);
  if (at != table.factors.end()) return static_cast<int>(at - table.factors.begin());
  throw InputError(fmt::format("no column '{}' to group by; the table has: group{}{}", column,
                               table.factors.empty() ? "" : ", ", fmt::join(table.factors, ", ")));
}

std::string label(const SpecimenTable& table, const Specimen& specimen, const std::vector<std::string>& columns) {
  std::string text;
  for (const auto& column : columns) {
    const int index = factor_index(table, column);
    text += (text.empty() ? "" : " ") + (index < 0 ? specimen.group : specimen.factors[index]);
  }
  return text;
}

Evaluated evaluate(const Specimen& specimen, const Options& options) {
  Evaluated result;
  result.specimen = specimen;
  result.excluded = specimen.problem;
  if (!result.excluded.empty()) return result;
  const double k = *specimen.k_N_per_mm;
  const auto solution = glue_compliance(specimen.geometry, k, options.formula);
  result.excluded = solution.reason;
  result.compliance_t = solution.value_mm_per_MPa;
  if (!result.compliance_t) return result;
  Uncertainty uncertainty = options.uncertainty;
  if (specimen.k_error_N_per_mm) uncertainty.k_relative = *specimen.k_error_N_per_mm / k;
  result.uncertainty = propagate(specimen.geometry, *result.compliance_t, uncertainty, options.formula);
  result.ratio = compliance_ratio(specimen.geometry, *result.compliance_t, options.formula);
  result.sensitivity = sensitivity(specimen.geometry, *result.compliance_t, options.formula);
  return result;
}

// Mean stiffness and geometry of all specimens that have one, and its 1/D_t.
void evaluate_mean_k(const std::vector<const Evaluated*>& members, Formula formula, Group& group) {
  std::vector<const Specimen*> measured;
  for (const Evaluated* member : members)
    if (member->specimen.k_N_per_mm && member->specimen.problem.empty()) measured.push_back(&member->specimen);
  group.n_mean_k = static_cast<int>(measured.size());
  const auto mean = [&](const auto& value) {
    double sum = 0;
    for (const Specimen* specimen : measured) sum += value(*specimen);
    return sum / group.n_mean_k;
  };
  group.mean_k_N_per_mm = mean([](const Specimen& s) { return *s.k_N_per_mm; });
  if (measured.empty()) return;
  for (auto field : {&Geometry::E1_MPa, &Geometry::E2_MPa, &Geometry::t1_mm, &Geometry::t2_mm, &Geometry::W_mm,
                     &Geometry::l_mm, &Geometry::L1_mm, &Geometry::L2_mm})
    group.mean_geometry.*field = mean([field](const Specimen& s) { return s.geometry.*field; });
  group.mean_geometry.G1_MPa = mean([](const Specimen& s) { return s.geometry.shear1_MPa(); });
  group.mean_geometry.G2_MPa = mean([](const Specimen& s) { return s.geometry.shear2_MPa(); });
  group.compliance_of_mean = glue_compliance(group.mean_geometry, group.mean_k_N_per_mm, formula).value_mm_per_MPa;
}

std::vector<double> values_of(const Analysis& analysis, const Group& group) {
  std::vector<double> values;
  for (const auto& specimen : analysis.specimens)
    if (specimen.group == group.name && specimen.compliance_t) values.push_back(*specimen.compliance_t);
  return values;
}

void make_groups(Analysis& analysis) {
  for (const auto& specimen : analysis.specimens) {
    const auto same = [&](const Group& g) { return g.name == specimen.group; };
    if (std::none_of(analysis.groups.begin(), analysis.groups.end(), same)) {
      Group group;
      group.name = specimen.group;
      group.family = specimen.family;
      analysis.groups.push_back(group);
    }
  }
  for (auto& group : analysis.groups) {
    std::vector<const Evaluated*> members;
    for (const auto& specimen : analysis.specimens)
      if (specimen.group == group.name) members.push_back(&specimen);
    group.compliance_t = statistics::summarise(values_of(analysis, group));
    group.excluded = static_cast<int>(members.size()) - group.compliance_t.n;
    evaluate_mean_k(members, analysis.options.formula, group);
  }
}

Family compare(const Analysis& analysis, const std::string& name) {
  Family family;
  family.name = name;
  std::vector<std::vector<double>> data;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < analysis.groups.size(); ++i) {
    const Group& group = analysis.groups[i];
    if (group.family != name) continue;
    if (group.compliance_t.n < 2 || !(group.compliance_t.sd > 0)) {
      left_out.push_back(group.name);
      continue;
    }
    family.groups.push_back(static_cast<int>(i));
    data.push_back(values_of(analysis, group));
  }
  if (!left_out.empty())
    family.note = fmt::format("not compared, fewer than two different values: {}", fmt::join(left_out, ", "));
  if (data.size() < 2) {
    family.note += fmt::format("{}no comparison: it takes two groups with scatter", family.note.empty() ? "" : "; ");
    return family;
  }
  family.anova = statistics::anova(data);
  family.welch = statistics::welch_anova(data);
  family.pairs = statistics::holm_welch_pairs(data);
  return family;
}

}  // namespace

Analysis analyse(const SpecimenTable& table, const Options& options) {
  if (options.group_by.empty()) throw InputError("no column to group by; the default is 'group'");
  std::vector<std::string> columns = options.within;  // so that no two groups have the same name
  for (const auto& column : options.group_by)
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  Analysis analysis;
  analysis.options = options;
  analysis.factors = table.factors;
  for (const auto& specimen : table.specimens) {
    Evaluated evaluated = evaluate(specimen, options);
    evaluated.group = label(table, specimen, columns);
    evaluated.family = label(table, specimen, options.within);
    analysis.specimens.push_back(std::move(evaluated));
  }
  make_groups(analysis);
  std::vector<std::string> names;
  for (const auto& group : analysis.groups)
    if (std::find(names.begin(), names.end(), group.family) == names.end()) names.push_back(group.family);
  for (const auto& name : names) analysis.families.push_back(compare(analysis, name));
  return analysis;
}

}  // namespace strandlab::bondline
