// strandlab theory: closed-form estimates of a panel, without a simulation.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/report/estimates.hpp"
#include "strandlab/run/theory_rows.hpp"
#include "strandlab/theory/estimate.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

struct TheoryArguments {
  std::string file, csv, off_axis;
  std::vector<std::string> overrides;
  std::vector<double> compactions, compliances_t;
  theory::Question question;
};

theory::Question question_of(const TheoryArguments& a) {
  if (a.file.empty() && !a.overrides.empty()) throw InputError("--set changes keys of a case; give a case file too");
  const auto c = a.file.empty() ? cases::ready_case("le2010_osb") : cases::read_case(a.file, a.overrides);
  auto q = run::theory_question(c, a.question, a.compactions, a.compliances_t);
  // Of a case the moduli that its virtual tests are drawn beside; without one those of free bars, as published.
  const auto by_default = a.file.empty() ? wood::OffAxis::kUncoupled : c.off_axis;
  q.off_axis = a.off_axis.empty() ? by_default : wood::off_axis_from_name(a.off_axis);
  return q;
}

void estimate(const TheoryArguments& a) {
  const auto q = question_of(a);
  const auto estimates = theory::estimate(q);
  if (a.csv == "-") {
    print("{}", report::estimate_table(estimates).text());
    return;
  }
  print("{}", report::text_of(q, estimates));
  if (!a.csv.empty()) report::estimate_table(estimates).write(a.csv);
}

}  // namespace

void add_theory(CLI::App& app) {
  auto arguments = std::make_shared<TheoryArguments>();
  auto* command = app.add_subcommand("theory", "closed-form estimates of a panel's density and moduli, at once");
  auto& a = *arguments;
  command->add_option("CASE", a.file, "case file (default: the ready case le2010_osb)");
  command->add_option("--set", a.overrides, "change a key of the case, key.path=value");
  command->add_option("--compaction", a.compactions, "list (default: those of the case)")->delimiter(',');
  command->add_option("--compliance-t", a.compliances_t, "1/D_t in mm/MPa, list (default: those of the case)")
      ->delimiter(',');
  command->add_option("--strand-length-mm", a.question.lengths_mm, "of strands along the panel, list")->delimiter(',');
  command->add_option("--gap-mm", a.question.gaps_mm, "between strands along the panel, list")->delimiter(',');
  command->add_option("--density-kg-m3", a.question.densities_kg_m3, "panel densities, list")->delimiter(',');
  command
      ->add_option("--matrix-modulus-MPa", a.question.matrix.modulus_MPa,
                   "of what fills the gaps in the shear-lag model")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--matrix-shear-MPa", a.question.matrix.shear_MPa, "its shear modulus")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option(
      "--offaxis", a.off_axis,
      "rows as free bars (uncoupled) or as a section holds them, in plane strain (exact); default: as the "
      "case has mat.offaxis, uncoupled without a case");
  command->add_option("--csv", a.csv, "also write a table to this file; - prints it instead");
  command->callback([arguments] { estimate(*arguments); });
}

}  // namespace strandlab::app
