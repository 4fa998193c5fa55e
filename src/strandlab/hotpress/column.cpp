#include "strandlab/hotpress/column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/wood/return_map.hpp"

namespace strandlab::hotpress {
namespace {

constexpr double kLargestStress = 1e10;  // Pa
constexpr double kMPa = 1e6;             // Pa

// H and dH/dx at the x that a plastic strain leaves, with x never less than it was.
struct Radius {
  double value, slope;  // slope by plastic compression
};
Radius radius(const wood::Crushing::Hardening& h, double collapsed, double plastic) {
  const double left = (1 - h.start()) * std::exp(plastic), x = 1 - left;
  double slope = 0;
  const double value = wood::Crushing::radius<wood::ScalarOps>(h, std::max(x, collapsed), slope);
  return {value, x > collapsed ? slope * left : 0};
}

}  // namespace

Layer layer_of(const wood::Material& material, double thickness) {
  return {thickness, kMPa * material.E_R, kMPa * material.crushing.Y_R, wood::Crushing::hardening(material)};
}

Column::Column(std::vector<Layer> layers, wood::RateEffect rate) : layers_(std::move(layers)), rate_(rate) {
  for (const auto& layer : layers_) {
    if (!(layer.thickness > 0)) throw InputError(fmt::format("a layer {} m thick cannot be pressed", layer.thickness));
    State state;
    state.collapsed = layer.hardening.start();
    states_.push_back(state);
  }
}

void Column::condition(const std::vector<double>& stiffness, const std::vector<double>& yield) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].e = stiffness[i];
    states_[i].g = yield[i];
  }
}

void Column::soften(const std::vector<double>& stiffness, const std::vector<double>& yield) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    auto& s = states_[i];
    if (stiffness[i] > s.e) {
      const double kept = s.elastic * s.e / stiffness[i];
      s.plastic += s.elastic - kept;
      s.elastic = kept;
      s.collapsed = std::max(s.collapsed, 1 - (1 - layers_[i].hardening.start()) * std::exp(s.plastic));
    }
    s.e = stiffness[i];
    s.g = yield[i];
  }
}

// Plastic compression of this step: the root d of ln H(x(d)) + n ln max(d/seconds, floor) = ln(sigma/(g Y_R)) +
// n ln reference, whose left side grows with d. Newton's method in ln d, in which the rate term is linear, kept between
// bounds. `slope` becomes d d/d sigma.
double Column::flow(const Layer& layer, const State& state, double stress, double seconds, double& slope) const {
  slope = 0;
  if (stress <= 0) return 0;
  const double n = rate_.exponent, least = rate_.floor * seconds;  // below this d the rate no longer counts
  const double wanted = std::log(stress / (state.g * layer.Y_R)) + n * std::log(rate_.reference * seconds);
  const auto at = [&](double d, double& by_d) {
    const auto h = radius(layer.hardening, state.collapsed, state.plastic - d);
    by_d = h.slope / h.value + (d > least ? n / d : 0);
    return std::log(h.value) + n * std::log(std::max(d, least)) - wanted;
  };
  double by_d = 0;
  if (at(0, by_d) >= 0) return 0;
  // The limit of H, where all pores are gone, is out of reach for any stress.
  const double full = state.plastic - std::log((1 - layer.hardening.limit) / (1 - layer.hardening.start()));
  double low = 0, high = full, d = std::min(std::max(least, 1e-6), .5 * full);
  for (int i = 0; i < 200; ++i) {
    const double f = at(d, by_d);
    (f < 0 ? low : high) = d;
    double next = d > least ? d * std::exp(std::clamp(-f / (by_d * d), -30., 30.)) : d - f / by_d;
    if (!(next > low && next < high)) next = low > 0 && high > 4 * low ? std::sqrt(low * high) : .5 * (low + high);
    if (std::abs(next - d) <= 1e-14 * d || next == d) break;
    d = next;
  }
  slope = 1 / (stress * by_d);
  return d;
}

