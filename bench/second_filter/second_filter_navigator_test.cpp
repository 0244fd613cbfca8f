// SPDX-License-Identifier: BSD-3-Clause
// Flights of the navigator with simulated sensors: faults, gaps, and what each measurement may correct.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/second_filter/sensors.hpp"
#include "bench/second_filter/simulated_flight.hpp"

namespace second_filter_navigator_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using simulated::g;
using simulated::normal;

namespace {

constexpr double lat_deg = 47.4, lon_deg = 8.5, alt_m = 400;

/// The path of simulated_flight.hpp in wind, 300 m above the origin, in sensors: an inertial unit at 100 Hz,
/// magnetometer, barometer and pitot at 20 Hz, a receiver at 5 Hz. It begins with the true state.
struct Sensors {
  Random r;
  simulated::Path path;
  Params p;
  Navigator n;
  LocalFrame frame{lat_deg, lon_deg, alt_m};
  Vector3d wind_n{3, -2, 0}, field_n = magnetic_field_ned(lat_deg, lon_deg, alt_m, 2026.0);
  Vector3d p_n{0, 0, -300};
  Vector3d fix_off = Vector3d::Zero();                                 ///< m: of the receiver
  Vector3d accel_off = Vector3d::Zero(), gyro_off = Vector3d::Zero();  ///< of the inertial unit
  double baro_off_m = 0, tube_share = 1;                               ///< of the pressures
  double field_turn = 0;                                               ///< rad: of the magnetometer
  bool has_unit = true, has_others = true;
  double age_s = 0;        ///< of a fix
  double shaken_mps2 = 0;  ///< noise of the accelerometers beside the usual
  int ticks = 0;

  explicit Sensors(std::uint64_t seed, bool turns = true) : r(seed), path{turns} {
    VehicleState s;
    s.attitude = from_eigen(Quaterniond(path.R_nb(0)));
    s.velocity_mps = from_eigen<Ned>(v_n());
    s.position_m = from_eigen<Ned>(p_n);
    s.wind_mps = from_eigen<Ned>(wind_n);
    s.wind_std_mps = {0.5, 0.5, 0.5};
    s.position_valid = s.origin_valid = true;
    s.origin_latitude_deg = lat_deg;
    s.origin_longitude_deg = lon_deg;
    s.origin_altitude_m = alt_m;
    n.resume(s, p, 0);
  }
  double time_s() const { return 0.01 * ticks; }
  Vector3d v_n() const { return path.v_n(time_s()) + wind_n; }
  double height_error() const { return n.filter()(pos + 2) - p_n.z(); }
  Vector2d place_error() const { return (n.filter().state().p_n() - p_n).head<2>(); }
  Vector2d wind_error() const { return n.filter().state().air_n().head<2>() - wind_n.head<2>(); }

  void unit() {
    constexpr double dt = 0.01;
    n.imu(path.rate_b(time_s()) + gyro_off + 5e-4 / std::sqrt(dt) * normal(r),
          path.force_b(time_s()) + accel_off + (0.02 / std::sqrt(dt) + shaken_mps2) * normal(r), time_s(), p);
  }
  void step() {
    const Vector3d v_before = v_n();
    ++ticks;
    p_n += 0.005 * (v_before + v_n());
    if (!has_unit) return;
    unit();
    if (has_others) others();
  }
  void others() {
    const Air air = standard_air(alt_m - p_n.z());
    if (ticks % 5 == 0) {
      const Vector3d turned = exp_map({0, 0, field_turn}) * field_n;
      n.mag(path.R_nb(time_s()).transpose() * turned + 0.01 * field_n.norm() * normal(r), p);
      n.baro(standard_air(alt_m - p_n.z() + baro_off_m).pressure_pa + 3 * r.normal(), p);
      n.pitot(tube_share * 0.5 * air.density_kgm3 * path.v_n(time_s()).squaredNorm() + r.normal(), p);
    }
    if (ticks % 20 == 0) fix();
  }
  void fix() {
    const LocalFrame::Geodetic at = frame.from_ned(p_n - age_s * v_n() + fix_off + 0.3 * normal(r));
    Gnss fix;
    fix.fix = FixType::fix_3d;
    fix.latitude_deg = at.lat_deg;
    fix.longitude_deg = at.lon_deg;
    fix.altitude_m = at.alt_m;
    fix.velocity_mps = from_eigen<Ned>(Vector3d(path.v_n(time_s() - age_s) + wind_n + 0.05 * normal(r)));
    fix.horizontal_std_m = 2;
    fix.vertical_std_m = 3;
    fix.speed_std_mps = 0.2;
    n.gnss(fix, time_s() - age_s, p);
  }
  void fly(double seconds) {
    for (int k = 0; k < std::lround(100 * seconds); ++k) step();
  }
};

}  // namespace

