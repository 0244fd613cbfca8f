// SPDX-License-Identifier: BSD-3-Clause
// A launch by hand and off a catapult: held, pushed along the nose, let go with its speed.
#include <doctest/doctest.h>

#include "fly.hpp"
#include "fulmar/testing.hpp"
#include "plugins/sim_aero/aircraft.hpp"

namespace launch_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

std::unique_ptr<Bench<Aircraft>> bench(LaunchKind kind, double speed_mps = 0) {
  auto b = std::make_unique<Bench<Aircraft>>(1);
  b->params.airframe.value = anaconda();
  b->params.sensors.value = SensorSet::perfect;
  b->params.launching.launch.value = kind;
  b->params.launching.launch_speed.value = speed_mps;
  b->params.launching.launch_after.value = 2;
  b->params.start.start_heading.value = 0.5;
  b->params.wind.wind_ned.value = {-8, 0, 0};
  return b;
}
void until(Bench<Aircraft>& b, double seconds) {
  while (b.tick.now_ns < std::llround(1e9 * seconds)) pass(b, nullptr);
}

}  // namespace

TEST_CASE("it is held with its nose up, whatever the wind does, and let go with the speed after its push") {
  const struct {
    LaunchKind kind;
    double speed_mps, length_m, height_m;
  } launches[] = {
      {LaunchKind::hand, 9, 1.5, 1.5}, {LaunchKind::catapult, 16, 4, 1}, {LaunchKind::hand, 11, 1.5, 1.5}};
  for (const auto& l : launches) {
    CAPTURE(l.speed_mps);
    const auto b = bench(l.kind, l.speed_mps == 11 ? 11 : 0);
    arm(*b);
    until(*b, 1.99);
    const double stands = 0.22;  // the centre of gravity over the wheels, less their sag
    const VehicleState held = b->out.truth.value;
    CHECK(held.height_m == Approx(stands + l.height_m).epsilon(0.02));
    CHECK(held.pitch_rad == Approx(0.2));
    CHECK(held.yaw_rad == Approx(0.5));
    CHECK(held.ground_speed_mps == 0);
    CHECK(held.airspeed_mps == Approx(8));
    CHECK(b->out.contact.value.touching);
    // v^2 = 2 a s, as long as v / a
    const double push_s = 2 * l.length_m / l.speed_mps;
    until(*b, 2 + 0.5 * push_s);
    CHECK(b->out.imu.value.specific_force_mps2.x ==
          Approx(l.speed_mps * l.speed_mps / (2 * l.length_m) + 9.80665 * std::sin(0.2)).epsilon(0.01));
    CHECK(b->out.contact.value.touching);
    until(*b, 2 + push_s + 0.005);
    const RigidBody& x = b->component().plant().state();
    CHECK(x.v_n.norm() == Approx(l.speed_mps).epsilon(0.02));
    CHECK(-x.p_n.z() - held.height_m == Approx(l.length_m * std::sin(0.2)).epsilon(0.1));
    CHECK(std::hypot(x.p_n.x(), x.p_n.y()) == Approx(l.length_m * std::cos(0.2)).epsilon(0.05));
    CHECK(std::atan2(x.v_n.y(), x.v_n.x()) == Approx(0.5).epsilon(0.01));
    CHECK_FALSE(b->out.contact.value.touching);
    until(*b, 2 + push_s + 6);  // without commands it is on the ground again
    CHECK(b->out.contact.value.touching);
  }
}

TEST_CASE("nobody is launched before he is armed, and not while he waits") {
  const auto b = bench(LaunchKind::hand);
  b->params.launching.launch_after.value = 100;
  REQUIRE(b->configure() == Status::ok);
  until(*b, 60);
  CHECK(b->out.truth.value.ground_speed_mps == 0);
  CHECK(b->out.contact.value.touching);
  arm(*b);
  until(*b, 159);
  CHECK(b->out.truth.value.ground_speed_mps == 0);
  until(*b, 160.5);
  CHECK(b->out.truth.value.ground_speed_mps > 5);
}

TEST_CASE("a launch of what begins in the air is refused") {
  const auto b = bench(LaunchKind::catapult);
  b->params.start.start_height.value = 50;
  CHECK(b->configure() == Status::failed);
  CHECK(std::string(b->error()) == "launch: sim_aero.launch_in_air");
}

}  // namespace launch_test
