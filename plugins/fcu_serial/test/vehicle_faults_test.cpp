// SPDX-License-Identifier: BSD-3-Clause
// The vehicle with the software flight controller, in virtual time: faults.
#include "flying.hpp"

namespace vehicle_faults_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;
using doctest::Approx;

TEST_CASE("the pilot takes over and hands back, and both are told") {
  Flying f;
  f.arm();
  f.world.fcu.inputs.rc_us[5] = 2000;
  f.fly(0.3);
  CHECK(f.status.override);
  CHECK_FALSE(f.status.in_control);
  CHECK(f.heard("fcu_serial.pilot_flies(fcu_serial.attitude_switch, fcu_serial.throttle_switch)"));
  f.world.fcu.inputs.rc_us[5] = 1000;
  f.fly(1.5);
  CHECK(f.heard("fcu_serial.pilot_hands_over"));
  CHECK(f.status.in_control);
}

TEST_CASE("the radio's frames stop: the controller says nothing, the vehicle does") {
  Flying f;
  f.arm();
  f.world.fcu.inputs.rc_frames = false;
  f.fly(1);
  CHECK_FALSE(f.status.failsafe);
  CHECK_FALSE(f.status.in_control);
  CHECK(f.status.rc_age_s == Approx(1).epsilon(0.15));
  CHECK_FALSE(f.rc.link);
  CHECK(f.heard("fcu_serial.radio_frozen"));
  f.world.fcu.inputs.rc_frames = true;
  f.fly(1.5);
  CHECK(f.status.in_control);
  CHECK(f.rc.link);
  CHECK(f.heard("fcu_serial.radio_back"));
}

TEST_CASE("the radio is lost by its flag: failsafe") {
  Flying f;
  f.arm();
  f.world.fcu.inputs.rc_lost = true;
  f.fly(0.5);
  CHECK(f.status.failsafe);
  CHECK_FALSE(f.status.in_control);
  CHECK(f.heard("fcu_serial.failsafe_entered"));
  f.world.fcu.inputs.rc_lost = false;
  f.fly(1.5);
  CHECK_FALSE(f.status.failsafe);
  CHECK(f.heard("fcu_serial.failsafe_over"));
}

TEST_CASE("unplugged for 5 s: ticks go on every 10 ms, nothing is published as new, and it is told") {
  Flying f;
  f.arm();
  const std::size_t ticks = f.ticks_ns.size(), samples = f.imu_ns.size();
  f.world.plugged = false;
  f.world.happen(LinkEvent::disconnected);
  f.fly(5);
  CHECK(static_cast<double>(f.ticks_ns.size() - ticks) == Approx(500).epsilon(0.02));
  CHECK(f.imu_ns.size() - samples <= 1);
  CHECK(f.status.armed);
  CHECK_FALSE(f.status.in_control);
  CHECK(f.status.health == Health::failed);
  CHECK((f.status.errors & own_error_link_down) != 0);
  CHECK(f.heard("fcu_serial.device_gone"));
  CHECK(f.tick() == Status::degraded);
  f.world.plugged = true;
  f.world.happen(LinkEvent::connected);
  f.fly(2);
  CHECK(f.heard("fcu_serial.controller_back(5."));
  CHECK_FALSE(f.heard("fcu_serial.radio_"));
  CHECK(f.status.in_control);
  CHECK(f.status.health == Health::ok);
  for (std::size_t i = 1; i < f.ticks_ns.size(); ++i) REQUIRE(f.ticks_ns[i] > f.ticks_ns[i - 1]);
}

TEST_CASE("a gap of 100 ms is counted and takes nothing away") {
  Flying f;
  f.arm();
  f.world.cut = true;
  f.fly(0.1);
  f.world.cut = false;
  f.fly(0.3);
  CHECK(f.status.in_control);
  CHECK_FALSE(f.heard("fcu_serial.controller_silent"));
  f.fly(0.2);
  CHECK(f.bench.out.link.value.worst_gap_s == Approx(0.1).epsilon(0.1).scale(0));
  CHECK(f.bench.out.link.value.imu_gaps == 1);
}

