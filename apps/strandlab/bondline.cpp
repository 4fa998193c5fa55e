// strandlab bondline: glue-line compliance 1/D_t from double-lap-shear tests, its statistics, and the design of such
// tests.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "strandlab/bondline/analysis.hpp"
#include "strandlab/bondline/example.hpp"
#include "strandlab/bondline/plots.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/report/bondline_tables.hpp"
#include "strandlab/report/gnuplot.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string file, folder, records;
  std::string formula = "coth";
  std::vector<std::string> group_by{"group"}, within;
  std::vector<double> window_percent{10, 40}, window_N;
  bondline::Uncertainty uncertainty;
  bool force = false, design = false, example = false;
  std::uint64_t seed = 1;
  // --design
  bondline::Geometry geometry;
  std::vector<double> compliances{0.0021, 0.01048, 0.01628, 0.06536, 0.14645};
  std::vector<double> overlaps{2, 100};
};

// ---- Analysis of tests ---------------------------------------------------------------------------------------------

bondline::SpecimenTable read(const Arguments& a) {
  if (a.records.empty()) return bondline::read_specimens(a.file);
  const bool newtons = !a.window_N.empty();
  const bondline::LoadWindow window =
      newtons ? bondline::LoadWindow{a.window_N[0], a.window_N[1], false}
              : bondline::LoadWindow{a.window_percent[0] / 100, a.window_percent[1] / 100, true};
  return bondline::read_specimens(a.file, bondline::Records{a.records, window});
}

void print_excluded(const bondline::Analysis& analysis) {
  for (const auto& s : analysis.specimens)
    if (!s.excluded.empty())
      print("excluded: {} ({}): {}\n", printable(s.specimen.id), printable(s.specimen.source), printable(s.excluded));
  for (const auto& s : analysis.specimens) {
    if (!s.specimen.slope) continue;
    for (const auto& flag : s.specimen.slope->flags) print("flag: {}: {}\n", printable(s.specimen.id), flag);
  }
}

void print_groups(const bondline::Analysis& analysis) {
  print("{:<24}{:>4}{:>10}{:>12}{:>11}{:>12}{:>12}{:>10}{:>14}\n", "group", "n", "excluded", "1/D_t", "sd", "95 % low",
        "95 % high", "p(0)", "from mean k");
  for (const auto& g : analysis.groups) {
    const auto& c = g.compliance_t;
    print("{:<24}{:>4}{:>10}{:>12.5f}{:>11.5f}{:>12.5f}{:>12.5f}{:>10.3g}{:>14}\n", printable(g.name), c.n, g.excluded,
          c.mean, c.sd, c.low, c.high, c.p,
          g.compliance_of_mean ? fmt::format("{:.5f}", *g.compliance_of_mean) : "none");
  }
  print("1/D_t in mm/MPa; interval: Student's t; p(0): one-sample t-test of 1/D_t = 0\n");
}

void print_comparisons(const bondline::Analysis& analysis) {
  for (const auto& family : analysis.families) {
    const std::string within = family.name.empty() ? "" : printable(family.name) + ": ";
    if (!family.note.empty()) print("{}{}\n", within, family.note);
    if (!family.anova) continue;
    print(
        "{}one-way ANOVA F({}, {}) = {:.4g}, p = {:.3g}; without equal variances (Welch) F({:g}, {:.1f}) = {:.4g}, p = "
        "{:.3g}\n",
        within, family.anova->df_between, family.anova->df_within, family.anova->F, family.anova->p,
        family.welch->df_between, family.welch->df_within, family.welch->F, family.welch->p);
    for (const auto& pair : family.pairs)
      print("  {} - {}: {:.5f} mm/MPa, t = {:.3g}, p = {:.3g}\n",
            printable(analysis.groups[family.groups[pair.first]].name),
            printable(analysis.groups[family.groups[pair.second]].name), pair.difference, pair.t, pair.p_holm);
    print("  pairs: Welch's t-test, p corrected by Holm's method\n");
  }
}

// Number of pictures drawn; the first that cannot be drawn is reported, and the others are not tried.
int draw(const std::vector<bondline::Picture>& pictures, const fs::path& folder) {
  int drawn = 0;
  for (const auto& picture : pictures) {
    if (const auto problem = report::draw_script(picture.script, folder / picture.file_name)) {
      tell(STDERR_FILENO, fmt::format("strandlab: {}\n", *problem));
      return drawn;
    }
    ++drawn;
  }
  return drawn;
}

void write_results(const Arguments& a, const bondline::Analysis& analysis, const fs::path& folder) {
  files::make_folder(folder);
  specimen_table(analysis).write(folder / "specimens.csv");
  group_table(analysis).write(folder / "groups.csv");
  comparison_table(analysis).write(folder / "comparisons.csv");
  const fs::path input = a.file;
  const fs::path json = folder / (input.stem().string() + ".json");
  files::write_atomically(json, bondline::to_json(analysis, input.filename().string()));
  const int plots = draw(bondline::pictures(analysis), folder);
  print("written: {}: specimens.csv, groups.csv, comparisons.csv, {}, {} plots\n", printable(folder.string()),
        printable(json.filename().string()), plots);
}

