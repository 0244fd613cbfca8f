// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/sim_aero/sensors.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <set>

#include "sdk/test/flight/airframe_file.hpp"

namespace sensors_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

const Airframe& anaconda() {
  static const Airframe airframe = test::airframe_file("anaconda");
  return airframe;
}

const Vector3d field(21e-6, 4e-6, 46e-6);

Sensors sensors(SensorSet set, std::uint64_t seed = 1) {
  return Sensors(sensor_spec(set), 400, LocalFrame(40.2463724, -111.6474138, 1387), field, seed);
}

Plant flying() {
  Plant p(anaconda(), {}, 1387, 1);
  REQUIRE(p.fly({120, -40, -70}, 0.6, 17));
  return p;
}

struct Statistics {
  double mean = 0, deviation = 0;
};

Statistics of(int n, const std::function<double()>& draw) {
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = draw();
    sum += x;
    squares += x * x;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean)};
}

}  // namespace

TEST_CASE("perfect sensors say what is") {
  const Plant p = flying();
  Sensors s = sensors(SensorSet::perfect);
  CHECK(eigen(s.imu(p).rate_radps) == p.state().omega_b);
  CHECK((eigen(s.imu(p).specific_force_mps2) - p.state().q_nb.conjugate() * Vector3d(0, 0, -9.80665)).norm() <
        1e-6);  // steady flight
  CHECK(eigen(s.mag(p).field_tesla).norm() == Approx(field.norm()));
  CHECK(s.baro(p).pressure_pa ==
        Approx(101325 * std::pow(1 - 0.0065 * 1457 / 288.15, 5.25588)).epsilon(1e-6));
  CHECK(s.pitot(p).pressure_pa == Approx(0.5 * p.air().density_kgm3 * 17 * 17));
  CHECK(true_airspeed(s.pitot(p).indicated_airspeed_mps, p.air().density_kgm3) == Approx(17));
  const Gnss g = s.gnss(p, 42);
  CHECK(g.altitude_m == Approx(1457).epsilon(1e-5));
  CHECK(eigen(g.velocity_mps) == p.state().v_n);
  CHECK(g.utc_ns == 42);
  CHECK(g.fix == FixType::fix_3d);
  // 120 m north on the meridian's radius of curvature, 40 m west on the parallel's, WGS-84 at 40.246 deg
  // and 1.4 km
  CHECK((g.latitude_deg - 40.2463724) * std::numbers::pi / 180 * (6362109.0 + 1457) ==
        Approx(120).epsilon(1e-3));
  CHECK((g.longitude_deg + 111.6474138) * std::numbers::pi / 180 * (6387068.0 + 1457) * std::cos(0.70243) ==
        Approx(-40).epsilon(1e-3));
}

TEST_CASE(
    "sensors with errors say what fits into single precision, on each axis; perfect ones say all digits") {
  const Plant p = flying();
  const auto fits = [](double x) {
    volatile const float single = static_cast<float>(x);
    return x == static_cast<double>(single);
  };
  for (const SensorSet set : {SensorSet::rosflight, SensorSet::ublox}) {
    Sensors s = sensors(set);
    for (int n = 0; n < 100; ++n) {
      const Imu imu = s.imu(p);
      for (const Vec3<Body>& v : {imu.rate_radps, imu.specific_force_mps2, s.mag(p).field_tesla}) {
        CHECK(fits(v.x));
        CHECK(fits(v.y));
        CHECK(fits(v.z));
      }
      CHECK(fits(s.baro(p).pressure_pa));
      const Pitot pitot = s.pitot(p);
      CHECK(fits(pitot.pressure_pa));
      CHECK(fits(pitot.indicated_airspeed_mps));
    }
  }
  CHECK(!fits(sensors(SensorSet::perfect).mag(p).field_tesla.x));
  CHECK(to_single(-9.80665) == -9.8066501617431640625);  // IEEE 754: 9.80665f
  CHECK(to_single(0.1) == 0.100000001490116119384765625);
  CHECK(to_single(0) == 0);
}

TEST_CASE("the rosflight sensors have the deviations of its simulator") {
  const Plant p = flying();
  Sensors s = sensors(SensorSet::rosflight);
  const int n = 20000;
  // white noise: half the mean square of successive differences, so that biases and walks do not count
  const auto white = [&](const std::function<double()>& draw) {
    double before = draw();
    return of(n,
              [&] {
                const double now = draw(), d = now - before;
                before = now;
                return d;
              })
               .deviation /
           std::sqrt(2.0);
  };
  CHECK(white([&] { return s.imu(p).rate_radps.x; }) == Approx(0.00226).epsilon(0.04).scale(0));
  CHECK(white([&] { return s.imu(p).specific_force_mps2.z; }) == Approx(0.2).epsilon(0.03).scale(0));
  CHECK(white([&] { return s.baro(p).pressure_pa; }) == Approx(4).epsilon(0.03));
  CHECK(white([&] { return s.pitot(p).pressure_pa; }) == Approx(1.15).epsilon(0.03));
  CHECK(of(n, [&] { return s.gnss(p, 0).velocity_mps.east - p.state().v_n.y(); }).deviation ==
        Approx(0.01).epsilon(0.03).scale(0));
  // x <- exp(-7 T) x + 3e-6 T n at 50 Hz
  CHECK(of(100000, [&] {
          return (eigen(s.mag(p).field_tesla) - p.state().q_nb.conjugate() * field).x();
        }).deviation == Approx(3e-6 * 0.02 / std::sqrt(1 - std::exp(-2 * 7 * 0.02))).epsilon(0.06).scale(0));
}

