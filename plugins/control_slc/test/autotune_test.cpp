// SPDX-License-Identifier: BSD-3-Clause
// The autotune flies the nonlinear Anaconda of sdk/test/flight at 17 m/s: gains kept, gains restored, and
// reasons for an end. bench_autotune evaluates its results with a linear model.
#include <cstring>
#include <limits>

#include "autotune_flight.hpp"

namespace autotune_test {

TEST_CASE("from wrong gains all three axes end with measured margins, within 90 s") {
  for (const double factor : {0.5, 2.0}) {
    CAPTURE(factor);
    Flight f(factor);
    f.fly(5);
    f.tune();
    REQUIRE(f.fly_until([&] { return f.done(); }));
    const AutotuneReport r = f.report();
    CHECK(r.stage == Stage::finished);
    CHECK(r.time_s < 90);
    CHECK(r.roll == Verdict::kept);
    CHECK(r.pitch == Verdict::kept);
    CHECK(r.yaw == Verdict::kept);
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(i);
      CHECK(r.gain_margin_ratio[i] > 1.995);  // 6 dB
      CHECK(r.phase_margin_rad[i] > 0.785);
      CHECK_FALSE(as_before(r, i));
    }
    CHECK(r.before_kp_ratio[0] == doctest::Approx(1.2 * factor));
    CHECK(r.kp_ratio[0] > 1.5);  // of the 0.6 and of the 2.4: both end at about the same
    CHECK(r.kp_ratio[0] < 4.5);
    CHECK(f.reported.size() == 3);
    CHECK(f.has_reported("roll_kp: "));
    CHECK(f.has_reported("yaw_kd: "));
    CHECK(f.has_reported("control_slc.axis_kept(roll_kp: "));
    f.fly(2);
    CHECK(f.report().time_s == r.time_s);  // once
    CHECK(f.report().kp_ratio[0] == r.kp_ratio[0]);
    CHECK(f.tuner.validation_error().empty());
  }
}

TEST_CASE("the margins measured are those that a known gain has: a gain times two costs 6 dB") {
  Flight f, twice;
  const auto scale = [](Flight& one, double by) {
    slc::Inner::Params& p = one.tuner.params.law;
    for (Param* gain : {&p.roll_kp, &p.roll_ki, &p.roll_kd}) gain->value *= by;
  };
  scale(f, 3);
  scale(twice, 6);
  std::array<double, 2> margin{}, crossover{};
  for (Flight* one : {&f, &twice}) {
    one->fly(5);
    one->tune();
    REQUIRE(one->fly_until([&] { return one->report().stage == Stage::searching; }));
    const std::size_t i = one == &twice;
    margin[i] = one->report().before_gain_margin_ratio[0];
    crossover[i] = one->report().before_phase_margin_rad[0];
  }
  CHECK(margin[0] / margin[1] == doctest::Approx(2).epsilon(0.1));
  CHECK(crossover[1] < crossover[0]);
}

TEST_CASE("as long as it does not tune it is the inner law, byte for byte") {
  Flight f(1, Turbulence::light);
  Bench<slc::Inner> inner;
  inner.params = f.tuner.params.law;
  VehicleState seen;
  f.seen = [&](VehicleState& state) { seen = state; };
  f.command.course_rad = 0.6;
  for (int k = 0; k < 1500; ++k) {
    f.step();
    inner.set(inner.in.state, seen);
    inner.set(inner.in.attitude, f.outer.out.attitude);
    inner.step(0.01);
    REQUIRE(std::memcmp(&inner.out.actuators, &f.tuner.out.law.actuators, sizeof(Actuators)) == 0);
  }
  CHECK(f.report().stage == Stage::idle);
  CHECK_FALSE(f.report().done);
  CHECK(f.reported.empty());
}

TEST_CASE("margins that do not hold in the second excitation send the axis back to its old gains") {
  Flight f;
  f.tuner.params.time_limit.value = 26;  // no third excitation
  f.fly(5);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().stage == Stage::verifying; }));
  f.fly(0.6);
  CHECK_FALSE(as_before(f.report(), 0));
  f.aileron_power = 6;  // another aircraft than the one that was measured
  REQUIRE(f.fly_until([&] { return f.done(); }));
  f.fly(0.6);
  CHECK(f.report().roll == Verdict::reverted);
  CHECK(f.report().pitch == Verdict::left_out);
  CHECK(as_before(f.report(), 0));
  CHECK(f.has_reported("control_slc.axis_reverted(roll, "));
}

TEST_CASE("with time left it searches again from the second record, and measures once more") {
  Flight f;
  f.tuner.params.time_limit.value = 60;
  f.fly(5);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().stage == Stage::verifying; }));
  const double first = f.report().kp_ratio[0];
  f.aileron_power = 4;
  REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
  f.fly(0.6);
  CHECK(f.report().roll == Verdict::kept);
  CHECK(f.report().kp_ratio[0] < 3 * first / 4 * 2);
  CHECK(f.report().gain_margin_ratio[0] > 1.995);
}

