// Limits that a measured number is held against.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace strandlab::test {

inline std::string number(double value, int digits = 4) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

class Limit {
 public:
  enum class Side { kBelow, kAbove, kWithin, kBetween };

  // Why a limit is more than ten times what is measured: a bound of the method, other instruction sets, a statistical
  // band, another program's own error.
  Limit because(std::string reason) const {
    Limit with_reason = *this;
    with_reason.reason_ = std::move(reason);
    return with_reason;
  }
  const std::string& reason() const { return reason_; }

  bool holds(double measured) const {
    switch (side_) {
      case Side::kBelow:
        return measured < size_;
      case Side::kAbove:
        return measured > size_;
      case Side::kWithin:
        return std::abs(measured - centre_) < size_;
      case Side::kBetween:
        return centre_ < measured && measured < size_;
    }
    return false;
  }

  // How often what is measured fits into what is allowed; 1 between two bounds, infinite where the measure is zero.
  double slack(double measured) const {
    const auto over = [](double a, double b) { return b > 0 ? a / b : std::numeric_limits<double>::infinity(); };
    switch (side_) {
      case Side::kBelow:
        return over(size_, measured);
      case Side::kAbove:
        return over(measured, size_);
      case Side::kWithin:
        return over(size_, std::abs(measured - centre_));
      case Side::kBetween:
        return 1;
    }
    return 1;
  }

  // Of the measured number, so that a small deviation from what is expected shows.
  int digits() const { return side_ == Side::kWithin && centre_ != 0 ? 6 : 4; }

  std::string text() const {
    switch (side_) {
      case Side::kBelow:
        return "< " + number(size_);
      case Side::kAbove:
        return "> " + number(size_);
      case Side::kWithin:
        return (centre_ == 0 ? "within " : number(centre_, digits()) + " +- ") + number(size_);
      case Side::kBetween:
        return number(centre_) + " to " + number(size_);
    }
    return {};
  }

 private:
  friend Limit below(double limit);
  friend Limit above(double limit);
  friend Limit within(double tolerance);
  friend Limit near(double expected, double tolerance);
  friend Limit between(double low, double high);
  Limit(Side side, double centre, double size) : side_(side), centre_(centre), size_(size) {}
  Side side_;
  double centre_, size_;
  std::string reason_;
};

inline Limit below(double limit) {
  return {Limit::Side::kBelow, 0, limit};
}
inline Limit above(double limit) {
  return {Limit::Side::kAbove, 0, limit};
}
inline Limit within(double tolerance) {  // of zero
  return {Limit::Side::kWithin, 0, tolerance};
}
inline Limit near(double expected, double tolerance) {
  return {Limit::Side::kWithin, expected, tolerance};
}
inline Limit between(double low, double high) {
  return {Limit::Side::kBetween, low, high};
}

// Why a limit of round-off leaves room.
inline constexpr const char* kRoundOff = "round-off: sums run in another order on other instruction sets";

}  // namespace strandlab::test