TEST_CASE("the ublox sensors have the white noise of their data sheets") {
  const Plant p = flying();
  Sensors s = sensors(SensorSet::ublox);
  // half of the mean squared difference of successive samples
  const auto white = [](const std::function<double()>& draw) {
    double squares = 0, before = draw();
    for (int i = 0; i < 20000; ++i) {
      const double now = draw();
      squares += (now - before) * (now - before);
      before = now;
    }
    return std::sqrt(squares / 20000 / 2);
  };
  const double degree = std::numbers::pi / 180, bandwidth = std::sqrt(200.0);  // per root Hz, over 200 Hz
  CHECK(white([&] { return s.imu(p).rate_radps.y; }) / (0.004 * degree * bandwidth) ==
        Approx(1).epsilon(0.03));
  CHECK(white([&] { return s.imu(p).specific_force_mps2.y; }) / (100e-6 * 9.80665 * bandwidth) ==
        Approx(1).epsilon(0.03));
  CHECK(white([&] { return s.mag(p).field_tesla.y; }) / 0.3e-6 == Approx(1).epsilon(0.03));
}

TEST_CASE("the rosflight biases fill their ranges, another one for each seed") {
  double largest_gyro = 0, largest_accel = 0, sum = 0;
  std::set<double> all;
  const int n = 1000;
  for (int i = 0; i < n; ++i) {
    const Sensors s = sensors(SensorSet::rosflight, static_cast<std::uint64_t>(i));
    largest_gyro = std::max(largest_gyro, s.gyro_bias().cwiseAbs().maxCoeff());
    largest_accel = std::max(largest_accel, s.accel_bias().cwiseAbs().maxCoeff());
    sum += s.gyro_bias().z() * s.gyro_bias().z();
    all.insert(s.gyro_bias().x());
  }
  CHECK(largest_gyro > 0.245);
  CHECK(largest_gyro <= 0.253);  // the range and the warm-up
  CHECK(largest_accel > 0.59);
  CHECK(largest_accel <= 0.6);
  CHECK(std::sqrt(sum / n) == Approx(0.25 / std::sqrt(3)).epsilon(0.06).scale(0));
  CHECK(all.size() == static_cast<std::size_t>(n));
}

TEST_CASE("the rosflight position walks as its recursion does") {
  // x <- exp(-T/1100) x + 0.21 T n from zero: after k steps the variance is a geometric sum
  const double T = 0.1, a = std::exp(-T / 1100), k = 1000;
  const double expected = 0.21 * T * std::sqrt((1 - std::pow(a, 2 * k)) / (1 - a * a));
  double sum = 0;
  const int runs = 1000;
  for (int r = 0; r < runs; ++r) {
    Random random(static_cast<std::uint64_t>(r));
    Noise noise(rosflight_sensors().gnss_position[0], T, random);
    double x = 0;
    for (int i = 0; i < 1000; ++i) x = noise.next(random);
    sum += x * x;
  }
  CHECK(std::sqrt(sum / runs) == Approx(expected).epsilon(0.08).scale(0));
  CHECK(expected == Approx(0.64).epsilon(0.02).scale(0));
}

TEST_CASE("a Gauss-Markov error has its deviation and its time constant at any rate") {
  for (double T : {0.02, 0.5}) {
    Random random(3);
    NoiseSpec spec;
    spec.drift = 2;
    spec.drift_tau_s = 5;
    Noise noise(spec, T, random);
    const int n = 400000, lag = static_cast<int>(std::lround(5 / T));
    std::vector<double> x(static_cast<std::size_t>(n));
    for (double& v : x) v = noise.next(random);
    double square = 0, product = 0;
    for (int i = lag; i < n; ++i) {
      square += x[static_cast<std::size_t>(i)] * x[static_cast<std::size_t>(i)];
      product += x[static_cast<std::size_t>(i)] * x[static_cast<std::size_t>(i - lag)];
    }
    CHECK(std::sqrt(square / (n - lag)) == Approx(2).epsilon(0.08));
    CHECK(product / square == Approx(std::exp(-1)).epsilon(0.15).scale(0));
  }
}

TEST_CASE("an initial offset fades with its time constant") {
  Random random(1);
  NoiseSpec spec;
  spec.offset = 0.003;
  spec.offset_tau_s = 400;
  Noise noise(spec, 0.0025, random);
  for (int i = 0; i < 160000; ++i) noise.next(random);
  CHECK(noise.bias() == Approx(0.003 * std::exp(-1)));
}

