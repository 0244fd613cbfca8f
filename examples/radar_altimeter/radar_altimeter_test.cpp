// SPDX-License-Identifier: BSD-3-Clause
// The range against a ray that meets the ground, its row against finite differences, and the navigator on a
// flight in closed form: a turn of constant radius with changing height.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>
#include <functional>
#include <numbers>

#include "radar_navigator.hpp"

namespace {

constexpr double g = 9.80665, alt0 = 1387;

VehicleState over_ground(double height_m, double roll_rad, double pitch_rad, double yaw_rad = 0.7) {
  VehicleState truth;
  truth.height_m = height_m;
  truth.roll_rad = roll_rad;
  truth.pitch_rad = pitch_rad;
  truth.attitude = from_eigen(quaternion_from({roll_rad, pitch_rad, yaw_rad}));
  return truth;
}
RadarRange seen(Bench<RadarAltimeter>& bench, const VehicleState& truth) {
  bench.set(bench.in.truth, truth);
  bench.step(0.05);
  bench.step(0.05);  // the output is one step late, and a new measurement needs a new truth
  bench.set(bench.in.truth, truth);
  REQUIRE(allocations([&] { bench.step(0.05); }) == 0);
  REQUIRE(bench.validation_error() == "");
  REQUIRE(bench.out.range.count == 1);
  return bench.out.range.items[0];
}

/// Sensors of a turn at 17 m/s with 0.4 rad of bank, 70 m above the ground, rising and falling by 3 m in 12.6
/// s. The receiver reads 2 m too high, the barometer 30 m.
struct Flight {
  Bench<RadarNavigator> bench;
  LocalFrame frame{40, -111, alt0};
  Vector3d field_n = magnetic_field_ned(40, -111, alt0, 2026);
  Random random{3};
  double height_error_m = 0, bias_m = 0;  // of the estimate; of the radar
  double fix_north_m = 0;                 // error of the receiver
  bool radar = true, gnss = true, imu = true;
  Status status = Status::ok;
  std::function<void(RadarRange&)> alter = [](RadarRange&) {};

  struct Truth {
    Eigen::Quaterniond q_nb;
    Vector3d p_n, v_n, omega_b, f_b;
  };
  static Truth at(double t) {
    const double V = 17, phi = 0.4, w = g * std::tan(phi) / V, chi = w * t;
    const Vector3d a_n(-V * w * std::sin(chi), V * w * std::cos(chi), 0.75 * std::sin(0.5 * t));
    Truth x;
    x.q_nb = quaternion_from({phi, 0, chi});
    x.p_n = {V / w * std::sin(chi), V / w * (1 - std::cos(chi)), -70 - 3 * std::sin(0.5 * t)};
    x.v_n = {V * std::cos(chi), V * std::sin(chi), -1.5 * std::cos(0.5 * t)};
    x.omega_b = w * Vector3d(0, std::sin(phi), std::cos(phi));
    x.f_b = x.q_nb.conjugate() * (a_n - Vector3d(0, 0, g));
    return x;
  }

  /// Last outputs of the previous filter: 2 m too high, as its receiver.
  static RadarNavigator::Outputs applied() {
    const Truth x = at(0);
    RadarNavigator::Outputs last;
    VehicleState& s = last.nav.state.value;
    s.attitude = from_eigen(x.q_nb);
    s.velocity_mps = from_eigen<Ned>(x.v_n);
    s.position_m = from_eigen<Ned>(Vector3d(x.p_n - Vector3d(0, 0, 2)));
    s.airspeed_mps = 17;
    s.attitude_std_rad = {0.01, 0.01, 0.03};
    s.velocity_std_mps = {0.1, 0.1, 0.1};
    s.position_std_m = {1, 1, 2};
    s.wind_std_mps = {1, 1, unknown_std};
    s.origin_latitude_deg = 40;
    s.origin_longitude_deg = -111;
    s.origin_altitude_m = alt0;
    s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = true;
    s.airspeed_valid = s.wind_valid = true;
    return last;
  }
  void set_imu(const Truth& x, double late_s = 0) {
    bench.set(bench.in.sensors.imu, Imu{from_eigen<Body>(x.f_b), from_eigen<Body>(x.omega_b)}, late_s);
  }
  void take_over() {
    // A turn of constant radius does not excite the accelerometer bias, which is 0 in this flight.
    bench.params.nav.accel_bias_std.value = 0.02;
    set_imu(at(0));
    REQUIRE(bench.activate(applied()) == Status::ok);
  }

