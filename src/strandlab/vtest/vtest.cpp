#include "strandlab/vtest/vtest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/beam.hpp"
#include "strandlab/vtest/load_cases.hpp"
#include "strandlab/vtest/window.hpp"

namespace strandlab::vtest {
namespace {

constexpr double kFewFolded = 1e-3;    // of the elements: corners of single strands; judgement
constexpr double kRoundOff = 1e-9;     // of lengths
constexpr double kShortestSpan = 8;    // thicknesses: room for loads at thirds and for half the span
constexpr double kSoftestGlue = 1e-3;  // MPa/mm: below this strands slide freely and the stiffness matrix is singular

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_;
};

bool wants(const Options& options, Kind kind) {
  return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
}

bool on_supports(const Options& options) {
  return wants(options, Kind::kBending3Point) || wants(options, Kind::kBending4Point);
}

void check_span(const Panel<2>& panel, const Options& options) {
  if (!on_supports(options)) return;
  if (!(options.span_to_thickness >= kShortestSpan)) {
    throw InputError(
        fmt::format("a span of {} thicknesses: {:g} or more are possible", options.span_to_thickness, kShortestSpan));
  }
  if (!(options.pad_to_thickness > 0 && options.pad_to_thickness <= 1))
    throw InputError(fmt::format("pads of {} thicknesses: more than 0 and at most 1", options.pad_to_thickness));
  const double needed = needed_length_mm(options, panel.thickness_mm());
  if (panel.length_mm < needed * (1 - kRoundOff)) {
    throw InputError(fmt::format(
        "bending on supports at a span of {:g} thicknesses of {:.2f} mm needs a panel {:.0f} mm long (span and "
        "a thickness beyond either support); this one has {:g} mm",
        options.span_to_thickness, panel.thickness_mm(), std::ceil(needed), panel.length_mm));
  }
}

// Stiffness of a glue line of compliance 1/D, between that of a perfect bond and the floor. Says what it changed.
double glue_stiffness(const char* symbol, double compliance, double perfect, std::vector<std::string>& warnings) {
  std::string warning;
  double stiffness = compliance > 0 ? std::min(1 / compliance, perfect) : perfect;
  if (compliance < 0) {
    warning = fmt::format("The glue compliance 1/{} = {} mm/MPa is negative; it is taken as a perfect bond.", symbol,
                          compliance);
  } else if (stiffness < kSoftestGlue) {
    stiffness = kSoftestGlue;
    warning =
        fmt::format("The glue stiffness {} = {:.3g} MPa/mm is raised to {} MPa/mm to keep the panel in one piece.",
                    symbol, 1 / compliance, kSoftestGlue);
  }
  if (!warning.empty() && std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
    warnings.push_back(warning);
  return stiffness;
}

// A panel ready to be tested: everything that does not depend on the glue.
struct Model {
  Connection connection;
  statics::Mesh mesh;
  Section section;
  std::vector<glue::GluePoint<2>> points;  // of strands that are kept
  std::optional<statics::PanelStiffness> stiffness;
  double perfect = 0;  // MPa/mm
};

Model make_model(const Panel<2>& panel, const Options& options, Result& result) {
  const Stopwatch watch(result.assemble_s);
  Model model;
  const double spacing = statics::element_length(panel, options.elements_through_strand);
  auto curing = options.curing;
  if (curing.point_spacing_mm == 0) curing.point_spacing_mm = spacing;
  auto points = glue::cure(panel, curing);
  double glued = 0;
  for (const auto& point : points) glued += point.area;
  const double facing = glue::facing_length(panel);
  // Glue lines are measured on the lower strand's face: where that is the longer of the two the sum may pass 1.
  result.glued_fraction = facing > 0 ? std::min(1.0, 2 * glued / facing) : 0;

  model.connection = connect(panel, points);
  const auto& group = model.connection.group;
  if (model.connection.groups == 0)
    throw InputError("no strands connect the two ends of the panel: there is nothing to test");
  result.strands = static_cast<int>(group.size());
  result.floating_strands = model.connection.floating;
  std::erase_if(points, [&](const auto& point) { return group[point.a.strand] < 0; });

  std::vector<bool> keep(group.size());
  std::transform(group.begin(), group.end(), keep.begin(), [](int g) { return g >= 0; });
  model.mesh = statics::make_mesh(panel, keep, options.elements_through_strand);
  model.section = make_section(panel, model.connection, model.mesh);
  std::vector<bool> at_end(model.mesh.nodes.size());
  for (const int n : model.section.left) at_end[n] = true;
  for (const int n : model.section.right) at_end[n] = true;
  model.stiffness.emplace(model.mesh, statics::make_springs(model.mesh, points, at_end));
  result.unknowns = model.mesh.dofs();
  if (model.mesh.straightened > kFewFolded * static_cast<double>(model.mesh.elements.size())) {
    result.warnings.push_back(
        fmt::format("{} of {} elements were folded over, as dragged strand corners are, and were straightened.",
                    model.mesh.straightened, model.mesh.elements.size()));
  }
  model.points = std::move(points);
  double stiffest = 0;
  for (const auto& c : model.mesh.stiffness) stiffest = std::max(stiffest, c.diagonal().maxCoeff());
  model.perfect = options.perfect_bond * stiffest / spacing;
  return model;
}

// One glue stiffness being tested.
struct Trial {
  const Model& model;
  statics::GlueStiffness glue;     // MPa/mm, that of a penalty where the bond is perfect
  bool perfect_t, perfect_n;       // such bonds open by nothing: their tractions are found besides the penalty
  statics::LowerMatrix stiffness;  // of wood and glue
  double compliance_t = 0;         // mm/MPa, as asked for
  std::function<void()> before_solve{};
};

// Displacements, and the tractions that perfect bonds carry in excess of their penalty springs.
struct Response {
  std::vector<double> displacement;
  std::vector<Vec<2>> excess;

  void add(double factor, const Response& other) {
    for (std::size_t i = 0; i < displacement.size(); ++i) displacement[i] += factor * other.displacement[i];
    for (std::size_t k = 0; k < excess.size(); ++k) excess[k] += factor * other.excess[k];
  }
};

double energy(const Trial& trial, const Response& r) {
  const auto& stiffness = *trial.model.stiffness;
  return stiffness.wood_energy(r.displacement) + stiffness.glue_energy(r.displacement, trial.glue) +
         0.5 * stiffness.traction_work(r.excess, r.displacement);
}

// Nodal forces that hold the panel in this state: reactions and loads.
std::vector<double> forces(const Trial& trial, const Response& r) {
  auto f = statics::multiply(trial.stiffness, r.displacement);
  trial.model.stiffness->add_traction_forces(r.excess, f);
  return f;
}

// Hands the tractions of perfect bonds' penalty springs over to the excess; returns the largest of them, relative to
// the largest excess.
double hand_over(const Trial& trial, Response& r) {
  double change = 0, largest = std::numeric_limits<double>::min();
  const auto jumps = trial.model.stiffness->jumps(r.displacement);
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    const Vec<2> more(trial.perfect_t ? trial.glue.tangential * jumps[k][0] : 0,
                      trial.perfect_n ? trial.glue.normal * jumps[k][1] : 0);
    r.excess[k] += more;
    change = std::max(change, more.cwiseAbs().maxCoeff());
    largest = std::max(largest, r.excess[k].cwiseAbs().maxCoeff());
  }
  return change / largest;
}

// Solves one load case by the method of multipliers: what a perfect bond's penalty spring carries is handed over to its
// traction until the spring is idle, so that the penalty leaves no trace; each step refines the linear solution too.
// One factor serves all.
Response respond(const Trial& trial, const statics::LowerMatrix& matrix, const statics::Supports& supports,
                 const std::vector<double>& rhs, statics::Cholesky& cholesky) {
  constexpr int kLeastSteps = 2, kMostSteps = 10;
  constexpr double kSettled = 1e-4,
                   kStalled = 0.5;  // tractions change by less than this; no longer fall by this (round-off)
  Response r{cholesky.solve(rhs), {}};
  r.excess.assign(trial.model.stiffness->jumps(r.displacement).size(), Vec<2>::Zero());
  double previous = 1;
  for (int step = 1; step <= kMostSteps; ++step) {
    const double change = hand_over(trial, r);
    std::vector<double> held(rhs.size(), 0.0);
    trial.model.stiffness->add_traction_forces(r.excess, held);
    auto residual = statics::multiply(matrix, r.displacement);
    for (std::size_t i = 0; i < held.size(); ++i)
      residual[i] = rhs[i] - residual[i] - (supports.fixed[i] ? 0.0 : held[i]);
    const auto correction = cholesky.solve(residual);
    for (std::size_t i = 0; i < held.size(); ++i) r.displacement[i] += correction[i];
    if (step >= kLeastSteps && (change < kSettled || change > kStalled * previous)) break;
    previous = change;
  }
  return r;
}

using Vectors = std::vector<std::vector<double>>;

// Responses to forces and given displacements, one pair for each load case, on the same supports.
std::vector<Response> respond(const Trial& trial, const statics::Supports& supports, const Vectors& loads,
                              const Vectors& given, statics::Cholesky& cholesky, Result& result) {
  if (trial.before_solve) trial.before_solve();
  statics::LowerMatrix matrix;
  {
    const Stopwatch watch(result.factor_s);
    matrix = statics::constrained(trial.stiffness, supports);
    cholesky.factorise(matrix);
  }
  const Stopwatch watch(result.solve_s);
  std::vector<Response> responses;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (k > 0 && trial.before_solve) trial.before_solve();
    const auto rhs = statics::right_hand_side(trial.stiffness, supports, loads[k], given[k]);
    responses.push_back(respond(trial, matrix, supports, rhs, cholesky));
  }
  return responses;
}

