// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/sim_aero/sheet.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "allan.hpp"
#include "faulty.hpp"

namespace sheet_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

const LocalFrame provo(40.2463724, -111.6474138, 1387);
const Vector3d field(21e-6, 4e-6, 46e-6);

SensorSuite none() {
  SensorSuite s;
  s.imu.timing.rate_hz = 400;
  return s;
}
Sensors sensors(const SensorSuite& suite, std::uint64_t seed = 1) {
  return Sensors(spec_of(suite, 400), 400, provo, field, seed);
}
Plant flying() {
  Plant p(anaconda(), {}, 1387, 1);
  REQUIRE(p.fly({120, -40, -70}, 0.6, 17));
  return p;
}
/// In a hard manoeuvre, so that all rates and their derivatives are there.
Plant turning() {
  Plant p = flying();
  for (int i = 0; i < 80; ++i) p.advance({0.6, 0.2, -0.15, 0.1}, 1, 0.0025);
  return p;
}

std::unique_ptr<Bench<Aircraft>> with(const SensorSuite& suite, std::uint64_t seed = 1) {
  auto b = airborne(SensorSet::perfect, seed);
  b->params.own_sensors.sensor_file.value = suite;
  b->params.own_sensors.sensor_file.is_given = true;
  return b;
}

std::vector<double> sums(std::size_t n, const std::function<double()>& draw) {
  std::vector<double> out{0};
  for (std::size_t i = 0; i < n; ++i) out.push_back(out.back() + draw());
  return out;
}

}  // namespace

TEST_CASE("the Allan deviation of white noise and of a random walk is what NIST SP 1065 says") {
  Random random(3);
  const auto white = sums(400000, [&] { return 0.7 * random.normal(); });
  double x = 0;
  const auto walk = sums(400000, [&] { return x += 0.7 * random.normal(); });
  for (const std::size_t m : {4UL, 16UL, 64UL, 256UL}) {
    const double M = static_cast<double>(m);
    CHECK(allan_deviation(white, m) / (0.7 / std::sqrt(M)) == Approx(1).epsilon(0.04));
    // of averages of a discrete walk: (2 m^2 + 1) / (6 m)
    CHECK(allan_deviation(walk, m) / (0.7 * std::sqrt((2 * M * M + 1) / (6 * M))) == Approx(1).epsilon(0.08));
  }
}

TEST_CASE("the Allan variance of a Gauss-Markov process is that of one that is drawn") {
  Random random(5);
  NoiseSpec spec;
  spec.drift = 2;
  spec.drift_tau_s = 5;
  Noise noise(spec, 0.05, random);
  const auto sum = sums(2000000, [&] { return noise.next(random); });
  for (const double tau : {1.0, 5.0, 9.45, 40.0}) {
    const double drawn = allan_deviation(sum, static_cast<std::size_t>(std::lround(tau / 0.05)));
    CHECK(drawn / (2 * std::sqrt(Wander::variance(tau, 5))) == Approx(1).epsilon(0.05));
  }
  CHECK(Wander::variance(0.004, 5) / (2 * 0.004 / 15) == Approx(1).epsilon(1e-3));  // as a random walk
}

TEST_CASE("a bias instability is the lowest Allan deviation, noise and walk included") {
  SensorSuite suite = none();
  suite.imu.gyro.noise_per_root_hz_radps = 1e-4;
  suite.imu.gyro.instability_radps = 3e-5;
  suite.imu.gyro.instability_time_s = 10;
  suite.imu.gyro.walk_radps = 1e-6;
  const SensorSpec s = spec_of(suite, 50);
  const Curve curve = allan_curve(s.gyro, s.gyro_sheet, 50, 9000, 11);
  CHECK(curve.at_1s() / (1e-4 / std::sqrt(2)) == Approx(1).epsilon(0.1));
  CHECK(curve.lowest() / 3e-5 == Approx(1).epsilon(0.1));
  suite.imu.gyro.instability_radps = 1e-6;  // below the noise
  CHECK_THROWS_WITH(sensors(suite), doctest::Contains("sensor_file: sim_aero.instability_too_small("));
}

