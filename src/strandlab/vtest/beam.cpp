#include "strandlab/vtest/beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "strandlab/core/error.hpp"

namespace strandlab::vtest {
namespace {

constexpr double kRoundOff = 1e-9;   // of lengths
constexpr double kShortestSpan = 8;  // thicknesses: room for loads at thirds and for half the span

// A place on the line between two nodes.
struct Place {
  int first = 0, second = 0;
  double xi = 0;  // 0 at the first
  double y = 0;   // mm
};

// Where the line of nodes j of a strand crosses the section at x; nothing where it does not reach it.
std::optional<Place> crossing(const statics::Mesh<2>& mesh, const statics::StrandMesh<2>& strand, int j, double x) {
  for (int i = 0; i < strand.along(); ++i) {
    const int a = strand.node(i, j), b = strand.node(i + 1, j);
    const double xa = mesh.nodes[a][0], xb = mesh.nodes[b][0];
    if (x < std::min(xa, xb) || x > std::max(xa, xb) || xa == xb) continue;
    const double xi = (x - xa) / (xb - xa);
    return Place{a, b, xi, (1 - xi) * mesh.nodes[a][1] + xi * mesh.nodes[b][1]};
  }
  return std::nullopt;
}

void add_at(const Place& place, double value, std::vector<double>& vector) {
  vector[2 * place.first + 1] += (1 - place.xi) * value;
  vector[2 * place.second + 1] += place.xi * value;
}

[[noreturn]] void no_wood(const char* what, double x) {
  throw InputError(fmt::format("bending on supports: there is no wood {} x = {:.2f} mm", what, x));
}

// Adds the nodal forces of a pad pressed on the panel: a vertical force (N, positive up) spread over `width` mm around
// x as 1 + cos, on the topmost (or lowest) wood at each place. Its resultant is `force` at x, exactly.
enum class PadOn { kTop, kBottom };
void add_pad(const statics::Mesh<2>& mesh, PadOn face, double x, double width, double force,
             std::vector<double>& forces) {
  constexpr int kSamples = 100;
  const double sign = face == PadOn::kTop ? 1 : -1;
  for (int k = 0; k < kSamples; ++k) {
    const double t = (k + 0.5) / kSamples - 0.5;  // of the width; the weights sum to 1
    std::optional<Place> outermost;
    for (const auto& strand : mesh.strands) {
      const auto place = crossing(mesh, strand, face == PadOn::kTop ? strand.through() : 0, x + t * width);
      if (place && (!outermost || sign * (place->y - outermost->y) > 0)) outermost = place;
    }
    if (!outermost) no_wood("under a pad at", x);
    add_at(*outermost, force * (1 + std::cos(2 * M_PI * t)) / kSamples, forces);
  }
}

// Adds `factor` times the deflection of the cross section at x.
void add_deflection(const statics::Mesh<2>& mesh, double x, double factor, std::vector<double>& form) {
  struct Layer {
    Place lower, upper;
    double height;
  };
  std::vector<Layer> layers;
  double total = 0;
  for (const auto& strand : mesh.strands) {
    auto lower = crossing(mesh, strand, 0, x);
    for (int j = 0; j < strand.through(); ++j) {
      const auto upper = crossing(mesh, strand, j + 1, x);
      if (lower && upper) {
        layers.push_back({*lower, *upper, std::abs(upper->y - lower->y)});
        total += layers.back().height;
      }
      lower = upper;
    }
  }
  if (!(total > 0)) no_wood("in the section at", x);
  for (const auto& layer : layers) {
    const double share = 0.5 * factor * layer.height / total;
    add_at(layer.lower, share, form);
    add_at(layer.upper, share, form);
  }
}

double middle_of(const Model& model) {
  return 0.5 * model.section.length;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double apparent_modulus(const BeamTest& test, const Section& section, double deflection) {
  const double a = test.arm;
  return a * (3 * test.span * test.span - 4 * a * a) / (48 * section.second_moment() * deflection);
}

}  // namespace

double span_mm(const Model& model, const Options& options) {
  return options.span_to_thickness * model.section.thickness;
}
double pad_mm(const Model& model, const Options& options) {
  return options.pad_to_thickness * model.section.thickness;
}

double length_for_span_mm(const Options& options, double thickness_mm) {
  return (options.span_to_thickness + 2) * thickness_mm;
}

void check_span(const Panel<2>& panel, const Options& options) {
  if (!(options.span_to_thickness >= kShortestSpan)) {
    throw InputError(
        fmt::format("a span of {} thicknesses: {:g} or more are possible", options.span_to_thickness, kShortestSpan));
  }
  if (!(options.pad_to_thickness > 0 && options.pad_to_thickness <= 1))
    throw InputError(fmt::format("pads of {} thicknesses: more than 0 and at most 1", options.pad_to_thickness));
  const double needed = length_for_span_mm(options, panel.thickness_mm());
  if (panel.length_mm < needed * (1 - kRoundOff)) {
    throw InputError(fmt::format(
        "bending on supports at a span of {:g} thicknesses of {:.2f} mm needs a panel {:.0f} mm long (span and "
        "a thickness beyond either support); this one has {:g} mm",
        options.span_to_thickness, panel.thickness_mm(), std::ceil(needed), panel.length_mm));
  }
}

statics::Supports rigid_motion_supports(const Model& model) {
  const auto& mesh = model.mesh;
  auto supports = no_supports(model.bonded.stiffness());
  const auto [left, right] = std::minmax_element(mesh.nodes.begin(), mesh.nodes.end(),
                                                 [](const Vec<2>& a, const Vec<2>& b) { return a[0] < b[0]; });
  const auto first = static_cast<std::size_t>(left - mesh.nodes.begin());
  const auto last = static_cast<std::size_t>(right - mesh.nodes.begin());
  supports.fixed[2 * first] = supports.fixed[2 * first + 1] = supports.fixed[2 * last + 1] = 1;
  return supports;
}

std::vector<double> sag(const Model& model, double length) {
  auto form = nothing(model);
  const double middle = middle_of(model);
  add_deflection(model.mesh, middle, -1, form);
  add_deflection(model.mesh, middle - 0.5 * length, 0.5, form);
  add_deflection(model.mesh, middle + 0.5 * length, 0.5, form);
  return form;
}

BeamTest supported(const Model& model, double span, double arm, double pad) {
  BeamTest test{nothing(model), {}, span, arm};
  for (const double side : {-1.0, 1.0})
    add_pad(model.mesh, PadOn::kBottom, middle_of(model) + side * 0.5 * span, pad, 0.5, test.forces);
  test.deflection = sag(model, span);
  return test;
}

void add_load(const Model& model, double offset, double pad, double load, BeamTest& test) {
  add_pad(model.mesh, PadOn::kTop, middle_of(model) + offset, pad, -load, test.forces);
}

statics::LoadCase force_load(const BeamTest& test) {
  return {test.forces, std::vector<double>(test.forces.size(), 0.0)};
}
statics::LoadCase deflection_load(const BeamTest& test) {
  return {test.deflection, std::vector<double>(test.deflection.size(), 0.0)};
}

// From U(a + s b) - U(a - s b) = 2 s (a, b), with s such that both weigh alike.
double mutual_energy(const statics::BondedPanel<2>& panel, const statics::Solution<2>& a,
                     const statics::Solution<2>& b) {
  const double s = std::sqrt(panel.energy(a) / panel.energy(b));
  auto sum = a, difference = a;
  sum.add(s, b);
  difference.add(-s, b);
  return (panel.energy(sum) - panel.energy(difference)) / (2 * s);
}

void apparent(const Model& model, const BeamTest& test, const statics::Solution<2>& loaded,
              const statics::Solution<2>& deflection, Modulus& modulus) {
  modulus.modulus_MPa = apparent_modulus(test, model.section, mutual_energy(model.bonded, loaded, deflection));
  modulus.reaction_modulus_MPa = apparent_modulus(test, model.section, dot(test.deflection, loaded.displacement));
}

}  // namespace strandlab::vtest
