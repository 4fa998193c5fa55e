// Forward automatic differentiation: a value and its derivatives by N unknowns.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace strandlab::transfer {

template <int N>
struct Dual {
  double v = 0;
  std::array<double, static_cast<std::size_t>(N)> d{};

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT(google-explicit-constructor): a constant is a number without derivatives
  static Dual unknown(double value, int number) {
    Dual x(value);
    x.d[static_cast<std::size_t>(number)] = 1;
    return x;
  }
};

template <int N>
Dual<N> chain(const Dual<N>& x, double value, double slope) {
  Dual<N> result(value);
  for (std::size_t i = 0; i < x.d.size(); ++i) result.d[i] = slope * x.d[i];
  return result;
}
template <int N>
Dual<N> chain(const Dual<N>& a, const Dual<N>& b, double value, double slope_a, double slope_b) {
  Dual<N> result(value);
  for (std::size_t i = 0; i < a.d.size(); ++i) result.d[i] = slope_a * a.d[i] + slope_b * b.d[i];
  return result;
}

template <int N>
Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  return chain(a, b, a.v + b.v, 1, 1);
}
template <int N>
Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  return chain(a, b, a.v - b.v, 1, -1);
}
template <int N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  return chain(a, b, a.v * b.v, b.v, a.v);
}
template <int N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  return chain(a, b, a.v / b.v, 1 / b.v, -a.v / (b.v * b.v));
}
template <int N>
Dual<N> operator-(const Dual<N>& a) {
  return chain(a, -a.v, -1);
}
template <int N>
Dual<N> operator+(const Dual<N>& a, double b) {
  return chain(a, a.v + b, 1);
}
template <int N>
Dual<N> operator+(double a, const Dual<N>& b) {
  return chain(b, a + b.v, 1);
}
template <int N>
Dual<N> operator-(const Dual<N>& a, double b) {
  return chain(a, a.v - b, 1);
}
template <int N>
Dual<N> operator-(double a, const Dual<N>& b) {
  return chain(b, a - b.v, -1);
}
template <int N>
Dual<N> operator*(const Dual<N>& a, double b) {
  return chain(a, a.v * b, b);
}
template <int N>
Dual<N> operator*(double a, const Dual<N>& b) {
  return chain(b, a * b.v, a);
}
template <int N>
Dual<N> operator/(const Dual<N>& a, double b) {
  return chain(a, a.v / b, 1 / b);
}
template <int N>
Dual<N> operator/(double a, const Dual<N>& b) {
  return chain(b, a / b.v, -a / (b.v * b.v));
}
template <int N>
Dual<N> exp(const Dual<N>& x) {
  const double value = std::exp(x.v);
  return chain(x, value, value);
}
template <int N>
Dual<N> sqrt(const Dual<N>& x) {
  const double value = std::sqrt(x.v);
  return chain(x, value, 0.5 / value);
}
template <int N>
Dual<N> pow(const Dual<N>& x, double exponent) {
  const double value = std::pow(x.v, exponent);
  return chain(x, value, exponent * value / x.v);
}

// The number alone: what switches (upwinding, floors) decide by.
inline double value_of(double x) {
  return x;
}
template <int N>
double value_of(const Dual<N>& x) {
  return x.v;
}

}  // namespace strandlab::transfer
