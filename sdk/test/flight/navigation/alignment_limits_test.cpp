// SPDX-License-Identifier: BSD-3-Clause
// Parts of the alignment: rest on both sides of each threshold, tilted attitudes, windows that are too short,
// too long or without a direction, the drift of the field. Each is tested twice, since the second run must
// equal the first.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/navigation/alignment.hpp>
#include <fulmar/flight/navigation/consistency.hpp>
#include <fulmar/flight/navigation/gusts.hpp>

namespace alignment_limits_test {

using namespace fulmar;
using namespace fulmar::navigation;

namespace {

constexpr double g = isa::g0;
const Vector3d axes[3] = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};

/// A unit at rest with arbitrary readings.
struct Unit {
  Stillness still{};
  Vector3d omega{0.3, -0.2, 0.1}, f{-2, 3, -9};
  int n = 0;
  void samples(int count, const Vector3d& rate_swing, const Vector3d& force_swing, double dt = 0.005) {
    for (int k = 0; k < count; ++k, ++n)
      still.update(omega + (n % 2 ? 1 : -1) * rate_swing, f + (n % 2 ? 1 : -1) * force_swing, dt);
  }
  void quiet(int count, double dt = 0.005) { samples(count, Vector3d::Zero(), Vector3d::Zero(), dt); }
};

/// Constant acceleration and rate in any attitude.
struct Motion {
  Quaterniond begin{Eigen::AngleAxisd(0.6, Vector3d(1, -2, 3).normalized())};
  Vector3d rate{0.3, -0.2, 0.4}, a{3, -2, 1}, v0{15, 6, -1};
  Quaterniond attitude(double t) const { return begin * exp_map(rate * t); }
  void feel(FlightAlignment& alignment, double from, int n, double dt = 0.005) const {
    for (int k = 0; k < n; ++k) {
      const double t = from + (k + 0.5) * dt;
      alignment.imu(rate, attitude(t).conjugate() * (a - Vector3d(0, 0, g)), dt);
    }
  }
};
double angle(const Quaterniond& a, const Quaterniond& b) { return a.angularDistance(b); }
const Vector3d field(2.1e-5, 6e-6, 4.2e-5);

}  // namespace

TEST_CASE("a unit rests at any reading, and returns the mean of its last second") {
  Unit u;
  u.quiet(199);
  CHECK_FALSE(u.still.still());
  u.quiet(1);
  CHECK(u.still.still());
  Unit steps;
  for (int block = 0; block < 6; ++block) {
    steps.quiet(50);
    CHECK(steps.still.still() == (block >= 3));
    if (block == 5) break;
    steps.omega += Vector3d(0.005, -0.01, 0.015);
    steps.f += Vector3d(0.1, -0.2, 0.05);
  }
  CHECK((steps.still.omega() - (steps.omega - 1.5 * Vector3d(0.005, -0.01, 0.015))).norm() < 1e-9);
  CHECK((steps.still.f() - (steps.f - 1.5 * Vector3d(0.1, -0.2, 0.05))).norm() < 1e-9);
}

TEST_CASE("noise and steps of the means beyond a limit are no rest, on any axis, either way") {
  for (const Vector3d& axis : axes)
    for (const double side : {1.0, -1.0}) {
      const auto still = [&](double gyro_noise, double accel_noise, double gyro_step, double accel_step) {
        Unit u;
        for (int block = 0; block < 6; ++block) {
          u.samples(50, gyro_noise * axis, accel_noise * axis);
          u.omega += side * gyro_step * axis;
          u.f += side * accel_step * axis;
        }
        return u.still.still();
      };
      CHECK(still(0.029, 0.58, 0, 0));
      CHECK_FALSE(still(0.031, 0, 0, 0));
      CHECK_FALSE(still(0, 0.62, 0, 0));
      CHECK(still(0, 0, 0.019, 0.24));
      CHECK_FALSE(still(0, 0, 0.021, 0));
      CHECK_FALSE(still(0, 0, 0, 0.26));
    }
}

TEST_CASE("a jump of the rate or the force ends the rest with its sample, and rest begins again") {
  for (const Vector3d& axis : axes)
    for (const double side : {1.0, -1.0}) {
      const auto after = [&](double rate, double force) {
        Unit u;
        u.quiet(240);
        REQUIRE(u.still.still());
        u.still.update(u.omega + side * rate * axis, u.f + side * force * axis, 0.005);
        const bool still = u.still.still();
        u.quiet(450);
        CHECK(u.still.still());
        return still;
      };
      CHECK(after(0.49, 2.9));
      CHECK_FALSE(after(0.51, 0));
      CHECK_FALSE(after(0, 3.1));
    }
}

