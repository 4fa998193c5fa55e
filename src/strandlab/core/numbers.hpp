// The state of something as a list of numbers: written one after the other, read back in the same order.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "strandlab/core/error.hpp"

namespace strandlab {

// One function visits the numbers of a state for both ways: numbers(x) writes x, or reads it. Throws InputError for a
// list that is too short for what is read.
class Numbers {
 public:
  Numbers() = default;                                                                      // to write
  explicit Numbers(std::vector<double> stored) : reads_(true), list_(std::move(stored)) {}  // to read

  bool reads() const { return reads_; }
  const std::vector<double>& list() const { return list_; }

  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void operator()(Number& number) {
    if (reads_) {
      number = static_cast<Number>(next());
    } else {
      list_.push_back(static_cast<double>(number));
    }
  }

  // Any list with resize(): its length, then each of its elements, of one number or more, by `visit(element)`.
  template <class List, class Visit>
  void each(List& list, const Visit& visit) {
    auto count = static_cast<double>(list.size());
    (*this)(count);
    if (reads_) {
      if (!(count >= 0 && count <= static_cast<double>(list_.size() - at_))) refuse();
      list.resize(static_cast<std::size_t>(count));
    }
    for (auto& element : list) visit(element);
  }
  template <class Number>
  void operator()(std::vector<Number>& list) {
    each(list, [this](Number& number) { (*this)(number); });
  }

 private:
  double next() {
    if (at_ == list_.size()) refuse();
    return list_[at_++];
  }
  [[noreturn]] static void refuse() { throw InputError("a stored state has not the numbers that it should have"); }

  bool reads_ = false;
  std::vector<double> list_;
  std::size_t at_ = 0;
};

}  // namespace strandlab
