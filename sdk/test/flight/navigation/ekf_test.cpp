// SPDX-License-Identifier: BSD-3-Clause
// The error-state filter: every derivative against finite differences, the update against the information
// form, the past states against the motion.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fulmar/flight/navigation/ekf_models.hpp>
#include <fulmar/random.hpp>
#include <numbers>

namespace ekf_test {

using namespace fulmar;
using Eigen::Vector3d;

namespace {

Vector3d any(Random& r, double range) {
  return {r.uniform(-range, range), r.uniform(-range, range), r.uniform(-range, range)};
}

ekf::Nominal any_state(Random& r) {
  ekf::Nominal x;
  x.q_nb = quaternion_from({r.uniform(-3, 3), r.uniform(-1.4, 1.4), r.uniform(-3, 3)});
  x.v_n = any(r, 20) + Vector3d(5, 0, 0);
  x.p_n = any(r, 300);
  x.gyro_bias = any(r, 0.2);
  x.accel_bias = any(r, 0.5);
  x.wind = {r.uniform(-6, 6), r.uniform(-6, 6)};
  x.gust_mps = r.normal();
  x.baro_m = 5 * r.normal();
  x.port_ratio = 0.1 * r.normal();
  x.gnss_delay_s = 0.02 * r.normal();
  x.heading_rad = 0.1 * r.normal();
  return x;
}

/// Derivative of the expected value: minus that of the innovation, central differences.
template <class Model>
ekf::Row numeric(const ekf::Nominal& x, const Model& model) {
  ekf::Row H;
  constexpr double step = 1e-6;
  for (int i = 0; i < ekf::size; ++i) {
    ekf::Vector dx = ekf::Vector::Zero();
    dx(i) = step;
    const double up = model(x.plus(dx)).innovation, down = model(x.plus(-dx)).innovation;
    H(i) = -wrap_pi(up - down) / (2 * step);
  }
  return H;
}

ErrorStateEkf filter_at(const ekf::Nominal& x) {
  ErrorStateEkf f;
  f.reset(x, ekf::Vector::Constant(0.1), 0);
  return f;
}

ekf::Covariance any_covariance(Random& r) {
  ekf::Covariance A;
  for (int i = 0; i < ekf::size; ++i)
    for (int j = 0; j < ekf::size; ++j) A(i, j) = r.normal();
  return A * A.transpose() / ekf::size + 0.01 * ekf::Covariance::Identity();
}

}  // namespace

TEST_CASE("the row of every measurement is the derivative of what it expects") {
  Random r(11);
  for (int i = 0; i < 60; ++i) {
    const ekf::Nominal x = any_state(r);
    const Vector3d field = x.q_nb.conjugate() * Vector3d(2e-5, 4e-6, i % 2 ? 4.5e-5 : -5e-5) + any(r, 2e-6);
    const auto airspeed = [](const ekf::Nominal& n) { return ekf::true_airspeed(n, 17); };
    const auto sideslip = [](const ekf::Nominal& n) { return ekf::zero_sideslip(n); };
    const auto heading = [&](const ekf::Nominal& n) { return ekf::magnetic_heading(n, field, 0.2); };
    const auto baro = [](const ekf::Nominal& n) { return ekf::baro_height(n, 85000, 1387); };
    const auto port = [](const ekf::Nominal& n) { return ekf::baro_height_in_flight(n, 85000, 1387); };
    const auto rate = [](const ekf::Nominal& n) { return ekf::zero_rate(n, 1, 0.01); };
    CHECK((airspeed(x).H - numeric(x, airspeed)).norm() < 1e-6);
    CHECK((sideslip(x).H - numeric(x, sideslip)).norm() < 1e-5);
    CHECK((heading(x).H - numeric(x, heading)).norm() < 1e-5 * heading(x).H.norm());
    CHECK((baro(x).H - numeric(x, baro)).norm() < 1e-6);
    CHECK((port(x).H - numeric(x, port)).norm() < 1e-5);
    CHECK(ekf::late(rate(x), 3).H(ekf::delay) == -3);  // a rising value was smaller a second ago
    CHECK((rate(x).H - numeric(x, rate)).norm() < 1e-6);
    const ErrorStateEkf::Past now{x.p_n, x.v_n, 0, true};
    const ErrorStateEkf f = filter_at(x);
    for (int axis = 0; axis < 3; ++axis) {
      const auto velocity = [&](const ekf::Nominal& n) {
        return ekf::velocity(f, {n.p_n, n.v_n, 0, true}, axis, 3);
      };
      const auto position = [&](const ekf::Nominal& n) {
        return ekf::position(f, {n.p_n, n.v_n, 0, true}, axis, 3);
      };
      CHECK((ekf::velocity(f, now, axis, 3).H - numeric(x, velocity)).norm() < 1e-6);
      ekf::Row expected = numeric(x, position);
      if (axis < 2) expected(ekf::gnss + axis) = 1;  // the receiver reads further north and east
      CHECK((ekf::position(f, now, axis, 3).H - expected).norm() < 1e-6);
    }
  }
}

TEST_CASE("the covariance follows the motion: Phi P Phi' with Phi by finite differences of the integration") {
  Random r(12);
  for (int trial = 0; trial < 10; ++trial) {
    const ekf::Nominal x = any_state(r);
    const ekf::Covariance P = any_covariance(r);
    const Vector3d omega = any(r, 1), f_b = any(r, 5) + Vector3d(0, 0, -10);
    const auto moved = [&](const ekf::Nominal& from) {
      ErrorStateEkf f = filter_at(from);
      f.noise = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1e9, 0, 0, 0, 1e9};
      f.noise.delay_walk = 0;
      f.set_covariance(P);
      for (int k = 0; k < 4; ++k) f.predict(omega, f_b, 0.0025);
      return f;
    };
    const ErrorStateEkf end = moved(x);
    ekf::Covariance Phi;
    constexpr double step = 1e-5;
    for (int i = 0; i < ekf::size; ++i) {
      ekf::Vector dx = ekf::Vector::Zero();
      dx(i) = step;
      Phi.col(i) = moved(x.plus(dx)).state().minus(moved(x.plus(-dx)).state()) / (2 * step);
    }
    Phi.block<2, 2>(ekf::gnss, ekf::gnss) =
        std::exp(-0.01 / ekf::Noise{}.gnss_time) * Eigen::Matrix2d::Identity();
    const ekf::Covariance expected = Phi * P * Phi.transpose();
    CHECK((end.covariance() - expected).cwiseAbs().maxCoeff() < 2e-4 * expected.cwiseAbs().maxCoeff());
    CHECK((end.covariance() - P).cwiseAbs().maxCoeff() > 0.01);  // with an effect
  }
}

