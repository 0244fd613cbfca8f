// SPDX-License-Identifier: BSD-3-Clause
// Appended states of the error-state filter: the whole covariance against a dense filter of all states, with
// its transition by finite differences of the integration.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <fulmar/flight/navigation/ekf_models.hpp>
#include <fulmar/random.hpp>
#include <stdexcept>

namespace ekf_more_test {

using namespace fulmar;
using Eigen::Vector3d;

namespace {

constexpr int n = ekf::size, whole = n + 2;
using Whole = Eigen::Matrix<double, whole, whole>;
using WholeVector = Eigen::Matrix<double, whole, 1>;

/// Error of the x accelerometer as a share of its reading.
Eigen::Matrix<double, 9, 1> accel_scale(const ekf::Motion& m) {
  const Vector3d dv = -m.time_s * m.force_b.x() * m.R_nb.col(0);
  Eigen::Matrix<double, 9, 1> G;
  G << Vector3d::Zero(), dv, 0.5 * m.time_s * dv;
  return G;
}
/// The same for the z gyro.
Eigen::Matrix<double, 9, 1> gyro_scale(const ekf::Motion& m) {
  Eigen::Matrix<double, 9, 1> G = Eigen::Matrix<double, 9, 1>::Zero();
  G.head<3>() = -m.time_s * m.rate_b.z() * m.R_nb.col(2);
  return G;
}

Vector3d any(Random& r, double range) {
  return {r.uniform(-range, range), r.uniform(-range, range), r.uniform(-range, range)};
}
ekf::Nominal any_state(Random& r) {
  ekf::Nominal x;
  x.q_nb = quaternion_from({r.uniform(-3, 3), r.uniform(-1.4, 1.4), r.uniform(-3, 3)});
  x.v_n = any(r, 20);
  x.p_n = any(r, 300);
  x.gyro_bias = any(r, 0.2);
  x.accel_bias = any(r, 0.5);
  return x;
}
/// Two appended states, one that drives the velocity and one that drives the attitude.
ErrorStateEkf filter_at(const ekf::Nominal& x, double first = 0, double second = 0) {
  ErrorStateEkf f;
  f.append({.std = 0.3, .walk = 0.02, .drive = accel_scale});
  f.append({.std = 0.2, .time_s = 0.5, .drive = gyro_scale});
  f.reset(x, ekf::Vector::Constant(0.1), 0);
  f.more().set(0, first, 0.3);
  f.more().set(1, second, 0.2);
  return f;
}
Whole covariance(const ErrorStateEkf& f) {
  Whole P;
  P.topLeftCorner<n, n>() = f.covariance();
  P.bottomLeftCorner<2, n>() = f.more().cross().topRows<2>();
  P.topRightCorner<n, 2>() = f.more().cross().topRows<2>().transpose();
  P.bottomRightCorner<2, 2>() = f.more().covariance().topLeftCorner<2, 2>();
  return P;
}
WholeVector row_of(const ekf::Scalar& z) {
  WholeVector H;
  H << z.H.transpose(), z.more.head<2>().transpose();
  return H;
}
ekf::Scalar any_measurement(Random& r) {
  ekf::Scalar z;
  for (int i = 0; i < n; ++i) z.H(i) = i % 3 ? r.normal() : 0;
  z.more.head<2>() << r.normal(), r.normal();
  z.innovation = 0.01 * r.normal();
  return z;
}
/// Correlates all states.
void mix(ErrorStateEkf& f, Random& r) {
  for (int i = 0; i < 12; ++i) {
    ekf::Scalar z = any_measurement(r);
    z.innovation = 0;
    f.fuse(z, 0.2, 1e9);
  }
}
WholeVector difference(const ErrorStateEkf& to, const ErrorStateEkf& from) {
  WholeVector d;
  d << to.state().minus(from.state()), (to.more().values() - from.more().values()).head<2>();
  return d;
}

}  // namespace

TEST_CASE("an update of the filter with appended states is that of a dense filter of all states") {
  Random r(21);
  for (int trial = 0; trial < 20; ++trial) {
    ErrorStateEkf f = filter_at(any_state(r));
    mix(f, r);
    const Whole P = covariance(f);
    const ErrorStateEkf before = f;
    const ekf::Scalar z = any_measurement(r);
    const WholeVector H = row_of(z), PHt = P * H;
    const double S = H.dot(PHt) + 0.3;
    REQUIRE(P.bottomLeftCorner<2, n>().norm() > 1e-3);  // with correlations before
    CHECK(f.expected_std(z, 0.3) == doctest::Approx(std::sqrt(S)).epsilon(1e-9));
    REQUIRE(f.fuse(z, 0.3, 1e9).accepted);
    Whole expected = P - PHt * PHt.transpose() / S;
    WholeVector dx = PHt * (z.innovation / S);
    expected.block<2, 2>(ekf::gnss, ekf::gnss) = P.block<2, 2>(ekf::gnss, ekf::gnss);  // a consider state
    dx.segment<2>(ekf::gnss).setZero();
    CHECK((covariance(f) - expected).norm() < 1e-9 * P.norm());
    CHECK((difference(f, before) - dx).norm() < 1e-5 * dx.norm() + 1e-9);
  }
}

TEST_CASE("what only considers the attitude leaves the appended states alone, and is Joseph's") {
  Random r(22);
  ErrorStateEkf f = filter_at(any_state(r));
  mix(f, r);
  const Whole P = covariance(f);
  const ErrorStateEkf before = f;
  const ekf::Scalar z = ekf::zero_sideslip(f.state());
  REQUIRE(f.fuse_considering_attitude(z, 4, 1e9).accepted);
  const WholeVector H = row_of(z);
  WholeVector K = P * H / (H.dot(P * H) + 4);
  K.segment<3>(ekf::theta).setZero();
  K.segment<6>(ekf::gyro_bias).setZero();
  K.segment<2>(ekf::gnss).setZero();
  K.tail<2>().setZero();
  const Whole A = Whole::Identity() - K * H.transpose();
  const Whole expected = A * P * A.transpose() + 4 * K * K.transpose();
  CHECK((covariance(f) - expected).norm() < 1e-9 * P.norm());
  CHECK((f.more().values() - before.more().values()).norm() == 0);
}

TEST_CASE("the whole covariance follows the motion: Phi P Phi' + Q, Phi by finite differences") {
  Random r(23);
  for (int trial = 0; trial < 10; ++trial) {
    const ekf::Nominal x = any_state(r);
    const Vector3d omega = any(r, 1), f_b = any(r, 5) + Vector3d(3, 0, -10);
    const double first = 0.005 * r.normal(), second = 0.005 * r.normal();
    ErrorStateEkf mixed = filter_at(x, first, second);
    mixed.noise = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1e9, 0, 0, 0, 1e9};
    mixed.noise.delay_walk = 0;
    mix(mixed, r);
    const Whole P = covariance(mixed);
    const auto moved = [&](const WholeVector& dx) {
      ErrorStateEkf f = filter_at(x.plus(dx.head<n>()), first + dx(n), second + dx(n + 1));
      for (int k = 0; k < 4; ++k) f.predict(omega, f_b, 0.0025);
      return f;
    };
    Whole Phi;
    constexpr double step = 1e-5;
    for (int i = 0; i < whole; ++i) {
      WholeVector dx = WholeVector::Zero();
      dx(i) = step;
      Phi.col(i) = difference(moved(dx), moved(-dx)) / (2 * step);
    }
    for (int k = 0; k < 4; ++k) mixed.predict(omega, f_b, 0.0025);
    Phi.block<2, 2>(ekf::gnss, ekf::gnss) =
        std::exp(-0.01 / ekf::Noise{}.gnss_time) * Eigen::Matrix2d::Identity();
    Whole expected = Phi * P * Phi.transpose();
    // In the mixed filter gust and heading hardly decay, since their time constants are 1e9 s.
    const Whole got = covariance(mixed);
    expected(n, n) += 0.02 * 0.02 * 0.01;
    expected(n + 1, n + 1) += 0.2 * 0.2 * -std::expm1(-2 * 0.01 / 0.5);
    for (const int i : {+ekf::gust, +ekf::heading}) {
      expected.row(i).setZero();
      expected.col(i).setZero();
      expected.row(i) = got.row(i);
      expected.col(i) = got.col(i);
    }
    CHECK((got - expected).cwiseAbs().maxCoeff() < 5e-4 * expected.cwiseAbs().maxCoeff());
    CHECK((got - expected).bottomRows<2>().cwiseAbs().maxCoeff() <
          3e-3 * (got - P).bottomRows<2>().cwiseAbs().maxCoeff());
    CHECK((got - got.transpose()).cwiseAbs().maxCoeff() == 0);  // symmetric to the last bit
    CHECK(Phi(n + 1, n + 1) == doctest::Approx(std::exp(-0.01 / 0.5)));
    CHECK((Phi.block<9, 2>(0, n).norm()) > 5e-3);  // with effect on the motion
  }
}

