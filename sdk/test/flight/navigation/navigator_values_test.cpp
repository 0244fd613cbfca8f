// SPDX-License-Identifier: BSD-3-Clause
// Values of the navigator by single samples: state taken over at a switch, shift by a fix of any standard
// deviation, waiting time of a rejected sensor, tilted attitudes that do not point north.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/navigation/navigator_updates.hpp>

namespace navigator_values_test {

using namespace fulmar;
using namespace fulmar::navigation;
using doctest::Approx;

namespace {

constexpr double lat = 40.25, lon = -111.65, alt = 1387;

/// A state with a different value in each field, so that an exchange is detected.
VehicleState odd() {
  VehicleState s;
  s.attitude = from_eigen(quaternion_from({0.2, -0.1, 2.4}));
  s.velocity_mps = {-12, 11, 1.5};
  s.position_m = {130, -240, -75};
  s.gyro_bias_radps = {0.01, -0.02, 0.03};
  s.accel_bias_mps2 = {0.1, 0.2, -0.3};
  s.wind_mps = {3, -4, 0};
  s.wind_std_mps = {0.8, 1.7, 0};
  s.origin_latitude_deg = lat;
  s.origin_longitude_deg = lon;
  s.origin_altitude_m = alt;
  s.origin_valid = s.position_valid = true;
  s.reset_count = 4;
  s.reset_position_m = {1, 2, 3};
  s.reset_velocity_mps = {4, 5, 6};
  s.reset_yaw_rad = 0.7;
  return s;
}
Navigator resumed(const VehicleState& s, const Params& p = {}) {
  Navigator n;
  n.resume(s, p, 10);
  return n;
}
double std_of(const Navigator& n, int i) { return n.filter().std(i); }

/// Fix at the estimated position and velocity, with these errors.
Gnss fix_at(const Navigator& n, const Vector3d& off_m, const Vector3d& off_mps) {
  const LocalFrame frame(lat, lon, alt);
  const auto at = frame.from_ned(n.filter().state().p_n + off_m);
  Gnss g;
  g.latitude_deg = at.lat_deg;
  g.longitude_deg = at.lon_deg;
  g.altitude_m = at.alt_m;
  g.velocity_mps = from_eigen<Ned>(Vector3d(n.filter().state().v_n + off_mps));
  g.horizontal_std_m = 3;
  g.vertical_std_m = 6;
  g.speed_std_mps = 0.4;
  g.fix = FixType::fix_3d;
  return g;
}
/// Flies without acceleration until `until_s`.
void fly(Navigator& n, const Params& p, double until_s) {
  const ekf::Nominal& x = n.filter().state();
  while (n.time_s() < until_s - 1e-9)
    n.imu(x.gyro_bias, x.q_nb.conjugate() * Vector3d(0, 0, -p.gravity) + x.accel_bias, n.time_s() + 0.01, p);
}

}  // namespace

TEST_CASE("it takes over each part of an estimate, and is as sure of it as it may be") {
  const Params p;
  const VehicleState s = odd();
  const Navigator n = resumed(s);
  const ekf::Nominal& x = n.filter().state();
  CHECK(x.q_nb.angularDistance(eigen(s.attitude)) < 1e-9);
  CHECK(x.v_n == eigen(s.velocity_mps));
  CHECK(x.p_n == eigen(s.position_m));
  CHECK(x.gyro_bias == eigen(s.gyro_bias_radps));
  CHECK(x.accel_bias == eigen(s.accel_bias_mps2));
  CHECK(x.wind == Vector2d(3, -4));
  CHECK(n.aligned());
  CHECK(n.seen().yaw);
  CHECK(n.seen().position);
  CHECK(n.origin().lat_deg == lat);
  CHECK(n.origin().lon_deg == lon);
  CHECK(n.origin().alt_m == alt);
  CHECK(n.resets().count == 4);
  CHECK(n.resets().position_m == Vector3d(1, 2, 3));
  CHECK(n.resets().velocity_mps == Vector3d(4, 5, 6));
  CHECK(n.resets().yaw_rad == 0.7);
  for (int i = 0; i < 3; ++i) {
    CHECK(std_of(n, ekf::theta + i) == Approx(0.05));
    CHECK(std_of(n, ekf::vel + i) == Approx(1));
    CHECK(std_of(n, ekf::pos + i) == Approx(5));
    CHECK(std_of(n, ekf::gyro_bias + i) == Approx(0.02));
    CHECK(std_of(n, ekf::accel_bias + i) == Approx(p.accel_bias_std));
  }
  CHECK(std_of(n, ekf::wind) == Approx(0.8));
  CHECK(std_of(n, ekf::wind + 1) == Approx(1.7));
  CHECK(std_of(n, ekf::gust) == Approx(p.gust_std));
  CHECK(std_of(n, ekf::port) == Approx(p.static_port_std));
  CHECK(std_of(n, ekf::heading) == Approx(p.mag_deviation));
  CHECK(std_of(n, ekf::gnss) == Approx(p.gnss_horizontal_std));
  CHECK(std_of(n, ekf::delay) == Approx(p.gnss_delay_std));
  VehicleState sure = s;
  sure.wind_std_mps = {0.1, 99, 0};
  CHECK(std_of(resumed(sure), ekf::wind) == Approx(0.5));
  CHECK(std_of(resumed(sure), ekf::wind + 1) == Approx(p.wind_std));
}

TEST_CASE("each noise of the filter is its parameter, and what a receiver states outlasts a change of them") {
  Params p;
  double next = 0.011;
  Param* all[] = {&p.gyro_noise,     &p.gyro_scale_error,   &p.accel_noise,       &p.accel_scale_error,
                  &p.gyro_bias_walk, &p.accel_bias_walk,    &p.wind_walk,         &p.wind_shear,
                  &p.gust_std,       &p.gust_time,          &p.baro_walk,         &p.static_port_walk,
                  &p.mag_deviation,  &p.mag_deviation_time, &p.gnss_position_time};
  for (Param* one : all) one->value = next += 0.001;
  p.gravity.value = 9.79;
  Navigator n;
  n.start(p);
  const ekf::Noise& f = n.filter().noise;
  const double is[] = {f.gyro,           f.gyro_scale,      f.accel,     f.accel_scale,
                       f.gyro_bias_walk, f.accel_bias_walk, f.wind_walk, f.wind_shear,
                       f.gust_std,       f.gust_time,       f.baro_walk, f.port_walk,
                       f.heading_std,    f.heading_time,    f.gnss_time};
  for (std::size_t i = 0; i < std::size(all); ++i) CHECK(is[i] == all[i]->value);
  CHECK(n.filter().gravity_mps2 == 9.79);
  CHECK(f.gnss_std == p.gnss_horizontal_std);
  const Params q;
  Navigator flies = resumed(odd(), q);
  flies.imu({0.01, -0.02, 0.03}, {0, 0, -9.8}, 10.01, q);
  flies.gnss(fix_at(flies, Vector3d::Zero(), Vector3d::Zero()), 10.01, q);
  CHECK(flies.filter().noise.gnss_std == 3);
  flies.tune(q);
  CHECK(flies.filter().noise.gnss_std == 3);
}

TEST_CASE("a fix moves the position by the share of its variance, north and east, and no more than that") {
  const Params p;
  for (const double std_m : {3.0, 0.5, 8.0}) {
    Navigator n = resumed(odd());
    fly(n, p, 10.01);
    // The slow error of the receiver adds to its white noise.
    const double P = std::pow(std_of(n, ekf::pos), 2), R = std_m * std_m,
                 B = std::pow(p.gnss_horizontal_std, 2);
    Gnss g = fix_at(n, {2, -3, 0}, Vector3d::Zero());
    g.horizontal_std_m = std_m;
    g.speed_std_mps = 1e5;
    const Vector3d before = n.filter().state().p_n;
    n.gnss(g, 10.01, p);
    const Vector3d moved = n.filter().state().p_n - before;
    CHECK(moved.x() == Approx(2 * P / (P + B + R)).epsilon(0.02));
    CHECK(moved.y() == Approx(-3 * P / (P + B + R)).epsilon(0.02));
  }
}

TEST_CASE("a velocity moves each axis by its share, and reports that axis alone") {
  const Params p;
  for (int axis = 0; axis < 2; ++axis) {
    Navigator n = resumed(odd());
    fly(n, p, 10.01);
    Vector3d off = Vector3d::Zero();
    off(axis) = -0.8;
    const Gnss g = fix_at(n, Vector3d::Zero(), off);
    const double P = std::pow(std_of(n, ekf::vel + axis), 2), R = 0.4 * 0.4;
    const Vector3d before = n.filter().state().v_n;
    n.gnss(g, 10.01, p);
    const Vector3d moved = n.filter().state().v_n - before;
    CHECK(moved(axis) == Approx(-0.8 * P / (P + R)).epsilon(0.03));
    CHECK(std::abs(moved(1 - axis)) < 0.02);
    CHECK(n.health().velocity_innovation(axis) == Approx(-0.8 / std::sqrt(P + R)).epsilon(0.01));
    CHECK(std::abs(n.health().velocity_innovation(1 - axis)) < 1e-6);
  }
}

TEST_CASE(
    "a wind that is not along an axis goes on over a bridge, and the way is that of the mean velocity") {
  const Params p;
  Navigator n = resumed(odd());
  fly(n, p, 10.05);
  const ekf::Nominal before = n.filter().state();
  const Quaterniond turn(Eigen::AngleAxisd(0.9, Vector3d(0.3, 0.2, 1).normalized()));
  for (double t = 10.06; t < 10.9; t += 0.5) n.imu({0, 0, 0}, {0, 0, -9.8}, t + 0.7, p);  // too long: lost
  const double T = n.time_s() - n.filter().time_s();
  REQUIRE(n.regaining());
  const double theta = std_of(n, ekf::theta), vel = std_of(n, ekf::vel), pos = std_of(n, ekf::pos);
  n.bridge(turn, p);
  const ekf::Nominal& x = n.filter().state();
  const Vector3d wind(before.wind.x(), before.wind.y(), 0);
  const Vector3d v = before.q_nb * turn * (before.q_nb.conjugate() * (before.v_n - wind)) + wind;
  CHECK((x.v_n - v).norm() < 1e-9);
  CHECK((x.p_n - before.p_n - 0.5 * T * (before.v_n + v)).norm() < 1e-9);
  CHECK(std_of(n, ekf::theta) == Approx(std::hypot(theta, 0.01 + 0.01 * T)));
  CHECK(std_of(n, ekf::vel) == Approx(std::hypot(vel, T)));
  CHECK(std_of(n, ekf::pos) == Approx(std::hypot(pos, T * T)));
  CHECK(n.aligned());
}

TEST_CASE(
    "a position that is off is set after the time to wait, and after two seconds when it comes back soon") {
  const Params p;
  Navigator n = resumed(odd());
  const auto until_set = [&](const Vector3d& off) {
    const Vector3d at = n.filter().state().p_n;  // propagated with the velocity of the filter
    const double begin = n.time_s();
    const std::uint32_t count = n.resets().count;
    while (n.resets().count == count && n.time_s() < begin + 20) {
      fly(n, p, n.time_s() + 0.2);
      const double t = n.time_s() - begin;
      Gnss g = fix_at(n, at + off + t * n.filter().state().v_n - n.filter().state().p_n, Vector3d::Zero());
      n.gnss(g, n.time_s(), p);
    }
    return n.time_s() - begin;
  };
  for (int k = 0; k < 25; ++k) {
    fly(n, p, n.time_s() + 0.2);
    n.gnss(fix_at(n, Vector3d::Zero(), Vector3d::Zero()), n.time_s(), p);
  }
  const Vector3d off(120, -90, 0);
  CHECK(std::abs(until_set(off) - p.gnss_reset_after) < 0.5);
  CHECK(n.resets().position_m.x() == Approx(120).epsilon(0.02));
  CHECK(n.resets().position_m.y() == Approx(-90).epsilon(0.02));
  CHECK(std::abs(n.resets().position_m.z()) < 1);
  CHECK(std::abs(until_set(-off) - 2) < 0.8);
  CHECK(n.resets().position_m.x() == Approx(-120).epsilon(0.02));
  for (int k = 0; k < 330; ++k) {  // more than a minute of valid samples
    fly(n, p, n.time_s() + 0.2);
    n.gnss(fix_at(n, Vector3d::Zero(), Vector3d::Zero()), n.time_s(), p);
  }
  CHECK(std::abs(until_set(off) - p.gnss_reset_after) < 0.5);
}

}  // namespace navigator_values_test
