// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/safety/monitor.hpp"

#include "watch.hpp"

namespace monitor_test {

using namespace fulmar;
using namespace fulmar::safety;
using kit::Watch;

TEST_CASE("each flag has an alarm, with words and the cause of its name") {
  const fulmar_type& state = *detail::type_table<SafetyState>();
  const fulmar_type& notice = *detail::type_table<Notice>();
  const fulmar_field* cause = nullptr;
  for (std::uint32_t i = 0; i < notice.field_count; ++i)
    if (std::string_view(notice.fields[i].name) == "cause") cause = &notice.fields[i];
  REQUIRE(cause);
  const SafetyState base;
  std::size_t flags = 0;
  for (std::uint32_t i = 0; i < state.field_count; ++i) {
    const fulmar_field& f = state.fields[i];
    const std::string_view name = f.name;
    if (f.kind != FULMAR_BOOL || name == "airborne" || name == "ready") continue;
    ++flags;
    const auto at = std::find_if(alarms.begin(), alarms.end(), [&](const NamedAlarm& a) {
      const auto* const place = reinterpret_cast<const char*>(&(base.*a.flag));
      return place - reinterpret_cast<const char*>(&base) == static_cast<std::ptrdiff_t>(f.offset);
    });
    REQUIRE_MESSAGE(at != alarms.end(), name);
    CHECK(cause->labels[static_cast<std::size_t>(at->cause)] == name);
    CHECK(at->words()[0] != 0);
  }
  CHECK(flags == alarms.size());
}

TEST_CASE("an alarm and its end are reported with their cause") {
  Watch w;
  w.fly(5);
  w.state.position_valid = false;
  w.raised_after(&SafetyState::gnss_lost);
  w.state.position_valid = true;
  w.fly(6);
  std::vector<Severity> said;
  for (const Notice& n : w.notices)
    if (n.cause == Cause::gnss_lost) said.push_back(n.severity);
  CHECK(said == std::vector{Severity::warning, Severity::info});
}

TEST_CASE("in order nothing is told, for long") {
  Watch w;
  w.fence();
  w.has_health = true;
  CHECK(w.fly(60).answer == SafetyAnswer::none);
  CHECK(w.reported == "");
}

TEST_CASE("the fence is told before it is reached, by what the turn back takes, and kept until the landing") {
  Watch w;
  w.fence();
  w.fly(2);
  const double R = 17 * 17 / (9.80665 * std::tan(0.7 * 0.785));
  const double from = 1000 - 15 - 17 * 1.5 - R;  // margin, reaction, radius
  w.state.position_m.north = from - 3;
  CHECK_FALSE(w.fly(0.1).fence);
  w.state.position_m.north = from + 3;
  CHECK(w.fly(0.1).fence);
  CHECK(w.out.safety.answer == SafetyAnswer::home);
  CHECK(w.reported.find("safety.alarm(safety.near_fence(") != std::string::npos);
  CHECK(w.reported.find("), safety.returns, keep inside)") != std::string::npos);
  w.state = kit::level();
  CHECK_FALSE(w.fly(3).fence);
  CHECK(w.out.safety.answer == SafetyAnswer::home);
  CHECK(w.fly(120).answer == SafetyAnswer::land);
  Watch free;
  free.fence();
  free.params.fencing.keep_fence.value = false;
  free.fly(2);
  free.state.position_m.north = 990;
  CHECK(free.fly(0.1).answer == SafetyAnswer::home);
  free.state = kit::level();
  CHECK(free.fly(3).answer == SafetyAnswer::none);
}

TEST_CASE(
    "the ceiling is told by the climb and the pull-out; the floor only when it has been left, and not for a "
    "landing") {
  Watch w;
  w.fence();
  w.state.height_m = 5;
  CHECK_FALSE(w.fly(5).fence);  // take-off
  w.state.height_m = 100;
  w.state.climb_rate_mps = 6;  // 9 m of reaction, 6 m of pull-out
  CHECK_FALSE(w.fly(0.2).fence);
  CHECK(w.out.safety.height_margin_m == doctest::Approx(5));
  w.state.height_m = 106;
  CHECK(w.fly(0.2).fence);
  w.state = kit::level();
  CHECK_FALSE(w.fly(5).fence);
  w.params.landing.value = true;
  w.retune();
  w.state.height_m = 15;
  CHECK_FALSE(w.fly(1).fence);
  w.params.landing.value = false;
  w.retune();
  CHECK(w.fly(1).fence);
}

TEST_CASE("the pilot is given the answer that he asks for, in the air, as long as nothing is wrong") {
  for (const SafetyAnswer asked : {SafetyAnswer::home, SafetyAnswer::land, SafetyAnswer::wait}) {
    Watch w;
    w.params.asked.value = asked;
    CHECK(w.fly(0.5).answer == SafetyAnswer::none);  // not yet in the air
    CHECK(w.fly(3).answer == asked);
    w.state.attitude_valid = false;
    CHECK(w.fly(3).answer == SafetyAnswer::level);  // the failure has priority
    w.state.attitude_valid = true;
    CHECK(w.fly(5).answer == asked);
    w.status.on_ground = true;
    CHECK(w.fly(1).answer == SafetyAnswer::none);
  }
}

TEST_CASE("home has to lie within the fence, with room") {
  for (const double south : {100.0, -10.0}) {
    Watch w;
    w.fence(south);
    CHECK(w.configure() == Status::failed);
    CHECK(w.error() == (south > 0 ? "fence.corners: safety.home_outside_fence(0, 0)"
                                  : "fence.corners: safety.home_near_fence(0, 0, 10.0, 15)"));
  }
}

TEST_CASE("an empty battery has no higher limit than a low one") {
  Watch charge, volt;
  charge.params.battery.battery_low.value = 0.05;
  CHECK(charge.configure() == Status::failed);
  CHECK(charge.error() == "battery_empty: safety.battery_limits_crossed(0.1, battery_low, 0.05)");
  volt.params.battery.volt_empty.value = 0.99;
  CHECK(volt.configure() == Status::failed);
  CHECK(volt.error().find("volt_empty: safety.battery_limits_crossed(0.99, volt_low, ") == 0);
}

TEST_CASE("the position: lost after 3 s, waited for, given up after the time; back after 3 s") {
  Watch w;
  w.fly(2);
  w.state.position_valid = false;
  CHECK(w.raised_after(&SafetyState::gnss_lost) == doctest::Approx(3).epsilon(0.02));
  CHECK(w.out.safety.answer == SafetyAnswer::wait);
  CHECK(w.fly(119).answer == SafetyAnswer::wait);
  CHECK(w.fly(2).answer == SafetyAnswer::descend);
  w.state.position_valid = true;
  CHECK(w.raised_after(&SafetyState::gnss_lost, 20, false) == doctest::Approx(3).epsilon(0.02));
  CHECK(w.out.safety.answer == SafetyAnswer::none);
  Watch silent;  // the filter reckons on, the receiver is silent
  silent.has_health = true;
  silent.fly(2);
  silent.health.gnss_position.state = SensorState::silent;
  CHECK(silent.raised_after(&SafetyState::gnss_lost) == doctest::Approx(3).epsilon(0.02));
  Watch never;
  never.state.position_valid = false;
  CHECK_FALSE(never.fly(20).gnss_lost);
}

TEST_CASE("the pitot tube: lost when it was there, by the health or by the state") {
  Watch w;
  w.has_health = true;
  w.fly(2);
  w.health.pitot.state = SensorState::silent;
  CHECK(w.raised_after(&SafetyState::pitot_lost) == doctest::Approx(2).epsilon(0.02));
  CHECK(w.out.safety.answer == SafetyAnswer::land);
  Watch plain;
  plain.fly(2);
  plain.state.airspeed_valid = false;
  CHECK(plain.raised_after(&SafetyState::pitot_lost) == doctest::Approx(2).epsilon(0.02));
  Watch none;  // an aircraft without one
  none.has_health = true;
  none.health.pitot.state = SensorState::never;
  CHECK_FALSE(none.fly(20).pitot_lost);
}

TEST_CASE("the radio is lost when it was heard, or has to be there") {
  Watch never;
  CHECK_FALSE(never.fly(20).radio_lost);
  Watch demanded;
  demanded.params.radio.radio_required.value = true;
  CHECK(demanded.fly(5).radio_lost);
  Watch w;
  w.has_rc = true;
  w.rc.link = true;
  w.fly(3);
  w.has_rc = false;  // 1 s of time-out, 2 s until the report
  CHECK(w.raised_after(&SafetyState::radio_lost) == doctest::Approx(3).epsilon(0.02));
  CHECK(w.out.safety.answer == SafetyAnswer::home);
  CHECK(w.fly(121).answer == SafetyAnswer::land);
  w.has_rc = true;
  CHECK_FALSE(w.fly(3).radio_lost);
  CHECK(w.out.safety.answer == SafetyAnswer::none);
  Watch linkless;  // frames without a link
  linkless.has_rc = true;
  linkless.rc.link = true;
  linkless.fly(3);
  linkless.rc.link = false;
  CHECK(linkless.fly(4).radio_lost);
  Watch by_status;
  by_status.status.rc_age_s = 0.1;
  by_status.fly(3);
  by_status.status.rc_age_s = 3;
  CHECK(by_status.fly(3).radio_lost);
}

TEST_CASE("the link: a status that came and does not come") {
  Watch w;
  w.fly(3);
  w.has_status = false;
  CHECK(w.raised_after(&SafetyState::link_lost) == doctest::Approx(1).epsilon(0.05));
  CHECK(w.out.safety.answer == SafetyAnswer::home);
  Watch none;
  none.has_status = false;
  CHECK_FALSE(none.fly(20).link_lost);
}

TEST_CASE("the battery: by charge or voltage, after 3 s; one that reads nothing is none") {
  Watch w;
  w.fly(2);
  w.status.battery_frac = 0.2;
  CHECK(w.raised_after(&SafetyState::battery_low) == doctest::Approx(3).epsilon(0.02));
  CHECK(w.out.safety.answer == SafetyAnswer::land);
  w.status.battery_frac = 0.3;  // above, but not by a tenth
  CHECK(w.fly(60).battery_low);
  w.status.battery_frac = 0.05;
  CHECK(w.fly(4).answer == SafetyAnswer::glide);
  Watch volts;
  volts.fly(2);
  volts.status.battery_volt = 0.82 * 24;
  CHECK(volts.fly(4).battery_low);
  CHECK_FALSE(volts.out.safety.battery_empty);
  volts.status.battery_volt = 0;
  CHECK(volts.fly(4).battery_empty);
  Watch none;
  none.status.battery_volt = 0;
  CHECK_FALSE(none.fly(20).battery_low);
}

TEST_CASE("an excessive attitude, either way, is levelled at once and taken back well below") {
  for (const double sign : {-1.0, 1.0}) {
    Watch w;
    w.fly(2);
    w.state.roll_rad = sign * 1.2;
    CHECK(w.raised_after(&SafetyState::attitude_excessive) == doctest::Approx(0.3).epsilon(0.1));
    CHECK(w.out.safety.answer == SafetyAnswer::level);
    w.state.roll_rad = sign * 0.9;
    CHECK(w.fly(5).attitude_excessive);
    w.state.roll_rad = sign * 0.5;
    CHECK_FALSE(w.fly(1.5).attitude_excessive);
    w.state.roll_rad = 0;
    w.state.pitch_rad = sign * 0.8;
    CHECK(w.fly(1).attitude_excessive);
  }
}

TEST_CASE("the motor: the trim's throttle holds level flight, and no motor sinks or slows") {
  Watch w;
  CHECK(w.fly(10).thrust_ratio == doctest::Approx(1).epsilon(0.35));
  w.state.climb_rate_mps = -7.1;  // of the Anaconda with a propeller that brakes, at 17 m/s
  const double after = w.raised_after(&SafetyState::engine_failed);
  CHECK(after > 1.9);
  CHECK(after < 4);
  CHECK(w.out.safety.answer == SafetyAnswer::glide);
  CHECK(w.reported.find("safety.alarm(flight.engine_failed, safety.glides, ") != std::string::npos);
  w.actuators.throttle_frac = 0;  // no demand: no evidence
  CHECK(w.fly(30).engine_failed);
  w.actuators.throttle_frac = 0.57;
  w.state.climb_rate_mps = 0;
  CHECK_FALSE(w.fly(10).engine_failed);
  Watch slows;
  slows.fly(3);
  slows.state.specific_force_mps2.x = -4.1;  // level, and 18.6 N are missing
  CHECK(slows.fly(4).engine_failed);
  Watch glides;  // as commanded
  glides.actuators.throttle_frac = 0;
  glides.state.climb_rate_mps = -7.1;
  CHECK_FALSE(glides.fly(30).engine_failed);
  Watch sinks;  // air that sinks by 1 m/s
  sinks.fly(3);
  sinks.state.climb_rate_mps = -1;
  CHECK_FALSE(sinks.fly(30).engine_failed);
}

TEST_CASE("a battery that has less voltage gives less thrust: that is no failure of the motor") {
  Watch w;
  w.status.battery_volt = 0.8 * 24;
  w.actuators.throttle_frac = 0.57 / 0.8;
  CHECK(w.fly(20).thrust_ratio == doctest::Approx(1).epsilon(0.35));
  CHECK_FALSE(w.out.safety.engine_failed);
}

TEST_CASE("wind beyond its share of the cruise speed, for long, sends it to land") {
  Watch w;
  w.state.wind_mps = {0.55 * 17, 0, 0};
  CHECK_FALSE(w.fly(40).wind_excessive);
  w.state.wind_mps = {0, -0.7 * 17, 0};
  CHECK(w.fly(30).wind_excessive);
  CHECK(w.out.safety.answer == SafetyAnswer::land);
  w.state.wind_valid = false;
  CHECK(w.fly(60).wind_excessive);
}

TEST_CASE("an estimate that is not valid levels the wings") {
  Watch w;
  w.fly(2);
  w.state.height_valid = false;
  CHECK(w.fly(1.2).answer == SafetyAnswer::level);
  CHECK(w.out.safety.estimator_failed);
}

TEST_CASE("of several failures the graver one is answered: motor, attitude, position, battery, radio") {
  Watch w;
  w.has_rc = true;
  w.rc.link = true;
  w.fly(2);
  w.rc.link = false;
  CHECK(w.fly(4).answer == SafetyAnswer::home);
  w.status.battery_frac = 0.2;
  CHECK(w.fly(4).answer == SafetyAnswer::land);
  w.state.position_valid = false;
  CHECK(w.fly(4).answer == SafetyAnswer::descend);  // the battery does not wait
  w.state.roll_rad = 1.3;
  CHECK(w.fly(1).answer == SafetyAnswer::level);
  w.status.battery_frac = 0.05;
  CHECK(w.fly(4).answer == SafetyAnswer::glide);
}

TEST_CASE("on the ground nothing is answered, and a bounce of a second is no flight") {
  Watch w;
  w.fly(2);
  w.status.battery_frac = 0.05;
  CHECK(w.fly(4).answer == SafetyAnswer::glide);
  w.status.on_ground = true;
  CHECK(w.fly(0.1).answer == SafetyAnswer::none);
  w.status.on_ground = false;
  CHECK(w.fly(1.3).answer == SafetyAnswer::none);
  CHECK(w.fly(0.5).answer == SafetyAnswer::glide);
  Watch disarmed;
  disarmed.status.armed = false;
  disarmed.status.battery_frac = 0.05;
  CHECK(disarmed.fly(10).answer == SafetyAnswer::none);
}

}  // namespace monitor_test
