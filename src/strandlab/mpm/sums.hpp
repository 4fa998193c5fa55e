// The members of what the kernels return, for core/members.hpp.
#pragma once

#include <concepts>
#include <tuple>
#include <type_traits>

#include "strandlab/mpm/kernels.hpp"

namespace strandlab::mpm {

template <class S>
requires std::same_as<std::remove_const_t<S>, PencilResult>
auto members(S& result) {
  auto& [friction, contact, platen_impulse, platen_work, kinetic_change, force_change, contact_ticks, overflow,
         unconverged, most_fields] = result;
  static_cast<void>(most_fields);  // no sum
  return std::tie(friction, contact, platen_impulse, platen_work, kinetic_change, force_change, contact_ticks, overflow,
                  unconverged);
}

}  // namespace strandlab::mpm