TEST_CASE("a noise density gives the same Allan deviation at every rate") {
  for (const double hz : {50.0, 400.0}) {
    SensorSuite suite = none();
    suite.imu.timing.rate_hz = hz;
    suite.imu.accel.noise_per_root_hz_mps2 = 0.002;
    const SensorSpec s = spec_of(suite, 1000);
    const Curve curve = allan_curve(s.accel, s.accel_sheet, hz, 2000, 2);
    CAPTURE(hz);
    CHECK(curve.at_1s() / (0.002 / std::sqrt(2)) == Approx(1).epsilon(0.05));
  }
}

TEST_CASE("an accelerometer off the centre of gravity feels what its own motion is") {
  SensorSuite suite = none();
  const Vector3d r(0.3, -0.2, 0.1);
  suite.imu.mount.position_m = {r.x(), r.y(), r.z()};
  const Actuators a{0.6, 0.2, -0.15, 0.1};
  Plant p = turning();
  Sensors s = sensors(suite);
  // the second difference of where it is, less gravity, over three short steps
  const double h = 1e-4;
  std::vector<Vector3d> at;
  Vector3d sensed = Vector3d::Zero();
  Eigen::Quaterniond q = p.state().q_nb;
  for (int i = 0; i < 3; ++i) {
    at.push_back(p.state().p_n + p.state().q_nb * r);
    if (i == 1) {
      sensed = eigen(s.imu(p).specific_force_mps2);
      q = p.state().q_nb;
    }
    p.advance(a, 1, h);
  }
  const Vector3d acceleration = (at[2] - 2 * at[1] + at[0]) / (h * h);
  const Vector3d expected = q.conjugate() * (acceleration - Vector3d(0, 0, 9.80665));
  CHECK((sensed - expected).norm() / expected.norm() < 2e-3);
  CHECK((eigen(sensors(none()).imu(p).specific_force_mps2) - expected).norm() > 0.3);  // it matters
}

TEST_CASE("an antenna off the centre of gravity is where it is and moves as it does") {
  SensorSuite suite = none();
  const Vector3d r(-0.4, 0.5, -0.2);
  suite.gnss.position_m = {r.x(), r.y(), r.z()};
  Plant p = turning();
  Sensors s = sensors(suite);
  const Gnss g = s.gnss(p, 0);
  const Vector3d here = p.state().p_n + p.state().q_nb * r;
  CHECK((provo.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m) - here).norm() < 1e-6);
  const double h = 1e-5;
  p.advance({0.6, 0.2, -0.15, 0.1}, 1, h);
  const Vector3d velocity = (p.state().p_n + p.state().q_nb * r - here) / h;
  CHECK((eigen(g.velocity_mps) - velocity).norm() / velocity.norm() < 1e-4);
}

TEST_CASE("a pitot tube on a wing tip feels the yaw rate, either way") {
  for (const double yaw_rate : {0.8, -0.8}) {
    Plant p = flying();
    RigidBody x = p.state();
    x.omega_b = {0, 0, yaw_rate};
    p.set_state(x);
    SensorSuite suite = none();
    suite.pitot.position_m = {0, 1.2, 0};
    const Vector3d v = p.air_velocity_b() + Vector3d(-yaw_rate * 1.2, 0, 0);  // omega x r
    CHECK(sensors(suite).pitot(p).pressure_pa / (0.5 * p.air().density_kgm3 * v.squaredNorm()) == Approx(1));
  }
}

TEST_CASE("static ports that feel the flow: the altimeter reads low and the airspeed, too") {
  const Plant p = flying();
  const double q = 0.5 * p.air().density_kgm3 * 17 * 17;
  SensorSuite suite = none();
  suite.baro.static_port_ratio = suite.pitot.static_port_ratio = 0.05;
  suite.pitot.alpha_ratio = 0.5;
  const double alpha = std::atan2(p.air_velocity_b().z(), p.air_velocity_b().x());
  Sensors s = sensors(suite), right = sensors(none());
  CHECK((s.baro(p).pressure_pa - right.baro(p).pressure_pa) / (0.05 * q) == Approx(1));
  CHECK(s.pitot(p).pressure_pa / (q * (1 + 0.5 * alpha - 0.05)) == Approx(1));
}

