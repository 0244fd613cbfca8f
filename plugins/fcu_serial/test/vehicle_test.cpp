// SPDX-License-Identifier: BSD-3-Clause
// The vehicle against the software flight controller, in virtual time.
#define FULMAR_COUNT_ALLOCATIONS
#include "flying.hpp"
#include "fulmar/testing.hpp"

namespace vehicle_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;
using doctest::Approx;

TEST_CASE("a controller is greeted, and its sensors come at their rates") {
  Flying f;
  f.fly(4);
  CHECK(f.heard("fcu_serial.connected(v2.0.1-0-ge8cf6a0f)"));
  CHECK(f.imu_ns.size() == Approx(1600).epsilon(0.01));
  CHECK(f.published["mag"] == Approx(400).epsilon(0.02));
  CHECK(f.published["baro"] == Approx(200).epsilon(0.02));
  CHECK(f.published["pitot"] == Approx(400).epsilon(0.02));
  CHECK(f.published["gnss"] == Approx(40).epsilon(0.05));
  CHECK(f.published["rc"] == Approx(444).epsilon(0.02));
  CHECK(f.published["attitude"] == Approx(1600).epsilon(0.01));
  CHECK(f.published["outputs"] == Approx(200).epsilon(0.02));
  CHECK(f.published["status"] == Approx(41).epsilon(0.15));
  CHECK(f.published["link"] == Approx(40).epsilon(0.1));
}

