// SPDX-License-Identifier: BSD-3-Clause
// The navigator by single samples: the limits of each gate, and the state after a switch, a bridge and a gap.
#include "fulmar/flight/navigation/navigator.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/testing.hpp>
#include <numbers>

#include "fulmar/flight/navigation/estimator.hpp"

namespace navigator_test {

using namespace fulmar;
using namespace fulmar::navigation;

namespace {

constexpr double pi = std::numbers::pi, lat = 40.25, lon = -111.65, alt = 1387;
const Vector3d still_omega = Vector3d::Zero(), level_f(0, 0, -isa::g0);

/// In the air at 17 m/s to the north, level.
VehicleState flying() {
  VehicleState s;
  s.velocity_mps = {17, 0, 0};
  s.position_m = {0, 0, -70};
  s.origin_latitude_deg = lat;
  s.origin_longitude_deg = lon;
  s.origin_altitude_m = alt;
  s.origin_valid = s.position_valid = true;
  return s;
}

Navigator resumed(const VehicleState& s, const Params& p = {}) {
  Navigator n;
  n.resume(s, p, 10);
  return n;
}

Gnss fix(double north_mps = 17, double east_mps = 0, double down_mps = 0) {
  Gnss g;
  g.latitude_deg = lat;
  g.longitude_deg = lon;
  g.altitude_m = alt + 70;
  g.velocity_mps = {north_mps, east_mps, down_mps};
  g.horizontal_std_m = 1;
  g.vertical_std_m = 2;
  g.speed_std_mps = 0.2;
  g.fix = FixType::fix_3d;
  return g;
}

VehicleStatus on_the_ground() {
  VehicleStatus s;
  s.on_ground = true;
  return s;
}

/// At rest without a magnetometer, until `until_s`.
void stand(Navigator& n, const Params& p, double until_s, double hz = 200) {
  n.status(on_the_ground());
  while (n.time_s() < until_s) n.imu(still_omega, level_f, n.time_s() + 1 / hz, p);
}
Navigator standing(const Params& p, double until_s, double hz = 200) {
  Navigator n;
  n.start(p);
  n.imu(still_omega, level_f, 1 / hz, p);
  stand(n, p, until_s, hz);
  return n;
}

double std_of(const Navigator& n, int state) { return n.filter().std(state); }

}  // namespace

TEST_CASE("taken over without a position it does not know where it is") {
  VehicleState s = flying();
  CHECK(std_of(resumed(s), ekf::pos) == doctest::Approx(5));
  s.position_valid = false;
  CHECK(std_of(resumed(s), ekf::pos) == doctest::Approx(1e3));
}

TEST_CASE(
    "after its first fix it knows where it is as well as the receiver, and what that is off by as well") {
  const Params p;
  VehicleState s = flying();
  s.position_valid = false;
  Navigator n = resumed(s);
  n.imu(still_omega, level_f, 10.0025, p);
  n.gnss(fix(), 10.0025, p);
  CHECK(std_of(n, ekf::pos) ==
        doctest::Approx(std::sqrt(2.0)).epsilon(0.01));  // 1 m reported, slow and white
  CHECK(std_of(n, ekf::gnss) == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("a sample at the time of the last one is none") {
  const Params p;
  Navigator n = resumed(flying());
  CHECK(n.imu(still_omega, level_f, 10.01, p));
  CHECK_FALSE(n.imu(still_omega, level_f, 10.01, p));
  CHECK_FALSE(n.imu(still_omega, level_f, 10.0, p));
  CHECK(n.imu(still_omega, level_f, 10.02, p));
}

TEST_CASE("a fix knows as much of the height as there are correlation times since the last one") {
  const Params p;
  Navigator n = resumed(flying());
  double at_s = 10.0025, last_s = 0;  // after the longest interval that counts, 10 s, and after 1 s
  for (const double since_s : {10.0, 1.0}) {
    if (last_s > 0)
      for (at_s = last_s; at_s < last_s + since_s - 0.001;) n.imu(still_omega, level_f, at_s += 0.0025, p);
    else
      n.imu(still_omega, level_f, at_s, p);
    const double before = std_of(n, ekf::pos + 2);
    Gnss g = fix();
    g.velocity_mps = {17, 0, n.filter().state().v_n.z()};
    g.speed_std_mps = 1000;  // no information on the velocity
    g.altitude_m = alt - n.filter().state().p_n.z();
    n.gnss(g, at_s + p.gnss_delay, p);
    const double known = 1 / std::pow(std_of(n, ekf::pos + 2), 2) - 1 / (before * before);
    CHECK(1 / known / (4 * (1 + 2 * p.gnss_height_time / since_s)) == doctest::Approx(1).epsilon(0.02));
    last_s = at_s;
  }
}

TEST_CASE("how sure rest makes does not depend on the rate of the inertial unit") {
  const Params p;
  const double slow = std_of(standing(p, 12, 100), ekf::gyro_bias),
               fast = std_of(standing(p, 12, 800), ekf::gyro_bias);
  CHECK(fast / slow == doctest::Approx(1).epsilon(0.05));
  const double v_slow = std_of(standing(p, 12, 100), ekf::vel),
               v_fast = std_of(standing(p, 12, 800), ekf::vel);
  CHECK(v_fast / v_slow == doctest::Approx(1).epsilon(0.1));
}

TEST_CASE("over a bridge the air meets the aircraft as before, and the wind goes on") {
  Params p;
  VehicleState s = flying();
  s.wind_mps = {3, -4, 0};
  Navigator n = resumed(s, p);
  n.imu(still_omega, level_f, 10.0025, p);
  const Vector3d v = n.filter().state().v_n,
                 wind(n.filter().state().wind.x(), n.filter().state().wind.y(), 0);
  REQUIRE(wind.norm() > 2);
  n.bridge(Quaterniond(Eigen::AngleAxisd(pi / 2, Vector3d::UnitZ())), p);
  const Vector3d air = v - wind, turned(-air.y(), air.x(), air.z());  // rotated by 90 deg to the right
  CHECK((n.filter().state().v_n - (turned + wind)).norm() < 1e-9);
}

TEST_CASE("without a magnetometer an alignment waits 2 s for one, after a gap again") {
  Params p;
  Navigator n = standing(p, 1.8);
  CHECK_FALSE(n.aligned());
  stand(n, p, 4);
  REQUIRE(n.aligned());
  n.imu(still_omega, level_f, 4 + p.max_coast + 1, p);
  CHECK_FALSE(n.aligned());
  const double again_s = n.time_s();
  stand(n, p, again_s + 1.8);
  CHECK_FALSE(n.aligned());
  stand(n, p, again_s + 4);
  CHECK(n.aligned());
}

TEST_CASE("the origin is the mean of the fixes, not the last of them") {
  Params p;
  p.origin_fixes.value = 4;
  Navigator n = standing(p, 4);
  for (int i = 0; i < 4; ++i) {
    Gnss g = fix(0);
    g.latitude_deg += 1e-5 * i;
    g.longitude_deg -= 2e-5 * i;
    g.altitude_m = alt + i;
    CHECK_FALSE(n.seen().origin);
    n.gnss(g, n.time_s(), p);
  }
  REQUIRE(n.seen().origin);
  CHECK(std::abs(n.origin().lat_deg - (lat + 1.5e-5)) < 1e-9);
  CHECK(std::abs(n.origin().lon_deg - (lon - 3e-5)) < 1e-9);
  CHECK(n.origin().alt_m == doctest::Approx(alt + 1.5).epsilon(1e-9));
}

TEST_CASE("without a magnetometer the course is the yaw once it is run along the ground, not when carried") {
  const Params p;
  const auto yaw_after = [&](double north, double east, double down) {
    Navigator n = standing(p, 4);
    REQUIRE_FALSE(n.seen().yaw);
    n.gnss(fix(north, east, down), n.time_s(), p);
    return n.seen().yaw ? euler_from(n.filter().R_nb()).yaw_rad : -9;
  };
  CHECK(yaw_after(3, 3, 0) == -9);
  CHECK(yaw_after(0, 0, 6) == -9);
  CHECK(yaw_after(0, 6, 0) == doctest::Approx(pi / 2));
  CHECK(yaw_after(-4, -4, 0) == doctest::Approx(-3 * pi / 4));
}

TEST_CASE("near a magnetic pole the needle is not asked") {
  const Params p;
  const auto asked = [&](double at_lat, double at_lon) {
    VehicleState s = flying();
    s.origin_latitude_deg = at_lat;
    s.origin_longitude_deg = at_lon;
    Navigator n = resumed(s, p);
    n.imu(still_omega, level_f, 10.0025, p);
    const Vector3d field = magnetic_field_ned(at_lat, at_lon, alt, 2026);
    n.mag(field, p);
    return n.health().heading.accepted_s > 0;
  };
  CHECK(asked(lat, lon));
  CHECK_FALSE(asked(85.8, 139));  // World Magnetic Model 2025: the dip pole of 2025
}

TEST_CASE("a pressure that no air has is no pressure") {
  const Params p;
  for (const double pressure : {9e3, 1.3e5, -1.0, std::nan("")}) {
    Navigator n;
    n.start(p);
    n.imu(still_omega, level_f, 0.01, p);
    n.baro(pressure, p);
    CHECK_FALSE(n.seen().altitude);
    n.baro(9e4, p);
    CHECK(n.seen().altitude);
  }
}

TEST_CASE("a fix that was slow long ago is no witness that the aircraft rests") {
  const Params p;
  for (const bool goes_on : {true, false}) {
    CAPTURE(goes_on);
    Navigator n;
    n.start(p);
    for (int i = 1; i <= 1200; ++i) {  // 6 s, in which only the receiver could measure rest
      n.imu(still_omega, level_f, 0.005 * i, p);
      if (i == 20 || (goes_on && i % 200 == 0)) n.gnss(fix(0), n.time_s(), p);
    }
    CHECK(n.aligned() == goes_on);
  }
}

TEST_CASE("an alignment in the air begins after the gap, not with a fix of before take-off") {
  Params p;
  p.max_coast.value = 0.05;
  Navigator n;
  n.start(p);
  double t = 0;
  const auto run = [&](double until_s) {
    while (t < until_s - 1e-9) n.imu(still_omega, level_f, t += 0.005, p);
  };
  run(0.1);
  n.gnss(fix(0), t, p);  // rest not known yet
  n.status(on_the_ground());
  for (const double until_s : {0.5, 0.8, 1.1, 1.4}) {
    run(until_s);
    n.mag(magnetic_field_ned(lat, lon, alt, 2026), p);
  }
  REQUIRE(n.aligned());
  run(5);
  VehicleStatus armed;
  armed.armed = true;
  n.status(armed);
  n.imu(still_omega, level_f, t += 0.06, p);
  REQUIRE_FALSE(n.aligned());
  run(t + 0.2);
  n.gnss(fix(), t, p);  // the first one after it
  CHECK_FALSE(n.aligned());
  run(t + 0.6);
  n.gnss(fix(), t, p);
  CHECK(n.aligned());
}

TEST_CASE("what is kept over a gap becomes unsure as a walk does: with the root of the time") {
  Params p;
  p.accel_bias_std.value = 0.01;
  p.accel_bias_walk.value = 0.1;
  VehicleState s = flying();
  Navigator n = resumed(s, p);
  n.imu(still_omega, level_f, 10.0025, p);
  const double before = std_of(n, ekf::accel_bias), since_s = n.filter().time_s();
  double t = 18;
  n.imu(still_omega, level_f, t, p);
  REQUIRE(n.regaining());
  n.gnss(fix(), t, p);
  while (t < 18.6) n.imu(still_omega, level_f, t += 0.005, p);
  n.gnss(fix(), t, p);
  REQUIRE(n.aligned());
  const double after = std_of(n, ekf::accel_bias);
  CHECK((after * after - before * before) / (0.1 * 0.1 * (t - since_s)) == doctest::Approx(1));
}

TEST_CASE("the magnetic field is that of the year which the receiver tells, also where the origin is given") {
  const Params p;
  constexpr double there_lat = 55,
                   there_lon = -125;  // the declination moves west by a fifth of a degree per year
  VehicleState s = flying();
  s.origin_latitude_deg = there_lat;
  s.origin_longitude_deg = there_lon;
  Navigator n = resumed(s, p);
  n.imu(still_omega, level_f, 10.0025, p);
  Gnss g = fix();
  g.latitude_deg = there_lat;
  g.longitude_deg = there_lon;
  g.utc_ns = 1893456000'000'000'000 - 86400'000'000'000;  // a day before 2030
  n.gnss(g, n.time_s(), p);
  const Vector3d now = magnetic_field_ned(there_lat, there_lon, alt, decimal_year(g.utc_ns)),
                 then = magnetic_field_ned(there_lat, there_lon, alt, 2026);
  REQUIRE(std::abs(std::atan2(now.y(), now.x()) - std::atan2(then.y(), then.x())) > 0.003);
  n.mag(now, p);
  CHECK(std::abs(n.health().heading.ratio) < 1e-3);
}

TEST_CASE("a fix that is older than what is remembered says nothing of now") {
  const Params p;
  for (const double late_s : {0.3, 1.5}) {
    CAPTURE(late_s);
    Navigator n = resumed(flying());
    while (n.time_s() < 12) n.imu(still_omega, level_f, n.time_s() + 0.0025, p);
    n.gnss(fix(), n.time_s() - late_s, p);
    CHECK((n.health().velocity.accepted_s == n.time_s()) == (late_s < 1));
  }
}

namespace {

using EkfBench = Bench<Ekf>;
void imu(EkfBench& bench) {
  Imu sample;
  sample.specific_force_mps2 = {0, 0, -isa::g0};
  bench.set(bench.in.imu, sample, -0.0025);  // valid at the next step
}
void take_over(EkfBench& bench, VehicleState s) {
  s.attitude_valid = s.velocity_valid = true;
  s.wind_std_mps = {1, 1, unknown_std};
  imu(bench);
  Ekf::Outputs last;
  last.state.value = s;
  REQUIRE(bench.activate(last) == Status::ok);
  bench.tick.now_ns += 2'500'000;  // the first sample after the switch
}
void fly(EkfBench& bench, int steps) {
  for (int i = 0; i < steps; ++i) {
    imu(bench);
    bench.step(0.0025);
  }
  REQUIRE(bench.out.state.written);
}

}  // namespace

TEST_CASE("who has not stepped for a while takes over from who flew meanwhile; who has goes on by itself") {
  for (const bool rested : {true, false}) {
    CAPTURE(rested);
    EkfBench bench;
    bench.tick.now_ns = 10'000'000'000;
    take_over(bench, flying());
    fly(bench, 40);
    VehicleState other = flying();
    other.position_m.north = 500;
    if (rested) bench.tick.now_ns += 1'000'000'000;
    take_over(bench, other);
    fly(bench, 4);
    CHECK((bench.out.state.value.position_m.north > 499) == rested);
  }
}

TEST_CASE("after a gap of t the position may be off by what an acceleration unseen makes of it: a t^2 / 2") {
  EkfBench bench;
  bench.tick.now_ns = 10'000'000'000;
  take_over(bench, flying());
  fly(bench, 40);
  const VehicleState before = bench.out.state.value;
  bench.step(2);
  REQUIRE(bench.out.state.written);
  const VehicleState& after = bench.out.state.value;
  REQUIRE_FALSE(after.velocity_valid);
  const auto grown = [](double then, double now) { return std::sqrt(now * now - then * then); };
  CHECK(grown(before.velocity_std_mps.north, after.velocity_std_mps.north) / (5 * 2) ==
        doctest::Approx(1).epsilon(0.01));
  CHECK(grown(before.position_std_m.north, after.position_std_m.north) / (0.5 * 5 * 4) ==
        doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("a height that may be off by more than 20 m is not called valid, though there is one") {
  for (const double std_m : {10.0, 30.0}) {
    CAPTURE(std_m);
    EkfBench bench;
    bench.tick.now_ns = 10'000'000'000;
    VehicleState s = flying();
    s.position_valid = false;
    take_over(bench, s);
    fly(bench, 4);
    Gnss g = fix();
    g.vertical_std_m = std_m;
    bench.set(bench.in.gnss, g);
    fly(bench, 8);
    CHECK(bench.out.state.value.position_std_m.down / std_m == doctest::Approx(1).epsilon(0.1));
    CHECK(bench.out.state.value.height_valid == (std_m < 20));
  }
}

}  // namespace navigator_test
