// SPDX-License-Identifier: BSD-3-Clause
// Jumps and drifts of slow errors: each hypothesis against the difference of two filters, and flights whose
// errors are known.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bench/second_filter/measurements.hpp"
#include "fulmar/random.hpp"

namespace second_filter_faults_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using fulmar::second_filter::Vector;

namespace {

constexpr double g = 9.80665;
const Vector3d field_n = Vector3d(0.4, 0.05, 0.9).normalized();

Vector3d normal(Random& r) { return {r.normal(), r.normal(), r.normal()}; }
/// Errors of the slow states are small, as after some minutes of flight.
Filter filter_at(const Nominal& n) {
  Filter f;
  for (const Block& b : {Block{.first = wind, .count = 2, .std = 0.5, .walk = 0.01},
                         {.first = gust, .count = 2, .std = 0.5, .time_s = 15},
                         {.first = fix_pos, .count = 3, .std = 2, .time_s = 150},
                         {.first = fix_vel, .count = 3, .std = 0.1, .time_s = 2},
                         {.first = baro_bias, .count = 1, .std = 1, .walk = 0.06},
                         {.first = tube_scale, .count = 1, .std = 0.01}})
    f.add_block(b);
  Eigen::Matrix<double, 15, 1> std;
  std << Vector3d::Constant(0.01), Vector3d::Constant(0.2), Vector3d::Constant(1), Vector3d::Constant(1e-3),
      Vector3d::Constant(0.02);
  f.reset(n, std, 0);
  return f;
}

/// A flight at 10 Hz, straight and level, whose errors are those of the model of the filter.
struct Flight {
  Random r;
  Nominal truth;
  Filter f;
  double outlier_m = 0;  ///< of the next barometer sample

  explicit Flight(std::uint64_t seed) : r(seed) {
    truth.x.segment<3>(vel) << 20, 0, 0;
    f = filter_at(truth);
    Vector dx;
    for (int i = 0; i < size; ++i) dx(i) = f.std(i) * r.normal();
    truth.x.tail<size - wind>() = dx.tail<size - wind>();
    dx.tail<size - wind>().setZero();
    f.restart(truth.plus(dx), 0);
    for (int i = wind; i < size; ++i) f.correct(i, -truth.x(i));
  }
  void step() {
    constexpr double dt = 0.1, baro_std = 0.3, pitot_std = 0.2, fix_std = 0.1, place_std = 0.6;
    f.predict(f.unit.gyro / std::sqrt(dt) * normal(r),
              Vector3d(0, 0, -g) + f.unit.accel / std::sqrt(dt) * normal(r), dt);
    truth.x(pos) += 20 * dt;
    for (const auto& [first, count, std, time_s] :
         {std::tuple{+gust, 2, 0.5, 15.0}, {+fix_pos, 3, 2.0, 150.0}, {+fix_vel, 3, 0.1, 2.0}})
      for (int i = first; i < first + count; ++i) {
        const double keep = std::exp(-dt / time_s);
        truth.x(i) = keep * truth.x(i) + std * std::sqrt(1 - keep * keep) * r.normal();
      }
    for (int i = 0; i < 2; ++i) truth.x(wind + i) += 0.01 * std::sqrt(dt) * r.normal();
    truth.x(baro_bias) += 0.06 * std::sqrt(dt) * r.normal();
    const auto fuse = [&](const Scalar& z, double std) { f.fuse(z, std * std, 5, Vector::Ones()); };
    const double height = -truth.x(pos + 2) + truth.x(baro_bias) + baro_std * r.normal() + outlier_m;
    fuse(baro_height(f, standard_air(height).pressure_pa, 0, true), baro_std);
    outlier_m = 0;
    fuse(tube_airspeed(f, (1 + truth.x(tube_scale)) * truth.through_air_n().norm() + truth.x(tube_bias) +
                              pitot_std * r.normal()),
         pitot_std);
    for (int i = 0; i < 3; ++i) {
      const Past now = f.at(f.time_s());
      fuse(fix_velocity(f, now, i, truth.x(vel + i) + truth.x(fix_vel + i) + fix_std * r.normal(), 0),
           fix_std);
      fuse(fix_position(f, now, i, truth.x(pos + i) + truth.x(fix_pos + i) + place_std * r.normal()),
           place_std);
    }
  }
  Fault fly(double seconds, double drift_per_s = 0, double least = 60) {
    for (int k = 0; k < std::lround(10 * seconds); ++k) {
      truth.x(baro_bias) += 0.1 * drift_per_s;
      step();
      const Fault fault = f.find_fault(least);
      if (fault.state >= 0) return fault;
    }
    return {};
  }
};

}  // namespace

