// SPDX-License-Identifier: BSD-3-Clause
// Airspeed by thrust and drag: a straight flight of varying speed whose forward force is 10 m/s2 times the
// throttle minus a drag of V^2 / 80 m.
#include <doctest/doctest.h>

#include <cmath>

#include "bench/second_filter/thrust.hpp"
#include "fulmar/random.hpp"

namespace second_filter_thrust_test {

using namespace fulmar;
using namespace fulmar::second_filter;

namespace {

constexpr double g = 9.80665;

struct Straight {
  Random r{71};
  Params p;
  Navigator n;
  Thrust thrust;
  LocalFrame frame{47, 8, 0};
  double north_m = 0, speed_mps = 20, motor = 1;  ///< share of the thrust that is there
  bool has_pitot = true, has_fixes = true, commanded = true;
  int ticks = 0;

  Straight() {
    VehicleState s;
    s.velocity_mps.north = speed_mps;
    s.position_m.down = -100;
    s.wind_std_mps = {0.5, 0.5, 0.5};
    s.position_valid = s.origin_valid = true;
    s.origin_latitude_deg = 47;
    s.origin_longitude_deg = 8;
    n.resume(s, p, 0);
  }
  void step() {
    constexpr double dt = 0.01;
    const double t = dt * ++ticks, throttle = 0.5 + 0.15 * std::sin(0.4 * t);
    const double force = 10 * throttle * motor - speed_mps * speed_mps / 80;
    north_m += dt * (speed_mps + 0.5 * dt * force);
    speed_mps += dt * force;
    n.imu(Vector3d(1e-3 * r.normal(), 1e-3 * r.normal(), 1e-3 * r.normal()),
          Vector3d(force + 0.05 * r.normal(), 0.05 * r.normal(), -g + 0.05 * r.normal()), t, p);
    const Air air = standard_air(100);
    if (ticks % 5 == 0) n.baro(air.pressure_pa + 2 * r.normal(), p);
    if (has_pitot && ticks % 5 == 0) n.pitot(0.5 * air.density_kgm3 * speed_mps * speed_mps + r.normal(), p);
    if (has_fixes && ticks % 20 == 0) fix(t);
    thrust.step(n, throttle, commanded, dt, p);
  }
  void fix(double t) {
    const LocalFrame::Geodetic at = frame.from_ned({north_m, 0, -100});
    Gnss fix;
    fix.fix = FixType::fix_3d;
    fix.latitude_deg = at.lat_deg;
    fix.longitude_deg = at.lon_deg;
    fix.altitude_m = at.alt_m;
    fix.velocity_mps = {speed_mps + 0.05 * r.normal(), 0.05 * r.normal(), 0.05 * r.normal()};
    fix.horizontal_std_m = fix.vertical_std_m = 2;
    fix.speed_std_mps = 0.2;
    n.gnss(fix, t, p);
  }
  void fly(double seconds) {
    for (int k = 0; k < std::lround(100 * seconds); ++k) step();
  }
  double error_mps() const { return n.filter().state().through_air_n().norm() - speed_mps; }
};

}  // namespace

TEST_CASE("thrust: it supplies the airspeed without pitot and receiver, and not beside the pitot") {
  Straight s;
  s.fly(90);
  CHECK(!s.thrust.in_use());
  s.has_pitot = s.has_fixes = false;
  s.fly(0.4);
  CHECK(!s.thrust.in_use());
  s.fly(60);
  CHECK(s.thrust.in_use());
  CHECK(std::abs(s.error_mps()) < 1);
  CHECK(s.n.filter().std(model) > 0.2);
  Straight without;
  without.commanded = false;
  without.fly(90);
  without.has_pitot = without.has_fixes = false;
  without.fly(60);
  CHECK(!without.thrust.in_use());
  const auto std = [](const Filter& f) { return f.expected_std(modelled_airspeed(f, 0), 0); };
  CHECK(std(s.n.filter()) < 0.6 * std(without.n.filter()));
  s.has_pitot = true;
  s.fly(1);
  CHECK(!s.thrust.in_use());
}

TEST_CASE("thrust: a motor that stops ends it until the pitot returns, and the wind stays") {
  Straight s;
  s.fly(90);
  s.has_pitot = s.has_fixes = false;
  s.fly(10);
  REQUIRE(s.thrust.in_use());
  const Vector2d wind_before = s.n.filter().state().air_n().head<2>();
  s.motor = 0;
  s.fly(2);
  CHECK(!s.thrust.in_use());
  CHECK((s.n.filter().state().air_n().head<2>() - wind_before).norm() < 2);
  s.motor = 1;
  s.fly(5);
  CHECK(!s.thrust.in_use());
  s.has_pitot = true;
  s.fly(20);
  s.has_pitot = false;
  s.fly(1);
  CHECK(s.thrust.in_use());
}

TEST_CASE("thrust: before it is learnt it is not used") {
  Straight s;
  s.fly(12);
  s.has_pitot = false;
  s.fly(5);
  CHECK(!s.thrust.in_use());
}

}  // namespace second_filter_thrust_test
