#include "strandlab/vtest/beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "strandlab/core/error.hpp"

namespace strandlab::vtest {
namespace {

// A place on the line between two nodes.
struct Place {
  int first = 0, second = 0;
  double xi = 0;  // 0 at the first
  double y = 0;   // mm
};

// Where the line of nodes j of a strand crosses the section at x; nothing where it does not reach it.
std::optional<Place> crossing(const statics::Mesh& mesh, const statics::StrandMesh& strand, int j, double x) {
  for (int i = 0; i < strand.along; ++i) {
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

BeamTest empty_test(const statics::Mesh& mesh, double span, double arm) {
  BeamTest test;
  test.forces.assign(static_cast<std::size_t>(mesh.dofs()), 0.0);
  test.deflection = test.forces;
  test.span = span;
  test.arm = arm;
  return test;
}

// Deflection in the middle against the mean of two sections `length` apart, positive down.
void add_sag(const Beam& beam, double middle, double length, std::vector<double>& form) {
  beam.add_deflection(middle, -1, form);
  beam.add_deflection(middle - 0.5 * length, 0.5, form);
  beam.add_deflection(middle + 0.5 * length, 0.5, form);
}

void add_supports(const Beam& beam, double middle, double pad, BeamTest& test) {
  for (const double side : {-1.0, 1.0})
    beam.add_pad(Beam::Face::kBottom, middle + side * 0.5 * test.span, pad, 0.5, test.forces);
  add_sag(beam, middle, test.span, test.deflection);
}

}  // namespace

void Beam::add_pad(Face face, double x, double width, double force, std::vector<double>& forces) const {
  constexpr int kSamples = 100;
  const double sign = face == Face::kTop ? 1 : -1;
  for (int k = 0; k < kSamples; ++k) {
    const double t = (k + 0.5) / kSamples - 0.5;  // of the width; the weights sum to 1
    std::optional<Place> outermost;
    for (const auto& strand : mesh_.strands) {
      const auto place = crossing(mesh_, strand, face == Face::kTop ? strand.through : 0, x + t * width);
      if (place && (!outermost || sign * (place->y - outermost->y) > 0)) outermost = place;
    }
    if (!outermost) no_wood("under a pad at", x);
    add_at(*outermost, force * (1 + std::cos(2 * M_PI * t)) / kSamples, forces);
  }
}

void Beam::add_deflection(double x, double factor, std::vector<double>& form) const {
  struct Layer {
    Place lower, upper;
    double height;
  };
  std::vector<Layer> layers;
  double total = 0;
  for (const auto& strand : mesh_.strands) {
    auto lower = crossing(mesh_, strand, 0, x);
    for (int j = 0; j < strand.through; ++j) {
      const auto upper = crossing(mesh_, strand, j + 1, x);
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

statics::Supports rigid_motion_supports(const statics::Mesh& mesh, const statics::LowerMatrix& stiffness) {
  auto supports = no_supports(stiffness);
  const auto [left, right] = std::minmax_element(mesh.nodes.begin(), mesh.nodes.end(),
                                                 [](const Vec<2>& a, const Vec<2>& b) { return a[0] < b[0]; });
  const auto first = static_cast<std::size_t>(left - mesh.nodes.begin());
  const auto last = static_cast<std::size_t>(right - mesh.nodes.begin());
  supports.fixed[2 * first] = supports.fixed[2 * first + 1] = supports.fixed[2 * last + 1] = 1;
  return supports;
}

BeamTest three_point(const Section& section, const statics::Mesh& mesh, double span, double pad) {
  auto test = empty_test(mesh, span, 0.5 * span);
  const Beam beam(mesh);
  const double middle = 0.5 * section.length;
  add_supports(beam, middle, pad, test);
  beam.add_pad(Beam::Face::kTop, middle, pad, -1, test.forces);
  return test;
}

BeamTest four_point(const Section& section, const statics::Mesh& mesh, double span, double pad) {
  auto test = empty_test(mesh, span, span / 3);
  const Beam beam(mesh);
  const double middle = 0.5 * section.length, inner = span / 3;
  add_supports(beam, middle, pad, test);
  for (const double side : {-1.0, 1.0})
    beam.add_pad(Beam::Face::kTop, middle + side * 0.5 * inner, pad, -0.5, test.forces);
  test.gauge_length = inner - 2 * section.thickness;
  test.gauge.assign(test.deflection.size(), 0.0);
  add_sag(beam, middle, test.gauge_length, test.gauge);
  return test;
}

double apparent_modulus(const BeamTest& test, const Section& section, double deflection) {
  const double a = test.arm;
  return a * (3 * test.span * test.span - 4 * a * a) / (48 * section.second_moment() * deflection);
}

double gauge_modulus(const BeamTest& test, const Section& section, double deflection) {
  return test.arm * test.gauge_length * test.gauge_length / (16 * section.second_moment() * deflection);
}

double modulus_without_shear(double long_span, double long_modulus, double short_span, double short_modulus) {
  const double l = long_span * long_span, s = short_span * short_span;
  return (l - s) / (l / long_modulus - s / short_modulus);
}

}  // namespace strandlab::vtest