TEST_CASE("digits and range are those of the part, either way") {
  SheetSpec spec;
  spec.step = 0.25;
  spec.range = 2;
  const Sheet sheet(spec, 0.01, 1);
  CHECK(sheet.digits(0.37) == 0.25);
  CHECK(sheet.digits(-0.38) == -0.5);
  CHECK(sheet.digits(7) == 2);
  CHECK(sheet.digits(-7) == -2);
  SensorSuite suite = none();
  suite.imu.gyro.range_radps = 0.1;
  suite.imu.gyro.step_radps = 0.03;
  Plant p = turning();
  const Vector3d w = p.state().omega_b, rate = eigen(sensors(suite).imu(p).rate_radps);
  REQUIRE(w.cwiseAbs().maxCoeff() > 0.2);
  for (int i = 0; i < 3; ++i) CHECK(rate[i] == Approx(std::clamp(0.03 * std::round(w[i] / 0.03), -0.1, 0.1)));
}

TEST_CASE("scale and cross-axis errors fill their ranges and nothing else") {
  double on = 0, off = 0, sum = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SheetSpec spec;
    spec.scale = 0.03;
    spec.cross_axis = 0.02;
    Sheet sheet(spec, 0.01, seed);
    Eigen::Matrix3d M;
    for (int k = 0; k < 3; ++k) M.col(k) = sheet.bent(Vector3d::Unit(k));
    const Eigen::Matrix3d E = M - Eigen::Matrix3d::Identity();
    on = std::max(on, E.diagonal().cwiseAbs().maxCoeff());
    sum += E.diagonal().sum();
    off = std::max(off, (E - Eigen::Matrix3d(E.diagonal().asDiagonal())).cwiseAbs().maxCoeff());
  }
  CHECK(on / 0.03 == Approx(1).epsilon(0.01));
  CHECK(off / 0.02 == Approx(1).epsilon(0.01));
  CHECK(std::abs(sum / 900) < 0.0018);  // 0.03 / sqrt(3 900): three deviations
}

TEST_CASE("a unit that sits askew measures in its own axes") {
  SensorSuite suite = none();
  suite.imu.mount.yaw_rad = 0.1;
  Plant p = flying();
  RigidBody x = p.state();
  x.omega_b = {1, 0, 0};
  p.set_state(x);
  const Vector3d sensed = eigen(sensors(suite).imu(p).rate_radps);  // its nose is to the right of a roll
  CHECK(sensed.x() == Approx(std::cos(0.1)));
  CHECK(sensed.y() == Approx(-std::sin(0.1)));
  CHECK(sensed.z() == Approx(0));
}

TEST_CASE("iron and the motor's current bend the magnetic field") {
  SensorSuite suite = none();
  suite.mag.hard_iron_tesla = {1e-6, 0, -2e-6};
  suite.mag.soft_iron_ratio = {0.1, 0, 0, 0, 0, 0, 0, 0.2, 0};
  suite.mag.current_tesla = {0, 3e-8, 0};
  const Plant p = turning();
  REQUIRE(p.battery_amp() > 1);
  Vector3d b = p.state().q_nb.conjugate() * field + p.battery_amp() * Vector3d(0, 3e-8, 0);
  b = Vector3d(1.1 * b.x(), b.y(), b.z() + 0.2 * b.y()) + Vector3d(1e-6, 0, -2e-6);
  CHECK((eigen(sensors(suite).mag(p).field_tesla) - b).norm() / b.norm() < 1e-12);
}

TEST_CASE("a low-pass holds back 3 dB at its bandwidth and nothing at rest") {
  SheetSpec spec;
  spec.bandwidth_hz = 5;
  Sheet sheet(spec, 1e-4, 1);
  double most = 0;
  for (int i = 0; i < 20000; ++i) {
    const double y = sheet.smooth(Vector3d(std::sin(2 * std::numbers::pi * 5 * 1e-4 * i), 1, 0)).x();
    if (i > 10000) most = std::max(most, y);
  }
  CHECK(most / std::sqrt(0.5) == Approx(1).epsilon(0.01));
  CHECK(sheet.smooth(Vector3d(0, 1, 0)).y() == Approx(1));
}

