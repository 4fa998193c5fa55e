// Where the time of a step goes.
#pragma once

#include <concepts>
#include <tuple>
#include <type_traits>

namespace strandlab::mpm {

struct Phases {  // of a step; seconds, ticks or ns per particle-step, as whoever holds them says
  double weights, surface, scatter, grid, contact, gather, material;
};

template <class S>
requires std::same_as<std::remove_const_t<S>, Phases>
auto members(S& phases) {
  auto& [weights, surface, scatter, grid, contact, gather, material] = phases;
  return std::tie(weights, surface, scatter, grid, contact, gather, material);
}

}  // namespace strandlab::mpm