Modulus tension(const Trial& trial, const Response& stretch) {
  const auto& s = trial.model.section;
  const double factor = s.length / s.thickness;  // for a stretch of 1 mm
  Modulus modulus{Kind::kTension};
  modulus.modulus_MPa = 2 * energy(trial, stretch) * factor;
  modulus.reaction_modulus_MPa = right_resultant(s, forces(trial, stretch)).force * factor;
  return modulus;
}

// Slips of the stretch of 1 mm.
std::vector<GlueSlip> slips_of(const Model& model, const Response& stretch) {
  const auto jumps = model.stiffness->jumps(stretch.displacement);
  std::vector<GlueSlip> slips;
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const auto& p = model.points[k];
    slips.push_back({p.a.strand, p.b.strand, 0.5 * (p.a.position + p.b.position), -jumps[k][0] * model.section.length});
  }
  return slips;
}

// The stretch that takes the axial force off the rotation is added to it.
Modulus end_rotation(const Trial& trial, const Response& stretch, const Response& rotation) {
  const auto& s = trial.model.section;
  const double q =
      -right_resultant(s, forces(trial, rotation)).force / right_resultant(s, forces(trial, stretch)).force;
  auto bent = rotation;
  bent.add(q, stretch);
  const double factor = s.length / s.second_moment();  // for a rotation of 1 rad
  Modulus modulus{Kind::kBendingEndRotation};
  modulus.modulus_MPa = 2 * energy(trial, bent) * factor;
  modulus.reaction_modulus_MPa = right_resultant(s, forces(trial, bent)).moment * factor;
  return modulus;
}

