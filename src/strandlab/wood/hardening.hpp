// Hardening by crushing: yield at f = H(x), x the collapsed part of the volume. Plain data and arithmetic only, so that
// it can be compiled for several instruction sets (see return_map.hpp).
#pragma once

namespace strandlab::wood {

// H(x) = 1 + h1 x + h2 (x/(limit - x))^exponent, with x = 1 - min J_p over the history and J_p = (1 - start) exp(tr
// eps_p): the history variable of this law, which never falls. H has no bound as x nears the limit, where all pores are
// gone.
struct CrushingHardening {
  double limit = 0;  // x_L = 1 - rho0/1500; 0: this law does not hold
  double start = 0;  // x of the strand as formed
  double h1 = 0, h2 = 0, exponent = 1;
};

// H(x), and its derivative in `slope`. Beyond the limit H is huge and its slope 0.
template <class Ops>
[[gnu::always_inline]] inline typename Ops::Value crushing_radius(const CrushingHardening& h,
                                                                  const typename Ops::Value& x,
                                                                  typename Ops::Value& slope) {
  using T = typename Ops::Value;
  const T zero = T{};
  const T room = h.limit - x;
  const auto inside = room > 1e-12;
  const T gap = Ops::select(inside, room, zero + 1e-12);
  const T some = Ops::select(x > 1e-30, x, zero + 1e-30);  // the power and its slope have limits at x = 0
  const T inverse = 1.0 / (some * gap);
  const T power = h.h2 * Ops::power(some * some * inverse, h.exponent);
  slope = Ops::select(inside, h.h1 + power * (h.exponent * h.limit) * inverse, zero);
  return 1.0 + h.h1 * x + power;
}

}  // namespace strandlab::wood
