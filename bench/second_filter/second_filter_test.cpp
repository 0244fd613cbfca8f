// SPDX-License-Identifier: BSD-3-Clause
// States, measurement rows and prediction of the second formulation: rows and transition against central
// finite differences of an integration of its own.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "bench/second_filter/sensors.hpp"
#include "fulmar/random.hpp"

namespace second_filter_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using fulmar::second_filter::Vector;

namespace {

constexpr double g = 9.80665;

Vector3d any(Random& r, double range) {
  return {r.uniform(-range, range), r.uniform(-range, range), r.uniform(-range, range)};
}
/// A state in flight at some 20 m/s, with an error in each slow state.
Nominal any_state(Random& r) {
  Nominal n;
  n.q_nb = quaternion_from({r.uniform(-1, 1), r.uniform(-0.8, 0.8), r.uniform(-3, 3)});
  for (int i = 3; i < size; ++i) n.x(i) = 0.05 * r.normal();
  n.x.tail<4>().setZero();
  n.x.segment<3>(vel) = n.q_nb * Vector3d(20, 1, 1) + any(r, 2);
  n.x.segment<3>(pos) = any(r, 100);
  n.x.segment<4>(wind) << 3, -2, 0.5, 1;
  return n;
}
void add_blocks(Filter& f) {
  for (const Block& b : {Block{.first = wind, .count = 2, .std = 5, .walk = 0.01},
                         {.first = gust, .count = 2, .std = 1, .time_s = 15},
                         {.first = fix_pos, .count = 3, .std = 2, .time_s = 150},
                         {.first = fix_vel, .count = 3, .std = 0.3, .time_s = 2},
                         {.first = baro_bias, .count = 1, .std = 100, .walk = 0.06},
                         {.first = slip, .count = 1, .std = 0.3, .time_s = 1}})
    f.add_block(b);
}
/// Without noise of the unit.
Filter filter_at(const Nominal& n, double std = 0.1) {
  Filter f;
  add_blocks(f);
  f.unit.gyro = f.unit.accel = 0;
  f.reset(n, Eigen::Matrix<double, 15, 1>::Constant(std), 100);
  return f;
}

/// Samples of an inertial unit in a manoeuvre.
struct Sample {
  Vector3d rate, force;
};
Sample unit_at(double t) {
  return {{0.3 * std::cos(1.3 * t), 0.25, 0.2 * std::sin(0.7 * t) - 0.1},
          {2 + std::sin(0.9 * t), 1, -17 + std::cos(t)}};
}
void fly(Filter& f, double seconds, double rate_hz) {
  const double begin_s = f.time_s() - 100;
  const int steps = static_cast<int>(std::lround(seconds * rate_hz));
  for (int k = begin_s == 0 ? 0 : 1; k <= steps; ++k) {
    const Sample u = unit_at(begin_s + k / rate_hz);
    f.predict(u.rate, u.force, k == 0 ? 1e-9 : 1 / rate_hz);
  }
}
/// Velocity and position `age_s` before the state `n` of time 100 + t, by integration backwards.
struct Then {
  Vector3d v_n, p_n, a_n;
};
Then back(const Nominal& n, double t, double age_s) {
  constexpr int steps = 100;
  const double h = age_s / steps;
  const Vector3d bg = n.at<3>(gyro_bias), ba = n.at<3>(accel_bias);
  Matrix3d R = n.q_nb.normalized().toRotationMatrix();
  const auto turned = [&](const Matrix3d& from, double at_s, double by_s) -> Matrix3d {
    const Vector3d turn = (unit_at(at_s).rate - bg) * by_s;
    return turn.norm() > 0 ? Matrix3d(from * Eigen::AngleAxisd(turn.norm(), turn.normalized())) : from;
  };
  Then then{n.v_n(), n.p_n(), Vector3d::Zero()};
  for (int k = 0; k < steps; ++k) {
    const double s = t - (k + 0.5) * h;
    const Vector3d a = turned(R, s + 0.25 * h, -0.5 * h) * (unit_at(s).force - ba) + Vector3d(0, 0, g);
    then.p_n -= h * then.v_n - 0.5 * h * h * a;
    then.v_n -= h * a;
    R = turned(R, s, -h);
  }
  then.a_n = R * (unit_at(t - age_s).force - ba) + Vector3d(0, 0, g);
  return then;
}

/// Central differences of `expected(Nominal)` by the error state.
template <class Expected>
Row differences(const Nominal& n, const Expected& expected) {
  constexpr double step = 1e-5;
  Row H;
  for (int i = 0; i < size; ++i) {
    Vector dx = Vector::Zero();
    dx(i) = step;
    H(i) = (expected(n.plus(dx)) - expected(n.plus(-dx))) / (2 * step);
  }
  return H;
}
void check_row(const Row& got, const Row& expected, double tolerance, double of_biases) {
  for (const auto& [first, count] :
       {std::pair{+theta, 3}, {+vel, 3},  {+pos, 3},     {+gyro_bias, 3}, {+accel_bias, 3},
        {+wind, 2},           {+gust, 2}, {+fix_pos, 3}, {+fix_vel, 3},   {+delay, 1},
        {+baro_bias, 1},      {+port, 1}, {+iron, 3},    {+strength, 1},  {+tube_scale, 1},
        {+tube_bias, 1},      {+slip, 1}, {+mount, 1},   {+model, 1},     {+appended, 3}}) {
    CAPTURE(first);
    const double share = first == gyro_bias || first == accel_bias ? of_biases : tolerance;
    const auto there = expected.segment(first, count);
    CHECK((got.segment(first, count) - there).norm() <= share * there.norm() + 1e-7);
  }
}
/// After 1.5 s of the manoeuvre.
Filter flown(Random& r, double* t) {
  Filter f = filter_at(any_state(r));
  *t = 1.5;
  fly(f, *t, 200);
  return f;
}

/// Share of the force of the body's x axis, and of the rate about the body's z axis, that is error.
Eigen::Matrix<double, 9, 1> accel_scale(const Motion& m) {
  const Vector3d dv = -m.time_s * m.force_b.x() * m.R_nb.col(0);
  Eigen::Matrix<double, 9, 1> G;
  G << Vector3d::Zero(), dv, 0.5 * m.time_s * dv;
  return G;
}
Eigen::Matrix<double, 9, 1> gyro_scale(const Motion& m) {
  Eigen::Matrix<double, 9, 1> G = Eigen::Matrix<double, 9, 1>::Zero();
  G.head<3>() = -m.time_s * m.rate_b.z() * m.R_nb.col(2);
  return G;
}

}  // namespace

