// SPDX-License-Identifier: BSD-3-Clause
// The contract of the role, for any estimator. Add cases for your own one.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "my_law.hpp"

namespace {

/// Sensor samples at rest on the ground at the equator, level, nose to magnetic north.
void stand(Bench<MyLaw>& bench) {
  Imu imu;
  imu.specific_force_mps2 = {0, 0, -9.80665};
  Gnss gnss;
  gnss.fix = FixType::fix_3d;
  bench.set(bench.in.imu, imu);
  bench.set(bench.in.gnss, gnss);
  bench.set(bench.in.mag, Mag{{3e-5, 0, 0}});
  bench.set(bench.in.baro, Baro{101325, 288.15});
  bench.set(bench.in.pitot, Pitot{});
}

}  // namespace

TEST_CASE(
    "standing still what it calls valid is level and near the first fix; all of it is finite; it takes no "
    "memory") {
  Bench<MyLaw> bench;
  for (int i = 0; i < 8000; ++i) {
    stand(bench);
    REQUIRE(allocations([&] { REQUIRE(bench.step(0.0025) == Status::ok); }) == 0);
    REQUIRE(bench.validation_error() == "");
    const VehicleState& state = bench.out.state;
    const Quat& q = state.attitude;
    if (state.attitude_valid) {
      REQUIRE(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-3);
      REQUIRE(std::abs(state.roll_rad) < 0.1);
      REQUIRE(std::abs(state.pitch_rad) < 0.1);
    }
    if (state.height_valid) REQUIRE(std::abs(state.height_m) < 20);
    if (state.velocity_valid) REQUIRE(std::abs(state.velocity_mps.north) < 2);
  }
}

TEST_CASE("it takes over without a bump from one that flew the same") {
  Bench<MyLaw> before, next;
  for (int i = 0; i < 8000; ++i) {
    stand(before);
    REQUIRE(before.step(0.0025) == Status::ok);
  }
  stand(next);
  if constexpr (detail::TakesApplied<MyLaw> || detail::TakesOutputs<MyLaw>)
    REQUIRE(next.activate(before.out) == Status::ok);
  REQUIRE(next.step(0.0025) == Status::ok);
  const VehicleState &last = before.out.state, &first = next.out.state;
  if (!first.attitude_valid) return;  // not aligned yet
  CHECK(std::abs(first.roll_rad - last.roll_rad) < 0.02);
  CHECK(std::abs(first.pitch_rad - last.pitch_rad) < 0.02);
  CHECK(std::abs(first.position_m.north - last.position_m.north) < 1);
  CHECK(std::abs(first.height_m - last.height_m) < 1);
}