TEST_CASE("a block has eight samples at least, and none are further apart than a tenth of a second") {
  Unit slow;
  slow.quiet(31, 0.05);
  CHECK_FALSE(slow.still.still());
  slow.quiet(1, 0.05);
  CHECK(slow.still.still());
  for (const double gap_s : {0.099, 0.101}) {
    Unit u;
    u.quiet(240);
    u.quiet(1, gap_s);
    CHECK(u.still.still() == (gap_s < 0.1));
  }
}

TEST_CASE(
    "at rest the field tells the yaw in any tilt, whatever its dip, and without it the nose points north") {
  for (const double dip_share : {1.0, -0.5, 3.0})
    for (const double declination : {0.2, -0.3}) {
      const Quaterniond q = quaternion_from({0.4, -0.3, 2.1});
      const Vector3d north(std::cos(declination), std::sin(declination), dip_share);
      const Quaterniond found =
          attitude_at_rest(q.conjugate() * Vector3d(0, 0, -g), 3e-5 * (q.conjugate() * north), declination);
      CHECK(angle(found, q) < 1e-9);
    }
  const Euler tilt =
      euler_from(attitude_at_rest(quaternion_from({0.4, -0.3, 0}).conjugate() * Vector3d(0, 0, -g)));
  CHECK(tilt.roll_rad == doctest::Approx(0.4));
  CHECK(tilt.pitch_rad == doctest::Approx(-0.3));
  CHECK(std::abs(tilt.yaw_rad) < 1e-6);
  for (const double up : {1.0, -1.0}) {  // on its tail, on its nose
    const Quaterniond found = attitude_at_rest(Vector3d(up * g, 0, 0));
    CHECK((found * Vector3d(up, 0, 0) - Vector3d(0, 0, -1)).norm() < 1e-9);
  }
}

TEST_CASE("an attitude in flight, its acceleration and the way since are those of a constant acceleration") {
  const Motion m;
  for (const double late_s : {0.0, 0.15}) {
    CAPTURE(late_s);
    FlightAlignment alignment;
    const FlightAlignment::Known known{g, &field, nullptr, late_s};
    m.feel(alignment, 0, 60);  // earlier samples do not count
    alignment.mag(m.attitude(0.3).conjugate() * field);
    CHECK_FALSE(alignment.fix(m.v0 + (0.3 - late_s) * m.a, known));
    for (int k = 0; k < 10; ++k) {
      m.feel(alignment, 0.3 + 0.1 * k, 20);
      alignment.mag(m.attitude(0.4 + 0.1 * k).conjugate() * field);
    }
    const auto found = alignment.fix(m.v0 + (1.3 - late_s) * m.a, known);
    REQUIRE(found);
    CHECK(angle(found->q_nb, m.attitude(1.3)) < 2e-3);
    CHECK(angle(found->then_nb, m.attitude(1.3 - late_s)) < 2e-3);
    CHECK((found->f_n - (m.a - Vector3d(0, 0, g))).norm() < 1e-9);
    CHECK((found->a_n - m.a).norm() < 0.05);
    CHECK(found->jerk_n.norm() < 0.05);
    CHECK((found->since_n - late_s * m.a).norm() < 0.01);
    CHECK((found->second_n - field).norm() < 1e-12);
    CHECK(found->by_field);
    CHECK(found->window_s == doctest::Approx(1));
    CHECK(found->unseen_s == 0);
  }
}

TEST_CASE("an alignment that begins again after a gap finds what a fresh one finds, to the last bit") {
  const Motion m;
  const FlightAlignment::Known known{g, &field, nullptr, 0.1};
  const auto fly = [&](FlightAlignment& alignment) {
    (void)alignment.fix(m.v0, known);
    for (int k = 0; k < 8; ++k) {
      m.feel(alignment, 0.1 * k, 20);
      alignment.mag(m.attitude(0.1 * k + 0.1).conjugate() * field);
    }
    return alignment.fix(m.v0 + 0.8 * m.a, known);
  };
  FlightAlignment fresh, again;
  Motion other;
  other.rate = {-0.5, 0.1, 0.2};
  other.a = {-1, 4, 2};
  other.feel(again, 0, 201, 0.0037);
  again.mag({1e-5, 2e-5, -3e-5});
  again.mag({1e-5, 3e-5, -3e-5});
  (void)again.fix({20, 1, 2}, known);
  other.feel(again, 0.8, 60);
  again.imu({1, 1, 1}, {2, 2, 2}, 0.2);
  const auto a = fly(fresh), b = fly(again);
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a->q_nb.coeffs() == b->q_nb.coeffs());
  CHECK(a->a_n == b->a_n);
  CHECK(a->since_n == b->since_n);
  CHECK(a->window_s == b->window_s);
  CHECK(fresh.drift().bias(0.1, 0.05).bias_b == again.drift().bias(0.1, 0.05).bias_b);
  CHECK(fresh.drift().bias(0.1, 0.05).covariance == again.drift().bias(0.1, 0.05).covariance);
}