TEST_CASE("navigator: a flight without a fault stays without one, and near the truth") {
  Sensors s(60);
  s.fly(60);
  for (const Aid* aid :
       {&s.n.health().horizontal, &s.n.health().height, &s.n.health().velocity, &s.n.health().baro,
        &s.n.health().pitot, &s.n.health().gyro, &s.n.health().accel, &s.n.health().heading})
    CHECK(aid->faulty_s == never);
  CHECK((s.n.filter().state().v_n() - s.v_n()).norm() < 0.5);
  CHECK(std::abs(s.height_error()) < 1.5);
  CHECK(s.wind_error().norm() < 1);
  CHECK(s.n.resets().count == 0);
  CHECK(s.n.filter().sideslip_gust == s.p.sideslip_gust);
}

TEST_CASE("navigator: at half pressure of the pitot the wind stays, whatever an old hypothesis has become") {
  for (const bool turns : {true, false}) {
    CAPTURE(turns);
    Sensors s(61, turns);
    s.fly(50);
    const Vector2d before = s.n.filter().state().air_n().head<2>();
    s.tube_share = 0.5;
    double moved = 0;
    for (int k = 0; k < 300; ++k) {
      s.fly(0.1);
      moved = std::max(moved, (s.n.filter().state().air_n().head<2>() - before).norm());
    }
    CHECK(moved < 2);
    CHECK(s.n.health().pitot.faulty_s > 50);
    CHECK(s.n.health().pitot.faulty_s < 52);
    CHECK(s.n.filter()(tube_bias) < -80);  // half of some 230 Pa
    CHECK(s.n.health().accel.faulty_s == never);
  }
}

TEST_CASE("navigator: after a gap of 2 s the height is that of before, with a receiver that is 4 m off") {
  for (const double off : {4.0, -4.0}) {
    CAPTURE(off);
    Sensors s(62);
    s.fix_off << 0.5, -0.5, off;
    s.age_s = 0.15;
    s.fly(60);
    const double before = s.height_error();
    const Vector2d place = s.place_error();
    s.has_unit = false;
    s.fly(2);
    s.has_unit = true;
    s.n.imu(s.path.rate_b(s.time_s()), s.path.force_b(s.time_s()), s.time_s(), s.p);
    CHECK(s.n.regaining());
    double moved = 0, moved_aside = 0;
    int aligned = 0;
    for (int k = 0; k < 1000; ++k) {
      s.fly(0.01);
      if (!s.n.aligned()) continue;
      ++aligned;
      moved = std::max(moved, std::abs(s.height_error() - before));
      moved_aside = std::max(moved_aside, (s.place_error() - place).norm());
      if (aligned == 1) CHECK(s.n.filter().std(pos) < 2.5);
    }
    CHECK(moved_aside < 2);
    CHECK(aligned > 500);
    CHECK(moved < 1.5);
    CHECK(s.n.resets().count == 1);
    CHECK(std::abs(s.n.filter()(fix_pos + 2) - off) < 2);
  }
}

TEST_CASE("navigator: a jump of the barometer is named, and its walk fades with 5 s") {
  Sensors s(63);
  s.fly(50);
  s.baro_off_m = 12;
  s.fly(3);
  const Aid& baro = s.n.health().baro;
  REQUIRE(baro.faulty_s > 50);
  CHECK(baro.faulty_s < 51.5);
  CHECK(baro.faulty(s.time_s()));
  s.n.tune(s.p);
  const double usual = s.p.baro_walk * std::sqrt(baro.level.slow());
  CHECK(s.n.filter().block(baro_bias).walk ==
        doctest::Approx(std::hypot(usual, std::exp(-(s.time_s() - baro.faulty_s) / 5))).epsilon(1e-6));
  CHECK(baro.level.slow() != doctest::Approx(1).epsilon(0.02));
  CHECK(s.n.filter().block(port).walk ==
        doctest::Approx(s.p.static_port_walk * std::sqrt(std::max(baro.level.slow(), 0.25))));
  CHECK(std::abs(s.n.filter()(baro_bias) - 12) < 3);
  CHECK(std::abs(s.height_error()) < 2);
}

TEST_CASE("navigator: accelerometers that jump along x and y at once are named, their bias follows") {
  Sensors s(64);
  s.fly(50);
  s.accel_off << 0.8, 0.8, 0;
  s.fly(3);
  CHECK(s.n.health().accel.faulty_s > 50);
  CHECK((s.n.filter().state().at<3>(accel_bias) - s.accel_off).norm() < 0.4);
  CHECK(s.n.health().gyro.faulty_s == never);
  CHECK(s.n.health().heading.faulty_s == never);
}

TEST_CASE("navigator: accelerometers that are shaken are not judged") {
  for (const double shaken : {0.0, 1.0, 5.0}) {
    CAPTURE(shaken);
    Sensors s(68);
    s.shaken_mps2 = shaken;
    s.fly(50);
    s.accel_off << 3, 3, 0;
    s.fly(4);
    CHECK((s.n.health().accel.faulty_s > 50) == (shaken < 3));
  }
}

