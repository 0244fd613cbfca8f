// SPDX-License-Identifier: BSD-3-Clause
// The vector field: the book's numbers, convergence of a point that follows it, bank in wind, heights, and
// degenerate paths.
#include "plugins/path/vector_field.hpp"

#include <doctest/doctest.h>

#include "fulmar/random.hpp"
#include "fulmar/testing.hpp"

namespace vector_field_test {

using namespace fulmar;
using namespace fulmar::path;

namespace {

constexpr double pi = std::numbers::pi;

VehicleState at(double north, double east, double course, double speed = 17) {
  VehicleState s;
  s.position_m = {north, east, -50};
  s.height_m = 50;
  s.course_rad = s.yaw_rad = course;
  s.ground_speed_mps = s.airspeed_mps = speed;
  s.position_valid = s.velocity_valid = true;
  return s;
}

Path line(double course, double climb = 0) {
  Path path;
  const double norm = 1 / std::hypot(1, climb);
  path.origin_m = {0, 0, -50};
  path.direction_ratio = {std::cos(course) * norm, std::sin(course) * norm, -climb * norm};
  return path;
}

Path orbit(Turn turn, double radius) {
  Path path;
  path.kind = PathKind::orbit;
  path.turn = turn;
  path.origin_m = {0, 0, -50};
  path.radius_m = radius;
  path.next_curvature_ratio = (turn == Turn::right ? 1 : -1) / radius;
  return path;
}

GuidanceCommand command(Bench<VectorField>& bench, const VehicleState& state, const Path& path) {
  bench.set(bench.in.state, state);
  bench.set(bench.in.path, path);
  REQUIRE(bench.step(0.01) == Status::ok);
  return bench.out.command;
}

}  // namespace

TEST_CASE("on a line its course is commanded, far to the side the approach angle, on the right side of it") {
  Bench<VectorField> bench;
  CHECK(command(bench, at(100, 0, 0), line(0)).course_rad == doctest::Approx(0));
  CHECK(command(bench, at(100, 1e6, 0), line(0)).course_rad == doctest::Approx(-1.05).epsilon(1e-3));
  CHECK(command(bench, at(100, -1e6, 0), line(0)).course_rad == doctest::Approx(1.05).epsilon(1e-3));
  // where k e = 1 the arctangent is pi/4: half the approach angle
  CHECK(command(bench, at(100, 1 / 0.05, 0), line(0)).course_rad == doctest::Approx(-1.05 / 2));
  CHECK(bench.out.cross_track_m.value == doctest::Approx(1 / 0.05));
}

TEST_CASE(
    "it turns onto a line more gently the faster it is, and no more sharply below three tenths of the "
    "reference") {
  for (const auto& [speed, off] : {std::pair{34.0, 40.0}, {8.5, 10.0}, {1.0, 6.0}}) {
    Bench<VectorField> bench;
    CHECK(command(bench, at(100, off, 0, speed), line(0)).course_rad == doctest::Approx(-1.05 / 2));
  }
}

TEST_CASE("well inside an orbit a share of its bank is fed forward, as well outside") {
  const double full = 17.0 * 17 / (100 * 9.80665);
  for (const double d : {20.0, 180.0}) {  // 0.8 radii off it
    Bench<VectorField> bench;
    CHECK(command(bench, at(d, 0, pi / 2), orbit(Turn::right, 100)).roll_feedforward_rad ==
          doctest::Approx(std::atan(0.7 * full)));
  }
}

TEST_CASE("on an orbit the tangent is commanded, far outside the way to the centre") {
  Bench<VectorField> bench;
  CHECK(command(bench, at(50, 0, pi / 2), orbit(Turn::right, 50)).course_rad == doctest::Approx(pi / 2));
  CHECK(command(bench, at(50, 0, -pi / 2), orbit(Turn::left, 50)).course_rad == doctest::Approx(-pi / 2));
  CHECK(std::abs(wrap_pi(command(bench, at(1e6, 0, 0), orbit(Turn::right, 50)).course_rad - pi)) < 1e-3);
}

TEST_CASE("a point that flies the commanded course comes to the path from anywhere and stays") {
  Random rng(31);
  Bench<VectorField> bench;
  for (int trial = 0; trial < 24; ++trial) {
    const Path path = trial % 2 == 0 ? line(rng.uniform(-pi, pi))
                                     : orbit(trial % 4 == 1 ? Turn::right : Turn::left, rng.uniform(30, 150));
    double n = rng.uniform(-300, 300), e = rng.uniform(-300, 300), chi = 0;
    double before = 1e9;
    for (int i = 0; i < 5000; ++i) {
      chi = command(bench, at(n, e, chi), path).course_rad;
      const double off = std::abs(bench.out.cross_track_m.value);
      CHECK(off <= before + 0.02);  // never away from the path
      before = off;
      n += 0.02 * 17 * std::cos(chi);
      e += 0.02 * 17 * std::sin(chi);
    }
    CHECK(before < 0.2);  // straight steps of 0.34 m do not hold a circle more closely
  }
}

TEST_CASE("the height is that of the projection onto the path: beside it, behind its beginning and ahead") {
  Bench<VectorField> bench;
  const Path path = line(pi / 2, 0.1);  // east, climbing 1 in 10 from 50 m
  CHECK(command(bench, at(0, 200, pi / 2), path).height_m == doctest::Approx(70));
  CHECK(command(bench, at(300, 200, pi / 2), path).height_m == doctest::Approx(70));
  CHECK(command(bench, at(0, -100, pi / 2), path).height_m == doctest::Approx(40));
  CHECK(command(bench, at(0, 0, pi / 2, 20), path).climb_rate_mps == doctest::Approx(2));
  CHECK(std::abs(command(bench, at(0, 0, 0, 20), path).climb_rate_mps) < 1e-12);  // across it
  CHECK(bench.out.height_error_m.value == doctest::Approx(0));
}

TEST_CASE("a climbing arc gives the height where the aircraft is, through south too") {
  Bench<VectorField> bench;
  Path path = orbit(Turn::right, 100);
  path.climb_ratio = 0.05;
  path.start_rad = pi - 0.1;
  const double azimuth = -pi + 0.1;  // 0.2 rad on
  CHECK(command(bench, at(100 * std::cos(azimuth), 100 * std::sin(azimuth), 0), path).height_m ==
        doctest::Approx(50 + 0.05 * 100 * 0.2));
}

TEST_CASE("the fed-forward bank alone holds a circle over the ground in wind") {
  Bench<VectorField> bench;
  bench.params.field.roll_max.value = 1.2;
  for (const Turn turn : {Turn::right, Turn::left}) {
    const double R = 80, Va = 17, wind_n = 3, wind_e = -4, side = turn == Turn::right ? 1 : -1, dt = 0.002;
    // begin on the circle with the ground track along it
    double n = R, e = 0, psi = side * pi / 2;
    for (int i = 0; i < 50; ++i)
      psi -= wrap_pi(std::atan2(Va * std::sin(psi) + wind_e, Va * std::cos(psi) + wind_n) - side * pi / 2);
    double worst = 0;
    for (int i = 0; i < 15000; ++i) {
      const double vn = Va * std::cos(psi) + wind_n, ve = Va * std::sin(psi) + wind_e;
      VehicleState s = at(n, e, std::atan2(ve, vn), std::hypot(vn, ve));
      s.yaw_rad = wrap_pi(psi);
      const double phi = command(bench, s, orbit(turn, R)).roll_feedforward_rad;
      psi += dt * 9.80665 / Va * std::tan(phi);  // coordinated turn, B&M (9.13): independent of the ground
      n += dt * vn;
      e += dt * ve;
      worst = std::max(worst, std::abs(std::hypot(n, e) - R));
    }
    CHECK(worst < 1.5);
  }
}

TEST_CASE(
    "the bank of the next piece is commanded shortly before it begins, and not when far from the path") {
  Bench<VectorField> bench;
  bench.params.field.lead_time.value = 0.5;
  Path path = line(0);
  path.next_curvature_ratio = -1 / 50.0;
  path.remaining_m = 9;  // 17 m/s for 0.5 s is 8.5 m
  CHECK(command(bench, at(0, 0, 0), path).roll_feedforward_rad == 0);
  path.remaining_m = 8;
  CHECK(command(bench, at(0, 0, 0), path).roll_feedforward_rad ==
        doctest::Approx(-std::atan(17.0 * 17 / (50 * 9.80665))));
  CHECK(command(bench, at(0, 40, 0), path).roll_feedforward_rad == 0);
  CHECK(command(bench, at(0, 0, pi), path).roll_feedforward_rad == 0);
}

TEST_CASE(
    "course commands are wrapped and finite for every path and place, also at the centre of an orbit and on "
    "a vertical line") {
  Random rng(37);
  Bench<VectorField> bench;
  for (int i = 0; i < 5000; ++i) {
    Path path = i % 2 == 0 ? line(rng.uniform(-7, 7), rng.uniform(-0.5, 0.5))
                           : orbit(Turn::left, rng.uniform(0, 100));
    VehicleState s =
        at(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(-pi, pi), rng.uniform(0, 30));
    if (i % 5 == 0) s.position_m = {0, 0, -50};
    if (i % 7 == 0) path.direction_ratio = {0, 0, -1};
    if (i % 11 == 0) path.direction_ratio = {0, 0, 0};
    if (i % 13 == 0) path.radius_m = 0;
    const GuidanceCommand c = command(bench, s, path);
    CHECK(std::abs(c.course_rad) <= pi);
    CHECK(std::isfinite(c.height_m));
    CHECK(std::isfinite(c.climb_rate_mps));
    CHECK(std::abs(c.roll_feedforward_rad) <= 0.785);
  }
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

TEST_CASE("without a position it flies straight on at the height last asked for, and says so") {
  Bench<VectorField> bench;
  Path climbing = orbit(Turn::right, 50);
  climbing.climb_ratio = 0.1;
  const GuidanceCommand before = command(bench, at(0, 55, pi - 0.3), climbing);
  CHECK(before.roll_feedforward_rad > 0.1);
  CHECK(before.climb_rate_mps > 1);
  VehicleState lost = at(700, -300, 2);
  lost.position_valid = false;
  bench.set(bench.in.state, lost);
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK(bench.out.command.course_rad == before.course_rad);
  CHECK(bench.out.command.height_m == before.height_m);
  CHECK(bench.out.command.airspeed_mps == before.airspeed_mps);
  CHECK(bench.out.command.roll_feedforward_rad == 0);
  CHECK(bench.out.command.climb_rate_mps == 0);
  CHECK(command(bench, at(0, 55, pi - 0.3), climbing).roll_feedforward_rad == before.roll_feedforward_rad);
}

TEST_CASE(
    "without a fix the path is flown by the reckoned position, up to a deviation or a time; then a circle") {
  for (const bool by_time : {false, true}) {
    CAPTURE(by_time);
    Bench<VectorField> bench;
    VehicleState s = at(10, 4, 0);
    s.attitude_valid = true;
    const GuidanceCommand known = command(bench, s, line(0));
    s.position_valid = false;
    s.position_std_m = {30, 20, 5};
    for (int i = 0; i < 1140; ++i) {  // 114 s
      bench.set(bench.in.state, s);
      bench.step(0.1);
    }
    CHECK(bench.out.command.course_rad == known.course_rad);
    CHECK(bench.out.command.roll_feedforward_rad == known.roll_feedforward_rad);
    if (!by_time) s.position_std_m = {51, 20, 5};
    s.course_rad = 1.3;
    for (int i = 0; i < (by_time ? 20 : 1); ++i) {
      bench.set(bench.in.state, s);
      CHECK(bench.step(0.1) == Status::degraded);
    }
    // 17 m/s on 100 m: atan(17^2 / (9.80665 * 100)) = 16.42 deg
    CHECK(bench.out.command.roll_feedforward_rad == doctest::Approx(0.28660).epsilon(1e-3));
    CHECK(bench.out.command.course_rad == 1.3);
    CHECK(bench.out.command.height_m == known.height_m);
    CHECK(bench.out.command.climb_rate_mps == 0);
    s.position_valid = true;  // and back, with the whole time again
    CHECK(command(bench, s, line(0)).roll_feedforward_rad == 0);
  }
}

TEST_CASE("each outage has the whole time, and the larger of the two deviations counts") {
  Reckoning reckoning;
  VehicleState s = at(0, 0, 0);
  s.attitude_valid = true;
  constexpr std::int64_t second = 1'000'000'000;
  const auto located = [&](double now_s, bool valid, double north_std, double east_std) {
    s.position_valid = valid;
    s.position_std_m = {north_std, east_std, 5};
    return reckoning.located(s, static_cast<std::int64_t>(now_s) * second, 50, 115);
  };
  CHECK_FALSE(located(0, false, 1, 1));  // never valid
  CHECK(located(10, true, 1, 1));
  CHECK(located(20, false, 1, 1));
  CHECK(located(134, false, 1, 1));
  CHECK_FALSE(located(136, false, 1, 1));
  CHECK(located(140, true, 1, 1));
  CHECK(located(150, false, 1, 1));
  CHECK(located(264, false, 50, 50));
  CHECK_FALSE(located(264, false, 51, 1));
  CHECK_FALSE(located(264, false, 1, 1));  // for good, or it would circle and fly on by turns
  CHECK(located(270, true, 1, 1));
  CHECK(located(271, false, 1, 1));
  CHECK_FALSE(located(272, false, 1, 51));
}

TEST_CASE("a position is reckoned on by attitude and velocity: without either it is lost") {
  for (const bool attitude : {true, false}) {
    CAPTURE(attitude);
    Reckoning reckoning;
    VehicleState s = at(0, 0, 0);
    s.attitude_valid = true;
    s.position_std_m = {1, 1, 1};
    CHECK(reckoning.located(s, 0, 50, 115));
    s.position_valid = false;
    CHECK(reckoning.located(s, 1, 50, 115));
    (attitude ? s.attitude_valid : s.velocity_valid) = false;
    CHECK_FALSE(reckoning.located(s, 2, 50, 115));
  }
}

TEST_CASE("beyond 60 degrees of crab the bank grows no further: the formula means nothing there") {
  constexpr double g = 9.80665;
  CHECK(bank_for(0.01, 10, pi / 3, 1.4) == doctest::Approx(std::atan(100 * 0.01 / (g * 0.5))));
  CHECK(bank_for(0.01, 10, 1.4, 1.4) == doctest::Approx(std::atan(100 * 0.01 / (g * 0.5))));
  CHECK(bank_for(-0.01, 10, -2.5, 1.4) == doctest::Approx(-std::atan(100 * 0.01 / (g * 0.5))));
}

TEST_CASE("on a curve its own course, height, climb and bank are commanded, beside it the way back") {
  const Curve curve{{Vec3<Ned>{0, 0, -50}, {120, 0, -50}, {240, 60, -60}, {240, 240, -70}}};
  for (const double u : {0.2, 0.5, 0.7}) {
    Path path;
    path.next_curvature_ratio = -0.5;
    set_curve(path, curve, u);
    constexpr double h = 1e-5, Vg = 23;
    const Vec3<Ned> here = curve.point(u), a = curve.point(u - h), b = curve.point(u + h);
    const double course = std::atan2(b.east - a.east, b.north - a.north);
    const double metres = std::hypot(b.north - a.north, b.east - a.east);
    const double kappa = (curve.course_rad(u + h) - curve.course_rad(u - h)) / metres;
    Bench<VectorField> bench;
    bench.params.field.lead_time.value = 0;
    const GuidanceCommand on = command(bench, at(here.north, here.east, course, Vg), path);
    CHECK(std::abs(angle_difference(on.course_rad, course)) < 1e-4);
    CHECK(on.height_m == doctest::Approx(-here.down));
    CHECK(on.climb_rate_mps / (Vg * (a.down - b.down) / metres) == doctest::Approx(1).epsilon(1e-4));
    CHECK(std::tan(on.roll_feedforward_rad) / (Vg * Vg * kappa / 9.80665) ==
          doctest::Approx(1).epsilon(1e-4));
    const double north = -std::sin(course), east = std::cos(course);  // to its right
    const GuidanceCommand right =
        command(bench, at(here.north + 3 * north, here.east + 3 * east, course, Vg), path);
    CHECK(bench.out.cross_track_m.value == doctest::Approx(3).epsilon(1e-4));
    CHECK(angle_difference(right.course_rad, course) / (-1.05 * (2 / pi) * std::atan(0.05 * 17 / Vg * 3)) ==
          doctest::Approx(1).epsilon(1e-3));
    CHECK(command(bench, at(here.north - 3 * north, here.east - 3 * east, course, Vg), path).course_rad >
          course);
  }
  Path end;  // the bank of the next piece is commanded before the end
  end.next_curvature_ratio = -0.01;
  set_curve(end, curve, 0.999);
  const Vec3<Ned> here = curve.point(0.999);
  Bench<VectorField> bench;
  CHECK(command(bench, at(here.north, here.east, curve.course_rad(1)), end).roll_feedforward_rad < 0);
}

}  // namespace vector_field_test
