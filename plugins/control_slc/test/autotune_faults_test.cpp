// SPDX-License-Identifier: BSD-3-Clause
// Behaviour of the autotune with a surface that is stuck or saturated, commands that move, gains of 0, and an
// early end.
#include "autotune_flight.hpp"

namespace autotune_test {
namespace {

const std::array<double Actuators::*, 3> surfaces{&Actuators::aileron_rad, &Actuators::elevator_rad,
                                                  &Actuators::rudder_rad};

Verdict verdict(const AutotuneReport& r, std::size_t i) { return i == 0 ? r.roll : i == 1 ? r.pitch : r.yaw; }
Reason reason(const AutotuneReport& r, std::size_t i) {
  return i == 0 ? r.roll_reason : i == 1 ? r.pitch_reason : r.yaw_reason;
}

}  // namespace

TEST_CASE("a surface that is stuck, from the begin or after the first excitation, is never tuned") {
  int no_answers = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool late : {false, true})
      for (const Turbulence turbulence : {Turbulence::none, Turbulence::light})
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
          CAPTURE(axis);
          CAPTURE(late);
          CAPTURE(seed);
          Flight f(1, turbulence, seed);
          f.fly(5);
          f.tune();
          const auto here = static_cast<AutotuneAxis>(axis + 1);
          REQUIRE(f.fly_until(
              [&] { return f.report().axis == here && (!late || f.report().stage == Stage::verifying); }));
          f.fly(late ? 0.9 : 0);
          const double stands = f.tuner.out.law.actuators.*surfaces[axis];
          f.servos = [&](Actuators& u) { u.*surfaces[axis] = stands; };
          f.fly_until([&] { return verdict(f.report(), axis) != Verdict::open; });
          f.fly(0.6);
          CHECK(verdict(f.report(), axis) == Verdict::reverted);
          CHECK(as_before(f.report(), axis));
          no_answers += reason(f.report(), axis) == Reason::no_answer;
        }
  CAPTURE(no_answers);
  CHECK(no_answers >= 24);  // others end at a bound, or as turbulence
}

TEST_CASE("commands that move while it measures: the margins kept are those of a quiet flight, or none are") {
  std::array<double, 3> quiet{};
  int kept = 0;
  for (const int disturbed : {0, 1, 2, 3}) {
    CAPTURE(disturbed);
    Flight f;
    f.fly(5);
    f.tune();
    f.fly_until([&] {
      const double t = f.t;
      if (disturbed == 1) f.command.course_rad = std::fmod(t, 8) < 4 ? 0.1 : -0.1;
      if (disturbed == 2) f.command.height_m = std::fmod(t, 10) < 5 ? 70 : 74;
      if (disturbed == 3) {
        f.command.course_rad = 0.05 * t;
        f.command.roll_feedforward_rad = 0.09;
      }
      return f.done();
    });
    const AutotuneReport& r = f.report();
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(i);
      const double gain = i < 2 ? r.kp_ratio[i] : r.kd_ratio[i];
      if (disturbed == 0) quiet[i] = gain;
      if (verdict(r, i) != Verdict::kept) {
        CHECK(as_before(r, i));
        continue;
      }
      ++kept;
      CHECK(gain / quiet[i] < 1.2);
      CHECK(gain / quiet[i] > 0.85);
    }
  }
  CHECK(kept >= 9);  // of 12
}

