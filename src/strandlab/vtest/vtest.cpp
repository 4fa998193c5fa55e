#include "strandlab/vtest/vtest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/load_cases.hpp"

namespace strandlab::vtest {
namespace {

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

void check(const Panel<2>& panel, const Options& options) {
  if (panel.strands.empty()) throw InputError("the panel has no strands to test");
  if (options.kinds.empty()) throw InputError("no kind of test is asked for: give at least one of " + allowed_kinds());
  if (options.compliance_t_mm_per_MPa.empty()) throw InputError("no glue compliance 1/D_t is given: give at least one");
  const auto check_number = [](const char* what, double value) {
    if (std::isnan(value)) throw InputError(fmt::format("glue compliance {} is not a number", what));
  };
  for (const double c : options.compliance_t_mm_per_MPa) check_number("1/D_t", c);
  check_number("1/D_n", options.compliance_n_mm_per_MPa);
  if (options.elements_through_strand < 1 || options.elements_through_strand > 48) {
    throw InputError(
        fmt::format("{} elements through a strand: 1 to 48 are possible", options.elements_through_strand));
  }
  if (!(options.perfect_bond >= 10 && options.perfect_bond <= 1e6)) {
    throw InputError(
        fmt::format("a perfect bond of {} times the wood's stiffness: 10 to 1e6 are possible", options.perfect_bond));
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
  result.glued_fraction = facing > 0 ? 2 * glued / facing : 0;

  model.connection = connect(panel, points);
  const auto& group = model.connection.group;
  if (model.connection.groups == 0)
    throw InputError("no strands connect the two ends of the panel: there is nothing to test");
  result.floating_strands = model.connection.floating;
  if (result.floating_strands > 0) {
    result.warnings.push_back(fmt::format("{} of {} strands are not glued to both loaded ends and are left out.",
                                          result.floating_strands, group.size()));
  }
  std::erase_if(points, [&](const auto& point) { return group[point.a.strand] < 0; });

  std::vector<bool> keep(group.size());
  std::transform(group.begin(), group.end(), keep.begin(), [](int g) { return g >= 0; });
  model.mesh = statics::make_mesh(panel, keep, options.elements_through_strand);
  model.section = make_section(panel, model.connection, model.mesh);
  model.stiffness.emplace(model.mesh, statics::make_springs(model.mesh, points));
  result.unknowns = model.mesh.dofs();
  double stiffest = 0;
  for (const auto& c : model.mesh.stiffness) stiffest = std::max(stiffest, c.diagonal().maxCoeff());
  model.perfect = options.perfect_bond * stiffest / spacing;
  return model;
}

// One glue stiffness being tested.
struct Trial {
  const Model& model;
  statics::GlueStiffness glue;
  statics::LowerMatrix stiffness;

  double energy(const std::vector<double>& u) const {
    return model.stiffness->wood_energy(u) + model.stiffness->glue_energy(u, glue);
  }
};

using Vectors = std::vector<std::vector<double>>;

// Displacements for forces and given displacements, one pair for each load case.
Vectors solve(const Trial& trial, const statics::Supports& supports, const Vectors& forces, const Vectors& given,
              statics::Cholesky& cholesky, Result& result) {
  statics::LowerMatrix matrix;
  {
    const Stopwatch watch(result.factor_s);
    matrix = statics::constrained(trial.stiffness, supports);
    cholesky.factorise(matrix);
  }
  const Stopwatch watch(result.solve_s);
  Vectors rhs;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    rhs.push_back(statics::right_hand_side(trial.stiffness, supports, forces[k], given[k]));
  }
  return cholesky.solve(matrix, rhs);
}

Modulus tension(const Trial& trial, const std::vector<double>& stretch) {
  const auto& s = trial.model.section;
  const double factor = s.length / s.thickness;  // for a stretch of 1 mm
  const auto end = resultant(s, s.right, statics::multiply(trial.stiffness, stretch));
  Modulus modulus{Kind::kTension};
  modulus.modulus_MPa = 2 * trial.energy(stretch) * factor;
  modulus.reaction_modulus_MPa = end.force * factor;
  return modulus;
}

// The stretch that takes the axial force off the rotation is added to it.
Modulus end_rotation(const Trial& trial, const std::vector<double>& stretch, const std::vector<double>& rotation) {
  const auto& s = trial.model.section;
  const auto of_stretch = resultant(s, s.right, statics::multiply(trial.stiffness, stretch));
  const auto of_rotation = resultant(s, s.right, statics::multiply(trial.stiffness, rotation));
  const double q = -of_rotation.force / of_stretch.force;
  auto u = rotation;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += q * stretch[i];
  const double factor = s.length / s.second_moment();  // for a rotation of 1 rad
  Modulus modulus{Kind::kBendingEndRotation};
  modulus.modulus_MPa = 2 * trial.energy(u) * factor;
  modulus.reaction_modulus_MPa = (of_rotation.moment + q * of_stretch.moment) * factor;
  return modulus;
}

// The rotation that the couple works through and the moment that arrives at the clamp give the modulus from reactions.
Modulus end_couple(const Trial& trial, const std::vector<double>& forces, const std::vector<double>& u) {
  const auto& s = trial.model.section;
  double rotation = 0;  // work of a couple of 1 N mm
  for (std::size_t i = 0; i < u.size(); ++i) rotation += forces[i] * u[i];
  const auto clamp = resultant(s, s.left, statics::multiply(trial.stiffness, u));
  Modulus modulus{Kind::kBendingEndCouple};
  modulus.modulus_MPa = s.length / (2 * trial.energy(u) * s.second_moment());
  modulus.reaction_modulus_MPa = -clamp.moment * s.length / (rotation * s.second_moment());
  return modulus;
}

bool wants(const Options& options, Kind kind) {
  return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
}

std::vector<Modulus> measure_kinds(const Trial& trial, const Options& options, statics::Cholesky& cholesky,
                                   Result& result) {
  const auto& section = trial.model.section;
  const std::vector<double> none(static_cast<std::size_t>(trial.model.mesh.dofs()), 0.0);
  std::optional<Modulus> stretched, rotated, bent;
  if (wants(options, Kind::kTension) || wants(options, Kind::kBendingEndRotation)) {
    Vectors given{end_displacement(section, 1, 0)};
    if (wants(options, Kind::kBendingEndRotation)) given.push_back(end_displacement(section, 0, 1));
    const auto supports = end_plane_supports(section, trial.stiffness);
    const auto u = solve(trial, supports, Vectors(given.size(), none), given, cholesky, result);
    stretched = tension(trial, u[0]);
    if (u.size() > 1) rotated = end_rotation(trial, u[0], u[1]);
  }
  if (wants(options, Kind::kBendingEndCouple)) {
    const Vectors forces{couple_forces(trial.model.connection, trial.model.mesh)};
    const auto u = solve(trial, clamped_supports(section, trial.stiffness), forces, {none}, cholesky, result);
    bent = end_couple(trial, forces[0], u[0]);
  }
  std::vector<Modulus> moduli;
  for (const Kind kind : options.kinds) {
    moduli.push_back(*(kind == Kind::kTension ? stretched : kind == Kind::kBendingEndRotation ? rotated : bent));
  }
  return moduli;
}

}  // namespace

Result measure(const Panel<2>& panel, const Options& options) {
  check(panel, options);
  Result result;
  const Model model = make_model(panel, options, result);
  std::optional<statics::Cholesky> cholesky;
  const double normal = glue_stiffness("D_n", options.compliance_n_mm_per_MPa, model.perfect, result.warnings);
  for (const double compliance : options.compliance_t_mm_per_MPa) {
    Trial trial{model, {glue_stiffness("D_t", compliance, model.perfect, result.warnings), normal}, {}};
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
  return result;
}

GapSensitivity gap_sensitivity(const Panel<2>& panel, const Options& options) {
  const auto usual = measure(panel, options);
  const auto largest_change = [&](double factor) {
    auto changed = options;
    changed.curing.max_gap_mm *= factor;
    const auto result = measure(panel, changed);
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
