// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#define MyLaw PointMassTemplate
#include "sdk/template/roles/vehicle_point_mass.hpp"
#undef MyLaw

namespace {

/// Armed flight at full throttle for `seconds`, with these surfaces.
void fly(Bench<PointMassTemplate>& bench, double seconds, double aileron_rad, double elevator_rad) {
  for (int i = 0; i < seconds * 400; ++i) {
    REQUIRE(bench.read() == Status::ok);
    bench.set(bench.in.actuators, Actuators{1, aileron_rad, elevator_rad, 0});
    bench.push(bench.in.arm, ArmRequest{true});
    REQUIRE(bench.write() == Status::ok);
  }
}

}  // namespace

TEST_CASE("standing and level the accelerometer shows gravity, upwards") {
  Bench<PointMassTemplate> bench;
  REQUIRE(bench.read() == Status::ok);
  CHECK(bench.out.imu.specific_force_mps2.z == doctest::Approx(-9.80665));
  CHECK(bench.tick.now_ns == -5'000'000'000 + 2'500'000);
}

TEST_CASE("with the elevator up it takes off, with the aileron right it turns right") {
  Bench<PointMassTemplate> bench;
  fly(bench, 5, 0, 0);  // at rest until flight time 0
  fly(bench, 12, 0, -0.05);
  fly(bench, 1, 0.1, 0);
  fly(bench, 2, 0, 0);
  const VehicleState truth = bench.out.truth.value;
  CHECK(truth.height_m > 10);
  CHECK(truth.roll_rad > 0.1);
  CHECK(truth.yaw_rad > 0.1);
  // the GNSS course follows the turn rate of the book: chi_dot = g tan(phi) / Va
  const double before = truth.course_rad;
  fly(bench, 1, 0, 0);
  CHECK(bench.out.truth.value.course_rad - before ==
        doctest::Approx(9.80665 * std::tan(truth.roll_rad) / truth.airspeed_mps).epsilon(0.05));
}
