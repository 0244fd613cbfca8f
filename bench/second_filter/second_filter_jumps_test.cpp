// SPDX-License-Identifier: BSD-3-Clause
// Hypotheses of a jump: their errors against differences of filters, their sizes against weighted least
// squares, and which of them count.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/second_filter/simulated_flight.hpp"

namespace second_filter_jumps_test {

using namespace fulmar;
using namespace fulmar::second_filter;
using fulmar::second_filter::Vector;
using simulated::filter_at;
using simulated::g;

namespace {

const Vector3d field_n = Vector3d(0.4, 0.05, 0.9).normalized();
constexpr std::size_t none = 99;

/// The hypothesis about these states.
std::size_t about(int first, bool ramp = false) {
  for (std::size_t i = 0; i < Jumps::count; ++i)
    if (may_jump[i].first == first && may_jump[i].ramp == ramp) return i;
  return none;
}
Row row_of(int state, double value = 1) {
  Row H = Row::Zero();
  H(state) = value;
  return H;
}
/// Without gain and prediction the error of a jump stays the jump.
void seen(Jumps& jumps, const Row& H, double r, int times = 1, double gate = 5) {
  for (int k = 0; k < times; ++k) jumps.fused(H, Vector::Zero(), r, 1, gate);
}

}  // namespace

TEST_CASE("jumps: the hypotheses, and that their columns follow each other") {
  CHECK(Jumps::columns == 22);
  CHECK(column(0) == 0);
  CHECK(column(1) == 2);
  CHECK(column(9) == 15);
  for (const int first : {+fix_pos, fix_pos + 2, +fix_vel, fix_vel + 2, +baro_bias, +tube_bias, theta + 2,
                          +gyro_bias, +accel_bias})
    CHECK(about(first) != none);
  CHECK(may_jump[about(accel_bias)].count == 3);
  for (const int first : {+fix_pos, +baro_bias, +tube_bias, +gyro_bias}) CHECK(about(first, true) != none);
}

TEST_CASE("jumps: errors are the difference of filters, sizes those of weighted least squares") {
  constexpr double dt = 0.01, seconds = 13;
  int judged = 0, several = 0;
  for (std::size_t i = 0; i < Jumps::count; ++i) {
    const MayJump& may = may_jump[i];
    CAPTURE(i);
    CAPTURE(may.first);
    const int n_states = may.count;
    Random r(40 + i);
    Nominal n;
    n.q_nb = quaternion_from({0.3, 0.1, 0.7});
    n.x.segment<3>(vel) << 15, 12, -1;
    n.x.segment<2>(wind) << 3, -2;
    // One without a jump, one for a jump of each state, and one for a jump of all in some direction.
    Filter without = filter_at(n);
    std::vector<Filter> with;
    Jumps jumps(100);
    const double jump = 1e-3 * may.least;
    const Vector3d direction =
        n_states == 1 ? Vector3d(-1, 0, 0) : Vector3d(2, -1.5, n_states == 3 ? 1 : 0);  // any
    const auto moves = [&](int filter, int state) {
      return filter < n_states ? (filter == state ? 1.0 : 0.0) : direction(state);
    };
    Matrix3d information = Matrix3d::Zero();
    Vector3d weighted = Vector3d::Zero();
    double evidence = 0, concentrated = 0;
    Vector decay = Vector::Ones();
    decay.segment<2>(gust).setConstant(std::exp(-dt / 15));
    decay.segment<3>(fix_pos).setConstant(std::exp(-dt / 150));
    decay.segment<3>(fix_vel).setConstant(std::exp(-dt / 2));
    const auto correct_all = [&](double share) {
      for (int w = 0; w <= n_states; ++w)
        for (int s = 0; s < n_states; ++s)
          with[static_cast<std::size_t>(w)].correct(may.first + s, -share * jump * moves(w, s));
    };
    for (int k = -500; k < seconds / dt; ++k) {
      if (k == 0) {
        jumps.begin(0);
        with.assign(static_cast<std::size_t>(n_states + 1), without);
        if (!may.ramp) correct_all(1);
      }
      const Vector3d rate(0.2 * std::cos(k * dt), 0.1, 0.1), force(2 * std::sin(k * dt), 0.5, -12);
      const Vector3d v_before = without.state().v_n();
      const Matrix3d R_before = without.R_nb();
      without.predict(rate, force, dt);
      for (Filter& f : with) f.predict(rate, force, dt);
      const Matrix3d B = 0.5 * dt * (R_before + without.R_nb());
      const Matrix3d D = -skew(without.state().v_n() - v_before - Vector3d(0, 0, g * dt));
      jumps.predicted(B, D, -0.5 * D * B, dt, decay);
      if (may.ramp && k >= 0) correct_all(dt / 10);
      if (k % 10) continue;
      // The filter without a jump expects each measurement exactly: to the others it shows their jump. Some
      // noise beside it makes the sizes differ from the jump.
      const auto fuse = [&](const auto& row, double variance) {
        Scalar z = row(without, 0.0);
        const double measured = -z.innovation;
        const double S = std::pow(without.expected_std(z, variance), 2);
        const Vector K = without.covariance() * z.H.transpose() / S;
        z.innovation = 0;
        without.fuse(z, variance, 5, Vector::Ones());
        if (k < 0) return jumps.fused(z.H, K, 0, S, 5);
        Vector3d e = Vector3d::Zero();
        for (int w = 0; w < n_states; ++w) {
          const Scalar one = row(with[static_cast<std::size_t>(w)], measured);
          e(w) = one.innovation / jump;
          with[static_cast<std::size_t>(w)].fuse(one, variance, 5, Vector::Ones());
        }
        const Scalar all = row(with.back(), measured);
        with.back().fuse(all, variance, 5, Vector::Ones());
        const double innovation = all.innovation + 0.1 * jump * std::sqrt(e.squaredNorm()) * r.normal();
        jumps.fused(z.H, K, innovation, S, 5);
        information += e * e.transpose() / S;
        weighted += e * innovation / S;
        const double one = e.norm() * std::abs(innovation) / S;
        evidence += one;
        concentrated += one * one;
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
      fuse([](const Filter& f, double m) { return tube_pressure(f, m, 1.2, 1); }, 25);
    }
    Eigen::Matrix<double, size, 3> errors = Eigen::Matrix<double, size, 3>::Zero();
    for (int w = 0; w < n_states; ++w)
      errors.col(w) = without.state().minus(with[static_cast<std::size_t>(w)].state()) / jump;
    // A jump of 100 times the least that counts is one standard deviation before the measurements.
    const Matrix3d variance = (information + Matrix3d::Identity() / std::pow(100 * may.least, 2)).inverse();
    const Vector3d sizes = variance * weighted;
    CHECK((sizes - jump * direction).norm() < 0.2 * jump * direction.norm());
    CHECK(jumps.size_of(i) == doctest::Approx(n_states == 1 ? sizes(0) : sizes.norm()).epsilon(0.01));
    const Vector change = errors * sizes;
    const Covariance spread = errors * variance * errors.transpose();
    for (int first = 0; first < size; first += first < wind ? 3 : 1) {
      CAPTURE(first);
      const int count = first < wind ? 3 : 1;
      const double there = change.segment(first, count).norm();
      CHECK((jumps.change(i).segment(first, count) - change.segment(first, count)).norm() <
            0.03 * there + 1e-4 * jump);
      const double trace = spread.block(first, first, count, count).trace();
      CHECK(std::abs(jumps.spread(i).block(first, first, count, count).trace() - trace) <=
            0.03 * trace + 1e-9 * variance.trace());
    }
    CHECK((jumps.spread(i) - spread).norm() < 0.03 * spread.norm());
    if (may.after_s > 0) CHECK(jumps.ratio(may.after_s - 0.01, true)[i] == 0);
    const double ratio = may.doubt * jumps.ratio(seconds, true)[i];
    if (evidence * evidence < 8 * concentrated) {  // a few samples carry it
      CHECK(ratio == 0);
      continue;
    }
    ++judged;
    several += n_states > 1;
    CHECK(ratio / weighted.dot(sizes) == doctest::Approx(1).epsilon(0.02));
    CHECK((jumps.ratio(seconds, false)[i] == 0) == (may.first == gyro_bias || may.first == accel_bias));
  }
  CHECK(judged >= 10);
  CHECK(several >= 4);
}

TEST_CASE("jumps: sizes in white noise have the variance that is reported") {
  Random r(12);
  double squares = 0, most = 0;
  const std::size_t baro = about(baro_bias);
  for (int window = 0; window < 200; ++window) {
    Jumps jumps(2);
    for (int k = 0; k < 40; ++k) jumps.fused(row_of(baro_bias), Vector::Zero(), 3 * r.normal(), 9, 5);
    const double variance = jumps.spread(baro)(baro_bias, baro_bias);
    CHECK(variance == doctest::Approx(9 / 40.0).epsilon(1e-4));
    squares += jumps.size_of(baro) * jumps.size_of(baro) / variance / 200;
    const Jumps::PerJump ratio = jumps.ratio(2, true);
    most = std::max(most, *std::max_element(ratio.begin(), ratio.end()));
  }
  CHECK(squares == doctest::Approx(1).epsilon(0.25));
  CHECK(most > 3);
  CHECK(most < 20);  // chi-squared of one degree of freedom
}

TEST_CASE("jumps: of three states, the ratio is over the weighted mean square of what they leave") {
  const std::size_t accel = about(accel_bias);
  for (const double noise : {0.5, 1.4}) {
    CAPTURE(noise);
    Random r(41);
    Jumps jumps(10);
    const Vector3d truth(1.2, -0.7, 0.5);
    struct Sample {
      Vector3d e;
      double r, trust;
    };
    std::vector<Sample> samples;
    Matrix3d information = Matrix3d::Zero();
    Vector3d weighted = Vector3d::Zero();
    int beyond = 0;
    for (int k = 0; k < 200; ++k) {
      const Vector3d e(r.normal(), 0.5 * r.normal(), 1 + r.normal());
      const double of_r = e.dot(truth) + noise * r.normal(), trust = std::min(4 / std::abs(of_r), 1.0);
      beyond += trust < 1;
      Row H = Row::Zero();
      H.segment<3>(accel_bias) = 2 * e.transpose();
      jumps.fused(H, Vector::Zero(), 2 * of_r, 4, 4);
      samples.push_back({e, of_r, trust});
      information += trust * e * e.transpose();
      weighted += trust * of_r * e;
    }
    information += Matrix3d::Identity() / std::pow(100 * 0.15, 2);
    const Vector3d sizes = information.inverse() * weighted;
    double left = 0, weights = 0;
    for (const Sample& s : samples) {
      left += s.trust * s.trust * s.e.squaredNorm() * std::pow(s.r - s.e.dot(sizes), 2);
      weights += s.trust * s.trust * s.e.squaredNorm();
    }
    CHECK(beyond >= 3);
    CHECK((jumps.change(accel).segment<3>(accel_bias) - sizes).norm() < 1e-9);
    CHECK(jumps.size_of(accel) == doctest::Approx(sizes.norm()));
    CHECK(jumps.ratio(2, true)[accel] ==
          doctest::Approx(weighted.dot(sizes) / std::max(left / weights, 1.0)));
    CHECK(jumps.ratio(2, false)[accel] == 0);
    CHECK((left > weights) == (noise > 1));
  }
}

TEST_CASE("jumps: a hypothesis that leaves a mean square above 4 is none") {
  const std::size_t baro = about(baro_bias);
  for (const double off : {0.5, 1.9, 1.99, 2.01, 2.1}) {
    CAPTURE(off);
    Jumps jumps(10);
    for (int k = 0; k < 40; ++k) seen(jumps, row_of(baro_bias), 3 + (k % 2 ? off : -off), 1, 6);
    const double expected = off > 2 ? 0 : 40 * 9 / std::max(off * off, 1.0);
    CHECK(jumps.ratio(2, true)[baro] == doctest::Approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("jumps: a few samples that carry the evidence are no jump, whatever the others could have shown") {
  const std::size_t baro = about(baro_bias);
  for (const int odd : {6, 7, 9, 12}) {
    CAPTURE(odd);
    Jumps jumps(10);
    seen(jumps, row_of(baro_bias), 3, odd);
    seen(jumps, row_of(baro_bias), 0, 100);
    CHECK((jumps.ratio(2, true)[baro] > 0) == (odd > 8));
  }
}

TEST_CASE("jumps: one that explains less than half of what is odd is none; a receiver is one sensor") {
  const std::size_t baro = about(baro_bias), position = about(fix_pos), velocity = about(fix_vel);
  for (const int others : {35, 45}) {
    CAPTURE(others);
    Jumps jumps(10);
    seen(jumps, row_of(baro_bias), 4, 40);
    seen(jumps, row_of(wind), 4, others);  // no hypothesis
    CHECK((jumps.ratio(20, true)[baro] > 0) == (others < 40));
    CHECK(jumps.ratio(20, true)[position] == 0);
  }
  for (const bool with_velocity : {false, true}) {
    CAPTURE(with_velocity);
    Jumps jumps(10);
    seen(jumps, row_of(fix_pos), 4, 40);
    seen(jumps, row_of(with_velocity ? fix_vel : wind), 4, 30);
    seen(jumps, row_of(wind), 4, 30);
    CHECK((jumps.ratio(20, true)[position] > 0) == with_velocity);
    CHECK((jumps.ratio(20, true)[velocity] > 0) == with_velocity);
  }
}

TEST_CASE("jumps: a drift is not explained by a jump of the same sensor") {
  for (const int others : {35, 45}) {
    CAPTURE(others);
    Jumps jumps(30);
    const Matrix3d no = Matrix3d::Zero();
    jumps.predicted(no, no, no, 10, Vector::Ones());  // the drift has come to as much as the jump
    seen(jumps, row_of(baro_bias), 4, 40);
    seen(jumps, row_of(wind), 4, others);
    CHECK(jumps.size_of(about(baro_bias, true)) == doctest::Approx(4).epsilon(1e-3));
    CHECK((jumps.ratio(20, true)[about(baro_bias)] > 0) == (others < 40));
    CHECK((jumps.ratio(20, true)[about(baro_bias, true)] > 0) == (others < 40));
  }
}

TEST_CASE("jumps: a pitot needs three times the evidence, and each hypothesis its time in the window") {
  Jumps jumps(10);
  seen(jumps, row_of(tube_bias), 4, 40);
  CHECK(jumps.ratio(0, true)[about(tube_bias)] == doctest::Approx(40 * 16 / 3.0).epsilon(1e-3));
  for (const auto& [state, after_s] : {std::pair{theta + 2, 3.0}, {+gyro_bias, 6.0}, {+accel_bias, 1.0}}) {
    CAPTURE(state);
    Jumps other(10);
    other.begin(100);
    seen(other, row_of(state), 4, 40);
    CHECK(other.ratio(100 + after_s - 0.01, true)[about(state)] == 0);
    CHECK(other.ratio(100 + after_s + 0.01, true)[about(state)] > 100);
    CHECK_FALSE(other.over(109.9));
    CHECK(other.over(110.1));
  }
}

}  // namespace second_filter_jumps_test