TEST_CASE("a surface at its limit: half the gains first, and the axis goes back when that is not enough") {
  Flight f(4, Turbulence::light);
  f.tuner.params.law.airframe.value.aileron.limit_rad = 0.05;
  f.fly(5);
  f.tune();
  f.fly(0.1);
  REQUIRE(f.fly_until([&] { return f.report().kp_ratio[0] != f.report().before_kp_ratio[0]; }, 15));
  f.fly(0.6);
  CHECK(f.report().stage == Stage::exciting);
  CHECK(f.report().kp_ratio[0] == doctest::Approx(0.5 * 4.8));
  CHECK(f.report().ki_ratio[0] == doctest::Approx(0.5 * 0.4));

  Flight trimmed;
  trimmed.tuner.params.law.airframe.value.aileron.trim_rad = 0.64;  // of 0.698
  trimmed.servos = [](Actuators& u) { u.aileron_rad -= 0.64; };
  trimmed.fly(5);
  trimmed.tune();
  REQUIRE(trimmed.fly_until([&] { return trimmed.report().roll != Verdict::open; }));
  trimmed.fly(0.6);
  CHECK(trimmed.report().roll == Verdict::reverted);
  CHECK(trimmed.report().roll_reason == Reason::surface_at_limit);
  CHECK(trimmed.has_reported("control_slc.axis_reverted(roll, control_slc.surface_at_limit)"));
  CHECK(as_before(trimmed.report(), 0));
}

TEST_CASE("gains of 0 are not tuned, and a sentence says so") {
  Flight f;
  slc::Inner::Params& p = f.tuner.params.law;
  p.pitch_kp.value = p.roll_kp.value = p.yaw_kd.value = 0;
  f.tuner.configure();
  f.step();
  f.tune();
  f.step();
  const AutotuneReport& r = f.report();
  CHECK(r.stage == Stage::finished);
  CHECK(r.done);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(verdict(r, i) == Verdict::left_out);
    CHECK(reason(r, i) == Reason::gain_is_zero);
  }
  REQUIRE(f.reported.size() == 3);
  CHECK(f.reported[0] == "control_slc.axis_not_tuned(roll, control_slc.gain_zero)");

  Flight no_kd;  // one gain of 0 does not prevent the tuning
  no_kd.tuner.params.law.roll_kd.value = no_kd.tuner.params.law.roll_ki.value = 0;
  no_kd.fly(5);
  no_kd.tune();
  REQUIRE(no_kd.fly_until([&] { return no_kd.report().roll != Verdict::open; }));
  CHECK(no_kd.report().roll == Verdict::kept);
  CHECK(no_kd.report().kd_ratio[0] == 0);

  Flight no_rudder;
  no_rudder.tuner.params.law.airframe.value.aero.yaw.rudder_ratio = 0;
  no_rudder.fly(5);
  no_rudder.tune();
  REQUIRE(no_rudder.fly_until([&] { return no_rudder.done(); }));
  CHECK(no_rudder.report().yaw == Verdict::left_out);
  CHECK(no_rudder.report().yaw_reason == Reason::no_surface);
  CHECK(no_rudder.has_reported("control_slc.axis_not_tuned(yaw, control_slc.surface_missing)"));
}

TEST_CASE("a record that leaves no gains is taken again, larger, as long as there is time") {
  for (const double limit_s : {90.0, 49.0, 30.0}) {
    CAPTURE(limit_s);
    Flight f;
    f.tuner.params.law.roll_kp.value = 6;
    f.tuner.params.law.roll_kd.value = 0.1;
    f.tuner.params.wanted_delay_margin.value = 1;  // more than a sixth of these has
    f.tuner.params.time_limit.value = limit_s;
    f.fly(3);
    f.tune();
    REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
    f.fly(0.6);
    CHECK(f.report().roll_reason == Reason::no_gains_found);
    CHECK(as_before(f.report(), 0));
    const double records = limit_s > 80 ? 3 : limit_s > 40 ? 2 : 1;
    CHECK(f.report().time_s > 12 * records);
    CHECK(f.report().before_gain_margin_ratio[0] > 0);
    CHECK(f.report().gain_margin_ratio[0] == 0);  // no other gains were tried
  }
}

TEST_CASE("too little time for one axis tunes none") {
  Flight f;
  f.tuner.params.time_limit.value = 25.5;
  f.fly(2);
  f.tune();
  f.step();
  CHECK(f.report().stage == Stage::finished);
  CHECK(f.report().roll_reason == Reason::no_time);
  CHECK(f.has_reported("control_slc.axis_not_tuned(roll, control_slc.time_missing)"));
}