// The rotation that the couple works through and the moment that arrives at the clamp give the modulus from reactions.
Modulus end_couple(const Trial& trial, const std::vector<double>& couple, const Response& bent) {
  const auto& s = trial.model.section;
  double rotation = 0;  // work of a couple of 1 N mm
  for (std::size_t i = 0; i < couple.size(); ++i) rotation += couple[i] * bent.displacement[i];
  Modulus modulus{Kind::kBendingEndCouple};
  modulus.modulus_MPa = s.length / (2 * energy(trial, bent) * s.second_moment());
  modulus.reaction_modulus_MPa =
      -left_resultant(s, forces(trial, bent)).moment * s.length / (rotation * s.second_moment());
  return modulus;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Energy that one state's forces spend on another's displacements: from U(a + s b) - U(a - s b) = 2 s (a, b), with s
// such that both weigh alike.
double mutual_energy(const Trial& trial, const Response& a, const Response& b) {
  const double s = std::sqrt(energy(trial, a) / energy(trial, b));
  auto sum = a, difference = a;
  sum.add(s, b);
  difference.add(-s, b);
  return (energy(trial, sum) - energy(trial, difference)) / (2 * s);
}

// Responses to a beam test's loads, and to unit forces on what is read off.
struct BeamResponse {
  const BeamTest* test;
  const Response *loaded, *deflection, *gauge;
};

Modulus apparent(Kind kind, const Trial& trial, const BeamResponse& r) {
  const auto& section = trial.model.section;
  Modulus modulus{kind};
  modulus.modulus_MPa = apparent_modulus(*r.test, section, mutual_energy(trial, *r.loaded, *r.deflection));
  modulus.reaction_modulus_MPa = apparent_modulus(*r.test, section, dot(r.test->deflection, r.loaded->displacement));
  return modulus;
}

// The tests on supports share one factor: loads in balance need no supports but against rigid motion.
std::vector<Modulus> bend_on_supports(const Trial& trial, const Options& options, statics::Cholesky& cholesky,
                                      Result& result) {
  const auto& mesh = trial.model.mesh;
  const auto& section = trial.model.section;
  const double span = options.span_to_thickness * section.thickness, pad = options.pad_to_thickness * section.thickness;
  std::vector<BeamTest> tests;
  if (wants(options, Kind::kBending3Point)) {
    tests.push_back(three_point(section, mesh, span, pad));
    tests.push_back(three_point(section, mesh, 0.5 * span, pad));
  }
  if (wants(options, Kind::kBending4Point)) tests.push_back(four_point(section, mesh, span, pad));
  Vectors loads;
  for (const auto& test : tests) {
    loads.push_back(test.forces);
    loads.push_back(test.deflection);
    if (!test.gauge.empty()) loads.push_back(test.gauge);
  }
  const std::vector<double> none(static_cast<std::size_t>(mesh.dofs()), 0.0);
  const auto r = respond(trial, rigid_motion_supports(mesh, trial.stiffness), loads, Vectors(loads.size(), none),
                         cholesky, result);
  std::vector<Modulus> moduli;
  std::size_t next = 0;
  if (wants(options, Kind::kBending3Point)) {
    auto modulus = apparent(Kind::kBending3Point, trial, {&tests[0], &r[0], &r[1], nullptr});
    const auto half = apparent(Kind::kBending3Point, trial, {&tests[1], &r[2], &r[3], nullptr});
    modulus.shear_free_modulus_MPa = modulus_without_shear(span, modulus.modulus_MPa, 0.5 * span, half.modulus_MPa);
    moduli.push_back(modulus);
    next = 4;
  }
  if (wants(options, Kind::kBending4Point)) {
    const BeamResponse bent{&tests.back(), &r[next], &r[next + 1], &r[next + 2]};
    moduli.push_back(apparent(Kind::kBending4Point, trial, bent));
    moduli.back().shear_free_modulus_MPa =
        gauge_modulus(*bent.test, section, mutual_energy(trial, *bent.loaded, *bent.gauge));
  }
  return moduli;
}

int strands_at_right_end(const Panel<2>& panel) {
  const auto at_right = connect(panel, {}).at_right;
  return static_cast<int>(std::count(at_right.begin(), at_right.end(), true));
}

std::vector<Modulus> measure_kinds(const Trial& trial, const Options& options, statics::Cholesky& cholesky,
                                   Result& result) {
  const auto& section = trial.model.section;
  const std::vector<double> none(static_cast<std::size_t>(trial.model.mesh.dofs()), 0.0);
  std::vector<Modulus> found;
  if (wants(options, Kind::kTension) || wants(options, Kind::kBendingEndRotation)) {
    Vectors given{end_displacement(section, 1, 0)};
    if (wants(options, Kind::kBendingEndRotation)) given.push_back(end_displacement(section, 0, 1));
    const auto supports = end_plane_supports(section, trial.stiffness);
    const auto r = respond(trial, supports, Vectors(given.size(), none), given, cholesky, result);
    found.push_back(tension(trial, r[0]));
    if (wants(options, Kind::kTension) &&
        (result.slips.empty() || trial.compliance_t > result.slip_compliance_t_mm_per_MPa)) {
      result.slips = slips_of(trial.model, r[0]);
      result.slip_compliance_t_mm_per_MPa = trial.compliance_t;
    }
    if (r.size() > 1) found.push_back(end_rotation(trial, r[0], r[1]));
  }
  if (wants(options, Kind::kBendingEndCouple)) {
    const auto couple = couple_forces(trial.model.connection, trial.model.mesh);
    const auto r = respond(trial, clamped_supports(section, trial.stiffness), {couple}, {none}, cholesky, result);
    found.push_back(end_couple(trial, couple, r[0]));
  }
  if (on_supports(options)) {
    const auto bent = bend_on_supports(trial, options, cholesky, result);
    found.insert(found.end(), bent.begin(), bent.end());
  }
  std::vector<Modulus> moduli;
  for (const Kind kind : options.kinds) {
    moduli.push_back(*std::find_if(found.begin(), found.end(), [kind](const Modulus& m) { return m.kind == kind; }));
  }
  return moduli;
}

}  // namespace