TEST_CASE(
    "a late fix is compared with the state of its time, and its row is the derivative through the motion "
    "since") {
  Random r(13);
  const auto fly = [](const ekf::Nominal& x, Random noise) {
    ErrorStateEkf f;
    f.reset(x, ekf::Vector::Constant(0.1), 0);
    for (int k = 0; k < 60; ++k)
      f.predict(Vector3d(0.4, -0.2, 0.3) + any(noise, 0.1), Vector3d(1, -0.5, -12) + any(noise, 1), 0.0025);
    return f;
  };
  for (int trial = 0; trial < 10; ++trial) {
    const ekf::Nominal x = any_state(r);
    const ErrorStateEkf f = fly(x, Random(7));
    const ErrorStateEkf::Past past = f.at(0);
    REQUIRE(past.known);
    CHECK(past.age_s == doctest::Approx(0.15));
    CHECK((past.p_n - x.p_n).norm() < 1e-9);
    CHECK((past.v_n - x.v_n).norm() < 1e-9);
    for (int i = 0; i < 15; ++i) {
      ekf::Vector dx = ekf::Vector::Zero();
      dx(i) = 1e-4;
      const ekf::Vector error_now = fly(x.plus(dx), Random(7)).state().minus(f.state());
      for (int axis = 0; axis < 3; ++axis) {
        const double by_row_v = ekf::velocity(f, past, axis, 0).H.dot(error_now.transpose());
        const double by_row_p = ekf::position(f, past, axis, 0).H.dot(error_now.transpose());
        CHECK(by_row_v == doctest::Approx(dx(ekf::vel + axis)).epsilon(0.02).scale(1e-4));
        CHECK(by_row_p == doctest::Approx(dx(ekf::pos + axis)).epsilon(0.02).scale(1e-4));
      }
    }
  }
}