TEST_CASE("what is out of its bounds ends it, with the old gains, no excitation, and a sentence") {
  struct End {
    const char* code;
    std::function<void(Flight&)> make;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<End> ends{
      {"control_slc.commands_ignored", [](Flight& f) { f.status.in_control = false; }},
      {"control_slc.estimate_unknown",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.attitude_valid = false; }; }},
      {"control_slc.estimate_unknown",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.airspeed_valid = false; }; }},
      {"control_slc.estimate_unknown",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.height_valid = false; }; }},
      {"control_slc.roll_beyond_bound",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.roll_rad = -0.8; }; }},
      {"control_slc.roll_beyond_bound",
       [nan](Flight& f) { f.seen = [nan](VehicleState& s) { s.roll_rad = nan; }; }},
      {"control_slc.pitch_beyond_bound",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.pitch_rad = -0.5; }; }},
      {"control_slc.height_moved", [](Flight& f) { f.seen = [](VehicleState& s) { s.height_m -= 21; }; }},
      {"control_slc.airspeed_low",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.airspeed_mps = 10.9; }; }},
      {"control_slc.airspeed_high",
       [](Flight& f) { f.seen = [](VehicleState& s) { s.airspeed_mps = 25.1; }; }},
      {"control_slc.tune_switched_off",
       [](Flight& f) {
         f.tuner.params.tune.value = false;
         f.tuner.retune();
       }},
      {"control_slc.other_component_active", [](Flight& f) { f.tuner.activate(); }},
      {"control_slc.time_limit_over", [](Flight& f) {
         f.tuner.params.time_limit.value = 20;
         f.tuner.retune();
         f.fly(9);
       }}};
  for (const End& end : ends) {
    CAPTURE(end.code);
    Flight f;
    f.fly(3);
    f.tune();
    REQUIRE(f.fly_until([&] { return f.report().stage == Stage::verifying; }));
    f.fly(3);
    REQUIRE_FALSE(f.done());
    end.make(f);
    f.step();
    CHECK(f.report().stage == Stage::aborted);
    CHECK(f.report().done);
    CHECK(f.report().roll == Verdict::reverted);
    CHECK(f.has_reported(end.code));
    if (!(std::abs(f.tuner.out.law.actuators.aileron_rad) < 2)) continue;  // the host stops it here
    f.seen = [](VehicleState&) {};
    f.status.in_control = true;
    f.fly(1);
    CHECK(as_before(f.report(), 0));
    CHECK(f.report().stage == Stage::aborted);  // and does not restart
    CHECK(f.reported.size() == 1);
    // the surface is the law's alone: it stands still in calm air
    const double before = f.tuner.out.law.actuators.aileron_rad;
    f.fly(0.05);
    CHECK(std::abs(f.tuner.out.law.actuators.aileron_rad - before) < 0.01);
  }
}

TEST_CASE("just within the bounds it goes on, and asked again it tunes again") {
  Flight f;
  f.fly(3);
  f.tune();
  f.fly(4);
  f.seen = [](VehicleState& s) { s.height_m -= 19; };
  f.fly(1);
  CHECK(f.report().stage == Stage::exciting);
  f.seen = [](VehicleState& s) { s.airspeed_mps = 11.2; };
  f.fly(0.02);
  CHECK(f.report().stage == Stage::exciting);
  f.tuner.params.tune.value = false;
  f.tuner.retune();
  f.seen = [](VehicleState&) {};
  f.fly(0.1);
  CHECK(f.report().stage == Stage::aborted);
  f.tune();
  f.fly(0.1);
  CHECK(f.report().stage == Stage::exciting);
  CHECK(f.report().time_s < 0.2);
  CHECK(f.report().roll == Verdict::open);
}

TEST_CASE("a pilot who has flown, and gains that are set, count") {
  Flight f;
  f.fly(3);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().roll == Verdict::kept; }));
  const double found = f.report().kp_ratio[0];
  f.fly(2);
  f.tuner.activate();  // the pilot: roll was verified and stays, pitch goes back
  f.fly(1);
  CHECK(f.report().stage == Stage::aborted);
  CHECK(f.report().kp_ratio[0] == found);
  CHECK(f.report().pitch == Verdict::reverted);
  f.tuner.params.law.roll_kp.value = 0.9;
  f.tuner.retune();
  f.fly(0.02);
  CHECK(f.report().kp_ratio[0] == 0.9);
  CHECK(f.report().kp_ratio[1] == 4);
}

