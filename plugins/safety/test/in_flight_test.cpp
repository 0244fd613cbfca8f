// SPDX-License-Identifier: BSD-3-Clause
// Source of the commands, flight with a weak motor, and largest time of a circle without a position.
#include "watch.hpp"

namespace in_flight_test {

using namespace fulmar;
using namespace fulmar::safety;
using kit::Watch;

namespace {

/// Sinks as without thrust while its commands do not reach it.
void descends_unobeyed(Watch& w, double seconds) {
  w.status.in_control = false;
  w.state.climb_rate_mps = -7.1;
  w.fly(seconds);
  w.status.in_control = true;
}

}  // namespace

TEST_CASE("commands that did not move the aircraft say nothing of its motor") {
  Watch w;
  w.fly(3);
  descends_unobeyed(w, 30);
  CHECK_FALSE(w.out.safety.engine_failed);
  w.state.climb_rate_mps = 0;
  CHECK_FALSE(w.fly(10).engine_failed);  // nor the pilot's commands, after the hand-back
  CHECK(w.reported.find("flight.engine_") == std::string::npos);
}

TEST_CASE("an alarm of the motor ends with a hand-over, and comes again when the motor is dead") {
  Watch w;
  w.fly(3);
  w.state.climb_rate_mps = -7.1;
  CHECK(w.raised_after(&SafetyState::engine_failed) > 0);
  w.actuators.throttle_frac = 0;  // gives no evidence
  CHECK(w.fly(30).engine_failed);
  descends_unobeyed(w, 1);
  CHECK_FALSE(w.fly(1).engine_failed);
  w.actuators.throttle_frac = 0.57;
  CHECK(w.raised_after(&SafetyState::engine_failed) > 1.9);
}

TEST_CASE("a link that is silent says nothing of the motor: the last status is old") {
  Watch w;
  w.fly(3);
  w.has_status = false;
  w.fly(1.1);
  w.state.climb_rate_mps = -7.1;
  CHECK_FALSE(w.fly(20).engine_failed);
}

TEST_CASE(
    "a motor that holds level flight at full throttle is weak and no glide; one that does not has failed") {
  const double rho = standard_air(test::FlightModel::field_m + 70).density_kgm3;
  const Airframe a = test::anaconda();
  const auto with = [&](Watch& w, double share) {
    w.actuators.throttle_frac = 1;
    const double lost = turn_trim(a, 0, 17, rho).drag_newton - thrust_of(a, share, 17, rho);
    w.state.climb_rate_mps = -lost * 17 / (a.mass_kg * 9.80665);
    w.fly(30);
  };
  REQUIRE(thrust_of(a, 0.6, 17, rho) > turn_trim(a, 0, 17, rho).drag_newton);
  Watch weak;
  with(weak, 0.6);
  CHECK(weak.out.safety.engine_weak);
  CHECK_FALSE(weak.out.safety.engine_failed);
  CHECK(weak.out.safety.answer == SafetyAnswer::land);
  CHECK(weak.reported.find("safety.thrust_left(flight.engine_weak, ") != std::string::npos);
  REQUIRE(thrust_of(a, 0.3, 13.2, rho) < turn_trim(a, 0, 13.2, rho).drag_newton);
  Watch dead;
  with(dead, 0.3);
  CHECK(dead.out.safety.engine_failed);
  CHECK_FALSE(dead.out.safety.engine_weak);
  CHECK(dead.out.safety.answer == SafetyAnswer::glide);
  Watch sound;
  with(sound, 1);
  CHECK_FALSE(sound.out.safety.engine_weak);
  CHECK(sound.out.safety.answer == SafetyAnswer::none);
}

TEST_CASE(
    "a pitot tube that is blocked from before the take-off is lost in the air, without ever having been "
    "there") {
  for (const SensorState state : {SensorState::stuck, SensorState::silent, SensorState::refused}) {
    kit::Stands w;
    w.health.pitot.state = state;
    w.state.airspeed_valid = false;
    CHECK_FALSE(w.fly(10).pitot_lost);
    w.ground.contact = Contact::air;
    CHECK(w.raised_after(&SafetyState::pitot_lost) == doctest::Approx(1.5 + 2).epsilon(0.03));
    CHECK(w.out.safety.answer == SafetyAnswer::land);
  }
}

TEST_CASE("the circle without a position ends when drift and doubt reach the fence") {
  const auto waits = [](Watch& w, double wind_north, double south, double std_growth_mps) {
    w.fence(south);
    w.state.wind_mps = {wind_north, 0, 0};
    w.fly(20);
    w.state.position_valid = false;
    w.state.position_std_m = {2, 2, 2};
    for (int i = 0; i < 1300; ++i) {
      w.state.position_std_m.north += 0.1 * std_growth_mps;
      if (w.fly(0.1).answer == SafetyAnswer::descend) break;
    }
  };
  Watch still;
  waits(still, 0, -1000, 0);
  CHECK(still.out.safety.waiting_s == doctest::Approx(120).epsilon(0.01));
  // 1000 m to the north: with 2 m/s of growth the standard deviation ends dead reckoning at 50 m after 25 s;
  // then 8 m/s of wind, and the descent.
  Watch w;
  waits(w, 8, -1000, 2);
  const Airframe a = test::anaconda();
  const double rho = standard_air(test::FlightModel::field_m + 70).density_kgm3;
  const double down_s = 70 / sink_rate(a, 1.2 * a.limits.airspeed_min_mps, 0.26, rho);
  const double drift_s =
      (1000 - 15 - 2 * 50 - 8 * down_s) / (8 + 2);  // the standard deviation grows by 1 m/s, counted twice
  CHECK(w.out.safety.waiting_s == doctest::Approx(24 - 3 + drift_s).epsilon(0.05));
  CHECK(w.reported.find("safety.descends_near_fence(") != std::string::npos);
  Watch none;  // without a fence only the time is limited
  none.state.wind_mps = {12, 0, 0};
  none.fly(20);
  none.state.position_valid = false;
  CHECK(none.fly(115).answer == SafetyAnswer::wait);
}

TEST_CASE(
    "below the committed height a landing is finished without a position; what descends already goes on") {
  Watch w;
  w.params.landing.value = true;
  w.fly(2);
  w.state.height_m = 11;
  w.state.position_valid = false;
  CHECK(w.fly(10).answer == SafetyAnswer::none);
  CHECK(w.out.safety.gnss_lost);
  CHECK(w.reported.find("safety.alarm(flight.gnss_lost, safety.finishes, ") != std::string::npos);
  w.state.height_m = 13;
  CHECK(w.fly(0.1).answer == SafetyAnswer::wait);
  w.fly(121);
  w.state.height_m = 5;
  CHECK(w.fly(1).answer == SafetyAnswer::descend);
  Watch flares;
  flares.params.landing.value = true;
  flares.fly(2);
  flares.status.battery_frac = 0.05;
  flares.state.height_m = 3.9;
  CHECK(flares.fly(5).answer == SafetyAnswer::none);
  CHECK(flares.out.safety.battery_empty);
  flares.state.height_m = 4.1;
  CHECK(flares.fly(0.1).answer == SafetyAnswer::glide);
  Watch cruises;
  cruises.fly(2);
  cruises.state.height_m = 11;
  cruises.state.position_valid = false;
  CHECK(cruises.fly(10).answer == SafetyAnswer::wait);
}

TEST_CASE("wind above the largest airspeed is reported, and that it has dropped") {
  Watch w;
  w.state.wind_mps = {-30, 0, 0};
  CHECK(w.fly(40).drifting);
  CHECK(w.reported.find("safety.drifts(30)") != std::string::npos);
  w.state.wind_mps = {-5, 0, 0};
  CHECK_FALSE(w.fly(60).drifting);
  CHECK(w.reported.find("safety.drift_ended") != std::string::npos);
}

TEST_CASE("outside the fence or above its ceiling the distance is said without a sign") {
  Watch w;
  w.fence();
  w.fly(2);
  w.state.position_m.north = 1285;
  w.fly(0.1);
  CHECK(w.reported.find("safety.alarm(safety.outside_fence(285), safety.returns, ") != std::string::npos);
  Watch high;
  high.fence();
  high.fly(2);
  high.state.height_m = 126;
  high.fly(0.1);
  CHECK(high.reported.find("safety.alarm(safety.above_ceiling(6), safety.returns, ") != std::string::npos);
  for (const Watch* each : {&w, &high}) CHECK(each->reported.find('-') == std::string::npos);
}

}  // namespace in_flight_test
