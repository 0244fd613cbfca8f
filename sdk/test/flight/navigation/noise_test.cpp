// SPDX-License-Identifier: BSD-3-Clause
// Noise estimates from samples and innovations, and the effect of gusts on the mean wind: with sequences of
// known statistics.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/navigation/ekf.hpp>
#include <fulmar/flight/navigation/gusts.hpp>
#include <fulmar/flight/navigation/noise.hpp>
#include <fulmar/random.hpp>
#include <numbers>

namespace noise_test {

using namespace fulmar;
using Eigen::Vector2d;
using Eigen::Vector3d;
using navigation::FixNoise;
using navigation::UnitNoise;

namespace {

constexpr double pi = std::numbers::pi;

/// Learnt density of a unit with noise of `std` per sample, and an oscillation of +-`sway` at 2 Hz.
double learnt(double std, double rate_hz, double seconds, double reported, double sway = 0) {
  Random r(7);
  UnitNoise noise;
  const double dt = 1 / rate_hz;
  for (int k = 0; k < seconds * rate_hz; ++k) {
    const double moved = sway * std::sin(2 * pi * 2 * k * dt);
    noise.sampled(
        Vector3d(3 + moved, -9.8 - moved, moved) + std * Vector3d(r.normal(), r.normal(), r.normal()), dt);
  }
  return noise.density(reported);
}

/// Innovations at 10 Hz for a minute: white noise of `white` and a first-order process of `slow` with 2 s.
FixNoise receiver(double white, double slow, double reported) {
  Random r(3);
  FixNoise noise;
  const double phi = std::exp(-0.1 / 2), kick = slow * std::sqrt(1 - phi * phi);
  Vector3d drift = slow * Vector3d(r.normal(), r.normal(), r.normal());
  for (int k = 0; k < 600; ++k) {
    const auto normal = [&] { return Vector3d(r.normal(), r.normal(), r.normal()); };
    drift = phi * drift + kick * normal();
    noise.add(drift + white * normal(), reported, 0.1 * k);
  }
  return noise;
}

/// Standard deviation of the tilt after 20 s with this rate about x, from 0, with scale noise alone.
double tilt_std(double rate_hz, double (*rate)(double t_s)) {
  ErrorStateEkf f;
  f.noise = {};
  f.noise.gyro = f.noise.accel = f.noise.gyro_bias_walk = f.noise.accel_bias_walk = 0;
  f.noise.gyro_scale = 1e-3;
  f.reset({}, ekf::Vector::Constant(1e-9), 0);
  for (int k = 1; k <= 20 * rate_hz; ++k)
    f.predict({rate(k / rate_hz), 0, 0}, Vector3d(0, 0, -9.80665), 1 / rate_hz);
  return f.std(ekf::theta);
}

}  // namespace

TEST_CASE(
    "the noise of an inertial unit is learnt: that of both sets of sensors, five times as much, a fifth") {
  // plugins/sim_aero: 0.2 and 0.0139 m/s2, 2.26e-3 and 0.987e-3 rad/s a sample at 400 Hz
  for (const double times : {1.0, 5.0, 0.2})
    for (const double rate_hz : {100.0, 400.0}) {
      CAPTURE(times);
      CAPTURE(rate_hz);
      const double dt = 1 / rate_hz, min_accel = 0.5 * 0.02, min_gyro = 0.5 * 5e-4;
      const auto density = [&](double std) { return times * std * std::sqrt(dt); };
      const double accel = learnt(times * 0.2, rate_hz, 20, 0.02);
      CHECK(accel / std::min(std::hypot(density(0.2), min_accel), 0.1) == doctest::Approx(1).epsilon(0.06));
      CHECK(learnt(times * 0.0139, rate_hz, 20, 0.02) / std::hypot(density(0.0139), min_accel) ==
            doctest::Approx(1).epsilon(0.06));
      CHECK(learnt(times * 2.26e-3, rate_hz, 20, 5e-4) / std::hypot(density(2.26e-3), min_gyro) ==
            doctest::Approx(1).epsilon(0.06));
      CHECK(learnt(times * 0.987e-3, rate_hz, 20, 5e-4) / std::hypot(density(0.987e-3), min_gyro) ==
            doctest::Approx(1).epsilon(0.06));
    }
}

TEST_CASE(
    "motion is no noise, an unknown unit has the reported noise, a slow one too, and there are bounds") {
  CHECK(learnt(0.05, 400, 20, 0.02, 5) / std::hypot(0.05 / 20, 0.01) == doctest::Approx(1).epsilon(0.06));
  CHECK(learnt(0.05, 100, 20, 0.02, 2) / std::hypot(0.05 / 10, 0.01) == doctest::Approx(1).epsilon(0.08));
  CHECK(learnt(0.2, 400, 0.4, 0.02) == 0.02);
  CHECK(learnt(0.2, 50, 60, 0.02) == 0.02);
  CHECK(learnt(0, 400, 20, 0.02) / 0.01 == doctest::Approx(1));
  CHECK(learnt(20, 400, 20, 0.02) / 0.1 == doctest::Approx(1));
}

TEST_CASE("of what a receiver states, the part that is white counts once, and the slow one n times") {
  // half the mean square of successive differences: 0.03^2 + (1 - exp(-0.1 / 2)) 0.1^2
  const double white = 0.0009 + (1 - std::exp(-0.05)) * 0.01, reported = 0.15 * 0.15;
  const FixNoise slow = receiver(0.03, 0.1, 0.15);
  CHECK(slow.level(1) / reported == doctest::Approx(1));
  CHECK(slow.level(6) / (white + 6 * (reported - white)) == doctest::Approx(1).epsilon(0.02));
  CHECK(slow.climb(41) / (white + 41 * (reported - white)) == doctest::Approx(1).epsilon(0.02));
  CHECK(slow.beyond(0.2) / std::sqrt(0.04 - (reported - white)) == doctest::Approx(1).epsilon(0.02));
  CHECK(slow.beyond(0.1) == 0);
  // A receiver with correct white noise: each fix counts in full. One with more noise: not less either.
  for (const double std : {0.15, 0.5}) {
    const FixNoise honest = receiver(std, 0, 0.15);
    CHECK(honest.level(6) < (std > 0.15 ? 1.0001 : 1.8) * reported);
    CHECK(honest.climb(6) < (std > 0.15 ? 1.0001 : 1.8) * reported);
    CHECK(honest.beyond(0.15) > 0.135);
  }
}

TEST_CASE("before its fixes tell more, a receiver's level velocity is white, and its climb is slow") {
  FixNoise noise;
  Random r(1);
  for (int k = 0; k < 40; ++k)
    noise.add({0.01 * r.normal(), 0.01 * r.normal(), 0.01 * r.normal()}, 0.2, 0.1 * k);
  CHECK(noise.level(10) / 0.04 == doctest::Approx(1));
  CHECK(noise.climb(10) / 0.4 == doctest::Approx(1));
  CHECK(noise.beyond(0.1) / 0.1 == doctest::Approx(1));
}

TEST_CASE("a scale error counts where a turn lasts, either way, and hardly where it goes to and fro") {
  const double left = tilt_std(100, [](double) { return -0.5; }),
               right = tilt_std(100, [](double) { return 0.5; });
  // (1e-3 0.5)^2 times the integral of 1 - exp(-t / 2) over 20 s
  CHECK(right / (5e-4 * std::sqrt(18.0)) == doctest::Approx(1).epsilon(0.01));
  CHECK(left / right == doctest::Approx(1));
  // 1.5 Hz: the past value lags by a quarter period, and has 1 / (2 pi 1.5 2) of the amplitude; positive half
  // of their product
  const double sways = tilt_std(100, [](double t) { return 0.5 * std::sin(2 * pi * 1.5 * t); });
  CHECK(sways < 0.12 * right);
  // A pull of 0.2 s: (1e-3 5)^2 times the integral of 1 - exp(-t / 2) over it, as a scale error gives
  const double pull = tilt_std(100, [](double t) { return t < 0.2001 ? 5.0 : 0.0; });
  CHECK(pull / (5e-3 * std::sqrt(0.2 - 2 * (1 - std::exp(-0.1)))) == doctest::Approx(1).epsilon(0.1));
}

}  // namespace noise_test
