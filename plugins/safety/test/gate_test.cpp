// SPDX-License-Identifier: BSD-3-Clause
// Conditions that prevent a take-off.
#include "plugins/safety/gate.hpp"

#include "watch.hpp"

namespace gate_test {

using namespace fulmar;
using namespace fulmar::safety;
using kit::Stands;

namespace {

unsigned causes(const NotReady& n) {
  return static_cast<unsigned>(n.estimator) + n.position + n.pitot + n.radio + n.battery + n.wind + n.fence +
         n.height + n.motor;
}

/// Checks that after 8 s with one fault its condition is missing, and no other one.
void refuses(bool NotReady::*cause, const char* words, const std::function<void(Stands&)>& spoil) {
  Stands w;
  w.fence();
  spoil(w);
  w.fly(30);
  CAPTURE(words);
  CHECK_FALSE(w.out.safety.ready);
  CHECK(w.out.safety.not_ready.*cause);
  CHECK(causes(w.out.safety.not_ready) == 1);
  CHECK_MESSAGE(w.reported_of(words), w.reported);
  CHECK(w.reported.find('-') == std::string::npos);
  CHECK(std::count(w.reported.begin(), w.reported.end(), '\n') <= 2);  // the cause itself, and the list once
}

}  // namespace

TEST_CASE("an aircraft in order is ready at once, and no line is said of it") {
  Stands w;
  w.fence();
  CHECK(w.fly(0.1).ready);
  CHECK(w.fly(30).ready);
  CHECK(causes(w.out.safety.not_ready) == 0);
  CHECK(w.reported == "");
  CHECK(w.out.safety.fence_margin_m == doctest::Approx(1000));
  CHECK(w.out.safety.height_margin_m == doctest::Approx(120));
  w.ground.contact = Contact::air;
  CHECK_FALSE(w.fly(3).ready);  // of the ground alone
}

TEST_CASE("each thing that is wrong on the ground is refused by its name, once") {
  refuses(&NotReady::fence, "safety.not_ready(safety.outside_fence(300))",
          [](Stands& w) { w.state.position_m.north = 1300; });
  refuses(&NotReady::fence, "safety.not_ready(safety.near_fence(0))",
          [](Stands& w) { w.state.position_m.east = -1000; });
  refuses(&NotReady::fence, "safety.not_ready(safety.near_fence(14))",
          [](Stands& w) { w.state.position_m.east = 986; });
  refuses(&NotReady::height, "safety.not_ready(safety.above_ceiling(12))",
          [](Stands& w) { w.state.height_m = 132; });
  refuses(&NotReady::height, "safety.not_ready(safety.near_ceiling(10))",
          [](Stands& w) { w.state.height_m = 110; });
  refuses(&NotReady::pitot, "safety.not_ready(safety.pitot_missing)",
          [](Stands& w) { w.health.pitot.state = SensorState::stuck; });
  refuses(&NotReady::pitot, "safety.not_ready(safety.pitot_missing)",
          [](Stands& w) { w.health.pitot.state = SensorState::silent; });
  refuses(&NotReady::position, "safety.not_ready(safety.position_missing)",
          [](Stands& w) { w.state.position_valid = false; });
  refuses(&NotReady::position, "safety.not_ready(safety.position_missing)",
          [](Stands& w) { w.health.gnss_position.state = SensorState::silent; });
  refuses(&NotReady::estimator, "safety.not_ready(safety.estimate_missing)",
          [](Stands& w) { w.state.attitude_valid = false; });
  refuses(&NotReady::radio, "safety.not_ready(safety.radio_missing)",
          [](Stands& w) { w.params.radio.radio_required.value = true; });
  refuses(&NotReady::battery, "safety.not_ready(safety.battery_missing)",
          [](Stands& w) { w.status.battery_frac = 0.2; });
  refuses(&NotReady::wind, "safety.not_ready(safety.wind_strong(10))",
          [](Stands& w) { w.state.airspeed_mps = 10; });
  refuses(&NotReady::wind, "safety.not_ready(safety.wind_strong(", [](Stands& w) {
    w.state.wind_mps = {6.6, -8.8, 0};
    w.state.wind_valid = true;
  });
}

TEST_CASE("a lull is no end of the wind: below four fifths of the limit it is ready again") {
  Stands w;
  w.state.airspeed_mps = 10;
  CHECK_FALSE(w.fly(30).ready);
  w.state.airspeed_mps = 7.6;
  CHECK_FALSE(w.fly(60).ready);
  w.state.airspeed_mps = 7.2;
  CHECK(w.fly(60).ready);
}

TEST_CASE("a head wind that rolls the aircraft backwards stays the wind that it is") {
  Stands w;
  w.state.airspeed_mps = 10;
  w.fly(20);
  w.state.ground_speed_mps = 3;
  w.state.velocity_mps.north = -3;
  w.state.airspeed_mps = 7;
  CHECK_FALSE(w.fly(30).ready);
}

TEST_CASE("tail wind is found in the take-off run: less airspeed than ground speed") {
  for (const double tail : {9.0, 10.0}) {
    Stands w;
    w.fly(10);
    w.actuators.throttle_frac = 1;
    for (double speed = 0; speed < 12; speed += 0.08) {
      w.state.ground_speed_mps = w.state.velocity_mps.north = speed;
      w.state.airspeed_mps = std::max(speed - tail, 0.0);
      w.fly(0.02);
    }
    CHECK(w.out.safety.not_ready.wind == (tail > 9.35));
    w.state.ground_speed_mps = w.state.velocity_mps.north = w.state.airspeed_mps =
        0;  // standing, the pitot does not show it
    CHECK(w.fly(30).not_ready.wind == (tail > 9.35));
    CHECK(w.reported_of("safety.not_ready(safety.tail_wind)") == (tail > 9.35));
    w.status.in_control = false;
    CHECK_FALSE(w.fly(1).not_ready.wind);
  }
}

TEST_CASE("what is allowed: no tube, no radio, wind below 0.55 of the cruise speed, 16 m to the fence") {
  Stands w;
  w.fence();
  w.health.pitot.state = SensorState::never;
  w.state.airspeed_mps = 9;
  w.state.position_m.east = 984;
  CHECK(w.fly(30).ready);
}

TEST_CASE("a motor that does not move the aircraft at open throttle is not ready until a hand-over") {
  Stands w;
  w.actuators.throttle_frac = 1;
  CHECK(w.fly(2.9).ready);
  CHECK_FALSE(w.fly(0.2).ready);
  CHECK(w.out.safety.not_ready.motor);
  w.actuators.throttle_frac = 0;
  CHECK_FALSE(w.fly(10).ready);
  CHECK(w.reported_of("safety.not_ready(flight.engine_failed)"));
  w.status.in_control = false;
  w.fly(0.1);
  w.status.in_control = true;
  CHECK(w.fly(10).ready);
  CHECK(w.reported_of("safety.ready"));
  Stands rolls;
  rolls.actuators.throttle_frac = 1;
  rolls.fly(1);
  rolls.state.ground_speed_mps = rolls.state.velocity_mps.north = 2;
  CHECK(rolls.fly(10).ready);
  Stands pilot;  // the throttle is not the pilot's
  pilot.actuators.throttle_frac = 1;
  pilot.status.in_control = false;
  CHECK(pilot.fly(10).ready);
}

TEST_CASE("a list that flaps is not said more often than every 5 s") {
  Stands w;
  for (int i = 0; i < 20; ++i) {
    w.state.position_valid = i % 2 == 0;
    w.fly(2.5);
  }
  CHECK(std::count(w.reported.begin(), w.reported.end(), '\n') <= 20);
  Stands fast;
  for (int i = 0; i < 100; ++i) {
    fast.state.position_valid = i % 2 == 0;
    fast.fly(0.5);
  }
  CHECK(fast.reported == "");
}

TEST_CASE("contact with the ground decides what flies; a landing answers nothing whatever fails") {
  Stands w;
  w.status.on_ground = false;
  w.status.battery_frac = 0.05;
  CHECK(w.fly(5).answer == SafetyAnswer::none);
  CHECK_FALSE(w.out.safety.airborne);
  w.ground.contact = Contact::unknown;
  CHECK_FALSE(w.fly(5).airborne);
  w.ground.contact = Contact::air;
  CHECK(w.fly(2).answer == SafetyAnswer::glide);
  w.ground.contact = Contact::unknown;
  CHECK(w.fly(5).airborne);
  w.ground.landed = true;
  w.state.position_valid = false;
  w.ground.contact = Contact::air;  // a nose that is lifted by hand
  CHECK(w.fly(10).answer == SafetyAnswer::none);
}

TEST_CASE(
    "without contact an armed aircraft that stands does not fly, whatever its status says of the ground") {
  Stands w;
  w.has_ground = false;
  w.status.on_ground = false;
  w.status.battery_frac = 0.05;
  CHECK(w.fly(10).answer == SafetyAnswer::none);
  w.state.ground_speed_mps = 17;
  CHECK(w.fly(3).answer == SafetyAnswer::glide);
  Stands hovers;  // against as much wind
  hovers.has_ground = false;
  hovers.state.airspeed_mps = 17;
  CHECK(hovers.fly(3).airborne);
}

}  // namespace gate_test