TEST_CASE("a window lasts from 0.45 to 2.2 s, and each begins with the fix that ended or spoiled the last") {
  const Motion m;
  const FlightAlignment::Known known{g, nullptr, nullptr, 0};
  const auto found = [&](double after_s) {
    FlightAlignment alignment;
    (void)alignment.fix(m.v0, known);
    const int n = static_cast<int>(std::lround(after_s / 0.005));
    m.feel(alignment, 0, n);
    return alignment.fix(m.v0 + after_s * m.a, known);
  };
  CHECK_FALSE(found(0.44));
  CHECK(found(0.46));
  CHECK(found(2.19));
  CHECK_FALSE(found(2.21));
  FlightAlignment alignment;
  (void)alignment.fix(m.v0, known);
  m.feel(alignment, 0, 60);
  CHECK_FALSE(alignment.fix(Vector3d(99, 99, 99), known));  // too early: it starts no new window
  m.feel(alignment, 0.3, 60);
  REQUIRE(alignment.fix(m.v0 + 0.6 * m.a, known));
  m.feel(alignment, 0.6, 100);
  const auto second = alignment.fix(m.v0 + 1.1 * m.a, known);
  REQUIRE(second);
  CHECK(second->window_s == doctest::Approx(0.5));
  CHECK((second->f_n - (m.a - Vector3d(0, 0, g))).norm() < 1e-9);
}

TEST_CASE("near free fall and with the field along the force there is no direction in a window") {
  const auto found = [&](const Vector3d& a, const Vector3d* by_field, const Vector3d* wind) {
    Motion m;
    m.a = a;
    m.rate.setZero();
    FlightAlignment alignment;
    const FlightAlignment::Known known{g, by_field, wind, 0};
    (void)alignment.fix(m.v0, known);
    m.feel(alignment, 0, 50);
    if (by_field) alignment.mag(m.attitude(0).conjugate() * *by_field);
    m.feel(alignment, 0.25, 50);
    return alignment.fix(m.v0 + 0.5 * m.a, known);
  };
  CHECK(found({0, 0, g - 3.1}, nullptr, nullptr));
  CHECK_FALSE(found({0, 0, g - 2.9}, nullptr, nullptr));
  // the sine of the angle between field and force: 0.12 is enough, with a known wind 0.6
  const auto field_off = [](double sine) {
    return Vector3d(4e-5 * Vector3d(0, sine, std::sqrt(1 - sine * sine)));
  };
  const Vector3d wind(3, -2, 0), level(0, 0, 0);
  for (const auto& [sine, with_wind, by_field] :
       {std::tuple{0.11, false, false}, {0.22, false, true}, {0.58, true, false}, {0.62, true, true}}) {
    const Vector3d f = field_off(sine);
    const auto one = found(level, &f, with_wind ? &wind : nullptr);
    REQUIRE(one);
    CHECK(one->by_field == by_field);
    if (!by_field) CHECK((one->second_n - (Vector3d(15, 6, -1) - (with_wind ? wind : level))).norm() < 1e-9);
  }
  const Vector3d f = field_off(0.17);  // enough for an evaluation, too little for a result
  CHECK_FALSE(found(level, &f, nullptr));
}

TEST_CASE("of a window's beginning half a second may be unseen, and seven tenths of it") {
  const Motion m;
  const auto found = [&](double unseen_s, double window_s) {
    FlightAlignment alignment;
    const FlightAlignment::Known known{g, nullptr, nullptr, unseen_s};
    (void)alignment.fix(m.v0 - unseen_s * m.a, known);
    m.feel(alignment, 0, static_cast<int>(std::lround(window_s / 0.005)));
    return alignment.fix(m.v0 + (window_s - unseen_s) * m.a, known);
  };
  CHECK(found(0.49, 1));
  CHECK_FALSE(found(0.51, 1));
  CHECK(found(0.34, 0.5));
  CHECK_FALSE(found(0.36, 0.5));
  CHECK(found(0.3, 0.8)->unseen_s == doctest::Approx(0.3));
}

