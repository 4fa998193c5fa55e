#include "strandlab/vtest/vtest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/bond.hpp"
#include "strandlab/vtest/kinds/test.hpp"
#include "strandlab/vtest/model.hpp"
#include "strandlab/vtest/specimen.hpp"

namespace strandlab::vtest {
namespace {

bool wants(const Options& options, TestKind kind) {
  return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
}

// The kinds asked for, each once, in the order of their list.
std::vector<TestKind> asked_for(const Options& options) {
  auto kinds = all_tests();
  std::erase_if(kinds, [&](TestKind kind) { return !wants(options, kind); });
  return kinds;
}

// Load cases on the same supports, each once.
struct Factor {
  statics::Supports (*supports)(const Model&);
  std::vector<statics::LoadCase> loads;
};

// A test that is asked for: its factor, and which of its load cases are the test's.
struct Planned {
  TestKind kind;
  Setup setup;
  std::size_t factor;
  std::vector<std::size_t> loads;
};

struct Plan {
  std::vector<Factor> factors;
  std::vector<Planned> tests;
};

template <class Items, class Is, class Make>
std::size_t find_or_add(Items& items, Is is, Make make) {
  const auto at = std::find_if(items.begin(), items.end(), is);
  const auto index = static_cast<std::size_t>(at - items.begin());
  if (at == items.end()) items.push_back(make());
  return index;
}

Plan make_plan(const Model& model, const Options& options) {
  Plan plan;
  for (const TestKind kind : asked_for(options)) {
    const auto& test = test_of(kind);
    Planned planned{kind, test.set_up(model, options), 0, {}};
    planned.factor = find_or_add(
        plan.factors, [&](const Factor& f) { return f.supports == test.supports; },
        [&] {
          return Factor{test.supports, {}};
        });
    auto& loads = plan.factors[planned.factor].loads;
    for (const auto& load : planned.setup.loads) {
      planned.loads.push_back(find_or_add(
          loads, [&](const auto& other) { return other == load; }, [&] { return load; }));
    }
    plan.tests.push_back(std::move(planned));
  }
  return plan;
}

// Moduli of the tests in a plan, with the panel as it is glued now. The slips go to `result` where this glue is the
// softest so far.
std::vector<Modulus> carry_out(const Plan& plan, Model& model, double compliance_t,
                               const std::function<void()>& before_solve, statics::SolveTimes& times, Result& result) {
  std::vector<std::vector<statics::Solution<2>>> solutions;
  for (const auto& factor : plan.factors) {
    solutions.push_back(model.bonded.solve(factor.supports(model), factor.loads, times, before_solve));
  }
  std::vector<Modulus> moduli;
  for (const auto& planned : plan.tests) {
    Solutions own;
    for (const auto load : planned.loads) own.push_back(&solutions[planned.factor][load]);
    moduli.push_back(planned.setup.modulus(own));
    moduli.back().compliance_t_mm_per_MPa = compliance_t;
    const auto& test = test_of(planned.kind);
    if (test.slips && (result.slips.empty() || compliance_t > result.slip_compliance_t_mm_per_MPa)) {
      result.slips = test.slips(model, own);
      result.slip_compliance_t_mm_per_MPa = compliance_t;
    }
  }
  return moduli;
}

void refuse_parts(const Model& model, const Options& options) {
  const auto kinds = asked_for(options);
  const bool in_one_piece =
      std::any_of(kinds.begin(), kinds.end(), [](TestKind kind) { return test_of(kind).in_one_piece; });
  if (!in_one_piece || model.connection.groups <= 1) return;
  throw InputError(
      fmt::format("bending on supports needs a panel in one piece; this one is in {} that no glue connects",
                  model.connection.groups));
}

void add_once(const std::vector<std::string>& sentences, std::vector<std::string>& warnings) {
  for (const auto& sentence : sentences) {
    if (std::find(warnings.begin(), warnings.end(), sentence) == warnings.end()) warnings.push_back(sentence);
  }
}

}  // namespace

void check_bonds_and_elements(const std::vector<double>& compliances_t, double compliance_n, int elements_through) {
  if (compliances_t.empty()) throw InputError("no glue compliance 1/D_t is given: give at least one");
  const auto check_number = [](const char* what, double value) {
    if (std::isnan(value)) throw InputError(fmt::format("glue compliance {} is not a number", what));
  };
  for (const double c : compliances_t) check_number("1/D_t", c);
  check_number("1/D_n", compliance_n);
  if (elements_through < 1 || elements_through > kMostElements) {
    throw InputError(
        fmt::format("{} elements through a strand: 1 to {} are possible", elements_through, kMostElements));
  }
}

void check(const Panel<2>& panel, const Options& options) {
  if (panel.strands.empty()) throw InputError("the panel has no strands to test");
  if (options.kinds.empty()) throw InputError("no kind of test is asked for: give at least one of " + allowed_tests());
  check_bonds_and_elements(options.compliance_t_mm_per_MPa, options.compliance_n_mm_per_MPa,
                           options.elements_through_strand);
  if (!(options.perfect_bond >= 10 && options.perfect_bond <= 1e6)) {
    throw InputError(
        fmt::format("a perfect bond of {} times the wood's stiffness: 10 to 1e6 are possible", options.perfect_bond));
  }
  for (const TestKind kind : asked_for(options)) {
    if (test_of(kind).check_mat) test_of(kind).check_mat(panel);
  }
}

void check_ends(const Panel<2>& mat, double compaction) {
  if (can_connect(mat, compaction)) return;
  throw InputError(
      fmt::format("nothing to test in this mat: no glue can connect x = 0 with x = {:g} mm, as strands of one row do "
                  "not bond to one "
                  "another and no strands of other rows bridge their gaps. Add rows (mat.rows, or those of the mat "
                  "file), or strands "
                  "without gaps (kinds.NAME.length_mm = 0 and gap_mm = 0); strandlab press presses the mat as it is",
                  mat.length_mm));
}

double needed_length_mm(const Options& options, double thickness_mm) {
  double needed = 0;
  for (const TestKind kind : asked_for(options)) {
    if (test_of(kind).needed_length_mm)
      needed = std::max(needed, test_of(kind).needed_length_mm(options, thickness_mm));
  }
  return needed;
}

Result measure(const Panel<2>& panel, const Options& options, const std::function<void()>& before_solve) {
  check(panel, options);
  for (const TestKind kind : asked_for(options)) {
    if (test_of(kind).check_panel) test_of(kind).check_panel(panel, options);
  }
  Result result;
  const auto specimen = cut_to_window(panel);
  if (specimen.furthest_mm > 0) {
    result.warnings.push_back(fmt::format(
        "Strands reach up to {:.3g} mm beyond the panel's ends, as free sides let them: the specimen is cut "
        "there, {:.2g} % of the wood and {} whole strands are left out.",
        specimen.furthest_mm, 100 * specimen.cut_fraction, specimen.strands_outside));
  }
  if (specimen.panel.strands.empty()) throw InputError("no strand lies between the ends of the panel");
  Model model = make_model(specimen.panel, options, result);
  refuse_parts(model, options);
  const auto plan = make_plan(model, options);
  statics::SolveTimes times;
  for (const double compliance_t : options.compliance_t_mm_per_MPa) {
    const glue::Bond bond{compliance_t, options.compliance_n_mm_per_MPa};
    add_once(glue::remarks(bond), result.warnings);
    model.bonded.glue(bond, times);
    const auto moduli = carry_out(plan, model, compliance_t, before_solve, times, result);
    for (const TestKind kind : options.kinds) {
      result.moduli.push_back(
          *std::find_if(moduli.begin(), moduli.end(), [kind](const Modulus& m) { return m.kind == kind; }));
    }
  }
  result.assemble_s += times.assemble;
  result.analyse_s = times.analyse;
  result.factor_s = times.factor;
  result.solve_s = times.solve;
  for (auto& slip : result.slips) {
    slip.a = specimen.strand[slip.a];
    slip.b = specimen.strand[slip.b];
  }
  return result;
}

GapSensitivity gap_sensitivity(const Panel<2>& panel, const Options& options,
                               const std::function<void()>& before_solve) {
  const auto usual = measure(panel, options, before_solve);
  const auto largest_change = [&](double factor) {
    auto changed = options;
    changed.curing.max_gap_mm *= factor;
    const auto result = measure(panel, changed, before_solve);
    double change = 0;
    for (std::size_t i = 0; i < usual.moduli.size(); ++i) {
      const double relative = result.moduli[i].modulus_MPa / usual.moduli[i].modulus_MPa - 1;
      if (std::abs(relative) > std::abs(change)) change = relative;
    }
    return change;
  };
  return {largest_change(0.5), largest_change(2)};
}

}  // namespace strandlab::vtest
