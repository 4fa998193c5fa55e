// Structs of numbers, treated member by member. A struct that takes part lists its members once, in a function beside
// it:
//
//   template <class S> requires std::same_as<std::remove_const_t<S>, Sums>
//   auto members(S& s) {
//     auto& [count, work] = s;  // does not compile any more when Sums gains a member
//     return std::tie(count, work);
//   }
//
// A member is a number, an array of members, or a struct that lists its own.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace strandlab {

// Calls visit(number) for every number in `value`, in the order of the members.
template <class T, class Visit>
void for_each_member(T& value, const Visit& visit) {
  if constexpr (std::is_arithmetic_v<std::remove_const_t<T>>) {
    visit(value);
  } else if constexpr (std::is_array_v<T>) {
    for (auto& element : value) for_each_member(element, visit);
  } else {
    std::apply([&](auto&... member) { (for_each_member(member, visit), ...); }, members(value));
  }
}

// sum += part, member by member.
template <class T>
void add(T& sum, const T& part) {
  if constexpr (std::is_arithmetic_v<T>) {
    sum += part;
  } else if constexpr (std::is_array_v<T>) {
    for (std::size_t i = 0; i < std::extent_v<T>; ++i) add(sum[i], part[i]);
  } else {
    auto sums = members(sum);
    const auto parts = members(part);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (strandlab::add(std::get<I>(sums), std::get<I>(parts)), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(sums)>>());
  }
}

}  // namespace strandlab