TEST_CASE("ended in the middle, what was verified stays with its margins, what was under test goes back") {
  struct End {
    const char* code;
    std::function<void(Flight&)> make;
  };
  const std::vector<End> ends{
      {"control_slc.commands_ignored", [](Flight& f) { f.status.in_control = false; }},
      {"control_slc.tune_switched_off",
       [](Flight& f) {
         f.tuner.params.tune.value = false;
         f.tuner.retune();
       }},
      {"control_slc.other_component_active", [](Flight& f) { f.tuner.activate(); }},
      {"control_slc.gains_set",
       [](Flight& f) {
         f.tuner.params.law.yaw_kd.value = 0.4;
         f.tuner.retune();
       }},
      {"control_slc.roll_beyond_bound",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.roll_rad = 0.8; }; }}};
  for (const End& end : ends) {
    CAPTURE(end.code);
    Flight f;
    f.fly(3);
    f.tune();
    REQUIRE(f.fly_until(
        [&] { return f.report().axis == AutotuneAxis::pitch && f.report().stage == Stage::verifying; }));
    f.fly(5);
    const AutotuneReport verified = f.report();
    CHECK_FALSE(as_before(verified, 0));
    CHECK_FALSE(as_before(verified, 1));
    end.make(f);
    f.step();
    f.seen = [](VehicleState&) {};
    f.fly(0.6);
    const AutotuneReport& r = f.report();
    CHECK(r.stage == Stage::aborted);
    CHECK(r.roll == Verdict::kept);
    CHECK(r.roll_reason == Reason::none);
    CHECK(r.kp_ratio[0] == verified.kp_ratio[0]);
    CHECK(r.gain_margin_ratio[0] == verified.gain_margin_ratio[0]);
    CHECK(r.pitch == Verdict::reverted);
    CHECK(r.pitch_reason == Reason::ended);
    CHECK(as_before(r, 1));
    CHECK(r.yaw == Verdict::open);
    CHECK(f.has_reported(end.code));
  }
}

TEST_CASE("activated twice it ends once, and the old gains count at once") {
  Flight f;
  f.fly(3);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().stage == Stage::verifying; }));
  f.fly(3);
  f.tuner.activate();
  f.tuner.activate();
  f.step();
  CHECK(as_before(f.report(), 0));  // and not over half a second: it goes on from the surfaces
  CHECK(f.report().stage == Stage::aborted);
  CHECK(f.reported.size() == 1);
  f.fly(5);
  CHECK(f.report().stage == Stage::aborted);  // `tune` is still true
}

TEST_CASE("gains that are set count, and nothing that was measured is said of them") {
  Flight f;
  f.fly(3);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().roll == Verdict::kept; }));
  f.fly(5);
  f.tuner.params.law.roll_kp.value = 0.9;  // while pitch is excited
  f.tuner.retune();
  f.fly(0.6);
  CHECK(f.report().stage == Stage::aborted);
  CHECK(f.has_reported("control_slc.axis_reverted(pitch, control_slc.gains_set)"));
  CHECK(f.report().kp_ratio[0] == 0.9);
  CHECK(f.report().roll == Verdict::open);
  CHECK(f.report().gain_margin_ratio[0] == 0);
  CHECK(f.report().kp_ratio[1] == 4);

  Flight own;  // of the axis under test
  own.fly(3);
  own.tune();
  own.fly(5);
  own.tuner.params.law.roll_kp.value = 0.9;
  own.tuner.retune();
  own.fly(0.6);
  CHECK(own.report().stage == Stage::aborted);
  CHECK(own.report().kp_ratio[0] == 0.9);
  CHECK(own.report().roll == Verdict::open);
}

TEST_CASE("the input status need not be wired, and a mission that begins with tune ends it on the ground") {
  Flight f;
  f.has_status = false;
  f.fly(3);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
  CHECK(f.report().roll == Verdict::kept);

  Flight ground;
  ground.tuner.params.tune.value = true;
  ground.seen = [](VehicleState& s) { s.airspeed_mps = 0; };
  ground.fly(0.1);
  CHECK(ground.report().stage == Stage::aborted);
  CHECK(ground.has_reported("control_slc.airspeed_low"));
}

}  // namespace autotune_test
