// SPDX-License-Identifier: BSD-3-Clause
// Process noise of the second formulation against closed forms and simulated noise.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "bench/second_filter/sensors.hpp"
#include "fulmar/random.hpp"

namespace second_filter_noise_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using fulmar::second_filter::Vector;

namespace {

constexpr double g = 9.80665;

void add_blocks(Filter& f) {
  for (const Block& b : {Block{.first = wind, .count = 2, .std = 5, .walk = 0.01},
                         {.first = gust, .count = 2, .std = 1, .time_s = 15},
                         {.first = fix_pos, .count = 3, .std = 2, .time_s = 150},
                         {.first = slip, .count = 1, .std = 0.3, .time_s = 1}})
    f.add_block(b);
}

}  // namespace

TEST_CASE("filter: noise grows with time at any rate of the unit; a slow error keeps its variance") {
  for (const double rate_hz : {50.0, 400.0}) {
    CAPTURE(rate_hz);
    Filter f;
    add_blocks(f);
    f.unit = {.gyro = 1e-3, .accel = 0.05, .gyro_scale = 2e-3, .accel_scale = 0.01, .motion = 4};
    f.reset({}, Eigen::Matrix<double, 15, 1>::Zero(), 0);
    f.wind_shear = 0.02;
    f.inflate(gust, 2, std::sqrt(8.0));  // to a standard deviation of 3
    for (int k = 0; k < 2 * rate_hz; ++k) f.predict({0, 0, 0.5}, {0, 0, -2 * g}, 1 / rate_hz);
    CHECK(1e3 * f.std(theta + 2) == doctest::Approx(std::sqrt(2 * (1 + 4 * 2 * 2 * 0.25))).epsilon(1e-4));
    const double load = 4 * 0.01 * 0.01 * g * g;
    CHECK(f.std(vel + 2) == doctest::Approx(std::sqrt((0.05 * 0.05 + load) * 2)).epsilon(1e-4));
    CHECK(f.take_motion_variance() == doctest::Approx(2 * load));
    CHECK(f.take_motion_variance() == 0);
    const double climbed = std::pow(0.02 * g, 2) * 8 / 3;  // the integral of (0.02 g t)^2
    CHECK((f.covariance()(wind, wind) - 25) / (1e-4 * 2 + climbed) == doctest::Approx(1).epsilon(0.02));
    CHECK(f.std(fix_pos) == doctest::Approx(2));
    CHECK(f.std(gust) == doctest::Approx(std::sqrt(1 + 8 * std::exp(-2 * 2 / 15.0))));
  }
}

TEST_CASE("filter: the biases of the unit grow with turn rate and load, and with the motion that is seen") {
  // Without scale errors the biases stay known.
  const auto grown = [](double gyro_scale, double accel_scale, double motion) {
    Filter f;
    f.unit = {.gyro = 0, .accel = 0, .gyro_scale = gyro_scale, .accel_scale = accel_scale, .motion = motion};
    f.reset({}, Eigen::Matrix<double, 15, 1>::Zero(), 0);
    for (int k = 0; k < 400; ++k) f.predict({0.3, 0, 0.4}, {0, 0, -3 * g}, 0.01);
    return f.covariance();
  };
  // 0.7 % of the scale error in 1 s, as a random walk: rate 0.5 rad/s, load 2 g beyond 1 g, 4 s.
  const double gyro = std::pow(0.007 * 0.02 * 0.5, 2) * 4, accel = std::pow(0.007 * 0.01 * 2 * g, 2) * 4;
  for (const double motion : {1.0, 2.5}) {
    CAPTURE(motion);
    const Covariance P = grown(0.02, 0.01, motion);
    for (int i = 0; i < 3; ++i) {
      CHECK(P(gyro_bias + i, gyro_bias + i) / (motion * gyro) == doctest::Approx(1).epsilon(1e-5));
      CHECK(P(accel_bias + i, accel_bias + i) / (motion * accel) == doctest::Approx(1).epsilon(1e-5));
    }
  }
  CHECK(grown(0, 0.01, 1)(gyro_bias, gyro_bias) == 0);
  CHECK(grown(0.02, 0, 1)(accel_bias, accel_bias) == 0);
}

TEST_CASE(
    "filter: a gust from the side is sideslip, in a step by the closed form, in 2 s as in a simulation") {
  constexpr double dt = 0.01, share = 0.7;
  Filter f;
  add_blocks(f);
  f.unit.gyro = f.unit.accel = 0;
  f.sideslip_gust = share;
  Nominal n;
  n.q_nb = quaternion_from({0.6, 0.2, 2.2});
  f.reset(n, Eigen::Matrix<double, 15, 1>::Zero(), 0);
  f.forget(gust, 2, 0);
  f.forget(slip, 1, 0);
  const Vector3d force_b = n.q_nb.conjugate() * Vector3d(0, 0, -g);
  // The body y axis in NED, by the rotations of roll, pitch and yaw.
  const double sr = std::sin(0.6), cr = std::cos(0.6), sp = std::sin(0.2), sy = std::sin(2.2),
               cy = std::cos(2.2);
  const Vector2d side(sr * sp * cy - cr * sy, sr * sp * sy + cr * cy);
  f.predict(Vector3d::Zero(), force_b, dt);
  const double gust_q = 1 - std::exp(-2 * dt / 15), slip_q = 0.09 * (1 - std::exp(-2 * dt));
  const auto near = [&](double got, double expected) {
    CHECK(std::abs(got - expected) < 1e-6 * (gust_q + slip_q));
  };
  near(f.covariance()(slip, slip), slip_q + share * share * gust_q * side.squaredNorm());
  for (int i = 0; i < 2; ++i) {
    near(f.covariance()(gust + i, gust + i), gust_q);
    near(f.covariance()(gust + i, slip), -share * gust_q * side(i));
    near(f.covariance()(slip, gust + i), -share * gust_q * side(i));
  }
  near(f.covariance()(gust, gust + 1), 0);

  for (int k = 1; k < 200; ++k) f.predict(Vector3d::Zero(), force_b, dt);
  Random r(30);
  Matrix3d sampled = Matrix3d::Zero();
  constexpr int runs = 4000;
  const double keep = std::exp(-dt / 15), keep_slip = std::exp(-dt);
  for (int run = 0; run < runs; ++run) {
    Vector3d x = Vector3d::Zero();  // gust, sideslip
    for (int k = 0; k < 200; ++k) {
      const Vector2d blow = std::sqrt(gust_q) * Vector2d(r.normal(), r.normal());
      x.head<2>() = keep * x.head<2>() + blow;
      // The air comes from the other side than the gust blows to.
      x(2) = keep_slip * x(2) + std::sqrt(slip_q) * r.normal() - share * blow.dot(side);
    }
    sampled += x * x.transpose() / runs;
  }
  const int at[] = {gust, gust + 1, slip};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      const double scale = std::sqrt(sampled(i, i) * sampled(j, j));
      CHECK(std::abs(f.covariance()(at[i], at[j]) - sampled(i, j)) < 0.07 * scale);
    }
  CHECK(std::abs(f.covariance()(gust, slip)) > 0.2 * f.std(gust) * f.std(slip));
}

TEST_CASE("navigator: a component can append three states to its filter") {
  Navigator navigator;
  for (int i = 0; i < 3; ++i) CHECK_NOTHROW(navigator.filter().append(0.1, 0.01));
  CHECK_THROWS_AS(navigator.filter().append(0.1, 0.01), std::length_error);
}

}  // namespace second_filter_noise_test