void check(const Panel<2>& panel, const Options& options) {
  if (panel.strands.empty()) throw InputError("the panel has no strands to test");
  if (options.kinds.empty()) throw InputError("no kind of test is asked for: give at least one of " + allowed_kinds());
  if (options.compliance_t_mm_per_MPa.empty()) throw InputError("no glue compliance 1/D_t is given: give at least one");
  const auto check_number = [](const char* what, double value) {
    if (std::isnan(value)) throw InputError(fmt::format("glue compliance {} is not a number", what));
  };
  for (const double c : options.compliance_t_mm_per_MPa) check_number("1/D_t", c);
  check_number("1/D_n", options.compliance_n_mm_per_MPa);
  if (options.elements_through_strand < 1 || options.elements_through_strand > kMostElements) {
    throw InputError(fmt::format("{} elements through a strand: 1 to {} are possible", options.elements_through_strand,
                                 kMostElements));
  }
  if (!(options.perfect_bond >= 10 && options.perfect_bond <= 1e6)) {
    throw InputError(
        fmt::format("a perfect bond of {} times the wood's stiffness: 10 to 1e6 are possible", options.perfect_bond));
  }
  if (wants(options, Kind::kBendingEndCouple) && strands_at_right_end(panel) < 2) {
    throw InputError("bending by an end couple needs two strands at the loaded end, the mat has fewer");
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

Result measure(const Panel<2>& panel, const Options& options, const std::function<void()>& before_solve) {
  check(panel, options);
  check_span(panel, options);
  Result result;
  const auto specimen = cut_to_window(panel);
  if (specimen.furthest_mm > 0) {
    result.warnings.push_back(fmt::format(
        "Strands reach up to {:.3g} mm beyond the panel's ends, as free sides let them: the specimen is cut "
        "there, {:.2g} % of the wood and {} whole strands are left out.",
        specimen.furthest_mm, 100 * specimen.cut_fraction, specimen.strands_outside));
  }
  if (specimen.panel.strands.empty()) throw InputError("no strand lies between the ends of the panel");
  const Model model = make_model(specimen.panel, options, result);
  if (on_supports(options) && model.connection.groups > 1) {
    throw InputError(
        fmt::format("bending on supports needs a panel in one piece; this one is in {} that no glue connects",
                    model.connection.groups));
  }
  std::optional<statics::Cholesky> cholesky;
  const double normal = glue_stiffness("D_n", options.compliance_n_mm_per_MPa, model.perfect, result.warnings);
  for (const double compliance : options.compliance_t_mm_per_MPa) {
    const double tangential = glue_stiffness("D_t", compliance, model.perfect, result.warnings);
    Trial trial{model,      {tangential, normal}, tangential == model.perfect, normal == model.perfect, {},
                compliance, before_solve};
    {
      const Stopwatch watch(result.assemble_s);
      trial.stiffness = model.stiffness->with(trial.glue);
    }
    if (!cholesky) {
      const Stopwatch watch(result.analyse_s);
      cholesky.emplace(trial.stiffness);
    }
    for (auto& modulus : measure_kinds(trial, options, *cholesky, result)) {
      modulus.compliance_t_mm_per_MPa = compliance;
      result.moduli.push_back(modulus);
    }
  }
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