TEST_CASE("a reboot in flight is told, and the airspeed that it has zeroed is not believed") {
  Flying f;
  f.arm();
  f.world.fcu.reboot(f.world.now_ns / 1000);
  f.world.happen(LinkEvent::rebooted);
  f.fly(1);
  CHECK(f.heard("fcu_serial.rebooted_armed"));
  CHECK_FALSE(f.heard("fcu_serial.pilot_flies"));  // reported by its first status, of a disarmed aircraft
  CHECK(f.heard("fcu_serial.pitot_zeroed_in_flight"));
  CHECK_FALSE(f.status.in_control);
  const int before = f.published["pitot"], baro = f.published["baro"];
  f.fly(1);
  CHECK(f.published["pitot"] == before);
  CHECK(f.published["baro"] > baro);
}

TEST_CASE("a pitot tube that was zeroed in the wind or in the air is not used by a host that begins later") {
  for (const float pascal : {177.f, -31.f, std::numeric_limits<float>::quiet_NaN()}) {
    CAPTURE(pascal);
    Flying f;
    f.world.fcu.params().set(peer::param("DIFF_PRESS_BIAS"), pascal);
    f.world.fcu.write_flash();
    f.world.fcu.reboot(0);
    f.fly(4);
    CHECK(f.published["pitot"] == 0);
    CHECK(f.heard(std::isnan(pascal) ? "fcu_serial.pitot_zero_wrong" : "fcu_serial.pitot_zero_off("));
  }
  for (const float pascal : {29.f, -29.f, 0.f}) {
    CAPTURE(pascal);
    Flying f;
    f.world.fcu.params().set(peer::param("DIFF_PRESS_BIAS"), pascal);
    f.world.fcu.write_flash();
    f.world.fcu.reboot(0);
    f.fly(4);
    CHECK(f.published["pitot"] > 300);
    CHECK_FALSE(f.heard("fcu_serial.pitot_"));
    CHECK_FALSE(f.heard("fcu_serial.values_implausible"));
  }
}

TEST_CASE(
    "a pitot tube that is zeroed wrong while the host runs is used no more, and again when it is right") {
  Flying f;
  f.world.fcu.inputs.pitot_pa = 177;  // 17 m/s: the controller has rebooted undetected
  f.fly(6);
  CHECK(f.published["pitot"] > 500);
  f.fly(6);  // zeroed 10 s after its boot
  CHECK(f.heard("fcu_serial.pitot_zero_off(177)"));
  int before = f.published["pitot"];
  f.fly(1);
  CHECK(f.published["pitot"] == before);
  CHECK(f.bench.out.link.value.pitot_zeroed == false);  // the controller stores it
  f.world.fcu.params().set(peer::param("DIFF_PRESS_BIAS"), 3.f);
  f.fly(1);
  CHECK(f.heard("fcu_serial.pitot_used_again"));
  before = f.published["pitot"];
  f.fly(1);
  CHECK(f.published["pitot"] - before > 90);
}

TEST_CASE("another limit suits a sensor with a large offset of its own") {
  Flying f;
  f.bench.params.pitot_zero_limit.value = 100;
  f.world.fcu.params().set(peer::param("DIFF_PRESS_BIAS"), 70.f);
  f.world.fcu.write_flash();
  f.world.fcu.reboot(0);
  f.fly(4);
  CHECK(f.published["pitot"] > 300);
}

TEST_CASE("that the pitot was zeroed by a reboot in flight is told to who resumes, and is not used by it") {
  {
    Flying f;
    f.arm();
    CHECK_FALSE(f.bench.out.link.value.pitot_zeroed);
    f.world.fcu.reboot(f.world.now_ns / 1000);
    f.world.happen(LinkEvent::rebooted);
    f.fly(0.3);
    CHECK(f.bench.out.link.value.pitot_zeroed);
  }
  Flying later;
  later.fly(1);
  const int before = later.published["pitot"];
  CHECK(before > 90);
  later.bench.params.pitot_zeroed.value = 1;
  later.bench.retune();  // as the mission's `resume` sets it
  later.fly(1);
  CHECK(later.published["pitot"] == before);
  CHECK(later.heard("fcu_serial.pitot_zeroed_in_flight"));
  CHECK(later.bench.out.link.value.pitot_zeroed);
}

