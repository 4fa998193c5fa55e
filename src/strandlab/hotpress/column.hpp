// A mat without gaps as a column of layers in series: the mechanics of pressing through the thickness, in no time.
//
// All layers bear one stress sigma (Pa, compression positive). With J the thickness over that as formed, and crushing
// along the thickness only,
//   ln J = eps_p - J sigma/(e E_R),   sigma = g Y_R H(x) r where it yields,   x = 1 - (1 - x_start) exp(eps_p) at
//   least, r = (max(rate of -eps_p, rate_floor)/rate_reference)^n
// e and g are the softening factors, H the hardening of the crushing law (wood/laws/crushing.hpp).
#pragma once

#include <vector>

#include "strandlab/core/numbers.hpp"
#include "strandlab/wood/laws/crushing.hpp"
#include "strandlab/wood/material.hpp"
#include "strandlab/wood/rate_effect.hpp"

namespace strandlab::hotpress {

struct Layer {
  double thickness = 0;     // m, of the wood as formed, without gaps
  double E_R = 0, Y_R = 0;  // Pa
  wood::Crushing::Hardening hardening;
};
// Of `thickness` (m) of a material. Its crushing constants hold, whatever its law.
Layer layer_of(const wood::Material& material, double thickness);

class Column {
 public:
  // At 20 C and 12 % moisture content unless condition() follows. Throws InputError for a layer without thickness.
  Column(std::vector<Layer> layers, wood::RateEffect rate);

  // Wood of the given factors before the first load.
  void condition(const std::vector<double>& stiffness, const std::vector<double>& yield);

  // Factors of stiffness and yield from here on. Where a layer becomes softer its elastic strain stays and its stress
  // falls; where it becomes stiffer its stress stays, and the elastic strain that this no longer needs is locked in.
  void soften(const std::vector<double>& stiffness, const std::vector<double>& yield);

  // In `seconds` to a height (m), or under a stress (Pa). A stress below zero pulls: layers are then elastic. Throws
  // RunError where no stress up to 10 GPa reaches the height.
  void press_to(double height, double seconds);
  void load(double stress, double seconds);

  void visit(Numbers& numbers);  // its state

  double stress() const { return stress_; }  // Pa
  double height() const;                     // m
  double height_unloaded() const;            // m: elastic strains gone
  double height_as_formed() const;           // m
  std::vector<double> thickness() const;     // m, by layer

 private:
  struct State {
    double plastic = 0, elastic = 0;  // logarithmic strains, compression negative
    double collapsed = 0;             // x
    double e = 1, g = 1;
  };
  struct Response {
    State state;
    double slope = 0;  // d ln J/d sigma, 1/Pa
  };
  Response respond(const Layer& layer, const State& state, double stress, double seconds) const;
  double flow(const Layer& layer, const State& state, double stress, double seconds, double& slope) const;
  double height_under(double stress, double seconds, std::vector<Response>& responses, double& slope) const;

  std::vector<Layer> layers_;
  std::vector<State> states_;
  wood::RateEffect rate_;
  double stress_ = 0;
};

}  // namespace strandlab::hotpress