TEST_CASE("faults: the error of each hypothesis is the difference of two filters, its size what was put in") {
  constexpr double dt = 0.01, seconds = 13;
  int judged = 0;
  for (int i = 0; i < Jumps::count; ++i) {
    const MayJump& may = may_jump[static_cast<std::size_t>(i)];
    CAPTURE(i);
    CAPTURE(may.state);
    Nominal n;
    n.q_nb = quaternion_from({0.3, 0.1, 0.7});
    n.x.segment<3>(vel) << 15, 12, -1;
    n.x.segment<2>(wind) << 3, -2;
    Filter without = filter_at(n), with = without;  // jump
    Jumps jumps(100);
    const double jump = 1e-3 * may.least;
    double information = 0, concentrated = 0;
    Vector decay = Vector::Ones();
    decay.segment<2>(gust).setConstant(std::exp(-dt / 15));
    decay.segment<3>(fix_pos).setConstant(std::exp(-dt / 150));
    decay.segment<3>(fix_vel).setConstant(std::exp(-dt / 2));
    for (int k = -500; k < seconds / dt; ++k) {
      if (k == 0) {
        jumps.begin(0);
        with = without;
        if (!may.ramp) with.correct(may.state, -jump);
      }
      const Vector3d rate(0.2 * std::cos(k * dt), 0.1, 0.1), force(2 * std::sin(k * dt), 0.5, -12);
      const Vector3d v_before = without.state().v_n();
      const Matrix3d R_before = without.R_nb();
      without.predict(rate, force, dt);
      with.predict(rate, force, dt);
      const Matrix3d B = 0.5 * dt * (R_before + without.R_nb());
      const Matrix3d D = -skew(without.state().v_n() - v_before - Vector3d(0, 0, g * dt));
      jumps.predicted(B, D, -0.5 * D * B, dt, decay);
      if (may.ramp && k >= 0) with.correct(may.state, -jump * dt / 10);
      if (k % 10) continue;
      const auto fuse = [&](const auto& row, double variance) {
        Scalar z = row(without, 0.0);
        const double measured = -z.innovation;  // as without the jump expected
        const double S = std::pow(without.expected_std(z, variance), 2);
        const Vector K = without.covariance() * z.H.transpose() / S;
        const Scalar jumped = row(with, measured);
        jumps.fused(z.H, K, jumped.innovation, S, 5);
        const double weight = k < 0 ? 0 : std::pow(jumped.innovation / jump, 2) / S;
        information += weight;
        concentrated += weight * weight;
        z.innovation = 0;
        without.fuse(z, variance, 5, Vector::Ones());
        with.fuse(jumped, variance, 5, Vector::Ones());
      };
      for (int axis = 0; axis < 3; ++axis) {
        fuse([&](const Filter& f, double m) { return fix_velocity(f, f.at(f.time_s()), axis, m, 0); }, 0.01);
        fuse([&](const Filter& f, double m) { return fix_position(f, f.at(f.time_s()), axis, m); }, 0.4);
        fuse([&](const Filter& f, double m) { return field(f, field_n, axis, m); }, 0.0016);
      }
      const auto height = [](const Filter& f, double m) {
        Scalar z = baro_height(f, isa::sea_level_pressure, 0, true);
        z.innovation += m;
        return z;
      };
      fuse(height, 0.1);
      fuse([](const Filter& f, double m) { return tube_airspeed(f, m); }, 0.04);
    }
    const Vector error = without.state().minus(with.state()) / jump;
    for (int first = 0; first < size; first += first < wind ? 3 : 1) {
      CAPTURE(first);
      const int count = first < wind ? 3 : 1;
      const auto there = error.segment(first, count);
      CHECK((jumps.error(i).segment(first, count) - there).norm() < 0.02 * there.norm() + 1e-4);
    }
    CHECK(jumps.size_of(i) / jump == doctest::Approx(1).epsilon(0.005));
    Jumps::PerJump ratio = jumps.ratio(seconds, true);
    for (int k = 0; k < Jumps::count; ++k) ratio(k) *= may_jump[static_cast<std::size_t>(k)].doubt;
    CHECK(jumps.variance_of(i) * information == doctest::Approx(1).epsilon(0.01));
    if (may.after_s > 0) CHECK(jumps.ratio(may.after_s - 0.01, true)(i) == 0);
    if (information * information < 8 * concentrated) {  // a few samples carry it
      CHECK(ratio(i) == 0);
      continue;
    }
    ++judged;
    CHECK(ratio.maxCoeff() / ratio(i) == doctest::Approx(1).epsilon(1e-3));
    CHECK(ratio(i) / (jump * jump * information) == doctest::Approx(1).epsilon(0.01));
    CHECK((jumps.ratio(seconds, false)(i) == 0) == (may.state >= gyro_bias && may.state < wind));
  }
  CHECK(judged > 12);
}