TEST_CASE("a surface that answers the wrong way is not tuned") {
  Flight f(0.01);
  f.tuner.params.law.roll_kff.value = 0;  // or the course loop rolls it over
  f.tuner.params.law.pitch_kp.value = 4;
  f.tuner.params.law.pitch_kd.value = 0.28;
  f.fly(3);
  f.tune();
  f.tuner.params.roll_size.value = 0.02;
  f.tuner.params.roll_bound.value = 1.5;
  f.tuner.params.height_bound.value = 100;
  f.tuner.retune();
  f.aileron_power = -1;
  REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
  CHECK(f.report().roll == Verdict::reverted);
  CAPTURE(f.reported[0]);
  CHECK(f.has_reported("control_slc.surface_without_answer"));
}

TEST_CASE("a gyro that is stuck is no answer") {
  Flight f;
  f.fly(3);
  f.tune();
  f.seen = [](VehicleState& s) { s.rate_radps.x = 0; };
  REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
  CHECK(f.report().roll == Verdict::reverted);
  CHECK(f.has_reported("control_slc.surface_without_answer"));
  CHECK(f.tuner.validation_error().empty());
}

TEST_CASE("no surface steps: when gains change, an axis ends, or all of it ends, at 100 and at 400 Hz") {
  for (const double dt : {0.01, 0.0025}) {
    CAPTURE(dt);
    Flight f;
    f.dt = dt;
    f.fly(3);
    f.tune();
    Actuators before = f.tuner.out.law.actuators;
    double most = 0;
    bool ended = false;
    f.fly_until(
        [&] {
          const Actuators& now = f.tuner.out.law.actuators;
          most = std::max({most, std::abs(now.aileron_rad - before.aileron_rad),
                           std::abs(now.elevator_rad - before.elevator_rad),
                           std::abs(now.rudder_rad - before.rudder_rad)});
          before = now;
          if (f.report().stage == Stage::exciting && f.report().axis == AutotuneAxis::yaw && !ended) {
            f.fly(5);
            before = f.tuner.out.law.actuators;
            f.status.in_control = false;
            ended = true;
          }
          return f.done() && f.t > 70;
        },
        80);
    CHECK(ended);
    CHECK(most > 0.005);
    CHECK(most < 0.06 * std::sqrt(dt / 0.01));
  }
}

TEST_CASE("in turbulence it keeps what it has measured or goes back" * doctest::test_suite("amounts")) {
  int kept = 0;
  for (const Turbulence turbulence : {Turbulence::light, Turbulence::moderate})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      Flight f(0.7, turbulence, seed);
      f.fly(5);
      f.tune();
      REQUIRE(f.fly_until([&] { return f.done(); }));
      const AutotuneReport before = f.report();
      CHECK(before.time_s <= 90);
      f.fly(1);
      const AutotuneReport r = f.report();
      const std::array<Verdict, 3> verdicts{r.roll, r.pitch, r.yaw};
      for (std::size_t i = 0; i < 3; ++i) {
        if (verdicts[i] != Verdict::kept) {
          CHECK(as_before(r, i));
          continue;
        }
        ++kept;
        CHECK(r.gain_margin_ratio[i] > 1.995);
        CHECK(r.phase_margin_rad[i] > 0.785);
        CHECK(r.noise_ratio[i] <= 0.15);
      }
    }
  CHECK(kept >= 8);
}

TEST_CASE("turbulence that hides the answer sends it back after larger excitations" *
          doctest::test_suite("amounts")) {
  Flight f(1, Turbulence::severe, 2);
  f.tuner.params.noise_limit.value = 0.02;
  f.tuner.params.roll_bound.value = f.tuner.params.pitch_bound.value = 1.5;
  f.tuner.params.height_bound.value = 1000;
  f.tuner.params.law.airframe.value.limits.airspeed_max_mps = 60;
  f.tuner.params.law.airframe.value.limits.airspeed_min_mps = 5;
  f.fly(3);
  f.tune();
  REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
  CHECK(f.report().roll == Verdict::reverted);
  CHECK(f.has_reported("control_slc.turbulence_high"));
  CHECK(f.report().time_s > 20);  // more than one
}

TEST_CASE("gains that quietening has cut are where it begins, and what it finds is whole") {
  Flight f;
  f.tuner.params.law.quieten.value = true;
  f.fly(3);
  f.seen = [&](VehicleState& s) { s.roll_rad = 0.3 * std::sin(20 * f.t); };
  f.fly(1.3);
  f.seen = [](VehicleState&) {};
  f.fly(4);
  f.tune();
  f.fly(0.1);
  CHECK(f.report().before_kp_ratio[0] == doctest::Approx(0.4 * 1.2));
  CHECK(f.report().before_kp_ratio[1] == doctest::Approx(4));
  CHECK(f.report().kp_ratio[0] == f.report().before_kp_ratio[0]);
  REQUIRE(f.fly_until([&] { return f.report().roll != Verdict::open; }));
  CHECK(f.report().roll == Verdict::kept);
}

}  // namespace autotune_test