TEST_CASE("the stored past contains later corrections: the same late fix does not count twice") {
  ErrorStateEkf f;
  ekf::Nominal x;
  x.v_n = {17, 0, 0};
  ekf::Vector std = ekf::Vector::Zero();
  std.segment<6>(ekf::vel).setOnes();  // the tilt has caused no difference
  f.reset(x, std, 0);
  for (int k = 0; k < 80; ++k) f.predict(Vector3d::Zero(), Vector3d(0, 0, -f.gravity_mps2), 0.0025);
  f.fuse(ekf::velocity(f, f.at(0.2), 0, 20), 1e-8, 1e3);  // 20 m/s over the whole time
  const ErrorStateEkf::Past past = f.at(0.1);
  CHECK(past.v_n.x() == doctest::Approx(20).epsilon(1e-3));
  CHECK(f.state().p_n.x() - past.p_n.x() == doctest::Approx(2).epsilon(2e-3));
  CHECK_FALSE(f.at(-0.01).known);
}

TEST_CASE("one scalar update is the information filter's") {
  Random r(14);
  for (int trial = 0; trial < 20; ++trial) {
    ErrorStateEkf f = filter_at(any_state(r));
    const ekf::Covariance P = any_covariance(r);
    f.set_covariance(P);
    ekf::Scalar z;
    for (int i = 0; i < ekf::size; ++i) z.H(i) = i % 3 ? r.normal() : 0;
    z.innovation = 0.01 * r.normal();
    const double variance = 0.3;
    const ekf::Nominal before = f.state();
    REQUIRE(f.fuse(z, variance, 1e9).accepted);
    ekf::Covariance expected = (P.inverse() + z.H.transpose() * z.H / variance).inverse();
    ekf::Vector dx = expected * z.H.transpose() * z.innovation / variance;
    expected.block<2, 2>(ekf::gnss, ekf::gnss) = P.block<2, 2>(ekf::gnss, ekf::gnss);  // a consider state
    dx.segment<2>(ekf::gnss).setZero();
    CHECK((f.covariance() - expected).norm() < 1e-9 * P.norm());
    CHECK((f.state().minus(before) - dx).norm() < 1e-6 * dx.norm() + 1e-9);
  }
}

TEST_CASE(
    "an update that only considers attitude leaves it alone, and its covariance is Joseph's for that gain") {
  Random r(16);
  for (int trial = 0; trial < 20; ++trial) {
    ErrorStateEkf f = filter_at(any_state(r));
    const ekf::Covariance P = any_covariance(r);
    f.set_covariance(P);
    const ekf::Nominal before = f.state();
    const ekf::Scalar z = ekf::zero_sideslip(before);
    const double variance = 4;
    REQUIRE(f.fuse_considering_attitude(z, variance, 1e9).accepted);
    ekf::Vector K = P * z.H.transpose() / ((z.H * P * z.H.transpose()).value() + variance);
    K.segment<3>(ekf::theta).setZero();
    K.segment<3>(ekf::gyro_bias).setZero();
    K.segment<3>(ekf::accel_bias).setZero();
    K.segment<2>(ekf::gnss).setZero();
    const ekf::Covariance IKH = ekf::Covariance::Identity() - K * z.H;
    CHECK((f.covariance() - (IKH * P * IKH.transpose() + variance * K * K.transpose())).norm() <
          1e-10 * P.norm());
    CHECK(f.state().q_nb.angularDistance(before.q_nb) < 1e-7);
    CHECK(f.state().gyro_bias == before.gyro_bias);
    CHECK((f.state().v_n - before.v_n - K.segment<3>(ekf::vel) * z.innovation).norm() < 1e-9);
  }
}

TEST_CASE("an innovation beyond the gate changes nothing and is reported") {
  ErrorStateEkf f = filter_at({});
  ekf::Scalar z;
  z.H(ekf::pos) = 1;
  z.innovation = 10;
  const ekf::Covariance P = f.covariance();
  const ekf::Fused fused = f.fuse(z, 0.99, 5);  // expected standard deviation 1
  CHECK_FALSE(fused.accepted);
  CHECK(fused.ratio == doctest::Approx(10));
  CHECK(f.state().p_n.norm() == 0);
  CHECK(f.covariance() == P);
  z.innovation = std::nan("");
  CHECK_FALSE(f.fuse(z, 1, 5).accepted);
}