TEST_CASE("the scale of an accelerometer is learnt in flight, within its standard deviation, either sign") {
  for (const double scale : {-0.06, 0.06}) {
    CAPTURE(scale);
    ErrorStateEkf f;
    REQUIRE(f.append({.std = 0.1, .walk = 1e-5, .drive = accel_scale}) == 0);
    ekf::Vector std = ekf::Vector::Constant(1e-3);
    std.segment<3>(ekf::vel).setConstant(0.5);
    std.segment<3>(ekf::accel_bias).setConstant(0.2);
    f.reset({}, std, 0);
    Random r(24);
    Vector3d v = Vector3d::Zero();
    for (int k = 1; k <= 24000; ++k) {  // a minute of level accelerations and decelerations
      const double t = k / 400.0, a = 3 * std::sin(0.7 * t);
      v.x() += a / 400;
      f.predict(Vector3d::Zero(), {a * (1 + scale), 0, -f.gravity_mps2}, 1 / 400.0);
      if (k % 80) continue;
      for (int i = 0; i < 3; ++i)
        f.fuse(ekf::velocity(f, f.at(f.time_s()), i, v(i) + 0.1 * r.normal()), 0.01, 5);
    }
    // measured = (1 + scale) true: the error is scale / (1 + scale) of the reading
    const double expected = scale / (1 + scale);
    CHECK(f.more().std(0) < 0.01);
    CHECK(f.more().value(0) == doctest::Approx(expected).epsilon(0.1));
    CHECK(std::abs(f.more().value(0) - expected) < 3 * f.more().std(0));
    CHECK(std::abs(f.state().accel_bias.x()) < 0.05);
  }
}