TEST_CASE("vibration grows with the square of the motor's speed and turns with it") {
  SensorSuite suite = none();
  suite.imu.accel.vibration_mps2 = 4;
  suite.imu.vibration_speed_radps = 500;
  suite.imu.vibration_second_ratio = 0.5;
  Plant p = flying();
  const double size = 4 * std::pow(p.propeller_radps() / 500, 2);
  Sensors s = sensors(suite), still = sensors(none());
  double most = 0, along = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d v = eigen(s.imu(p).specific_force_mps2) - eigen(still.imu(p).specific_force_mps2);
    CHECK(std::hypot(v.y(), v.z()) / size == Approx(1));
    most = std::max(most, v.z());
    along = std::max(along, v.x());
  }
  CHECK(most / size == Approx(1).epsilon(0.01));
  CHECK(along / (0.5 * size) == Approx(1).epsilon(0.01));
}

TEST_CASE("a calibration takes off what is constant at rest, of every seed, and leaves noise and scale") {
  SensorSuite suite = none();
  suite.imu.gyro.bias_range_radps = 0.3;
  suite.imu.gyro.bias_std_radps = 0.1;
  suite.imu.gyro.g_sensitivity_radps = 0.01;
  suite.imu.accel.bias_range_mps2 = 0.5;
  suite.imu.accel.scale_range_ratio = 0.03;
  suite.imu.accel.cross_axis_ratio = 0.02;
  suite.baro.bias_range_pa = 300;
  suite.pitot.bias_range_pa = 30;
  Plant p(anaconda(), {}, 1387, 1);  // stands, level but for the gear
  double before = 0, after = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const bool calibrated : {false, true}) {
      suite.calibrated = calibrated;
      Sensors s = sensors(suite, seed), right = sensors(none());
      const Imu a = s.imu(p), b = right.imu(p);
      double& worst = calibrated ? after : before;
      worst = std::max({worst, eigen(a.rate_radps).norm() / 0.3,
                        (eigen(a.specific_force_mps2) - eigen(b.specific_force_mps2)).norm(),
                        std::abs(s.baro(p).pressure_pa - right.baro(p).pressure_pa) / 300,
                        std::abs(s.pitot(p).pressure_pa) / 30});
    }
  }
  CHECK(before > 0.8);
  CHECK(after < 0.01);
}

TEST_CASE("the parameter calibrates a built-in set, too") {
  for (const bool calibrated : {false, true}) {
    auto b = airborne(SensorSet::rosflight);
    b->params.own_sensors.calibrated.value = calibrated;
    double sum = 0;
    int n = 0;
    for (int i = 0; i < 400; ++i) {
      pass(*b, &level);
      if (b->out.truth.written) {
        sum += eigen(b->out.truth.value.gyro_bias_radps).norm();
        ++n;
      }
    }
    CHECK((sum / n > 0.02) == !calibrated);  // the drift of 0.3 mrad/s stays
  }
}

TEST_CASE("samples come late, jittering, lost in gaps, with stamps that only grow") {
  SensorSuite suite = none();
  suite.imu.timing = {400, 0.02, 0.001, 0.2, 0};  // eight periods late
  suite.gnss.timing = {10, 0.25, 0.03, 0, 0};     // later than a period
  suite.mag.timing = {1000, 0, 0, 0, 0};          // faster than the loop
  suite.baro.timing = {100, 0, 0, 0.3, 0.5};      // gaps of half a second
  auto b = with(suite);
  std::int64_t last_imu = -1, last_gnss = -1;
  int imu = 0, gnss = 0, mag = 0, baro = 0, gap = 0, longest = 0;
  double min_s = 1, most_s = 0;
  constexpr int ticks = 80000;
  for (int i = 1; i <= ticks; ++i) {
    pass(*b, &level);
    const std::int64_t now = b->tick.now_ns;
    if (b->out.imu.written) {
      CHECK(b->out.imu.valid_at_ns > last_imu);
      CHECK(now - b->out.imu.valid_at_ns >= 20000000);
      last_imu = b->out.imu.valid_at_ns;
      ++imu;
    }
    if (b->out.gnss.written) {
      CHECK(now - b->out.gnss.valid_at_ns >= 250000000);
      const double s = 1e-9 * static_cast<double>(b->out.gnss.valid_at_ns - last_gnss);
      if (last_gnss >= 0) {
        min_s = std::min(min_s, s);
        most_s = std::max(most_s, s);
      }
      last_gnss = b->out.gnss.valid_at_ns;
      ++gnss;
    }
    mag += b->out.mag.written;
    baro += b->out.baro.written;
    gap = b->out.baro.written ? 0 : gap + 1;
    longest = std::max(longest, gap);
  }
  CHECK(imu / (0.8 * ticks) == Approx(1).epsilon(0.01));
  CHECK(std::abs(gnss - 2000) <= 4);
  CHECK(min_s < 0.06);
  CHECK(most_s > 0.14);
  CHECK(min_s >= 0.04);
  CHECK(most_s <= 0.16);
  CHECK(mag == ticks);
  CHECK(baro / (0.7 * ticks / 4) == Approx(1).epsilon(0.15));
  CHECK(longest > 400);  // a second
}