TEST_CASE("the samples since a fix are those of its age, each for the time that it counts") {
  FlightAlignment alignment;
  for (int k = 0; k < 200; ++k) alignment.imu({0.01 * (k / 2), 0, 1}, {0, 0.1 * (k / 2), -g}, 0.005);
  for (const double age_s : {0.1, 0.025, 0.0}) {
    double time = 0;
    Vector3d omega = Vector3d::Zero(), f = Vector3d::Zero();
    alignment.since(age_s, [&](const Vector3d& w, const Vector3d& a, double dt) {
      time += dt;
      omega += dt * w;
      f += dt * a;
    });
    CHECK(time == doctest::Approx(age_s));
    double sum = 0;  // integral of k over the last age_s: pieces of 10 ms with k = 99, 98, ...
    for (double left = age_s, k = 99; left > 1e-9; left -= 0.01, --k) sum += k * std::min(left, 0.01);
    CHECK((omega - Vector3d(0.01 * sum, 0, age_s)).norm() < 1e-9);
    CHECK((f - Vector3d(0, 0.1 * sum, -g * age_s)).norm() < 1e-9);
  }
}

TEST_CASE(
    "the drift of the field needs four samples over 0.3 s, and knows no more than it was expected to be") {
  const Vector3d rate(0.2, -0.1, 0.3), bias(0.06, -0.04, 0.05);
  const auto drift = [&](int n, double dt, double scale) {
    FieldDrift d;
    Quaterniond q = Quaterniond::Identity(), turned = q;
    for (int i = 0; i < n; ++i) {
      const Vector3d m = (q.conjugate() * field).normalized();
      d.add(turned * m, turned, m, 7 + dt * i);
      q = q * exp_map(dt * rate);
      turned = turned * exp_map(dt * (rate + scale * bias));
    }
    return d;
  };
  CHECK(drift(3, 0.2, 1).bias(0.1, 0).bias_b.norm() == 0);
  CHECK(drift(4, 0.2, 1).bias(0.1, 0).bias_b.norm() > 0.01);
  CHECK(drift(15, 0.02, 1).bias(0.1, 0).bias_b.norm() == 0);
  CHECK(drift(17, 0.02, 1).bias(0.1, 0).bias_b.norm() > 0.01);
  // Without a bias across the field the bias along it keeps 0.01 of its expected value.
  const FieldDrift::Bias none = drift(200, 0.02, 0).bias(0.15, 0), some = drift(200, 0.02, 1).bias(0.15, 0);
  CHECK(none.bias_b.norm() < 1e-6);
  const auto most = [](const FieldDrift::Bias& b) {
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix3d>(b.covariance).eigenvalues()(2));
  };
  CHECK(most(none) < 0.0101);
  CHECK(most(some) > most(none));
  const double turned = 0.05 * (rate + bias).norm();  // a standard deviation that rotates with the aircraft
  const FieldDrift::Bias off = drift(200, 0.02, 1).bias(0.15, 0.05);
  const double least = std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix3d>(off.covariance).eigenvalues()(0));
  CHECK(least > turned);
  CHECK(least < 1.1 * turned);
}