Column::Response Column::respond(const Layer& layer, const State& state, double stress, double seconds) const {
  Response r{state, 0};
  double by_stress = 0;
  const double d = flow(layer, state, stress, seconds, by_stress);
  r.state.plastic -= d;
  r.state.collapsed = std::max(state.collapsed, 1 - (1 - layer.hardening.start()) * std::exp(r.state.plastic));
  // ln J + J sigma/(e E_R) = eps_p, by Newton's method.
  const double ratio = stress / (state.e * layer.E_R);
  double u = r.state.plastic;
  for (int i = 0; i < 50; ++i) {
    const double J = std::exp(u), change = (u - r.state.plastic + J * ratio) / (1 + J * ratio);
    u -= change;
    if (std::abs(change) < 1e-15) break;
  }
  const double J = std::exp(u);
  r.state.elastic = u - r.state.plastic;
  r.slope = -(by_stress + J / (state.e * layer.E_R)) / (1 + J * ratio);
  return r;
}

double Column::height_under(double stress, double seconds, std::vector<Response>& responses, double& slope) const {
  double height = 0;
  slope = 0;
  responses.clear();
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    responses.push_back(respond(layers_[i], states_[i], stress, seconds));
    const auto& r = responses.back();
    const double thickness = layers_[i].thickness * std::exp(r.state.plastic + r.state.elastic);
    height += thickness;
    slope += thickness * r.slope;
  }
  return height;
}

void Column::load(double stress, double seconds) {
  std::vector<Response> responses;
  double slope = 0;
  height_under(stress, seconds, responses, slope);
  for (std::size_t i = 0; i < states_.size(); ++i) states_[i] = responses[i].state;
  stress_ = stress;
}

// Newton's method between bounds for the stress: the height falls with it.
void Column::press_to(double height, double seconds) {
  std::vector<Response> responses;
  double slope = 0;
  double low = -kLargestStress, high = kLargestStress, stress = stress_;
  for (int i = 0; i < 300; ++i) {
    const double error = height_under(stress, seconds, responses, slope) - height;
    if (!std::isfinite(error)) {  // pulled apart
      low = stress;
      stress = .5 * (low + high);
      continue;
    }
    (error > 0 ? low : high) = stress;
    if (std::abs(error) < 1e-13 * height) break;
    double next = stress - error / slope;
    if (!(next > low && next < high)) {
      const double least = .1 * kMPa;  // bounds far apart are closed by factors
      next = error > 0 ? std::min(.5 * (low + high), 2 * std::max(std::abs(stress), least))
                       : std::max(.5 * (low + high), stress - 2 * std::max(std::abs(stress), least));
    }
    if (std::abs(next - stress) < 1e-12 * std::abs(stress)) break;
    stress = next;
  }
  if (!(std::abs(height_under(stress, seconds, responses, slope) - height) < 1e-8 * height)) {
    throw RunError(fmt::format("the column cannot be pressed to {:.4g} mm: no stress up to {:g} MPa does it",
                               1e3 * height, kLargestStress / kMPa));
  }
  for (std::size_t i = 0; i < states_.size(); ++i) states_[i] = responses[i].state;
  stress_ = stress;
}

void Column::visit(Numbers& numbers) {
  numbers(stress_);
  for (auto& s : states_) {
    for (auto* number : {&s.plastic, &s.elastic, &s.collapsed, &s.e, &s.g}) numbers(*number);
  }
}

double Column::height() const {
  double sum = 0;
  for (const double t : thickness()) sum += t;
  return sum;
}

double Column::height_unloaded() const {
  double sum = 0;
  for (std::size_t i = 0; i < layers_.size(); ++i) sum += layers_[i].thickness * std::exp(states_[i].plastic);
  return sum;
}

double Column::height_as_formed() const {
  double sum = 0;
  for (const auto& layer : layers_) sum += layer.thickness;
  return sum;
}

std::vector<double> Column::thickness() const {
  std::vector<double> all;
  for (std::size_t i = 0; i < layers_.size(); ++i)
    all.push_back(layers_[i].thickness * std::exp(states_[i].plastic + states_[i].elastic));
  return all;
}

}  // namespace strandlab::hotpress
