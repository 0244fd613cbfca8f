// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <fulmar/flight/math/angles.hpp>

namespace angles_test {

using namespace fulmar;
static constexpr double pi = std::numbers::pi;

TEST_CASE("wrapping keeps the point on the circle and stays in its range") {
  for (double angle = -40; angle < 40; angle += 0.0373) {
    const double a = wrap_pi(angle), b = wrap_2pi(angle);
    CHECK(std::abs(a) <= pi);
    CHECK(b >= 0);
    CHECK(b < 2 * pi);
    for (double w : {a, b}) {
      CHECK(std::cos(w) == doctest::Approx(std::cos(angle)).epsilon(1e-12));
      CHECK(std::abs(std::sin(w) - std::sin(angle)) < 1e-12);
    }
  }
}

TEST_CASE("an angle in range comes back bit for bit") {
  CHECK(wrap_pi(pi) == pi);
  CHECK(wrap_pi(-pi) == -pi);
  CHECK(wrap_pi(0.1) == 0.1);
  CHECK(wrap_2pi(0.0) == 0.0);
  CHECK(wrap_2pi(-1e-18) < 2 * pi);
}

TEST_CASE("course error wraps through north") {
  const double deg = pi / 180;
  CHECK(angle_difference(10 * deg, 350 * deg) == doctest::Approx(20 * deg));
  CHECK(angle_difference(350 * deg, 10 * deg) == doctest::Approx(-20 * deg));
  CHECK(angle_difference(-170 * deg, 170 * deg) == doctest::Approx(20 * deg));
}

TEST_CASE("the smooth step has the cubic's values, flat ends, and runs both ways") {
  CHECK(smoothly(-1, 0, 2) == 0);
  CHECK(smoothly(3, 0, 2) == 1);
  CHECK(smoothly(0.5, 0, 2) == doctest::Approx(0.15625));  // t = 1/4: 3/16 - 2/64
  CHECK(smoothly(1, 2, 0) == doctest::Approx(0.5));
  CHECK(smoothly(2.5, 2, 0) == 0);
  CHECK(smoothly(1e-4, 0, 1) < 1e-7);
  CHECK(smoothly(4, 5, 5) == 0);
  CHECK(smoothly(5, 5, 5) == 1);
}

}  // namespace angles_test
