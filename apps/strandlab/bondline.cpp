// strandlab bondline: glue-line compliance 1/D_t from double-lap-shear tests, its statistics, and the design of such
// tests.
#include "strandlab/run/bondline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "strandlab/bondline/analysis.hpp"
#include "strandlab/bondline/example.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/report/bondline_tables.hpp"
#include "strandlab/run/results.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;

struct BondlineArguments {
  std::string file, folder, records;
  std::string formula = "coth";
  std::vector<std::string> group_by{"group"}, within;
  std::vector<double> window_percent{10, 40}, window_N;
  bondline::Uncertainty uncertainty;
  bool force = false, design = false, example = false;
  std::uint64_t seed = 1;
  report::OverlapDesign overlap;
  std::vector<double> overlaps{overlap.shortest_mm, overlap.longest_mm};
};

bondline::SpecimenTable read(const BondlineArguments& a) {
  if (a.records.empty()) return bondline::read_specimens(a.file);
  const bool newtons = !a.window_N.empty();
  const bondline::LoadWindow window =
      newtons ? bondline::LoadWindow{a.window_N[0], a.window_N[1], false}
              : bondline::LoadWindow{a.window_percent[0] / 100, a.window_percent[1] / 100, true};
  return bondline::read_specimens(a.file, bondline::Records{a.records, window});
}

void analyse(const BondlineArguments& a) {
  const auto folder = a.folder.empty() ? run::bondline_folder(a.file) : fs::path(a.folder);
  run::refuse_results(folder / "specimens.csv", a.force);
  bondline::Options options;
  options.formula = bondline::formula_from_name(a.formula);
  options.uncertainty = a.uncertainty;
  options.group_by = a.group_by;
  options.within = a.within;
  const auto analysis = bondline::analyse(read(a), options);
  print("{}", report::text_of(analysis));
  const auto written = run::write(analysis, a.file, folder);
  for (const auto& warning : written.warnings) warn(warning);
  print("written: {}: {}, {} plots\n", printable(folder.string()),
        printable(fmt::format("{}", fmt::join(written.files, ", "))), written.plots);
}

void design(const BondlineArguments& a) {
  auto overlap = a.overlap;
  overlap.formula = bondline::formula_from_name(a.formula);
  overlap.uncertainty = a.uncertainty;
  overlap.shortest_mm = a.overlaps[0];
  overlap.longest_mm = a.overlaps[1];
  print("{}", report::text_of(overlap));
}

void bond_lines(const BondlineArguments& a) {
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

void add_analysis_options(CLI::App& command, BondlineArguments& a) {
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

void add_uncertainty_options(CLI::App& command, BondlineArguments& a) {
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

void add_design_options(CLI::App& command, BondlineArguments& a) {
  command.add_flag("--design", a.design, "which overlap measures a given 1/D_t best");
  command.add_option("--compliance-t", a.overlap.compliances_t, "with --design: 1/D_t in mm/MPa, a list")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--overlap-mm", a.overlaps, "with --design: shortest and longest overlap")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  auto& g = a.overlap.geometry;
  using Named = std::pair<const char*, double*>;
  for (const auto& [option, value] :
       {Named{"--E1-MPa", &g.E1_MPa}, Named{"--E2-MPa", &g.E2_MPa}, Named{"--t1-mm", &g.t1_mm},
        Named{"--t2-mm", &g.t2_mm}, Named{"--W-mm", &g.W_mm}, Named{"--L1-mm", &g.L1_mm}, Named{"--L2-mm", &g.L2_mm}})
    command.add_option(option, *value, "with --design: of the specimen")->capture_default_str();
}

}  // namespace

void add_bondline(CLI::App& app) {
  auto arguments = std::make_shared<BondlineArguments>();
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