TEST_CASE("states: minus is the inverse of plus, and the rotation is about NED axes") {
  Random r(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Nominal n = any_state(r);
    Vector dx;
    for (int i = 0; i < size; ++i) dx(i) = r.normal();
    dx.head<3>() *= r.uniform(0, 3.1) / dx.head<3>().norm();
    const Nominal to = n.plus(dx);
    CHECK((to.minus(n) - dx).norm() < 1e-9);
    CHECK((n.minus(to) + dx).norm() < 1e-9);
    CHECK(to.q_nb.norm() == doctest::Approx(1).epsilon(1e-12));
  }
  Vector dx = Vector::Zero();
  dx(theta + 2) = 0.5;
  const Nominal level = Nominal{}.plus(dx);
  const Vector3d nose = level.q_nb * Vector3d::UnitX();
  CHECK((nose - Vector3d(std::cos(0.5), std::sin(0.5), 0)).norm() < 1e-12);
  Nominal rolled;
  rolled.q_nb = quaternion_from({1, 0, 0});
  CHECK(euler_from(rolled.plus(dx).q_nb).yaw_rad == doctest::Approx(0.5));
  CHECK(euler_from(rolled.plus(dx).q_nb).roll_rad == doctest::Approx(1));
}

TEST_CASE("states: no two blocks overlap, and the air is wind and turbulence") {
  CHECK(appended + 3 == size);
  Nominal n;
  for (int i = 0; i < size; ++i) n.x(i) = i;
  CHECK((n.air_n() - Vector3d(wind + gust, wind + gust + 2, 0)).norm() == 0);
  CHECK((n.through_air_n() - Vector3d(vel - wind - gust, vel - wind - gust - 1, vel + 2)).norm() == 0);
}

TEST_CASE("fix_velocity and fix_position: value and row are those of an integration backwards") {
  Random r(2);
  for (const double age : {0.0, 0.2})
    for (int trial = 0; trial < 5; ++trial) {
      CAPTURE(age);
      double t = 0;
      const Filter f = flown(r, &t);
      const Past past = f.at(f.time_s() - age);
      const Nominal& n = f.state();
      const Then then = back(n, t, age);
      REQUIRE(past.known);
      CHECK(past.age_s == doctest::Approx(age).epsilon(1e-6));
      const auto late = [&](const Nominal& x) { return back(x, t, age + x.x(delay) - n.x(delay)); };
      for (int axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        const auto velocity = [&](const Nominal& x) { return late(x).v_n(axis) + x.x(fix_vel + axis); };
        const auto position = [&](const Nominal& x) { return late(x).p_n(axis) + x.x(fix_pos + axis); };
        const Scalar v = fix_velocity(f, past, axis, 7, then.a_n(axis)), p = fix_position(f, past, axis, 8);
        CHECK(v.innovation == doctest::Approx(7 - velocity(n)).epsilon(1e-3));
        CHECK(p.innovation == doctest::Approx(8 - position(n)).epsilon(1e-4));
        check_row(v.H, differences(n, velocity), 0.01, 0.05);
        check_row(p.H, differences(n, position), 0.08, 0.05);
      }
    }
}

