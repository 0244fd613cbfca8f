// SPDX-License-Identifier: BSD-3-Clause
// A failure of the aircraft or its air data is reported once, under its name; a flight without failures has
// no report.
#include "plugins/safety/aircraft_watch.hpp"

#include <string>
#include <vector>

#include "kit.hpp"

namespace aircraft_watch_test {

using namespace fulmar;
using namespace fulmar::safety;
using kit::deg;

namespace {

struct Watching {
  Bench<AircraftWatch> bench;
  VehicleState state = kit::level();
  VehicleStatus status;
  Actuators actuators;
  AttitudeCommand asked;
  GroundState ground;
  std::vector<Notice> reported;

  Watching() {
    kit::give_anaconda(bench.params);
    ground.contact = Contact::air;
    status.armed = status.in_control = true;
    status.battery_volt = test::anaconda().propulsion.battery_volt;
    actuators.throttle_frac = 0.57;
  }
  void fly(double seconds) {
    constexpr double dt = 0.02;
    for (int i = 0; i < static_cast<int>(seconds / dt + 0.5); ++i) {
      bench.set(bench.in.state, state);
      bench.set(bench.in.status, status);
      bench.set(bench.in.actuators, actuators);
      bench.set(bench.in.attitude, asked);
      bench.set(bench.in.ground, ground);
      REQUIRE(bench.step(dt) == Status::ok);
      for (std::uint32_t n = 0; n < bench.out.notices.count; ++n)
        reported.push_back(bench.out.notices.items[n]);
    }
  }
  int count(Severity severity, const char* word) const {
    int n = 0;
    for (const Notice& each : reported)
      n += each.severity == severity && each.text.view().find(word) != std::string_view::npos ? 1 : 0;
    return n;
  }
};

}  // namespace

TEST_CASE("level flight in order reports nothing, for minutes") {
  Watching w;
  w.fly(200);
  CHECK(w.reported.empty());
}

TEST_CASE("a bank that stays off its command is reported after a second, either side, and its end") {
  for (const double side : {-1.0, 1.0}) {
    Watching w;
    w.state.roll_rad = side * 4 * deg;
    w.asked.roll_rad = side * 30 * deg;
    w.fly(0.9);
    CHECK(w.reported.empty());
    w.fly(0.2);
    CHECK(w.count(Severity::critical, "safety.bank_off(26)") == 1);
    w.asked.roll_rad = side * 13 * deg;  // more than half of the 15 deg
    w.fly(10);
    CHECK(w.reported.size() == 1);
    w.asked.roll_rad = side * 10 * deg;
    w.fly(2.9);
    CHECK(w.reported.size() == 1);
    w.fly(0.2);
    CHECK(w.count(Severity::info, "safety.bank_follows") == 1);
  }
}

TEST_CASE("a bank that closes on its command is a turn that begins, one that goes away from it is not") {
  for (const double side : {-1.0, 1.0}) {
    Watching w;
    w.asked.roll_rad = side * 40 * deg;
    w.state.rate_radps.x = side * 0.2;
    w.fly(1.9);
    CHECK(w.reported.empty());
    w.fly(0.3);  // 2 s off the command are no turn that begins
    CHECK(w.count(Severity::critical, "safety.bank_off(") == 1);
    Watching away;
    away.asked.roll_rad = side * 40 * deg;
    away.state.rate_radps.x = -side * 0.2;
    away.fly(1.1);
    CHECK(away.count(Severity::critical, "safety.bank_off(") == 1);
  }
}

TEST_CASE("an aircraft that rolls on and on is reported, though half of the way it closes") {
  Watching w;
  for (double roll = 0; roll < 4 * 360; roll += 4) {  // 200 deg/s
    w.state.roll_rad = wrap_pi(roll * deg);
    w.state.rate_radps.x = 200 * deg;
    w.fly(0.02);
  }
  CHECK(w.count(Severity::critical, "safety.bank_off(") == 1);
}

TEST_CASE("the rates of bank and pitch are those of the Euler angles, in a steep turn too") {
  // In a level turn at 60 deg of bank the body pitches and yaws, and neither angle changes.
  Watching turn;
  const double roll = 60 * deg, rate = 9.80665 * std::tan(roll) / 17;
  turn.state.roll_rad = turn.asked.roll_rad = roll;
  turn.state.rate_radps = {0, rate * std::sin(roll), rate * std::cos(roll)};
  turn.asked.pitch_rad = 20 * deg;
  turn.fly(1.1);
  CHECK(turn.count(Severity::critical, "safety.pitch_off(20)") == 1);
  CHECK(turn.reported.size() == 1);
  // With the nose at 40 deg the same turn takes a roll rate of -rate sin(pitch) to hold the bank.
  Watching climb;
  const double pitch = 40 * deg;
  climb.state.pitch_rad = climb.asked.pitch_rad = pitch;
  climb.state.roll_rad = -roll;
  climb.asked.roll_rad = -roll + 20 * deg;
  climb.state.rate_radps = {rate * std::sin(pitch), rate * std::cos(pitch) * std::sin(roll),
                            -rate * std::cos(pitch) * std::cos(roll)};
  climb.fly(1.1);
  CHECK(climb.count(Severity::critical, "safety.bank_off(20)") == 1);
  CHECK(climb.reported.size() == 1);
}

TEST_CASE(
    "nothing is reported of commands that move nothing: on the ground, by the pilot, without attitude") {
  Watching ground, pilot, blind;
  for (Watching* w : {&ground, &pilot, &blind}) {
    w->asked.pitch_rad = 30 * deg;
    w->asked.roll_rad = 40 * deg;
  }
  ground.ground.contact = Contact::ground;
  pilot.status.in_control = false;
  blind.state.attitude_valid = false;
  for (Watching* w : {&ground, &pilot, &blind}) {
    w->fly(20);
    CHECK(w->reported.empty());
  }
  pilot.status.in_control = true;  // the second counts from the hand-over
  pilot.fly(0.9);
  CHECK(pilot.reported.empty());
  pilot.fly(0.2);
  CHECK(pilot.reported.size() == 2);
}

TEST_CASE("what comes and goes is reported once in 30 s") {
  Watching w;
  for (int i = 0; i < 5; ++i) {
    w.asked.roll_rad = 30 * deg;
    w.fly(2);
    w.asked.roll_rad = 0;
    w.fly(4);
  }
  CHECK(w.count(Severity::critical, "safety.bank_off(") == 1);
  w.fly(30);
  w.asked.roll_rad = 30 * deg;
  w.fly(2);
  CHECK(w.count(Severity::critical, "safety.bank_off(") == 2);
}

TEST_CASE("a motor without thrust and a weak one have their names, and a Monitor's are left to it") {
  for (const bool monitored : {false, true}) {
    // The airframe's own polar, and the brake of a propeller that stands: as much again.
    const Airframe a = test::anaconda();
    const double rho = standard_air(test::FlightModel::field_m + 70).density_kgm3, mg = a.mass_kg * isa::g0;
    const double sink = 2 * 17 * turn_trim(a, 0, 17, rho).drag_newton / mg;
    Watching dead, weak;
    dead.bench.params.monitored.value = weak.bench.params.monitored.value = monitored;
    dead.state.climb_rate_mps = -sink;
    weak.state.climb_rate_mps = 0;
    dead.actuators.throttle_frac = weak.actuators.throttle_frac = 1;
    dead.fly(10);
    weak.fly(20);
    CHECK(dead.count(Severity::critical, "safety.engine_failed") == (monitored ? 0 : 1));
    CHECK(weak.count(Severity::warning, "safety.engine_weak(") == (monitored ? 0 : 1));
    CHECK(dead.reported.size() == (monitored ? 0U : 1U));
  }
}

TEST_CASE("a battery that fades is low at 0.83 of its voltage and empty at 0.75") {
  Watching w;
  const double full = w.status.battery_volt;
  w.status.battery_volt = 0.84 * full;
  w.fly(10);
  CHECK(w.reported.empty());
  w.status.battery_volt = 0.82 * full;
  w.fly(3.1);
  CHECK(w.count(Severity::warning, "safety.battery_low(") == 1);
  w.status.battery_volt = 0.74 * full;
  w.fly(3.1);
  CHECK(w.count(Severity::critical, "safety.battery_empty(") == 1);
  CHECK(w.reported.size() == 2);
}

TEST_CASE("wind above 0.6 of the cruise airspeed is reported from every side") {
  const double limit = 0.6 * test::anaconda().limits.airspeed_cruise_mps;
  for (const double to : {0.3, 1.9, 3.5, 5.1}) {
    Watching below, above;
    below.state.wind_mps = {0.95 * limit * std::cos(to), 0.95 * limit * std::sin(to), 0};
    above.state.wind_mps = {1.05 * limit * std::cos(to), 1.05 * limit * std::sin(to), 0};
    below.fly(30);
    above.fly(12);
    CHECK(below.reported.empty());
    CHECK(above.count(Severity::warning, "safety.wind_excessive(") == 1);
    above.state.wind_valid = false;  // invalid: neither above nor below
    above.state.wind_mps = {};
    above.fly(60);
    CHECK(above.reported.size() == 1);
  }
}

}  // namespace aircraft_watch_test
