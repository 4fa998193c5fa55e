#include "strandlab/core/members.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <vector>

namespace strandlab {
namespace {

struct Part {
  double work = 0;
  int count = 0;
};
struct Whole {
  double weights[3] = {0, 0, 0};
  Part part;
  long long steps = 0;
};

template <class S>
requires std::same_as<std::remove_const_t<S>, Part>
auto members(S& part) {
  auto& [work, count] = part;
  return std::tie(work, count);
}
template <class S>
requires std::same_as<std::remove_const_t<S>, Whole>
auto members(S& whole) {
  auto& [weights, part, steps] = whole;
  return std::tie(weights, part, steps);
}

std::vector<double> numbers_of(const Whole& whole) {
  std::vector<double> all;
  for_each_member(whole, [&](auto number) { all.push_back(static_cast<double>(number)); });
  return all;
}

// Arrays and structs within a struct included, in the order in which they are declared.
TEST(Members, AreVisitedInOrder) {
  EXPECT_EQ(numbers_of({{1, 2, 3}, {4, 5}, 6}), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST(Members, AreChangedWhereTheyStand) {
  Whole whole{{1, 2, 3}, {4, 5}, 6};
  for_each_member(whole, [](auto& number) { number *= 2; });
  EXPECT_EQ(numbers_of(whole), (std::vector<double>{2, 4, 6, 8, 10, 12}));
}

TEST(Members, AreSummedOneByOne) {
  Whole sum{{1, 2, 3}, {4, 5}, 6};
  add(sum, Whole{{10, 20, 30}, {40, 50}, 60});
  EXPECT_EQ(numbers_of(sum), (std::vector<double>{11, 22, 33, 44, 55, 66}));
}

}  // namespace
}  // namespace strandlab