TEST_CASE("a random walk grows with the root of time, whatever the rate") {
  for (double T : {0.01, 0.1}) {
    double sum = 0;
    const int runs = 2000;
    for (int r = 0; r < runs; ++r) {
      Random random(static_cast<std::uint64_t>(r));
      NoiseSpec spec;
      spec.walk = 0.3;
      Noise noise(spec, T, random);
      for (int i = 0; i < std::lround(4 / T); ++i) noise.next(random);
      sum += noise.bias() * noise.bias();
    }
    CHECK(std::sqrt(sum / runs) == Approx(0.6).epsilon(0.06).scale(0));
  }
}

TEST_CASE("the ublox receiver's errors have the size of a real one's") {
  const Plant p = flying();
  double north = 0, down = 0, speed = 0;
  const int runs = 400;
  const LocalFrame frame(40.2463724, -111.6474138, 1387);
  for (int r = 0; r < runs; ++r) {
    Sensors s = sensors(SensorSet::ublox, static_cast<std::uint64_t>(r));
    const Gnss g = s.gnss(p, 0);
    const Vector3d error = frame.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m) - p.state().p_n;
    north += error.x() * error.x();
    down += error.z() * error.z();
    speed += std::pow(g.velocity_mps.north - p.state().v_n.x(), 2);
  }
  CHECK(std::sqrt(north / runs) == Approx(std::hypot(1.5, 0.3)).epsilon(0.12));
  CHECK(std::sqrt(down / runs) == Approx(std::hypot(3.0, 0.3)).epsilon(0.12));
  CHECK(std::sqrt(speed / runs) == Approx(std::hypot(0.1, 0.03)).epsilon(0.12).scale(0));
}

TEST_CASE("air from behind or from the side does not reach the pitot tube") {
  Plant p(anaconda(), {{6, 0, 0}, Turbulence::none}, 1387, 1);  // a tail wind, standing
  Sensors s = sensors(SensorSet::perfect);
  CHECK(s.pitot(p).pressure_pa == 0);
  Plant side(anaconda(), {{0, 6, 0}, Turbulence::none}, 1387, 1);
  CHECK(s.pitot(side).pressure_pa == 0);
}

TEST_CASE("a due time is kept for ever: no remainder builds up") {
  for (double rate : {400.0, 100.0, 50.0, 30.0, 7.0}) {
    Due due(rate, 0);
    int count = 0;
    for (std::int64_t now = 0; now < 1000000000000; now += 2500000) count += due(now);
    CHECK(std::abs(count - 1000 * rate) <= 1);
  }
}

TEST_CASE("a delayed sample comes late, in order, with the time that it was valid") {
  Delay<int> delay;
  delay.push(1, 0);
  delay.push(2, 100);
  CHECK(delay.pop(149, 150) == nullptr);
  const auto* first = delay.pop(150, 150);
  REQUIRE(first);
  CHECK(first->value == 1);
  CHECK(first->valid_at_ns == 0);
  CHECK(delay.pop(200, 150) == nullptr);
  CHECK(delay.pop(250, 150)->value == 2);
}

TEST_CASE("the scale of a pitot tube is off either way, by chance") {
  SensorSpec spec = sensor_spec(SensorSet::perfect);
  spec.pitot_scale = 0.04;
  Plant plant = flying();
  const double right = 0.5 * plant.air().density_kgm3 * plant.air_velocity_b().squaredNorm();
  double sum = 0, least = 2, most = 0;
  constexpr int seeds = 400;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Sensors s(spec, 400, LocalFrame(40.2463724, -111.6474138, 1387), field, seed);
    const double scale = s.pitot(plant).pressure_pa / right;
    sum += scale;
    least = std::min(least, scale);
    most = std::max(most, scale);
  }
  CHECK(std::abs(sum / seeds - 1) < 0.004);  // 0.04 / sqrt(3 seeds): three deviations
  CHECK(least / 0.96 == Approx(1).epsilon(0.002));
  CHECK(most / 1.04 == Approx(1).epsilon(0.002));
}

TEST_CASE("a bias walks by the time that passes, in a loop that is slower than the sensor, too") {
  SensorSpec spec = sensor_spec(SensorSet::perfect);
  spec.imu_hz = 400;
  spec.gyro[0].walk = 0.01;
  const Plant plant = flying();
  for (const double tick_hz : {400.0, 100.0}) {
    double squares = 0;
    constexpr int seeds = 400;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Sensors s(spec, tick_hz, LocalFrame(40.2463724, -111.6474138, 1387), field, seed);
      for (int i = 0; i < static_cast<int>(tick_hz); ++i) s.imu(plant);
      squares += s.gyro_bias().x() * s.gyro_bias().x();
    }
    CAPTURE(tick_hz);
    CHECK(std::abs(std::sqrt(squares / seeds) / 0.01 - 1) < 0.15);  // a deviation: 1 / sqrt(2 seeds)
  }
}

}  // namespace sensors_test