TEST_CASE("faults: sizes in white noise have the variance that is reported") {
  Random r(12);
  double squares = 0, most = 0;
  Row H = Row::Zero();
  H(baro_bias) = 1;
  const int baro = 6;
  REQUIRE(may_jump[baro].state == baro_bias);
  for (int window = 0; window < 200; ++window) {
    Jumps jumps(2);
    for (int k = 0; k < 40; ++k) jumps.fused(H, Vector::Zero(), 3 * r.normal(), 9, 5);
    CHECK(jumps.variance_of(baro) == doctest::Approx(9 / 40.0));
    squares += jumps.size_of(baro) * jumps.size_of(baro) / jumps.variance_of(baro) / 200;
    most = std::max(most, jumps.ratio(2, true).maxCoeff());
  }
  CHECK(squares == doctest::Approx(1).epsilon(0.25));
  CHECK(most > 3);
  CHECK(most < 20);  // chi-squared of one degree of freedom
}

TEST_CASE("faults: white noise alone is no fault in 200 windows of 8 s") {
  Flight flight(13);
  CHECK(flight.fly(1600, 0, 25).state == -1);
}

TEST_CASE("faults: a jump is found with its state, sign and size, and the estimate follows it") {
  for (const auto& [state, size] : {std::pair{+baro_bias, 6.0},
                                    {+baro_bias, -8.0},
                                    {fix_pos + 1, 12.0},
                                    {+fix_pos, -12.0},
                                    {+fix_vel, 3.0},
                                    {fix_vel + 1, -3.0},
                                    {+tube_bias, -5.0}}) {
    CAPTURE(state);
    CAPTURE(size);
    Flight flight(14);
    REQUIRE(flight.fly(20).state == -1);
    flight.f.begin_jumps();
    flight.truth.x(state) += size;
    const Fault fault = flight.fly(8);
    CHECK(fault.state == state);
    CHECK(fault.size == doctest::Approx(size).epsilon(0.2));
    CHECK(fault.ratio > 60);
    CHECK(std::abs(flight.f(state) - flight.truth.x(state)) < 4 * flight.f.std(state));
    CHECK(std::abs(flight.f(state) - flight.truth.x(state)) < 0.25 * std::abs(size));
    CHECK(flight.f.std(state) > 0.25 * std::abs(size));  // and it may be off
    CHECK(std::abs(flight.f(pos + 2) - flight.truth.x(pos + 2)) < 3);
    CHECK(flight.fly(40).state == -1);  // once
  }
}

