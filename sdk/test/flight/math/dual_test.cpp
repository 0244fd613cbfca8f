// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/math/dual.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <limits>

namespace dual_test {

using namespace fulmar;
using D = Dual<2>;

namespace {

const D x = D::variable(0.7, 0), y = D::variable(-1.3, 1);

void is(const D& f, double value, double by_x, double by_y) {
  const auto near = [](double is, double should) {
    return std::abs(is - should) <= 1e-14 * std::abs(should);
  };
  CHECK(near(f.v, value));
  CHECK(near(f.d[0], by_x));
  CHECK(near(f.d[1], by_y));
}

}  // namespace

TEST_CASE("the rules of calculus hold for sums, products and quotients") {
  is(x + y, -0.6, 1, 1);
  is(x - y, 2, 1, -1);
  is(x * y, -0.91, -1.3, 0.7);
  is(x / y, 0.7 / -1.3, 1 / -1.3, -0.7 / 1.69);
  is(3 - 2 * x * x, 3 - 0.98, -2.8, 0);
  is(1 / y, 1 / -1.3, 0, -1 / 1.69);
  D z = x;
  z += y;
  z *= x;
  z -= 1;
  z /= y;
  is(z, 1.42 / 1.3, 0.1 / -1.3, 0.7 / -1.3 + 1.42 / 1.69);
}

TEST_CASE("functions have the derivatives of the textbook") {
  is(sqrt(x), std::sqrt(0.7), 0.5 / std::sqrt(0.7), 0);
  is(exp(x * y), std::exp(-0.91), -1.3 * std::exp(-0.91), 0.7 * std::exp(-0.91));
  is(pow(x, 5.25), std::pow(0.7, 5.25), 5.25 * std::pow(0.7, 4.25), 0);
  is(sin(y), std::sin(-1.3), 0, std::cos(-1.3));
  is(cos(y), std::cos(-1.3), 0, std::sin(1.3));
  is(asin(x), std::asin(0.7), 1 / std::sqrt(0.51), 0);
  is(atan2(y, x), std::atan2(-1.3, 0.7), 1.3 / 2.18, 0.7 / 2.18);
  is(abs(y), 1.3, 0, -1);
  is(abs(x), 0.7, 1, 0);
  is(copysign(D(x * x), y), -0.49, -1.4, 0);
  is(copysign(D(x * x), x), 0.49, 1.4, 0);
}

TEST_CASE("a comparison goes by the value, so a limit that is reached has no slope") {
  CHECK(y < x);
  CHECK(x > 0);
  is(std::min(D(10 * x), D(2.0)), 2, 0, 0);
  is(std::max(D(0.0), x), 0.7, 1, 0);
  is(sqrt(std::max(D(0.0), y)), 0, 0, 0);
}

TEST_CASE("a quotient of numbers near the largest has a derivative") {
  const D large = D::variable(1e200, 0);
  CHECK(std::isfinite(((1 + large) / (large * 1e100)).d[0]));
}

TEST_CASE("Eigen turns vectors of them") {
  using Vector = Eigen::Matrix<D, 3, 1>;
  const Vector a(x, y, 2.0), b(1.0, x, y);
  is(a.dot(b), 0.7 - 0.91 - 2.6, 1 - 1.3, 0.7 + 2);
  is(a.norm(), std::sqrt(6.18), 0.7 / std::sqrt(6.18), -1.3 / std::sqrt(6.18));
  const Eigen::Quaternion<D> q(Eigen::AngleAxis<D>(x, Vector::UnitZ()));
  const Vector turned = q * Vector(1.0, 0.0, 0.0);
  is(turned.x(), std::cos(0.7), -std::sin(0.7), 0);
  is(turned.y(), std::sin(0.7), std::cos(0.7), 0);
  const Eigen::Matrix3d J = Eigen::Vector3d(1, 2, 3).asDiagonal();
  is(Vector(J * a).y(), -2.6, 0, 2);
}

}  // namespace dual_test