TEST_CASE("the covariance stays symmetric and positive definite over a minute of turns and updates") {
  Random r(15);
  ErrorStateEkf f;
  f.noise.gnss_std = 1.5;
  ekf::Nominal x;
  x.v_n = {17, 0, 0};
  ekf::Vector std = ekf::Vector::Constant(1);
  std.segment<3>(ekf::pos).setConstant(1e3);
  std.segment<3>(ekf::theta).setConstant(0.5);
  f.reset(x, std, 0);
  for (int k = 0; k < 60 * 200; ++k) {
    f.predict(any(r, 0.5), any(r, 3) + Vector3d(0, 0, -9.8), 0.005);
    if (k % 20 == 0)
      for (int axis = 0; axis < 3; ++axis) {
        f.fuse(ekf::velocity(f, f.at(f.time_s()), axis, 0), 1e-4, 1e9);
        f.fuse(ekf::position(f, f.at(f.time_s()), axis, 0), 1e-2, 1e9);
      }
    if (k % 4 == 0) f.fuse(ekf::true_airspeed(f.state(), 17), 0.01, 1e9);
    if (k % 200 == 0) {
      CHECK((f.covariance() - f.covariance().transpose()).cwiseAbs().maxCoeff() == 0);
      CHECK(Eigen::SelfAdjointEigenSolver<ekf::Covariance>(f.covariance()).eigenvalues().minCoeff() > 0);
    }
  }
  CHECK(f.state().q_nb.norm() == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("uncertainty grows with time and not with the number of samples") {
  const auto after = [](double hz) {
    ErrorStateEkf f;
    ekf::Nominal x;
    x.v_n = {17, 0, 0};
    f.reset(x, ekf::Vector::Constant(0.01), 0);
    for (int k = 0; k < static_cast<int>(10 * hz); ++k) f.predict({0, 0, 0.1}, {0, 1, -9.8}, 1 / hz);
    return ekf::Vector(f.covariance().diagonal().cwiseSqrt());
  };
  const ekf::Vector slow = after(50), usual = after(400), fast = after(1000);
  for (int i = 0; i < ekf::size; ++i) {
    CHECK(slow(i) == doctest::Approx(usual(i)).epsilon(0.01).scale(0));
    CHECK(fast(i) == doctest::Approx(usual(i)).epsilon(0.01).scale(0));
  }
}

TEST_CASE("pressure height is right a kilometre up and at any field elevation") {
  // An independent form of the standard atmosphere: p = 101325 (1 - 2.25577e-5 h)^5.25588
  const auto pressure = [](double h) { return 101325 * std::pow(1 - 2.25577e-5 * h, 5.25588); };
  for (const double field : {0.0, 1387.0, 3000.0})
    for (const double height : {0.0, 70.0, 300.0, 1000.0}) {
      ekf::Nominal x;
      x.p_n.z() = -height;
      CHECK(std::abs(ekf::baro_height(x, pressure(field + height), field).innovation) < 0.1);
    }
}

TEST_CASE("a needle that points to the declination gives the true heading in both hemispheres") {
  for (const double down : {4.5e-5, -5e-5})
    for (const double declination : {-0.3, 0.18, 0.2}) {
      const Vector3d field(2e-5 * std::cos(declination), 2e-5 * std::sin(declination), down);
      ekf::Nominal x;
      x.q_nb = quaternion_from({0.5, -0.2, 2.9});
      CHECK(std::abs(ekf::magnetic_heading(x, x.q_nb.conjugate() * field, declination).innovation) < 1e-12);
      ekf::Nominal turned = x;
      turned.q_nb = exp_map({0, 0, -0.1}) * x.q_nb;  // the estimate is 0.1 rad too small
      CHECK(ekf::magnetic_heading(turned, x.q_nb.conjugate() * field, declination).innovation ==
            doctest::Approx(0.1));
    }
}

TEST_CASE("a static port that sees a share of the dynamic pressure makes the barometer read too low by it") {
  ekf::Nominal x;
  x.v_n = {25, 3, -2};
  x.wind = {5, 3};
  x.p_n = {0, 0, -120};
  for (const double share : {0.1, -0.1}) {
    x.port_ratio = share;
    const Air air = standard_air(1387 + 120);
    const double dynamic_pa = 0.5 * air.density_kgm3 * (20 * 20 + 2 * 2);
    const ekf::Scalar z = ekf::baro_height_in_flight(x, air.pressure_pa + share * dynamic_pa, 1387);
    CHECK(std::abs(z.innovation) < 0.01);  // of 2.1 m: the change of density over them
    CHECK(ekf::baro_height(x, air.pressure_pa + share * dynamic_pa, 1387).innovation / share < -20);
  }
}

TEST_CASE("gust, heading deviation and the receiver's error grow to their deviations, and stay there") {
  ErrorStateEkf f;
  f.noise.gust_std = 1.3;
  f.noise.gust_time = 0.5;
  f.noise.heading_std = 0.04;
  f.noise.heading_time = 0.7;
  f.noise.gnss_std = 2.5;
  f.noise.gnss_time = 0.6;
  f.noise.port_walk = 0.02;
  f.reset({}, ekf::Vector::Zero(), 0);
  for (int i = 0; i < 2000; ++i) f.predict(Vector3d::Zero(), {0, 0, -9.80665}, 0.005);
  CHECK(f.std(ekf::port) / (0.02 * std::sqrt(10.0)) == doctest::Approx(1).epsilon(1e-6));  // random walk
  CHECK(f.std(ekf::gust) / 1.3 == doctest::Approx(1).epsilon(1e-6));
  CHECK(f.std(ekf::heading) / 0.04 == doctest::Approx(1).epsilon(1e-6));
  for (const int i : {0, 1}) CHECK(f.std(ekf::gnss + i) / 2.5 == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE(
    "what a receiver is off is in the position's deviation for good, and its correction is not shared") {
  ErrorStateEkf f;
  f.noise.gnss_std = 1.5;
  f.noise.gnss_time = 100;
  ekf::Vector std = ekf::Vector::Constant(0.1);
  std.segment<2>(ekf::pos).setConstant(1e3);
  std.segment<2>(ekf::gnss).setConstant(1.5);
  f.reset({}, std, 0);
  for (int i = 0; i < 200; ++i) f.fuse(ekf::position(f, f.at(0), 0, 10), 0.3 * 0.3, 1e9);
  CHECK(f.state().p_n.x() == doctest::Approx(10).epsilon(1e-3));  // the whole difference
  CHECK(f.std(ekf::pos) == doctest::Approx(1.5).epsilon(0.01));   // for any number
  CHECK(f.std(ekf::gnss) == doctest::Approx(1.5).epsilon(1e-9));
  const ekf::Covariance& P = f.covariance();
  CHECK(P(ekf::pos, ekf::gnss) / (f.std(ekf::pos) * f.std(ekf::gnss)) == doctest::Approx(-1).epsilon(0.01));
  CHECK(P(ekf::pos, ekf::pos) + P(ekf::gnss, ekf::gnss) + 2 * P(ekf::pos, ekf::gnss) < 0.001);  // of the sum
  CHECK(f.std(ekf::pos + 1) == doctest::Approx(1e3));
}

TEST_CASE(
    "the wind is less sure after a descent as after a climb, the velocity at half a g as at one and a half") {
  const auto after = [](double sink_mps, double load) {
    ErrorStateEkf f;
    f.noise = {};
    f.noise.wind_walk = 0.02;
    f.noise.wind_shear = 0.05;
    f.noise.accel = 0.02;
    f.noise.accel_scale = 0.05;
    f.noise.gyro = f.noise.gyro_bias_walk = 0;  // otherwise a share of the load by the tilt
    ekf::Nominal x;
    x.v_n.z() = sink_mps;
    f.reset(x, ekf::Vector::Zero(), 0);
    for (int i = 0; i < 2000; ++i) f.predict(Vector3d::Zero(), {0, 0, -load * 9.80665}, 0.005);
    return std::pair{f.std(ekf::wind), f.std(ekf::vel)};
  };
  CHECK(after(-5, 1).first / after(5, 1).first == doctest::Approx(1).epsilon(1e-6));
  CHECK(after(-5, 1).first > 5 * after(0, 1).first);
  CHECK(after(0, 0.5).second / after(0, 1.5).second == doctest::Approx(1).epsilon(1e-6));
  CHECK(after(0, 0.5).second > 5 * after(0, 1).second);
}

TEST_CASE("position follows a steady acceleration exactly, for any step") {
  for (const double dt : {0.1, 0.01}) {
    ErrorStateEkf f;
    f.reset({}, ekf::Vector::Zero(), 0);
    for (int i = 0; i < std::lround(1 / dt); ++i) f.predict(Vector3d::Zero(), {2, 0, -f.gravity_mps2}, dt);
    CHECK(f.state().v_n.x() == doctest::Approx(2));
    CHECK(f.state().p_n.x() == doctest::Approx(1));
  }
}

TEST_CASE("a pascal is as many metres as the standard atmosphere has there") {
  for (const double altitude : {0.0, 1500.0, 4000.0}) {
    const Air air = standard_air(altitude);
    const double metres = pressure_altitude(air.pressure_pa - 1) - pressure_altitude(air.pressure_pa);
    CHECK(ekf::metres_per_pascal(air) / metres == doctest::Approx(1).epsilon(1e-3));
  }
}

}  // namespace ekf_test