void analyse(const Arguments& a) {
  const fs::path input = a.file;
  const fs::path folder =
      a.folder.empty() ? fs::path("runs") / (input.stem().string() + "-bondline") : fs::path(a.folder);
  std::error_code error;
  if (!a.force && fs::exists(folder / "specimens.csv", error))
    throw InputError(
        fmt::format("{} holds results; --force overwrites them, -o names another folder", folder.string()));
  bondline::Options options;
  options.formula = bondline::formula_from_name(a.formula);
  options.uncertainty = a.uncertainty;
  options.group_by = a.group_by;
  options.within = a.within;
  const auto analysis = bondline::analyse(read(a), options);
  print_excluded(analysis);
  print_groups(analysis);
  print_comparisons(analysis);
  write_results(a, analysis, folder);
}

// ---- Design of tests -----------------------------------------------------------------------------------------------

void design(const Arguments& a) {
  if (const auto wrong = bondline::fault(a.geometry); !wrong.empty()) throw InputError(wrong);
  const auto formula = bondline::formula_from_name(a.formula);
  const auto& u = a.uncertainty;
  print("overlap that measures 1/D_t best, for errors of k {:g} %, E {:g} %, t {:g} %, overlap {:g} mm\n",
        100 * u.k_relative, 100 * u.E_relative, 100 * u.t_relative, u.l_mm);
  print("{:>14}{:>14}{:>22}{:>18}{:>22}{:>12}\n", "1/D_t mm/MPa", "overlap mm", "10 % worse at mm", "error of 1/D_t %",
        "d ln k/d ln(1/D_t)", "k N/mm");
  for (double compliance : a.compliances) {
    const auto best = bondline::best_overlap(a.geometry, compliance, u, a.overlaps[0], a.overlaps[1], formula);
    print("{:>14g}{:>14.1f}{:>22}{:>18.1f}{:>22.3f}{:>12.0f}\n", compliance, best.overlap_mm,
          fmt::format("{:.1f} to {:.1f}", best.shortest_mm, best.longest_mm), 100 * best.relative_uncertainty,
          best.sensitivity, best.stiffness_N_per_mm);
  }
}

void bond_lines(const Arguments& a) {
  if (a.example) {
    print("{}", bondline::example_table(a.seed));
  } else if (a.design) {
    design(a);
  } else if (a.file.empty()) {
    throw InputError("bondline needs a table of specimens (or --design, or --example)");
  } else {
    analyse(a);
  }
}

// ---- Command line --------------------------------------------------------------------------------------------------

void add_analysis_options(CLI::App& command, Arguments& a) {
  command.add_option(
      "TABLE", a.file,
      "specimens: id, group, E1_MPa, E2_MPa, t1_mm, t2_mm, W_mm, l_mm, L1_mm, L2_mm, k_N_per_mm [G1_MPa, "
      "G2_MPa, u_k_N_per_mm, further columns]; other units convert");
  command.add_option("-o,--output", a.folder, "folder for results (default runs/<table>-bondline)");
  command.add_flag("--force", a.force, "overwrite results in that folder");
  command.add_option("--group-by", a.group_by, "columns that make up a group")->delimiter(',')->capture_default_str();
  command.add_option("--within", a.within, "columns within whose values groups are compared")->delimiter(',');
  command.add_option("--records", a.records,
                     "folder of load-displacement records, <id>.csv or the table's column 'record': k is their slope");
  command.add_option("--window-percent", a.window_percent, "load window of the slope, % of the largest load")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  command.add_option("--window-N", a.window_N, "load window of the slope, N")->delimiter(',')->expected(2);
}

void add_uncertainty_options(CLI::App& command, Arguments& a) {
  const auto not_negative = CLI::Range(0.0, 1e3);
  auto& u = a.uncertainty;
  command.add_option("--u-k", u.k_relative, "relative standard uncertainty of k, where the table gives none")
      ->check(not_negative)
      ->capture_default_str();
  command.add_option("--u-E", u.E_relative, "of the moduli")->check(not_negative)->capture_default_str();
  command.add_option("--u-t", u.t_relative, "of the strand thicknesses")->check(not_negative)->capture_default_str();
  command.add_option("--u-l-mm", u.l_mm, "standard uncertainty of the overlap, mm")
      ->check(not_negative)
      ->capture_default_str();
}

void add_design_options(CLI::App& command, Arguments& a) {
  command.add_flag("--design", a.design, "which overlap measures a given 1/D_t best");
  command.add_option("--compliance-t", a.compliances, "with --design: 1/D_t in mm/MPa, a list")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--overlap-mm", a.overlaps, "with --design: shortest and longest overlap")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  auto& g = a.geometry;
  using Named = std::pair<const char*, double*>;
  for (const auto& [option, value] :
       {Named{"--E1-MPa", &g.E1_MPa}, Named{"--E2-MPa", &g.E2_MPa}, Named{"--t1-mm", &g.t1_mm},
        Named{"--t2-mm", &g.t2_mm}, Named{"--W-mm", &g.W_mm}, Named{"--L1-mm", &g.L1_mm}, Named{"--L2-mm", &g.L2_mm}})
    command.add_option(option, *value, "with --design: of the specimen")->capture_default_str();
}

}  // namespace

void add_bondline(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("bondline", "glue-line compliance 1/D_t from double-lap-shear tests");
  add_analysis_options(*command, *arguments);
  command->add_option("--formula", arguments->formula, "coth, or le2010 as printed in Le (2010)")
      ->capture_default_str();
  add_uncertainty_options(*command, *arguments);
  add_design_options(*command, *arguments);
  command->add_flag("--example", arguments->example, "print a made-up table with published means and scatter");
  command->add_option("--seed", arguments->seed, "with --example: of its random numbers")->capture_default_str();
  command->callback([arguments] { bond_lines(*arguments); });
}

}  // namespace strandlab::app
