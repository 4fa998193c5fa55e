// Mean of independent values and its standard error.
#pragma once

#include <cmath>

namespace strandlab::test {

class Sample {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  double mean() const { return sum_ / count_; }
  double error() const { return std::sqrt((squares_ / count_ - mean() * mean()) / (count_ - 1)); }

 private:
  double count_ = 0, sum_ = 0, squares_ = 0;
};

}  // namespace strandlab::test