TEST_CASE("a filter to which nothing was appended has room for four; what cannot be is refused") {
  ErrorStateEkf f;
  CHECK(f.more().count() == 0);
  CHECK_THROWS_AS(f.append({.std = 0}), std::invalid_argument);
  CHECK_THROWS_AS(f.append({.walk = -1}), std::invalid_argument);
  CHECK_THROWS_AS(f.append({.time_s = std::nan("")}), std::invalid_argument);
  for (int i = 0; i < ekf::max_more; ++i) CHECK(f.append({.std = 1.0 + i}) == i);
  CHECK_THROWS_AS(f.append({}), std::length_error);
  CHECK(f.more().std(3) == doctest::Approx(4));
}

TEST_CASE("a restarted filter keeps its appended states, without correlation") {
  Random r(25);
  ErrorStateEkf f = filter_at(any_state(r), 0.1, -0.1);
  mix(f, r);
  const double value = f.more().value(0), std = f.more().std(0);
  f.reset(f.state(), ekf::Vector::Constant(1), 3);
  CHECK(f.more().value(0) == value);
  CHECK(f.more().std(0) == std);
  CHECK(f.more().cross().norm() == 0);
  mix(f, r);
  CHECK(f.more().cross().col(ekf::vel + 1).norm() > 0);
  f.forget(ekf::vel, 3, 1);
  CHECK(f.more().cross().middleCols<3>(ekf::vel).norm() == 0);
  CHECK(f.more().cross().norm() > 0);
  f.more().begin_again();
  CHECK(f.more().value(0) == 0);
  CHECK(f.more().std(0) == doctest::Approx(0.3));
  CHECK(f.more().cross().topRows<2>().norm() == 0);
}

}  // namespace ekf_more_test