  void step() {
    constexpr double dt = 0.005;  // the time of the step is dt after the previous one: an age of -dt
    const auto tick = static_cast<int>(bench.tick.index) + 1;
    const double t = tick * dt;
    const Truth x = at(t);
    const double h = -x.p_n.z();
    const Air air = standard_air(alt0 + h), above = standard_air(alt0 + h + 30);
    if (imu) set_imu(x, -dt);
    if (tick % 4 == 0) {
      bench.set(bench.in.sensors.mag, Mag{from_eigen<Body>(Vector3d(x.q_nb.conjugate() * field_n))}, -dt);
      bench.set(bench.in.sensors.baro, Baro{above.pressure_pa}, -dt);
      bench.set(bench.in.sensors.pitot, Pitot{0.5 * air.density_kgm3 * x.v_n.squaredNorm()}, -dt);
    }
    if (gnss && tick % 20 == 0) bench.set(bench.in.sensors.gnss, fix(at(t - 0.1)), 0.1 - dt);
    if (radar && tick % 10 == 0) {
      const Truth then = at(t - 0.05);
      RadarRange range{-then.p_n.z() / std::cos(0.4) + bias_m + 0.25 * random.normal(), 0.25, true};
      alter(range);
      bench.push(bench.in.range, range, 0.05 - dt);
    }
    REQUIRE(allocations([&] { status = bench.step(dt); }) == 0);
    REQUIRE(bench.validation_error() == "");
    if (bench.out.nav.state.written) height_error_m = bench.out.nav.state.value.height_m - h;
  }
  Gnss fix(const Truth& then) const {
    const auto place = frame.from_ned(then.p_n + Vector3d(fix_north_m, 0, -2));
    Gnss fix;
    fix.latitude_deg = place.lat_deg;
    fix.longitude_deg = place.lon_deg;
    fix.altitude_m = place.alt_m;
    fix.velocity_mps = from_eigen<Ned>(then.v_n);
    fix.horizontal_std_m = 1;
    fix.vertical_std_m = 3;
    fix.speed_std_mps = 0.1;
    fix.fix = FixType::fix_3d;
    return fix;
  }
  /// Root mean square of the height error over this time.
  double fly(double seconds) {
    double squares = 0;
    const int n = static_cast<int>(seconds * 200);
    for (int i = 0; i < n; ++i) {
      step();
      squares += height_error_m * height_error_m / n;
    }
    return std::sqrt(squares);
  }
  double refused() const { return bench.out.radar_refused_ratio.value; }
};

}  // namespace

TEST_CASE("the range is that of a ray along the body's z axis that meets the ground, and is a step late") {
  Bench<RadarAltimeter> bench;
  bench.params.noise_std.value = bench.params.dropout.value = 0;
  CHECK(seen(bench, over_ground(70, 0, 0)).range_m == doctest::Approx(70));
  for (const double roll : {-0.4, 0.0, 0.5})
    for (const double pitch : {-0.3, 0.2}) {
      const VehicleState truth = over_ground(83, roll, pitch);
      const Vec3<Ned> ray = to_ned(truth.attitude, Vec3<Body>{0, 0, 1});
      const RadarRange range = seen(bench, truth);
      CHECK(83 - range.range_m * ray.down == doctest::Approx(0));  // height of the point of impact
      CHECK(range.valid);
      CHECK(bench.tick.now_ns - bench.out.range.stamps_ns[0] == 150'000'000);  // `seen` waits for three steps
    }
}

TEST_CASE("too far, too steep and below the ground there is no echo, and it says so") {
  Bench<RadarAltimeter> bench;
  bench.params.noise_std.value = bench.params.dropout.value = 0;
  CHECK(seen(bench, over_ground(119, 0, 0)).valid);
  CHECK(seen(bench, over_ground(70, 0.59, 0)).valid);
  for (const VehicleState& truth :
       {over_ground(121, 0, 0), over_ground(115, 0.4, 0), over_ground(70, 0.61, 0),
        over_ground(70, 0.45, 0.45), over_ground(-1, 0, 0), over_ground(70, 3, 0)}) {
    const RadarRange range = seen(bench, truth);
    CHECK_FALSE(range.valid);
    CHECK(range.range_std_m == unknown_std);
  }
}

