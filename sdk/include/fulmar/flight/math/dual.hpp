// SPDX-License-Identifier: BSD-3-Clause
// Numbers with their derivatives, for models that are written once and differentiated exactly: forward-mode
// automatic differentiation. Source: Griewank & Walther, Evaluating Derivatives (2008), chapter 3.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

namespace fulmar {

/// v + sum of d[i] epsilon[i], where the product of two epsilons is 0: f(v + d epsilon) = f(v) + f'(v) d
/// epsilon. Comparisons use the value, so that a branch is the one of the value.
template <int N>
struct Dual {
  using Gradient = std::array<double, std::size_t(N)>;
  double v = 0;
  Gradient d{};

  Dual() = default;
  Dual(double value) : v(value) {}  // implicit: a model has constants
  /// The variable `i` at its value.
  static Dual variable(double value, int i) {
    Dual x(value);
    x.d[std::size_t(i)] = 1;
    return x;
  }
  /// A function of a and b, from its value and its derivatives by them: the chain rule.
  static Dual chain(double value, double by_a, const Dual& a, double by_b, const Dual& b) {
    Dual f(value);
    for (std::size_t i = 0; i < f.d.size(); ++i) f.d[i] = by_a * a.d[i] + by_b * b.d[i];
    return f;
  }
  static Dual chain(double value, double by_a, const Dual& a) {
    Dual f(value);
    for (std::size_t i = 0; i < f.d.size(); ++i) f.d[i] = by_a * a.d[i];
    return f;
  }

  friend Dual operator-(const Dual& a) { return chain(-a.v, -1, a); }
  friend Dual operator+(const Dual& a, const Dual& b) { return chain(a.v + b.v, 1, a, 1, b); }
  friend Dual operator-(const Dual& a, const Dual& b) { return chain(a.v - b.v, 1, a, -1, b); }
  friend Dual operator*(const Dual& a, const Dual& b) { return chain(a.v * b.v, b.v, a, a.v, b); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.v / b.v;
    return chain(q, 1 / b.v, a, -q / b.v, b);
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
    return root > 0 ? chain(root, 0.5 / root, a) : Dual(root);  // no derivative at 0
  }
  friend Dual exp(const Dual& a) {
    const double e = std::exp(a.v);
    return chain(e, e, a);
  }
  friend Dual pow(const Dual& a, double power) {
    return chain(std::pow(a.v, power), power * std::pow(a.v, power - 1), a);
  }
  friend Dual sin(const Dual& a) { return chain(std::sin(a.v), std::cos(a.v), a); }
  friend Dual cos(const Dual& a) { return chain(std::cos(a.v), -std::sin(a.v), a); }
  friend Dual asin(const Dual& a) { return chain(std::asin(a.v), 1 / std::sqrt(1 - a.v * a.v), a); }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double square = x.v * x.v + y.v * y.v;
    return chain(std::atan2(y.v, x.v), x.v / square, y, -y.v / square, x);
  }
  friend Dual abs(const Dual& a) { return a.v < 0 ? -a : a; }
  friend Dual copysign(const Dual& size, const Dual& sign) {
    return std::signbit(size.v) == std::signbit(sign.v) ? size : -size;
  }
};

}  // namespace fulmar

namespace Eigen {

/// Makes Dual a scalar of Eigen's matrices.
template <int N>
struct NumTraits<fulmar::Dual<N>> : GenericNumTraits<fulmar::Dual<N>> {
  using Real = fulmar::Dual<N>;
  using NonInteger = fulmar::Dual<N>;
  using Nested = fulmar::Dual<N>;
  using Literal = double;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = N, AddCost = N };
  enum { MulCost = 2 * N };
};
/// A Dual with a double gives a Dual.
template <int N, class Operation>
struct ScalarBinaryOpTraits<fulmar::Dual<N>, double, Operation> {
  using ReturnType = fulmar::Dual<N>;
};
/// A double with a Dual gives a Dual.
template <int N, class Operation>
struct ScalarBinaryOpTraits<double, fulmar::Dual<N>, Operation> {
  using ReturnType = fulmar::Dual<N>;
};

}  // namespace Eigen