TEST_CASE("timing that cannot be is refused by the sensor's name") {
  SensorSuite suite = none();
  suite.baro.timing = {50, 0, 0.01, 0, 0};
  CHECK_THROWS_WITH(pass(*with(suite)), doctest::Contains("sim_aero.jitter_too_large(baro, 0.01, 0.009)"));
  suite.baro.timing = {50, 0, 0, 0, 0};
  suite.imu.timing.latency_s = 0.2;
  CHECK_THROWS_WITH(pass(*with(suite)), doctest::Contains("sim_aero.latency_too_large(imu, 0.2, "));
}

TEST_CASE("a receiver has no fix before it has started, and then the one of its file") {
  SensorSuite suite = none();
  suite.gnss.start_up_s = 2;
  suite.gnss.fix = FixType::rtk_fixed;
  auto b = with(suite);
  for (int i = 1; i <= 1600; ++i) {
    pass(*b, &level);
    if (!b->out.gnss.written) continue;
    const bool found = b->tick.now_ns >= 2000000000;
    CHECK((b->out.gnss.value.fix == FixType::rtk_fixed) == found);
    CHECK((b->out.gnss.value.horizontal_std_m < 1) == found);
  }
}

TEST_CASE("faults work on sensors from a file: off, stuck, wrong") {
  SensorSuite suite = none();
  suite.imu.gyro.noise_per_root_hz_radps = 1e-4;
  suite.imu.gyro.step_radps = 1e-3;
  suite.baro.noise_pa = 2;
  suite.baro.timing.latency_s = 0.05;
  auto b = with(suite);
  for (int i = 0; i < 100; ++i) pass(*b, &level);
  set_fault(*b, FaultTarget::gyro, SensorFault::stuck);
  set_fault(*b, FaultTarget::baro, SensorFault::off);
  b->retune();
  for (int i = 0; i < 40; ++i) pass(*b, &level);
  const Vector3d stuck = sensed(b->out, FaultTarget::gyro);
  bool silent = true;
  for (int i = 0; i < 200; ++i) {
    pass(*b, &level);
    CHECK(sensed(b->out, FaultTarget::gyro) == stuck);
    silent = silent && !b->out.baro.written;
  }
  CHECK(silent);
  set_fault(*b, FaultTarget::gyro, SensorFault::wrong);
  b->params.faults.sensors_that_fail.gyro_fault_size.value = {0.5, 0, 0};
  b->retune();
  pass(*b, &level);
  CHECK(sensed(b->out, FaultTarget::gyro).x() > 0.3);
}

TEST_CASE("one sensor's file leaves what all others draw as it is") {
  SensorSuite plain = none(), more = none();
  plain.baro.noise_pa = more.baro.noise_pa = 2;
  plain.imu.accel.noise_mps2 = more.imu.accel.noise_mps2 = 0.1;
  more.imu.accel.instability_mps2 = 0.05;
  more.imu.gyro.bias_std_radps = 0.1;
  more.mag.cross_axis_ratio = 0.1;
  more.gnss.timing.dropouts_frac = 0.5;
  auto a = with(plain), b = with(more);
  for (int i = 0; i < 400; ++i) {
    pass(*a, &level);
    pass(*b, &level);
    if (a->out.baro.written) CHECK(sensed(a->out, FaultTarget::baro) == sensed(b->out, FaultTarget::baro));
  }
  CHECK(sensed(a->out, FaultTarget::gyro) != sensed(b->out, FaultTarget::gyro));
}

}  // namespace sheet_test