TEST_CASE(
    "the noise has the mean and the deviation asked for, dropouts their share, and a seed its numbers") {
  RadarAltimeter radar(11), same(11), other(12);
  RadarAltimeter::Params p;
  double sum = 0, squares = 0;
  int valid = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const RadarRange range = radar.measure(over_ground(70, 0, 0), p);
    CHECK(range.range_m == same.measure(over_ground(70, 0, 0), p).range_m);
    if (!range.valid) continue;
    ++valid;
    sum += range.range_m - 70;
    squares += (range.range_m - 70) * (range.range_m - 70);
  }
  CHECK(std::abs(sum / valid) < 4 * 0.25 / std::sqrt(valid));
  CHECK(std::sqrt(squares / valid) ==
        doctest::Approx(0.25).epsilon(0.02));  // four standard deviations of a standard deviation
  CHECK(std::abs(1 - valid / static_cast<double>(n) - 0.02) < 4 * std::sqrt(0.02 * 0.98 / n));
  CHECK(other.measure(over_ground(70, 0, 0), p).range_m != radar.measure(over_ground(70, 0, 0), p).range_m);
}

TEST_CASE("a range is that of when it was measured, and its row the derivative, now and 50 ms late") {
  const auto flown = [](const ekf::Vector& error,
                        int samples) {  // a banked climb, from a state with this error
    ekf::Nominal x;
    x.q_nb = quaternion_from({0.5, 0.2, 1.1});
    x.v_n = {9, 14, -3};
    x.p_n = {20, -40, -70};
    ErrorStateEkf f;
    f.reset(x.plus(error), ekf::Vector::Ones(), 0);
    for (int i = 0; i < samples; ++i) f.predict({0.6, 0.15, 0.3}, {0.5, 0.3, -11}, 0.0025);
    return f;
  };
  const ErrorStateEkf f = flown(ekf::Vector::Zero(), 40);
  for (const int late : {0, 20}) {
    CAPTURE(late);
    const ErrorStateEkf then = flown(ekf::Vector::Zero(), 40 - late);
    const Euler e = euler_from(then.R_nb());
    const double r = -then.state().p_n.z() / (std::cos(e.roll_rad) * std::cos(e.pitch_rad));
    const ekf::Scalar z = RadarMeasurement::slant_range(f, then.time_s(), 80);
    CHECK(80 - z.innovation == doctest::Approx(r).epsilon(1e-6));
    for (int i = 0; i < ekf::size; ++i) {
      CAPTURE(i);
      ekf::Vector error = ekf::Vector::Zero();
      error(i) = 1e-5;
      const ErrorStateEkf moved = flown(error, 40);
      const ekf::Scalar z_moved = RadarMeasurement::slant_range(moved, then.time_s(), 80);
      const double change = (z.innovation - z_moved.innovation) / 1e-5;
      const ekf::Vector dx = moved.state().minus(f.state()) / 1e-5;  // present error
      CHECK(z.H.dot(dx) == doctest::Approx(change).epsilon(late > 0 ? 0.02 : 1e-4).scale(0.3));
    }
  }
}

TEST_CASE("it takes over without a step, from the state that was applied last") {
  Flight flight;
  flight.radar = false;
  flight.take_over();
  flight.step();
  const VehicleState& s = flight.bench.out.nav.state.value;
  const Flight::Truth x = Flight::at(0.005);
  CHECK(s.height_m == doctest::Approx(2 - x.p_n.z()).epsilon(1e-6));
  CHECK((eigen(s.velocity_mps) - x.v_n).norm() < 0.1);  // one correction, by the airspeed from ahead
  CHECK(eigen(s.attitude).angularDistance(x.q_nb) < 1e-5);
  CHECK(flight.bench.out.nav.state.written);
}

TEST_CASE(
    "nobody flew before: it finds its attitude in the air by itself, and then its height by the radar") {
  Flight flight;
  flight.bench.params.nav.origin.value = {40, -111, alt0, true};
  flight.bench.params.nav.origin.is_given = true;
  REQUIRE(flight.bench.activate() == Status::ok);
  flight.fly(10);
  CHECK(flight.status == Status::ok);
  CHECK(flight.fly(10) < 0.3);
}

