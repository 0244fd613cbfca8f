// SPDX-License-Identifier: BSD-3-Clause
// Textbook figures of the generated law of `fulmar new`. Its own test states the contract alone.
#include <doctest/doctest.h>

#include <fulmar/eigen.hpp>
#include <fulmar/testing.hpp>

#define MyLaw NavTemplate
#include "sdk/template/roles/nav.hpp"
#undef MyLaw

namespace {

/// Sensor samples at rest on the ground at the equator, level, nose to magnetic north.
void stand(Bench<NavTemplate>& bench, const Vec3<Body>& rate_radps) {
  Imu imu;
  imu.specific_force_mps2 = {0, 0, -9.80665};
  imu.rate_radps = rate_radps;
  Gnss gnss;
  gnss.fix = FixType::fix_3d;
  bench.set(bench.in.imu, imu);
  bench.set(bench.in.gnss, gnss);
  bench.set(bench.in.mag, Mag{{3e-5, 0, 0}});
  bench.set(bench.in.baro, Baro{101325, 288.15});
  bench.set(bench.in.pitot, Pitot{});
}

}  // namespace

TEST_CASE("standing still it is level, where it began, and a gyro's bias turns nothing") {
  Bench<NavTemplate> bench;
  bench.params.declination.value = 0.2;
  for (int i = 0; i < 4000; ++i) {
    stand(bench, {0.02, -0.01, 0.03});
    REQUIRE(bench.step(0.0025) == Status::ok);
  }
  const VehicleState& state = bench.out.state;
  CHECK(state.roll_rad == doctest::Approx(0).epsilon(1e-3));
  CHECK(state.yaw_rad == doctest::Approx(0.2).epsilon(1e-3));
  CHECK(std::abs(state.position_m.north) < 1e-6);
  CHECK(std::abs(state.height_m) < 1e-6);
  CHECK(state.gyro_bias_radps.z == doctest::Approx(0.03));
}

TEST_CASE("taken over with 5 degrees of roll error it finds the vertical again") {
  Bench<NavTemplate> bench;
  NavTemplate::Outputs last{};
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(0.0873, Eigen::Vector3d::UnitX()));
  last.state.attitude = from_eigen(tilted);
  last.state.roll_rad = 0.0873;
  last.state.attitude_valid = last.state.position_valid = last.state.origin_valid = true;
  stand(bench, {});
  REQUIRE(bench.activate(last) == Status::ok);
  for (int i = 0; i < 40000; ++i) {
    stand(bench, {});
    REQUIRE(bench.step(0.0025) == Status::ok);
  }
  CHECK(std::abs(bench.out.state.roll_rad) < 0.009);
}