TEST_CASE("a reboot on the ground is told, and that is all") {
  Flying f;
  f.fly(2);
  f.world.fcu.reboot(f.world.now_ns / 1000);
  f.world.happen(LinkEvent::rebooted);
  f.fly(2);
  CHECK(f.heard("fcu_serial.rebooted\n"));
  const int before = f.published["pitot"];
  f.fly(1);
  CHECK(f.published["pitot"] - before > 90);
}

TEST_CASE("a sensor that gives nonsense is silent, counted, and told once") {
  Flying f;
  f.fly(1);
  const int before = f.published["mag"];
  f.world.fcu.inputs.mag = {21000, 0, 46000};
  f.fly(1);
  CHECK(f.published["mag"] - before <= 1);
  const auto first = f.reported.find("fcu_serial.values_implausible(magnetometer)");
  REQUIRE(first != std::string::npos);
  CHECK(f.reported.find("(magnetometer)", first + 40) == std::string::npos);
  CHECK(f.bench.out.link.value.unusable > 80);
}

TEST_CASE("samples that waited too long are passed over; a burst of a few is flown sample by sample") {
  Flying f;
  f.fly(1);
  const std::size_t samples = f.imu_ns.size(), ticks = f.ticks_ns.size();
  f.world.run(f.world.now_ns + 10'000'000, false);  // the host slept: four samples wait
  f.tick();
  f.tick();
  f.tick();
  f.tick();
  CHECK(f.imu_ns.size() - samples == 4);
  CHECK(f.ticks_ns.size() - ticks == 4);
  f.world.run(f.world.now_ns + 2'000'000'000, false);  // two seconds
  f.tick();
  CHECK(f.world.now_ns - f.world.queue.front().arrived_ns < 60'000'000);
}

TEST_CASE("a fix that comes twice is one fix") {
  Flying f;
  f.fly(1);
  RosflightGnss fix;
  fix.fix_type = 3;
  fix.rosflight_timestamp = 77;
  const int before = f.published["gnss"];
  f.world.inject(fix);
  f.tick();
  f.world.inject(fix);
  f.tick();
  CHECK(f.published["gnss"] - before == 1);
}

TEST_CASE("what cannot be flown is refused by configure, within 5 s") {
  const auto refusal = [](World& world, std::function<void(Bench<TestVehicle>&)> change = {}) {
    Bench<TestVehicle> bench;
    bench.params.airframe.is_given = true;
    if (change) change(bench);
    CHECK(bench.configure() == Status::failed);
    CHECK(world.now_ns <= 5'000'000'000);
    return bench.error();
  };
  SUBCASE("silence") {
    World world;
    world.cut = true;
    CHECK(refusal(world) == "fcu_serial.device_silent(/dev/ttyACM0)");
  }
  SUBCASE("an old firmware") {
    peer::Options o;
    o.version = "v1.3.1";
    World world(o);
    world.fcu.provision();
    CHECK(refusal(world) == "fcu_serial.firmware_too_old(/dev/ttyACM0, v1.3.1)");
  }
  SUBCASE("one that does not say its version") {
    peer::Options o;
    o.answers = false;
    World world(o);
    world.fcu.provision();
    CHECK(refusal(world) == "fcu_serial.version_missing(/dev/ttyACM0)");
  }
  SUBCASE("a multirotor") {
    World world;
    CHECK(refusal(world) == "fcu_serial.not_fixed_wing(/dev/ttyACM0)");
  }
  SUBCASE("no port") {
    World world;
    CHECK(refusal(world, [](auto& bench) { bench.params.port.value = ""; }) == "fcu_serial.port_unset");
  }
  SUBCASE("an airframe without throws") {
    World world;
    CHECK(refusal(world, [](auto& bench) { bench.params.airframe.value.aileron.limit_rad = 0; }) ==
          "airframe.aileron.limit: fcu_serial.throw_too_small(aileron, 0)");
  }
}

TEST_CASE("a firmware that was not tried is told once at the start, and when it takes another's place") {
  for (const char* version : {"v3.1.0-4-g1234567", "1234567"}) {
    CAPTURE(version);
    peer::Options options;
    options.version = version;
    Flying f(options);
    REQUIRE(f.bench.configure() == Status::ok);
    f.fly(3);
    const std::string untried = std::string("fcu_serial.firmware_untried(2.0.1, ") + version + ")";
    CHECK(f.heard(untried.c_str()));
    f.reported.clear();
    f.fly(20);
    CHECK_FALSE(f.heard("fcu_serial.firmware_untried"));
  }
  Flying tried;
  REQUIRE(tried.bench.configure() == Status::ok);
  tried.fly(3);
  CHECK_FALSE(tried.heard("fcu_serial.firmware_untried"));
  RosflightVersion other;
  std::copy_n("v2.1.0", 6, other.version.begin());
  tried.world.inject(other);
  tried.fly(0.1);
  CHECK(tried.heard("fcu_serial.firmware_untried(2.0.1, v2.1.0)"));
}

TEST_CASE("its inertial unit dies: the loop goes on, and it is told") {
  Flying f;
  f.arm();
  f.world.fcu.inputs.imu_works = false;
  const std::size_t ticks = f.ticks_ns.size();
  f.fly(1);
  CHECK(static_cast<double>(f.ticks_ns.size() - ticks) == Approx(100).epsilon(0.05));
  CHECK_FALSE(f.status.in_control);
  CHECK(f.heard("fcu_serial.imu_silent") !=
        f.heard("fcu_serial.controller_silent"));  // its other messages are not checked
}

TEST_CASE("another controller in its place is noticed: its firmware, its parameters") {
  Flying f;
  f.fly(1);
  RosflightVersion version;
  std::copy_n("v2.1.0", 7, version.version.begin());
  f.world.inject(version);
  ParamValue p;
  std::copy_n("RC_X_CHN", 8, p.param_id.begin());
  p.param_type = param_int32;
  p.param_value = 3;
  f.world.inject(p);
  f.world.inject(p);
  f.fly(0.1);
  CHECK(f.heard("fcu_serial.firmware_changed(v2.1.0)"));
  const auto first = f.reported.find("fcu_serial.param_changed(RC_X_CHN, 3)");
  REQUIRE(first != std::string::npos);
  CHECK(f.reported.find("RC_X_CHN", first + 30) == std::string::npos);
  f.world.fcu.inputs.rc_us[3] = 2000;
  f.fly(0.1);
  CHECK(f.rc.roll_frac == 1);
}

TEST_CASE("a controller that comes back is asked for its version") {
  Flying f;
  f.fly(1);
  const auto before = f.world.count<RosflightCmd>();
  f.world.happen(LinkEvent::connected);
  f.fly(0.1);
  CHECK(f.world.count<RosflightCmd>() == before + 1);
  CHECK_FALSE(f.heard("fcu_serial.firmware_changed"));
}

TEST_CASE(
    "after a reboot the controller's attitude begins anew, and is not passed on before it has settled") {
  Flying f;
  f.arm();
  f.world.happen(LinkEvent::rebooted);
  f.fly(0.1);
  const int before = f.published["attitude"];
  REQUIRE(before > 0);
  f.fly(2.5);
  CHECK(f.published["attitude"] == before);
  f.fly(1);
  CHECK(f.published["attitude"] > before);
}

TEST_CASE("after a reboot a sample counts however it is dated beside those before") {
  Flying f;
  f.fly(1);
  const std::int64_t last_ns = f.imu_ns.back();
  const std::size_t n = f.imu_ns.size();
  SmallImu sample;
  sample.zacc = -9.8f;
  sample.temperature = 300;
  SUBCASE("but without one a sample that is dated before the last is left out") {
    f.world.inject(sample, 200'000'000);
    f.tick();
    CHECK(f.imu_ns.back() > last_ns);
  }
  SUBCASE("it is published") {
    f.world.happen(LinkEvent::rebooted);
    f.world.inject(sample, 200'000'000);
    f.tick();
    REQUIRE(f.imu_ns.size() == n + 1);
    CHECK(f.imu_ns.back() < last_ns);
  }
}

}  // namespace vehicle_faults_test