TEST_CASE("faults: the covariance grows by the variance of the size, and a short window needs more") {
  Flight flight(20);
  REQUIRE(flight.fly(20).state == -1);
  flight.f.begin_jumps();
  flight.truth.x(baro_bias) += 6;
  for (int k = 0; k < 30; ++k) flight.step();
  const Filter before = flight.f;
  const Fault fault = flight.f.find_fault(10);
  REQUIRE(fault.state == baro_bias);
  Covariance grown = flight.f.covariance() - before.covariance();
  grown(baro_bias, baro_bias) -= std::pow(0.3 * fault.size, 2);
  const double moved = flight.f(baro_bias) - before(baro_bias);
  CHECK(grown(baro_bias, baro_bias) / (moved * moved / fault.ratio) == doctest::Approx(1).epsilon(0.3));
  const Eigen::SelfAdjointEigenSolver<Covariance> solver(grown, Eigen::EigenvaluesOnly);
  CHECK(solver.eigenvalues().minCoeff() > -1e-9);
  Filter more = before, less = before;  // the longest window: 40 s
  CHECK(more.find_fault(fault.ratio / 1.15).state == -1);
  CHECK(less.find_fault(fault.ratio / 1.25).state == baro_bias);
}

TEST_CASE("faults: a position that jumps along all axes is found, axis by axis") {
  Flight flight(19);
  REQUIRE(flight.fly(20).state == -1);
  flight.f.begin_jumps();
  flight.truth.x.segment<3>(fix_pos) += Vector3d(12, -12, 12);
  for (int k = 0; k < 3; ++k) {
    const Fault fault = flight.fly(8);
    CHECK(fault.state >= fix_pos);
    CHECK(fault.state < fix_pos + 3);
  }
  for (int i = fix_pos; i < fix_pos + 3; ++i) CHECK(std::abs(flight.f(i) - flight.truth.x(i)) < 4);
}

TEST_CASE("faults: a drift is found with its state, sign and size per 10 s") {
  for (const double per_s : {0.4, -0.4}) {
    CAPTURE(per_s);
    Flight flight(15);
    REQUIRE(flight.fly(20).state == -1);
    flight.f.begin_jumps();
    const Fault fault = flight.fly(40, per_s);
    CHECK(fault.state == baro_bias);
    CHECK(fault.size == doctest::Approx(10 * per_s).epsilon(0.2));
    CHECK(std::abs(flight.f(baro_bias) - flight.truth.x(baro_bias)) < 1);
  }
}

TEST_CASE("faults: a few outliers are no jump, and do not hide one") {
  for (const double outlier_m : {5.0, 60.0, 3000.0}) {
    CAPTURE(outlier_m);
    Flight flight(16);
    REQUIRE(flight.fly(20).state == -1);
    for (int k = 0; k < 4; ++k) {
      flight.outlier_m = outlier_m;
      CHECK(flight.fly(0.5).state == -1);
    }
    CHECK(flight.fly(10).state == -1);
    flight.f.begin_jumps();
    flight.truth.x(baro_bias) += 8;
    flight.outlier_m = outlier_m;
    CHECK(flight.fly(8).state == baro_bias);
  }
}

TEST_CASE("faults: a window that is over is judged before the next one begins") {
  Flight flight(17);
  REQUIRE(flight.fly(20).state == -1);
  flight.f.begin_jumps();
  flight.truth.x(baro_bias) += 8;
  for (int k = 0; k < 401; ++k) flight.step();
  CHECK(flight.f.find_fault(60).state == baro_bias);
}

}  // namespace second_filter_faults_test
