// SPDX-License-Identifier: BSD-3-Clause
// Numbers that carry their derivatives along, for models that are written once and differentiated exactly:
// forward-mode automatic differentiation. Source: Griewank & Walther, Evaluating Derivatives (2008), chapter
// 3.
#pragma once
#include <Eigen/Core>
#include <cmath>

namespace fulmar {

/// v + sum of d(i) epsilon(i), where the product of two epsilons is 0: f(v + d epsilon) = f(v) + f'(v) d
/// epsilon. Compares by its value, so that a branch is the one which the value takes.
template <int N>
struct Dual {
  using Gradient = Eigen::Matrix<double, N, 1>;
  double v = 0;
  Gradient d = Gradient::Zero();

  Dual() = default;
  Dual(double value) : v(value) {}  // implicit: a constant, as models have them
  Dual(double value, const Gradient& gradient) : v(value), d(gradient) {}
  /// The variable `i` at its value.
  static Dual variable(double value, int i) { return {value, Gradient::Unit(i)}; }

  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.v * b.d + b.v * a.d}; }
  /// (a' - q b') / b, which overflows later than (a' b - a b') / b^2.
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.v / b.v;
    return {q, (a.d - q * b.d) / b.v};
  }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.v >= b.v; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.v);
    return {root, root > 0 ? Gradient(a.d / (2 * root)) : Gradient(Gradient::Zero())};  // at 0 it has none
  }
  friend Dual exp(const Dual& a) {
    const double e = std::exp(a.v);
    return {e, e * a.d};
  }
  friend Dual pow(const Dual& a, double power) {
    return {std::pow(a.v, power), power * std::pow(a.v, power - 1) * a.d};
  }
  friend Dual sin(const Dual& a) { return {std::sin(a.v), std::cos(a.v) * a.d}; }
  friend Dual cos(const Dual& a) { return {std::cos(a.v), -std::sin(a.v) * a.d}; }
  friend Dual asin(const Dual& a) { return {std::asin(a.v), a.d / std::sqrt(1 - a.v * a.v)}; }
  friend Dual atan2(const Dual& y, const Dual& x) {
    return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / (x.v * x.v + y.v * y.v)};
  }
  friend Dual abs(const Dual& a) { return a.v < 0 ? -a : a; }
  friend Dual copysign(const Dual& size, const Dual& sign) {
    return std::signbit(size.v) == std::signbit(sign.v) ? size : -size;
  }
};

}  // namespace fulmar

namespace Eigen {

template <int N>
struct NumTraits<fulmar::Dual<N>> : GenericNumTraits<fulmar::Dual<N>> {
  using Real = fulmar::Dual<N>;
  using NonInteger = fulmar::Dual<N>;
  using Nested = fulmar::Dual<N>;
  using Literal = double;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = N, AddCost = N };
  enum { MulCost = 2 * N };
};
template <int N, class Operation>
struct ScalarBinaryOpTraits<fulmar::Dual<N>, double, Operation> {
  using ReturnType = fulmar::Dual<N>;
};
template <int N, class Operation>
struct ScalarBinaryOpTraits<double, fulmar::Dual<N>, Operation> {
  using ReturnType = fulmar::Dual<N>;
};

}  // namespace Eigen