TEST_CASE("baro_height: row, and pressure of the standard atmosphere with a static port error") {
  Random r(3);
  for (int trial = 0; trial < 5; ++trial) {
    double t = 0;
    const Filter f = flown(r, &t);
    const Nominal& n = f.state();
    const double altitude = 120 - n.x(pos + 2), u = n.through_air_n().norm();
    // The port reads a share of rho u^2 / 2 too much: to first order in the density.
    const Air air = standard_air(altitude + n.x(baro_bias));
    const double pressure = air.pressure_pa + n.x(port) * 0.5 * air.density_kgm3 * u * u;
    CHECK(std::abs(baro_height(f, pressure, 120, true).innovation) < 0.02);
    CHECK(std::abs(baro_height(f, air.pressure_pa, 120, false).innovation) < 1e-6);
    const auto height = [&](const Nominal& x) {
      return -x.x(pos + 2) + x.x(baro_bias) - x.x(port) * x.through_air_n().squaredNorm() / (2 * g);
    };
    check_row(baro_height(f, pressure, 120, true).H, differences(n, height), 1e-6, 0);
    const auto still = [&](const Nominal& x) { return -x.x(pos + 2) + x.x(baro_bias); };
    check_row(baro_height(f, pressure, 120, false).H, differences(n, still), 1e-6, 0);
  }
  const Air air = standard_air(500);
  CHECK(
      metres_per_pascal(air) ==
      doctest::Approx(1 / (standard_air(499.5).pressure_pa - standard_air(500.5).pressure_pa)).epsilon(1e-5));
}

TEST_CASE("tube_pressure, modelled_airspeed, coordinated, zero_velocity and zero_rate: value and row") {
  Random r(4);
  for (int trial = 0; trial < 5; ++trial) {
    double t = 0;
    const Filter f = flown(r, &t);
    const Nominal& n = f.state();
    const auto pressure = [](const Nominal& x) {  // of an airspeed that reads 4 % high
      const Vector3d u(x.x(vel) - x.x(wind) - x.x(gust), x.x(vel + 1) - x.x(wind + 1) - x.x(gust + 1),
                       x.x(vel + 2));
      return 0.5 * 1.1 * std::pow(1.04 * (1 + x.x(tube_scale)) * u.norm(), 2) + x.x(tube_bias);
    };
    const auto side = [](const Nominal& x) {
      const Vector3d u(x.x(vel) - x.x(wind) - x.x(gust), x.x(vel + 1) - x.x(wind + 1) - x.x(gust + 1),
                       x.x(vel + 2));
      return (x.q_nb.conjugate() * u).y() - x.x(slip);
    };
    CHECK(tube_pressure(f, 150, 1.1, 1.04).innovation == doctest::Approx(150 - pressure(n)));
    check_row(tube_pressure(f, 150, 1.1, 1.04).H, differences(n, pressure), 1e-6, 0);
    const auto speed = [](const Nominal& x) { return x.through_air_n().norm() + x.x(model); };
    const double estimated = n.through_air_n().norm();
    CHECK(modelled_airspeed(f, 15 - estimated).innovation == doctest::Approx(15 - speed(n)));
    check_row(modelled_airspeed(f, 15 - estimated).H, differences(n, speed), 1e-6, 0);
    CHECK(coordinated(f).innovation == doctest::Approx(-side(n)));
    check_row(coordinated(f).H, differences(n, side), 1e-6, 0);
    for (int axis = 0; axis < 3; ++axis) {
      const auto velocity = [&](const Nominal& x) { return x.x(vel + axis); };
      const auto rate = [&](const Nominal& x) { return x.x(gyro_bias + axis); };
      CHECK(zero_velocity(f, axis).innovation == doctest::Approx(-velocity(n)));
      check_row(zero_velocity(f, axis).H, differences(n, velocity), 1e-6, 1e-6);
      CHECK(zero_rate(f, axis, 0.3).innovation == doctest::Approx(0.3 - rate(n)));
      check_row(zero_rate(f, axis, 0.3).H, differences(n, rate), 1e-6, 1e-6);
    }
  }
}

