// SPDX-License-Identifier: BSD-3-Clause
// Guidance against Park, Deyst & How, AIAA 2004-4900: its command near a line and on a circle, and the period
// and damping of its oscillation.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "l1_guide.hpp"

namespace {

constexpr double pi = std::numbers::pi;
constexpr double L1 = 0.75 * 7 * 17 / pi;  // of the default damping and period, at 17 m/s

/// In calm air, over (north, east), at 17 m/s, course `course_rad`.
VehicleState flying(double north_m, double east_m, double course_rad = 0) {
  VehicleState state;
  state.position_m = {north_m, east_m, -70};
  state.height_m = 70;
  state.airspeed_mps = state.ground_speed_mps = 17;
  state.course_rad = state.yaw_rad = course_rad;
  state.velocity_mps = {17 * std::cos(course_rad), 17 * std::sin(course_rad), 0};
  state.attitude_valid = state.velocity_valid = state.position_valid = state.height_valid = true;
  state.airspeed_valid = state.origin_valid = state.wind_valid = true;
  return state;
}
Path north() {
  Path path;
  path.origin_m = {0, 0, -70};
  path.airspeed_mps = 17;
  return path;
}
Path circle(Turn turn, double radius_m) {
  Path path = north();
  path.kind = PathKind::orbit;
  path.turn = turn;
  path.radius_m = radius_m;
  return path;
}

GuidanceCommand command_of(const VehicleState& state, const Path& path) {
  Bench<L1Guide> bench;
  bench.set(bench.in.state, state);
  bench.set(bench.in.path, path);
  REQUIRE(allocations([&] { REQUIRE(bench.step(0.01) == Status::ok); }) == 0);
  REQUIRE(bench.validation_error() == "");
  return bench.out.command;
}
double acceleration(const VehicleState& state, const Path& path) {
  const GuidanceCommand command = command_of(state, path);
  CHECK(command.lateral == LateralMode::acceleration);
  CHECK(std::tan(command.roll_feedforward_rad) ==
        doctest::Approx(command.lateral_acceleration_mps2 / 9.80665));
  return command.lateral_acceleration_mps2;
}

}  // namespace

TEST_CASE("on a circle it pulls Vg^2/R, whichever way round and whatever the radius") {
  for (const double R : {40.0, 80.0, 300.0})
    for (const Turn turn : {Turn::right, Turn::left}) {
      const double side = turn == Turn::right ? 1 : -1;
      for (const double azimuth : {0.3, 2.0, -2.5}) {
        const VehicleState state =
            flying(R * std::cos(azimuth), R * std::sin(azimuth), wrap_pi(azimuth + side * pi / 2));
        CHECK(acceleration(state, circle(turn, R)) == doctest::Approx(side * 17 * 17 / R).epsilon(1e-6));
      }
    }
}

TEST_CASE("near a line it is a spring and a damper of the period and damping asked for") {
  // Small angles, section IV: a = -2 Vg/L1 d' - 2 Vg^2/L1^2 d. With L1 = zeta P Vg / pi the damping is
  // 1/sqrt(2), and the frequency sqrt(2) Vg / L1.
  const double stiff = acceleration(flying(0, 0.1), north()) / 0.1;
  const double damp = acceleration(flying(0, 0, 0.01), north()) / (17 * 0.01);
  CHECK(stiff == doctest::Approx(-2 * 17 * 17 / (L1 * L1)).epsilon(1e-3));
  CHECK(damp == doctest::Approx(-2 * 17 / L1).epsilon(1e-3));
}

TEST_CASE("it turns early into the next leg, and only where that is known and wanted") {
  Path path = north();
  path.remaining_m = 10;
  CHECK(acceleration(flying(-10, 0), path) == doctest::Approx(0));
  path.has_next = true;
  path.next.origin_m = {0, 0, -70};
  path.next.direction_ratio = {0, 1, 0};
  // The point lies L1 - 10 m to the east of the corner.
  const double e = L1 - 10, distance = std::hypot(10, e);
  CHECK(acceleration(flying(-10, 0), path) ==
        doctest::Approx(2 * 17 * 17 / distance * e / distance).epsilon(1e-6));
  path.next.direction_ratio = {0, -1, 0};
  CHECK(acceleration(flying(-10, 0), path) < -1);
  path.remaining_m = 50;  // beyond the point
  CHECK(acceleration(flying(-50, 0), path) == doctest::Approx(0));
  Bench<L1Guide> bench;
  bench.params.corners.value = false;
  path.remaining_m = 10;
  bench.set(bench.in.state, flying(-10, 0));
  bench.set(bench.in.path, path);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.command.lateral_acceleration_mps2 == doctest::Approx(0));
}

TEST_CASE("a curve is followed as the circle that it is") {
  // A quarter of a circle of 100 m as a cubic curve, accurate to 0.03 %.
  const double R = 100, k = 4.0 / 3 * (std::sqrt(2.0) - 1) * R;
  Path path = north();
  set_curve(path, {{{{0, 0, -70}, {k, 0, -70}, {R, R - k, -70}, {R, R, -70}}}}, 0.4);
  const double a = 0.25 * pi;  // at the azimuth of 45 deg from its centre, (0, 100)
  const VehicleState state = flying(R * std::sin(a), R - R * std::cos(a), a);
  CHECK(acceleration(state, path) == doctest::Approx(17 * 17 / R).epsilon(0.01));
}

TEST_CASE("the wing pulls square to the heading: more of it in a crosswind") {
  VehicleState state = flying(0, 5);
  const double calm = acceleration(state, north());
  state.yaw_rad = 0.6;
  CHECK(acceleration(state, north()) == doctest::Approx(calm / std::cos(0.6)));
}

TEST_CASE("wherever it is, it is finite, and turns hard when it flies away") {
  for (int i = 0; i < 1000; ++i)
    command_of(flying(900 * std::sin(0.03 * i), 900 * std::sin(0.05 * i), wrap_pi(0.1 * i)),
               i % 2 == 0 ? north() : circle(i % 4 == 1 ? Turn::right : Turn::left, 60));
  command_of(flying(0, 0), circle(Turn::right, 60));          // over the centre
  CHECK(acceleration(flying(0, 30, pi - 0.1), north()) > 5);  // the shorter direction: to the right
  CHECK(acceleration(flying(0, -30, 0.1 - pi), north()) < -5);
  VehicleState lost = flying(0, 0);
  lost.position_valid = false;
  Bench<L1Guide> bench;
  bench.set(bench.in.state, lost);
  bench.set(bench.in.path, north());
  CHECK(bench.step(0.01) == Status::degraded);
}

TEST_CASE("the height is that of the path below the aircraft, uphill and round") {
  Path path = north();
  path.direction_ratio = {std::cos(0.1), 0, -std::sin(0.1)};
  const GuidanceCommand up = command_of(flying(200, 8), path);
  CHECK(up.height_m == doctest::Approx(70 + 200 * std::tan(0.1)));
  CHECK(up.climb_rate_mps == doctest::Approx(17 * std::tan(0.1)));
  Path round = circle(Turn::left, 100);
  round.climb_ratio = 0.05;
  round.start_rad = 0.5;
  const GuidanceCommand turn =
      command_of(flying(100 * std::cos(0.2), 100 * std::sin(0.2), wrap_pi(0.2 - pi / 2)), round);
  CHECK(turn.height_m == doctest::Approx(70 + 0.05 * 100 * 0.3));
  CHECK(turn.climb_rate_mps == doctest::Approx(0.05 * 17));
}