TEST_CASE("a gust north and one east follow the tube and the side as a Kalman filter of one state") {
  const Params p;
  const double R = 0.1 * 0.1, s2 = p.wind_gust_std * p.wind_gust_std;
  for (const int axis : {0, 1})
    for (const double side : {1.0, -1.0}) {
      const double other_variance = 0.09, variance = 0.25;
      Vector3d u = Vector3d::Zero();
      u(axis) = side * 17;
      Eigen::Vector2d v(other_variance, other_variance);
      v(axis) = variance;
      Gusts gusts;
      gusts.forget({u, v}, 10, p);
      CHECK(gusts.covariance()(axis, axis) == doctest::Approx(variance + s2));
      CHECK(gusts.covariance()(1 - axis, 1 - axis) == doctest::Approx(other_variance + s2));
      gusts.airspeed({u, v}, 18.5, 10, p);  // 1.5 m/s of head wind
      const double P = variance + s2, K = P / (P + R);
      CHECK(gusts.gust_mps()(axis) == doctest::Approx(-side * K * 1.5));
      CHECK(gusts.covariance()(axis, axis) == doctest::Approx(P * R / (P + R)));
      const double std = gusts.std_mps(p), phi = std::exp(-0.5 / gusts.time_s(p));
      const double g1 = gusts.gust_mps()(axis), P1 = gusts.covariance()(axis, axis);
      // Air from the right: nose along this axis, wing along the other one.
      Vector3d wing = Vector3d::Zero();
      wing(1 - axis) = 1;
      u(1 - axis) = 0.7;  // gust of this size
      gusts.sideslip({u, v}, wing, 0.3, 10.5, p);
      CHECK(gusts.gust_mps()(axis) == doctest::Approx(g1 * phi).epsilon(1e-6));
      CHECK(gusts.covariance()(axis, axis) ==
            doctest::Approx(P1 * phi * phi + (variance + std * std) * (1 - phi * phi)));
      const double Q = (other_variance + s2) * phi * phi + (other_variance + std * std) * (1 - phi * phi),
                   N = std::pow(p.wind_side_ratio * std, 2) + 0.3 * 0.3;
      CHECK(gusts.gust_mps()(1 - axis) == doctest::Approx(Q / (Q + N) * 0.7));
      CHECK(gusts.covariance()(1 - axis, 1 - axis) == doctest::Approx(Q * N / (Q + N)));
      gusts.forget({u, v}, 11, p);
      CHECK(gusts.gust_mps().norm() == 0);
    }
}

TEST_CASE("what errors and claims of a quantity come to: means, shares, and chi-square with correlations") {
  consistency::Channel c;
  CHECK(c.rms() == 0);
  for (const double error : {0.5, -1.5, 3.0, 0.9}) c.add(error, 1);
  c.add(0, 3);
  CHECK(c.rms() == doctest::Approx(std::sqrt((0.25 + 2.25 + 9 + 0.81) / 5)));
  CHECK(c.claim() == doctest::Approx(std::sqrt(13.0 / 5)));
  CHECK(c.share_1() == doctest::Approx(0.6));
  CHECK(c.share_2() == doctest::Approx(0.8));
  consistency::Innovations i;
  CHECK(i.nis() == 0);
  CHECK(i.correlation(1) == 0);
  i.add_flight({2, 1, -1});
  i.add_flight({3});
  CHECK(i.nis() == doctest::Approx(15.0 / 4));
  CHECK(i.correlation(1) == doctest::Approx(1.0 / 15));
  CHECK(i.correlation(2) == doctest::Approx(-2.0 / 15));
  consistency::Nees nees;
  CHECK_FALSE(nees.any());
  CHECK(nees.mean() == 0);
  CHECK(nees.inside() == 0);
  for (const double one : {2.6, 2.8, 18.9, 19.1}) nees.add(one);
  CHECK(nees.mean() == doctest::Approx(43.4 / 4));
  CHECK(nees.inside() == 0.5);
  consistency::Nees::Errors error = consistency::Nees::Errors::Zero(), std;
  std << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  error(0) = 1;
  error(4) = 5;
  std::array<double, 36> correlation{};
  CHECK(consistency::Nees::of(error, std, correlation) == doctest::Approx(2));
  correlation[6] = 0.5;  // of the fifth with the first: x' [1 r; r 1]^-1 x = 2 / (1 + r)
  CHECK(consistency::Nees::of(error, std, correlation) == doctest::Approx(2 / 1.5));
  VehicleState truth, estimate;
  const Quaterniond q = quaternion_from({0.1, 0.2, 2});
  const Vector3d small(0.01, -0.02, 0.03);
  estimate.attitude = from_eigen(q);
  truth.attitude = from_eigen(Quaterniond(exp_map(small) * q));
  truth.velocity_mps = {1, 2, 4};
  estimate.velocity_mps = {0, 4, 1};
  truth.position_m = {9, 7, 5};
  estimate.position_m = {8, 5, 9};
  estimate.attitude_std_rad = {1, 2, 3};
  estimate.velocity_std_mps = {4, 5, 6};
  estimate.position_std_m = {7, 8, 9};
  consistency::Nees::Errors wanted;
  wanted << small, 1, -2, 3, 1, 2, -4;
  CHECK((consistency::Nees::errors(truth, estimate) - wanted).norm() < 1e-9);
  CHECK((consistency::Nees::claims(estimate) - std).norm() == 0);
}

}  // namespace alignment_limits_test
