#include "strandlab/report/bondline_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab::report {
namespace {

using Cells = std::vector<files::CsvCell>;

files::CsvCell cell(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? files::CsvCell(*value) : files::CsvCell(std::string());
}

files::CsvCell count(int value) {
  return static_cast<long long>(value);
}

// D_t of a compliance; none for a perfect bond.
std::optional<double> inverse(const std::optional<double>& compliance_t) {
  return compliance_t && *compliance_t != 0 ? std::optional(1 / *compliance_t) : std::nullopt;
}

bool from_records(const bondline::Analysis& analysis) {
  return std::any_of(analysis.specimens.begin(), analysis.specimens.end(),
                     [](const auto& s) { return s.specimen.slope.has_value(); });
}

void add_result(const bondline::Evaluated& s, Cells& cells) {
  const bool known = s.compliance_t.has_value();
  const auto if_known = [&](double value) { return cell(known ? std::optional(value) : std::nullopt); };
  cells.insert(cells.end(), {cell(s.compliance_t), if_known(s.uncertainty.standard_mm_per_MPa),
                             if_known(s.uncertainty.low_mm_per_MPa), if_known(s.uncertainty.high_mm_per_MPa),
                             cell(inverse(s.compliance_t)), if_known(s.ratio), if_known(s.sensitivity),
                             cell(s.specimen.k_N_per_mm), if_known(s.uncertainty.k_equivalent),
                             s.specimen.geometry.l_mm, bondline::rigid_limit_N_per_mm(s.specimen.geometry),
                             bondline::lower_bound_mm_per_MPa(s.specimen.geometry), s.excluded});
}

void add_slope(const bondline::Slope& slope, Cells& cells) {
  const bool known = slope.problem.empty();
  const auto if_known = [&](double value) { return cell(known ? std::optional(value) : std::nullopt); };
  cells.insert(cells.end(), {if_known(slope.r_squared), cell(slope.low_N), cell(slope.high_N), count(slope.points),
                             if_known(slope.toe_mm), fmt::format("{}", fmt::join(slope.flags, "; "))});
}

std::string excluded_text(const bondline::Analysis& analysis) {
  std::string text;
  for (const auto& s : analysis.specimens)
    if (!s.excluded.empty())
      text += fmt::format("excluded: {} ({}): {}\n", printable(s.specimen.id), printable(s.specimen.source),
                          printable(s.excluded));
  for (const auto& s : analysis.specimens) {
    if (!s.specimen.slope) continue;
    for (const auto& flag : s.specimen.slope->flags)
      text += fmt::format("flag: {}: {}\n", printable(s.specimen.id), flag);
  }
  return text;
}

std::string groups_text(const bondline::Analysis& analysis) {
  auto text = fmt::format("{:<24}{:>4}{:>10}{:>12}{:>11}{:>12}{:>12}{:>10}{:>14}\n", "group", "n", "excluded", "1/D_t",
                          "sd", "95 % low", "95 % high", "p(0)", "from mean k");
  for (const auto& g : analysis.groups) {
    const auto& c = g.compliance_t;
    text += fmt::format("{:<24}{:>4}{:>10}{:>12.5f}{:>11.5f}{:>12.5f}{:>12.5f}{:>10.3g}{:>14}\n", printable(g.name),
                        c.n, g.excluded, c.mean, c.sd, c.low, c.high, c.p,
                        g.compliance_of_mean ? fmt::format("{:.5f}", *g.compliance_of_mean) : "none");
  }
  text += fmt::format("1/D_t in mm/MPa; interval: Student's t; p(0): one-sample t-test of 1/D_t = 0\n");
  return text;
}

std::string comparisons_text(const bondline::Analysis& analysis) {
  std::string text;
  for (const auto& family : analysis.families) {
    const std::string within = family.name.empty() ? "" : printable(family.name) + ": ";
    if (!family.note.empty()) text += fmt::format("{}{}\n", within, family.note);
    if (!family.anova) continue;
    text += fmt::format(
        "{}one-way ANOVA F({}, {}) = {:.4g}, p = {:.3g}; without equal variances (Welch) F({:g}, {:.1f}) = {:.4g}, p = "
        "{:.3g}\n",
        within, family.anova->df_between, family.anova->df_within, family.anova->F, family.anova->p,
        family.welch->df_between, family.welch->df_within, family.welch->F, family.welch->p);
    for (const auto& pair : family.pairs)
      text += fmt::format("  {} - {}: {:.5f} mm/MPa, t = {:.3g}, p = {:.3g}\n",
                          printable(analysis.groups[family.groups[pair.first]].name),
                          printable(analysis.groups[family.groups[pair.second]].name), pair.difference, pair.t,
                          pair.p_holm);
    text += fmt::format("  pairs: Welch's t-test, p corrected by Holm's method\n");
  }
  return text;
}

}  // namespace