TEST_CASE("time begins at 0, rises strictly, and goes with the samples") {
  Flying f;
  f.fly(2);
  CHECK(f.ticks_ns.front() == 0);
  int irregular = 0;
  for (std::size_t i = 1; i < f.ticks_ns.size(); ++i) {
    REQUIRE(f.ticks_ns[i] > f.ticks_ns[i - 1]);
    if (std::abs(f.ticks_ns[i] - f.ticks_ns[i - 1] - 2'500'000) > 200'000) ++irregular;
  }
  CHECK(irregular <= 2);
  // 0.3 ms on the way: that is the age of a sample in its tick
  CHECK(f.ticks_ns.back() - f.imu_ns.back() == 300'000);
}

TEST_CASE("the pilot arms; then what is commanded is what moves") {
  Flying f;
  f.arm();
  CHECK(f.world.fcu.armed());
  CHECK(f.world.fcu.deflected().aileron == Approx(0.1 / 0.7));
  CHECK(f.world.fcu.deflected().elevator == Approx(-0.05 / 0.5));
  CHECK(f.world.fcu.deflected().rudder == Approx(0.07 / 0.35));
  CHECK(f.world.fcu.deflected().throttle == Approx(0.4));
  CHECK(f.status.errors == 0);
  CHECK_FALSE(f.status.on_ground);
  CHECK(f.status.battery_volt > 10);
}

TEST_CASE("commands go out in the tick of each new one, at 100 Hz here") {
  Flying f;
  f.arm();
  const std::size_t before = f.world.count<OffboardControl>();
  f.fly(2);
  CHECK(static_cast<double>(f.world.count<OffboardControl>() - before) == Approx(200).epsilon(0.02));
}

TEST_CASE(
    "nobody renews the command: it is repeated for 100 ms, then the controller goes back to its pilot") {
  Flying f;
  f.arm();
  f.commands = false;
  f.fly(0.3);
  const std::int64_t last_command_ns = f.world.sent_ns.back();
  const auto last = f.world.count<OffboardControl>();
  f.fly(1);
  CHECK(f.world.count<OffboardControl>() == last);
  CHECK(f.world.now_ns - last_command_ns > 1'000'000'000);
  CHECK_FALSE(f.world.fcu.offboard());
  CHECK_FALSE(f.status.offboard);
  CHECK_FALSE(f.status.in_control);
  CHECK(f.heard("fcu_serial.not_in_control"));
}

TEST_CASE("a command that is not finite is not sent, and told once") {
  Flying f;
  f.arm();
  f.command.elevator_rad = std::numeric_limits<double>::quiet_NaN();
  const auto before = f.world.count<OffboardControl>();
  f.fly(1);
  CHECK(f.world.count<OffboardControl>() == before);
  const auto first = f.reported.find("fcu_serial.command_not_finite");
  REQUIRE(first != std::string::npos);
  CHECK(f.reported.find("fcu_serial.command_not_finite", first + 1) == std::string::npos);
  CHECK(std::isfinite(f.world.fcu.outputs()[4]));
}

TEST_CASE("auxiliary outputs and attitude are sent when they are wired and wanted") {
  Flying f;
  f.fly(0.5);
  AuxOutputs aux;
  aux.kinds[10] = AuxKind::servo;
  aux.values_ratio[10] = -0.5;
  f.bench.set(f.bench.in.aux, aux);
  f.tick();
  CHECK(f.world.last<RosflightAuxCmd>().aux_cmd_array[10] == -0.5f);
  CHECK(f.world.last<RosflightAuxCmd>().type_array[10] == 1);
  VehicleState state;
  state.attitude = {0.9659258, 0.2588190, 0, 0};
  state.attitude_valid = true;
  f.bench.set(f.bench.in.state, state);
  f.bench.write();
  CHECK(f.world.count<ExternalAttitude>() == 0);
  f.bench.params.send_attitude.value = true;
  f.bench.retune();
  f.bench.set(f.bench.in.state, state);
  f.bench.write();
  REQUIRE(f.world.count<ExternalAttitude>() == 1);
  CHECK(f.world.last<ExternalAttitude>().qx == Approx(0.2588190));
  const auto before = f.world.count<RosflightAuxCmd>();
  f.fly(3);
  CHECK(f.world.count<RosflightAuxCmd>() - before >= 2);
}

TEST_CASE("no tick allocates") {
  Flying f;
  f.arm();
  f.ticks_ns.reserve(10000);
  f.imu_ns.reserve(10000);
  f.world.sent.reserve(10000);
  f.world.sent_ns.reserve(10000);
  // The simulated controller allocates: only the vehicle's own calls are counted.
  std::uint64_t made = 0;
  for (int i = 0; i < 400; ++i) {
    f.world.run(f.world.now_ns + 2'500'000, true);
    if (i == 100) f.world.happen(LinkEvent::rebooted);
    if (i == 200) f.world.fcu.inputs.rc_us[5] = 2000;
    f.bench.set(f.bench.in.actuators, f.command);
    f.world.passes = false;  // the wire's own vectors would count
    made += allocations([&] {
      f.bench.read();
      f.bench.write();
    });
    f.world.passes = true;
  }
  CHECK(made == 0);
}

TEST_CASE("the last frame is the failsafe, whole, on the device that is there") {
  Flying f;
  f.fly(0.5);
  Bench<TestVehicle>& bench = f.bench;
  bench.set(bench.in.actuators, Actuators{0, 0, 0.25, 0});
  const fulmar_last_frame* frame = bench.component().last_frame(bench.in);
  REQUIRE(frame);
  CHECK(frame->fd == 7);
  CHECK(frame->size == 51);
  Parser parser;
  int found = 0;
  parser.feed({frame->data, frame->size}, [&](const Packet& p) {
    ++found;
    CHECK(p.as<OffboardControl>().u[4] == 0.5f);
  });
  CHECK(found == 1);
  f.world.plugged = false;
  f.tick();
  CHECK(frame->fd == -1);
  f.world.plugged = true;
  f.tick();
  CHECK(frame->fd == 7);
}

TEST_CASE("a host that starts again in the air takes over an armed controller") {
  Flying f;
  f.arm();
  REQUIRE(f.bench.configure() == Status::ok);
  f.ticks_ns.clear();
  f.fly(0.5);
  CHECK(f.ticks_ns.front() == 0);
  CHECK(f.status.armed);
  CHECK(f.status.in_control);
  CHECK(f.heard("fcu_serial.connected_armed"));
}

TEST_CASE("a lossy line is greeted all the same") {
  Flying f;
  int n = 0;
  f.world.lost = [&n](const Packet& p) { return p.is<RosflightVersion>() && n++ == 0; };
  f.fly(0.5);
  CHECK(f.heard("fcu_serial.connected(v2.0.1"));
}

TEST_CASE("a surface that is reversed in both places is a warning") {
  Flying f;
  f.world.fcu.params().set(peer::param("REV_ELEVATOR"), 1);
  f.bench.params.airframe.value.elevator.reversed = true;
  f.world.fcu.params().set(peer::param("REV_AILERON"), 1);
  f.fly(0.5);
  CHECK(f.heard("fcu_serial.reversed_twice(REV_ELEVATOR)"));
  CHECK_FALSE(f.heard("REV_AILERON"));
}

}  // namespace vehicle_test
