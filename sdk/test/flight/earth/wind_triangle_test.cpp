// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <fulmar/flight/earth/wind_triangle.hpp>
#include <numbers>

namespace wind_triangle_test {

using namespace fulmar;
static constexpr double pi = std::numbers::pi;

TEST_CASE("air velocity along the heading plus wind is ground velocity along the course") {
  for (double course = -3; course < 3.2; course += 0.37) {
    for (double wn : {-8.0, 0.0, 3.0, 9.0}) {
      for (double we : {-6.0, 0.0, 7.5}) {
        const double Va = 15;
        const WindTriangle w = fly_course(course, Va, Vec3<Ned>{wn, we, 0});
        REQUIRE(w.feasible);
        CHECK(Va * std::cos(w.heading_rad) + wn == doctest::Approx(w.ground_speed_mps * std::cos(course)));
        CHECK(Va * std::sin(w.heading_rad) + we == doctest::Approx(w.ground_speed_mps * std::sin(course)));
      }
    }
  }
}

TEST_CASE(
    "6 m/s of air moving east at 15 m/s airspeed, bearing north, needs a heading of -0.4115 rad and 7.8 m/s "
    "for 5 over ground") {
  const Vec3<Ned> wind{0, 6, 0};
  CHECK(fly_course(0, 15, wind).heading_rad == doctest::Approx(-0.4115).epsilon(1e-4));
  CHECK(fly_course(pi, 15, wind).heading_rad == doctest::Approx(-2.73).epsilon(1e-3));
  CHECK(airspeed_for_ground_speed(0, 5, wind) == doctest::Approx(7.81).epsilon(1e-3));
}

TEST_CASE("wind stronger than the airspeed is flagged: across, and from ahead") {
  CHECK_FALSE(fly_course(0, 15, Vec3<Ned>{0, 16, 0}).feasible);
  CHECK_FALSE(fly_course(0, 15, Vec3<Ned>{-16, 0, 0}).feasible);
  CHECK(fly_course(0, 15, Vec3<Ned>{-16, 0, 0}).ground_speed_mps == doctest::Approx(-1));
  CHECK(fly_course(0, 15, Vec3<Ned>{16, 0, 0}).feasible);
  CHECK(fly_course(0, 15, Vec3<Ned>{16, 0, 0}).ground_speed_mps == doctest::Approx(31));
  CHECK(fly_course(0, 15, Vec3<Ned>{0, 16, 0}).heading_rad == doctest::Approx(-pi / 2));
  CHECK_FALSE(fly_course(0, 0, Vec3<Ned>{1, 0, 0}).feasible);
}

TEST_CASE("the bank for a curvature makes the lift's horizontal part turn the ground path") {
  CHECK(bank_for_curvature(1 / 50.0, 17, 0) == doctest::Approx(std::atan(17 * 17 / (9.80665 * 50))));
  CHECK(bank_for_curvature(-1 / 50.0, 17, 0) == doctest::Approx(-std::atan(17 * 17 / (9.80665 * 50))));
  // With crab: weight m g = L cos(phi), across the ground path L sin(phi) cos(crab) = m Vg^2 / R.
  const double phi = bank_for_curvature(1 / 80.0, 20, 0.3);
  const double L = 9.80665 / std::cos(phi);
  CHECK(L * std::sin(phi) * std::cos(0.3) == doctest::Approx(20.0 * 20.0 / 80));
}

}  // namespace wind_triangle_test