TEST_CASE("field: value and row with a magnetometer turned by 1 rad") {
  Random r(5);
  const Vector3d m_n = Vector3d(0.4, 0.05, 0.9).normalized();
  for (int trial = 0; trial < 5; ++trial) {
    Nominal n = any_state(r);
    n.x(mount) = 1;
    const Filter f = filter_at(n);
    for (int axis = 0; axis < 3; ++axis) {
      CAPTURE(axis);
      const auto read = [&](const Nominal& x) {
        const Matrix3d R_bs = Eigen::AngleAxisd(x.x(mount), Vector3d::UnitZ()).toRotationMatrix();
        const Vector3d m_s = R_bs.transpose() * (x.q_nb.conjugate() * m_n);
        return (1 + x.x(strength)) * m_s(axis) + x.x(iron + axis);
      };
      CHECK(field(f, m_n, axis, 0.2).innovation == doctest::Approx(0.2 - read(f.state())));
      check_row(field(f, m_n, axis, 0.2).H, differences(f.state(), read), 1e-6, 0);
    }
  }
}

TEST_CASE("filter: the transition of the covariance is that of the state, at any rate of the unit") {
  Random r(6);
  for (const double rate_hz : {100.0, 400.0}) {
    CAPTURE(rate_hz);
    Filter start;
    add_blocks(start);
    const int scale = start.append(0.1, 0), turn = start.append(0.1, 0, 0.7, gyro_scale);
    start.block(scale).drive = accel_scale;
    start.wind_shear = 0.002;
    start.reset(any_state(r), Eigen::Matrix<double, 15, 1>::Zero(), 100);
    start.correct(scale, 0.002);
    start.correct(turn, -0.003);
    start.forget(0, size, 0);
    Filter noise = start;
    fly(noise, 0.5, rate_hz);
    for (int i = 0; i < size; ++i) {
      CAPTURE(i);
      Filter f = start, up = start, down = start;
      f.forget(i, 1, 1);
      fly(f, 0.5, rate_hz);
      const Covariance moved = f.covariance() - noise.covariance();
      const Vector column = moved.col(i) / std::sqrt(moved(i, i));
      constexpr double step = 1e-5;
      Vector dx = Vector::Zero();
      dx(i) = step;
      up.restart(start.state().plus(dx), 100);
      down.restart(start.state().plus(-dx), 100);
      fly(up, 0.5, rate_hz);
      fly(down, 0.5, rate_hz);
      const Vector expected = up.state().minus(down.state()) / (2 * step);
      for (int first = 0; first < 9; first += 3) {
        CAPTURE(first);
        const Vector3d there = expected.segment<3>(first);
        CHECK((column.segment<3>(first) - there).norm() < 0.005 * there.norm() + 1e-7);
      }
      CHECK((column - expected).tail<size - 9>().norm() < 1e-7);
      if (i == turn) CHECK(expected.head<9>().norm() > 0.01);  // it does drive the motion
      if (i != scale) continue;
      // the integral of the force along x
      const double forward = 0.5 * (2 - start(accel_bias)) + (1 - std::cos(0.9 * 0.5)) / 0.9;
      CHECK(expected.segment<3>(vel).norm() == doctest::Approx(forward).epsilon(0.02));
    }
  }
}

TEST_CASE("filter: the state is that of an integration, and its past that of the corrected present") {
  Random r(7);
  for (int trial = 0; trial < 5; ++trial) {
    Filter f = filter_at(any_state(r));
    const Nominal start = f.state();
    fly(f, 1.5, 400);
    const Then then = back(f.state(), 1.5, 1.5);
    CHECK((then.v_n - start.v_n()).norm() < 2e-3);
    CHECK((then.p_n - start.p_n()).norm() < 2e-3);
    Vector dx = Vector::Zero();
    dx.head<15>() << 0.015, -0.01, 0.01, any(r, 1), any(r, 5), any(r, 0.01), any(r, 0.2);
    f.correct(dx);
    for (const double age : {0.0, 0.013, 0.2, 0.5}) {
      CAPTURE(age);
      const Then expected = back(f.state(), 1.5, age);
      CHECK((f.at(f.time_s() - age).v_n - expected.v_n).norm() < 0.02 * age + 1e-3);
      CHECK((f.at(f.time_s() - age).p_n - expected.p_n).norm() < 0.02 * age * age + 1e-3);
    }
    CHECK_FALSE(f.at(f.time_s() - 2).known);
    CHECK(f.at(f.time_s() + 1).known);
  }
}

}  // namespace second_filter_test