TEST_CASE("navigator: a pitot has its noise in pascals, of its scale, and that of being late") {
  for (const double ahead : {0.0, 20.0}) {
    CAPTURE(ahead);
    Sensors s(69, false);
    s.p.pitot_scale.value = 1.1;
    s.p.pitot_speed_std.value = 0.4;
    s.fly(0.5);
    s.has_others = false;
    s.accel_off.x() = ahead;
    s.fly(0.3);
    const Filter& f = s.n.filter();
    const double density = standard_air(alt_m - f(pos + 2)).density_kgm3,
                 speed = f.state().through_air_n().norm();
    // The airspeed of 0.1 s before: less by 20 m/s2 times the share of 0.1 s that 0.3 s fill.
    const double late = ahead * 0.1 * (1 - std::exp(-3.0)), per_speed = density * speed;
    const double by_speed = 0.4 * per_speed;
    Scalar z;
    z.H = tube_pressure(f, 0, density, 1 / 1.1).H;
    const double variance =
        (1 + by_speed * by_speed) * s.n.health().pitot.level.white() + std::pow(late * per_speed, 2);
    const double std = f.expected_std(z, variance), read = 0.5 * density * std::pow(speed / 1.1, 2) + 2 * std;
    s.n.pitot(read, s.p);
    CHECK(s.n.health().pitot.ratio == doctest::Approx(2).epsilon(0.04));
  }
}

TEST_CASE("navigator: after a fault each error may go on changing, by the integral of the fading walk") {
  const auto walk = [](Aid second_filter::Health::*of, int state, bool ramp, double seconds) {
    Sensors s(65, false);
    s.has_others = false;
    s.fly(1);
    (s.n.health().*of).fault(s.n.time_s(), ramp);
    s.n.filter().forget(state, 1, 0);
    s.n.tune(s.p);
    for (int k = 0; k < 10 * seconds; ++k) {
      s.fly(0.1);
      s.n.tune(s.p);  // more often than the navigator itself
    }
    return s.n.filter().covariance()(state, state);
  };
  for (const auto& [ramp, seconds] : {std::pair{false, 10.0}, {true, 10.0}}) {
    CAPTURE(ramp);
    const double time_s = ramp ? 30 : 5, faded = 0.5 * time_s * (1 - std::exp(-2 * seconds / time_s));
    const Params p;
    const auto near = [&](double variance, double usual, double faulty) {
      CHECK(variance == doctest::Approx(usual * usual * seconds + faulty * faulty * faded).epsilon(0.03));
    };
    near(walk(&second_filter::Health::baro, baro_bias, ramp, seconds), p.baro_walk, 1);
    near(walk(&second_filter::Health::pitot, tube_bias, ramp, seconds), 0, 20);
    near(walk(&second_filter::Health::heading, mount, ramp, seconds), 0, 0.05);
    near(walk(&second_filter::Health::gyro, gyro_bias, ramp, seconds), p.gyro_bias_walk, 1e-3);
    near(walk(&second_filter::Health::accel, accel_bias, ramp, seconds), p.accel_bias_walk, 0.05);
  }
}

TEST_CASE("navigator: a zero sideslip corrects the wind, but no attitude, climb, height or barometer") {
  Sensors s(66);
  s.fly(20);
  s.has_others = false;
  while (!(std::fmod(s.time_s() + 0.05, 0.1) < 0.005)) s.fly(0.01);
  s.n.filter().correct(gust + 1, 2);
  Filter alone = s.n.filter();
  const double accepted = s.n.health().sideslip.accepted_s;
  for (int k = 0; k < 12; ++k) {
    ++s.ticks;
    const Vector3d rate = s.path.rate_b(s.time_s()), force = s.path.force_b(s.time_s());
    s.n.imu(rate, force, s.time_s(), s.p);
    alone.unit = s.n.filter().unit;
    alone.predict(rate, force, 0.01);
  }
  REQUIRE(s.n.health().sideslip.accepted_s > accepted);
  const auto change = [&](int state, int count) {
    return s.n.filter().state().minus(alone.state()).segment(state, count).norm();
  };
  CHECK(change(wind, 2) > 0.01);
  CHECK(change(gust, 2) > 0.01);
  CHECK(change(slip, 1) > 0.01);
  for (const auto& [state, count] : {std::pair{+theta, 3},
                                     {vel + 2, 1},
                                     {pos + 2, 1},
                                     {+gyro_bias, 3},
                                     {+accel_bias, 3},
                                     {+fix_pos, 6},
                                     {+baro_bias, 1}}) {
    CAPTURE(state);
    CHECK(change(state, count) < 1e-9);
  }
}

TEST_CASE("navigator: the magnetometer waits until the tilt is known") {
  for (const double tilt_std : {0.02, 0.045, 0.055, 0.2}) {
    CAPTURE(tilt_std);
    Sensors s(67, false);
    s.fly(5);
    s.has_others = false;
    s.n.filter().forget(theta, 2, tilt_std);
    s.n.filter().forget(theta + 2, 1, 0.3);
    s.fly(0.2);
    const double before = s.n.filter().std(theta + 2);
    s.n.mag(s.path.R_nb(0).transpose() * s.field_n, s.p);
    CHECK((s.n.filter().std(theta + 2) < 0.9 * before) == (tilt_std < 0.05));
  }
}

}  // namespace second_filter_navigator_test
