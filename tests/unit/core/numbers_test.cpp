// A state as a list of numbers comes back as it was, and what is no such list is refused.
#include "strandlab/core/numbers.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace strandlab {
namespace {

enum class Phase { kClose, kOpen };

struct State {
  double time = 0;
  bool open = false;
  Phase phase = Phase::kClose;
  std::size_t stage = 0;
  std::vector<double> heights;
  void visit(Numbers& numbers) {
    numbers(time);
    numbers(open);
    numbers(phase);
    numbers(stage);
    numbers(heights);
  }
};

std::vector<double> list_of(State state) {
  Numbers numbers;
  state.visit(numbers);
  return numbers.list();
}

TEST(Numbers, ComeBackAsTheyWere) {
  State back;
  Numbers numbers(list_of({.1, true, Phase::kOpen, 7, {1. / 3, 0, -2e300}}));
  back.visit(numbers);
  EXPECT_EQ(back.time, .1);
  EXPECT_TRUE(back.open);
  EXPECT_EQ(back.phase, Phase::kOpen);
  EXPECT_EQ(back.stage, 7U);
  EXPECT_EQ(back.heights, (std::vector<double>{1. / 3, 0, -2e300}));
}

// Too few of them, and a list that says to be longer than what is left.
TEST(Numbers, ThatAreNoStateAreRefused) {
  const auto whole = list_of({.1, true, Phase::kOpen, 7, {1, 2}});
  for (std::size_t count = 0; count < whole.size(); ++count) {
    State state;
    Numbers numbers(std::vector<double>(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(count)));
    EXPECT_THROW(state.visit(numbers), InputError) << count;
  }
  for (const double length : {1e18, -1., std::numeric_limits<double>::quiet_NaN()}) {
    State state;
    auto list = whole;
    list[4] = length;
    Numbers numbers(list);
    EXPECT_THROW(state.visit(numbers), InputError) << length;
  }
}

}  // namespace
}  // namespace strandlab