files::CsvTable specimen_table(const bondline::Analysis& analysis) {
  std::vector<std::string> columns{"id",
                                   "compliance_t_mm_per_MPa",
                                   "standard_uncertainty_mm_per_MPa",
                                   "low_mm_per_MPa",
                                   "high_mm_per_MPa",
                                   "D_t_MPa_per_mm",
                                   "compliance_ratio",
                                   "sensitivity",
                                   "k_N_per_mm",
                                   "k_equivalent_uncertainty",
                                   "l_mm",
                                   "rigid_limit_N_per_mm",
                                   "lower_bound_mm_per_MPa",
                                   "excluded",
                                   "group"};
  const bool records = from_records(analysis);
  if (records)
    columns.insert(columns.end(), {"r_squared", "window_low_N", "window_high_N", "window_points", "toe_mm", "flags"});
  for (const auto& factor : analysis.factors) {
    const bool taken = std::find(columns.begin(), columns.end(), factor) != columns.end();
    columns.push_back(taken ? "given_" + factor : factor);
  }
  files::CsvTable table(columns);
  for (const auto& s : analysis.specimens) {
    Cells cells{s.specimen.id};
    add_result(s, cells);
    cells.emplace_back(s.group);
    if (records) add_slope(*s.specimen.slope, cells);
    cells.insert(cells.end(), s.specimen.factors.begin(), s.specimen.factors.end());
    table.add_row(cells);
  }
  return table;
}

files::CsvTable group_table(const bondline::Analysis& analysis) {
  files::CsvTable table({"group", "within", "n", "excluded", "compliance_t_mm_per_MPa", "sd_mm_per_MPa",
                         "low_mm_per_MPa", "high_mm_per_MPa", "t", "p", "mean_k_N_per_mm",
                         "compliance_t_of_mean_k_mm_per_MPa"});
  for (const auto& g : analysis.groups) {
    const auto& c = g.compliance_t;
    table.add_row({g.name, g.family, count(c.n), count(g.excluded), cell(c.mean), cell(c.sd), cell(c.low), cell(c.high),
                   cell(c.t), cell(c.p), cell(g.mean_k_N_per_mm), cell(g.compliance_of_mean)});
  }
  return table;
}

files::CsvTable comparison_table(const bondline::Analysis& analysis) {
  files::CsvTable table({"within", "test", "first", "second", "difference_mm_per_MPa", "low_mm_per_MPa",
                         "high_mm_per_MPa", "statistic", "df1", "df2", "p", "p_holm"});
  const files::CsvCell none = std::string();
  for (const auto& family : analysis.families) {
    if (!family.anova) continue;
    const auto& a = *family.anova;
    const auto& w = *family.welch;
    table.add_row({family.name, "anova F", none, none, none, none, none, cell(a.F), count(a.df_between),
                   count(a.df_within), cell(a.p), none});
    table.add_row({family.name, "Welch anova F", none, none, none, none, none, cell(w.F), cell(w.df_between),
                   cell(w.df_within), cell(w.p), none});
    for (const auto& pair : family.pairs)
      table.add_row({family.name, "Welch t, Holm", analysis.groups[family.groups[pair.first]].name,
                     analysis.groups[family.groups[pair.second]].name, cell(pair.difference), cell(pair.low),
                     cell(pair.high), cell(pair.t), cell(pair.df), none, cell(pair.p), cell(pair.p_holm)});
  }
  return table;
}

std::string text_of(const bondline::Analysis& analysis) {
  return excluded_text(analysis) + groups_text(analysis) + comparisons_text(analysis);
}

std::string text_of(const OverlapDesign& design) {
  if (const auto wrong = bondline::fault(design.geometry); !wrong.empty()) throw InputError(wrong);
  const auto& u = design.uncertainty;
  auto text =
      fmt::format("overlap that measures 1/D_t best, for errors of k {:g} %, E {:g} %, t {:g} %, overlap {:g} mm\n",
                  100 * u.k_relative, 100 * u.E_relative, 100 * u.t_relative, u.l_mm);
  text += fmt::format("{:>14}{:>14}{:>22}{:>18}{:>22}{:>12}\n", "1/D_t mm/MPa", "overlap mm", "10 % worse at mm",
                      "error of 1/D_t %", "d ln k/d ln(1/D_t)", "k N/mm");
  for (double compliance_t : design.compliances_t) {
    const auto best =
        bondline::best_overlap(design.geometry, compliance_t, u, design.shortest_mm, design.longest_mm, design.formula);
    text += fmt::format("{:>14g}{:>14.1f}{:>22}{:>18.1f}{:>22.3f}{:>12.0f}\n", compliance_t, best.overlap_mm,
                        fmt::format("{:.1f} to {:.1f}", best.shortest_mm, best.longest_mm),
                        100 * best.relative_uncertainty, best.sensitivity, best.stiffness_N_per_mm);
  }
  return text;
}

}  // namespace strandlab::report