TEST_CASE("the receiver is 2 m too high: with the radar the height is right, without it is as the receiver") {
  Flight with, without, off;
  without.radar = false;
  off.bench.params.radar.use_radar.value = false;
  for (Flight* flight : {&with, &without, &off}) {
    flight->take_over();
    flight->fly(5);
  }
  CHECK(with.fly(10) < 0.1);
  CHECK(without.fly(10) == doctest::Approx(2).epsilon(0.05));
  CHECK(off.fly(10) == doctest::Approx(2).epsilon(0.05));
  CHECK(with.refused() == 0);
  // At constant speed the error of the static port and the bias of the barometer are not separable.
  CHECK(with.bench.out.nav.baro_bias_m.value == doctest::Approx(30).epsilon(0.04));
  CHECK(with.status == Status::ok);
}

TEST_CASE("a stuck radar is ignored after half a second, and used again when it changes") {
  Flight flight;
  flight.take_over();
  flight.fly(8);
  flight.alter = [](RadarRange& range) { range.range_m = 78; };
  CHECK(flight.fly(15) < 0.4);
  flight.alter = [](RadarRange&) {};
  flight.fly(1);
  CHECK(flight.fly(5) < 0.1);
}

TEST_CASE("a radar that is 20 m off stays out; the first range that is right comes in") {
  Flight flight;
  flight.take_over();
  flight.fly(8);
  flight.bias_m = 20;
  CHECK(flight.fly(20) < 0.6);
  CHECK(flight.refused() == 400);
  flight.bias_m = 0;
  flight.fly(1);
  CHECK(flight.refused() == 400);
  CHECK(flight.fly(5) < 0.1);
}

TEST_CASE("the gate opens again: after a radar error of 5 m the estimate follows the correct radar back") {
  Flight flight;
  flight.take_over();
  flight.fly(8);
  flight.bias_m = 5;
  CHECK(flight.fly(4.5) < 0.3);  // rejected
  flight.fly(15);
  CHECK(std::abs(flight.height_error_m) > 3);  // without another source of height
  flight.bias_m = 0;
  flight.fly(6);
  CHECK(flight.fly(5) < 0.2);
}

TEST_CASE("ranges without an echo, of the future, too old, negative or infinite do no harm") {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double odd : {-70.0, 1e300, inf, -inf, std::nan("")}) {
    Flight flight;
    flight.take_over();
    flight.alter = [&](RadarRange& range) { range.range_m = odd + flight.random.normal(); };
    CHECK(flight.fly(1) == doctest::Approx(2).epsilon(0.05));
    flight.alter = [](RadarRange& range) { range.valid = false; };
    CHECK(flight.fly(1) == doctest::Approx(2).epsilon(0.05));
  }
  for (const double age_s : {-0.5, 0.35, 10.0}) {
    Flight flight;
    flight.radar = false;
    flight.take_over();
    flight.fly(1);
    for (int i = 0; i < 50; ++i) {
      flight.bench.push(flight.bench.in.range, {50, 0.25, true}, age_s);
      flight.step();
    }
    CHECK(flight.height_error_m == doctest::Approx(2).epsilon(0.05));
    CHECK(flight.refused() == 0);
  }
}

TEST_CASE(
    "a short gap of the inertial unit is bridged, a long one ends in an alignment; the radar is heard "
    "again") {
  for (const double gap_s : {0.2, 3.0}) {
    CAPTURE(gap_s);
    Flight flight;
    flight.take_over();
    flight.fly(8);
    flight.imu = false;
    flight.fly(gap_s);
    CHECK(flight.status == Status::degraded);
    CHECK(flight.bench.out.nav.state.value.attitude_valid == (gap_s < 0.3));
    flight.imu = true;
    flight.fly(gap_s < 0.3 ? 0.1 : 2);
    CHECK(flight.status == Status::ok);
    CHECK(flight.bench.out.nav.state.value.attitude_valid);
    const double refused = flight.refused();
    flight.fly(2);
    CHECK(flight.refused() == refused);
    CHECK(flight.fly(5) < 0.15);
  }
}

TEST_CASE("without fixes the position is not valid any more, the height is, and a fix brings it back") {
  Flight flight;
  flight.take_over();
  flight.fly(3);
  flight.gnss = false;
  flight.fly(4);
  CHECK(flight.bench.out.nav.state.value.position_valid);
  flight.fly(2);
  CHECK_FALSE(flight.bench.out.nav.state.value.position_valid);
  CHECK(flight.status == Status::degraded);
  CHECK(flight.fly(10) < 0.15);
  flight.gnss = true;
  flight.fly(0.2);
  CHECK(flight.bench.out.nav.state.value.position_valid);
}
