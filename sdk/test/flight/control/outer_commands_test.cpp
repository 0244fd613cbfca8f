// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <fulmar/flight/control/outer_commands.hpp>

namespace outer_commands_test {

using namespace fulmar;

namespace {
VehicleState at(double airspeed, double ground_speed, double height, bool airspeed_valid = true) {
  VehicleState s;
  s.airspeed_mps = airspeed;
  s.ground_speed_mps = ground_speed;
  s.height_m = height;
  s.airspeed_valid = airspeed_valid;
  return s;
}
}  // namespace

TEST_CASE("standing needs a slow ground speed and a slow airspeed, or the ground when there is no airspeed") {
  CHECK(standing(at(0.5, 0.2, 0)));
  CHECK_FALSE(standing(at(15, 0.2, 70)));        // hovers in the wind
  CHECK_FALSE(standing(at(0, 0.2, 70, false)));  // may hover too: the airspeed is unknown
  CHECK(standing(at(0, 0.2, 0.3, false)));
  CHECK_FALSE(standing(at(1, 12, 0)));
  VehicleState falling = at(1, 1, 50);
  falling.climb_rate_mps = -6;
  CHECK_FALSE(standing(falling));
}

TEST_CASE(
    "the pitch ceiling comes down from the limit to level between the minimum airspeed and four fifths of "
    "it") {
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  limits.pitch_max_rad = 0.4;
  CHECK(pitch_ceiling(at(10, 10, 50), limits) == doctest::Approx(0.4));
  CHECK(pitch_ceiling(at(9, 10, 50), limits) == doctest::Approx(0.2));
  CHECK(pitch_ceiling(at(8, 10, 50), limits) == 0);
  CHECK(pitch_ceiling(at(0, 10, 50, false), limits) == doctest::Approx(0.4));
}

TEST_CASE("the shaped roll command approaches its target as a first-order lag with a rate limit") {
  CourseHold hold;
  const CourseTuning tuning{
      .kp = 2, .ki = 0, .cruise_mps = 15, .roll_max_rad = 0.8, .roll_rate_max_radps = 1, .smoothing_s = 0.2};
  hold.reset_to(0);
  // 0.6 rad away: at the rate limit until the lag commands less than 1 rad/s, 0.2 rad before the target, then
  // exp(-t / 0.2).
  for (int i = 0; i < 40; ++i) hold.shape(0.6, tuning, 0.01);
  CHECK(hold.shape(0.6, tuning, 0) == doctest::Approx(0.4).epsilon(0.01).scale(0));
  for (int i = 0; i < 20; ++i) hold.shape(0.6, tuning, 0.01);
  CHECK(hold.shape(0.6, tuning, 0) == doctest::Approx(0.6 - 0.2 * std::exp(-1.0)).epsilon(0.01).scale(0));
}

TEST_CASE("course hold's gain is bounded for odd ground speeds") {
  const CourseTuning tuning{
      .kp = 1, .ki = 0, .cruise_mps = 15, .roll_max_rad = 2, .roll_rate_max_radps = 100, .smoothing_s = 0};
  for (auto [Vg, gain] : {std::pair{15.0, 1.0}, {22.5, 1.5}, {0.0, 0.5}, {100.0, 2.0}}) {
    CourseHold hold;
    CHECK(hold.step(at(15, Vg, 70), 0.1, 0, tuning, 0.01) == doctest::Approx(0.1 * gain));
  }
}

TEST_CASE(
    "course hold round the kinematics of a coordinated turn settles as a first-order lag of bandwidth kp g / "
    "Vg") {
  const CourseTuning tuning{
      .kp = 2, .ki = 0, .cruise_mps = 17, .roll_max_rad = 0.8, .roll_rate_max_radps = 100, .smoothing_s = 0};
  CourseHold hold;
  VehicleState s = at(17, 17, 70);
  const double dt = 0.001, target = 0.05;
  for (int i = 0; i < 1000; ++i)
    s.course_rad += dt * 9.80665 / 17 * std::tan(hold.step(s, target, 0, tuning, dt));
  CHECK(s.course_rad == doctest::Approx(target * (1 - std::exp(-2 * 9.80665 / 17))).epsilon(0.01).scale(0));
}

TEST_CASE("a course integral that saturated the bank unwinds when the course is passed") {
  const CourseTuning tuning{.kp = 0.5,
                            .ki = 0.5,
                            .cruise_mps = 15,
                            .roll_max_rad = 0.5,
                            .roll_rate_max_radps = 100,
                            .smoothing_s = 0};
  CourseHold hold;
  VehicleState s = at(15, 15, 70);
  for (int i = 0; i < 6000; ++i) hold.step(s, 1, 0, tuning, 0.01);
  CHECK(hold.saturated());
  s.course_rad = 1.1;
  double roll = 0;
  for (int i = 0; i < 1100; ++i) roll = hold.step(s, 1, 0, tuning, 0.01);
  CHECK(roll < 0);
}

TEST_CASE("a course hold that begins again has forgotten its integral") {
  const CourseTuning tuning{.kp = 2,
                            .ki = 0.5,
                            .cruise_mps = 15,
                            .roll_max_rad = 0.8,
                            .roll_rate_max_radps = 100,
                            .smoothing_s = 0};
  CourseHold hold;
  const VehicleState s = at(15, 15, 70);
  for (int i = 0; i < 500; ++i) hold.step(s, 0.1, 0, tuning, 0.01);
  hold.reset_to(0);
  CHECK(hold.step(s, 0.1, 0, tuning, 0.01) / 0.2 == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE(
    "the take-off run takes the runway from the nose when it stands and from the course when it moves") {
  TakeoffRun run;
  VehicleState s = at(0, 0, 0);
  s.yaw_rad = 0.7;
  s.course_rad = -2;
  run.begin(s);
  CHECK(run.course_rad() == 0.7);
  s.ground_speed_mps = 8;
  run.begin(s);
  CHECK(run.course_rad() == -2);
}

TEST_CASE("without airspeed the take-off run rotates by ground speed") {
  TakeoffRun run;
  VehicleState s = at(0, 0, 0, false);
  run.begin(s);
  const TakeoffTuning tuning{
      .throttle_frac = 0.9, .pitch_rad = 0.2, .rotate_mps = 12, .course_kp = 1, .roll_max_rad = 0.1};
  s.ground_speed_mps = 11;
  CHECK(run.step(s, tuning, {}).pitch_rad == 0);
  s.ground_speed_mps = 12;
  CHECK(run.step(s, tuning, {}).pitch_rad == 0.2);
  CHECK(run.step(s, tuning, {}).throttle_frac == 0.9);
}

TEST_CASE("the motor waits for a throw, its delay after it, and the course is that of the nose then") {
  TakeoffTuning tuning;
  tuning.launch_mps2 = 15;
  tuning.launch_mps = 4;
  tuning.motor_delay_s = 0.3;
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  TakeoffRun run;
  VehicleState s = at(14, 0, 1.5);  // 14 m/s of wind while held in the hand
  s.velocity_valid = true;
  s.yaw_rad = 0.7;
  run.begin(s);
  const auto fly = [&](double seconds) {
    AttitudeCommand command;
    for (double t = 0; t < seconds - 1e-9; t += 0.01) command = run.step(s, tuning, limits, 0.01);
    return command;
  };
  CHECK(fly(600).throttle_frac == 0);
  CHECK(!run.rotated());
  s.yaw_rad = s.course_rad = -0.4;  // the throw has turned the aircraft
  s.specific_force_mps2.x = 15.5;
  s.ground_speed_mps = 5;
  CHECK(fly(0.09).throttle_frac == 0);
  CHECK(!run.launched());
  CHECK(fly(0.02).throttle_frac == 0);
  CHECK(run.launched());
  CHECK(run.course_rad() == -0.4);
  s.specific_force_mps2.x = 2;
  CHECK(fly(0.28).throttle_frac == 0);
  CHECK(fly(0.04).throttle_frac == 1);
  CHECK(fly(0.01).pitch_rad == doctest::Approx(0.2));  // above 1.2 times the minimum
  s.airspeed_mps = 11;
  CHECK(fly(0.01).pitch_rad == doctest::Approx(0.1));  // half way: 3 t^2 - 2 t^3 of a half
  s.airspeed_mps = 10;
  CHECK(fly(0.01).pitch_rad == 0);
  CHECK(fly(0.01).roll_rad == 0);
  // The motor was dead: the aircraft lies on the ground, and waits for the next throw.
  s.ground_speed_mps = 0.5;
  CHECK(fly(1.9).throttle_frac == 1);
  CHECK(fly(0.2).throttle_frac == 0);
  CHECK(!run.launched());
}

TEST_CASE("what flew before the launch leaves no power to a propeller in the hand") {
  OuterTuning tuning;
  tuning.takeoff.launch_mps2 = 15;
  OuterCommands commands;
  VehicleState s = at(8, 0, 1.5);
  commands.start(OuterLaw::hold, s, {0, 0.05, 0.6});
  REQUIRE(commands.begin(OuterLaw::takeoff, s) == OuterAction::take_off);
  CHECK(commands.take_off(s, tuning, {}, 0.01).throttle_frac == 0);
  tuning.takeoff.launch_mps2 = 0;  // take-off on wheels: the run continues
  OuterCommands rolling;
  rolling.start(OuterLaw::hold, s, {0, 0.05, 0.6});
  rolling.begin(OuterLaw::takeoff, s);
  CHECK(rolling.take_off(s, tuning, {}, 0.01).throttle_frac > 0.6);
}

TEST_CASE(
    "on the roll-out the motor is off, wings level, and the pitch that the wheels give is the command") {
  OuterTuning tuning;
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  OuterCommands commands;
  VehicleState s = at(15, 10, 0);
  s.attitude_valid = s.airspeed_valid = true;
  s.pitch_rad = 0.12;  // a tail-dragger
  commands.start(OuterLaw::hold, s, {0.2, 0.1, 0.6});
  REQUIRE(commands.begin(OuterLaw::roll_out, s) == OuterAction::roll_out);
  AttitudeCommand c;
  const auto roll = [&](double Va) {
    s.airspeed_mps = Va;
    for (int i = 0; i < 200; ++i) c = commands.roll_out(s, tuning, limits, 0.01);
  };
  roll(7.9);
  CHECK(c.pitch_rad == doctest::Approx(0.12));
  CHECK(c.throttle_frac == 0);
  CHECK(std::abs(c.roll_rad) < 1e-6);
  roll(12);  // fast enough to lift off again: pitch is a degree below that of the wheels
  CHECK(c.pitch_rad == doctest::Approx(0.10));
  s.attitude_valid = false;
  roll(7);
  CHECK(c.pitch_rad == 0);
}

TEST_CASE("a stumble, a push without speed and a ride without a push start no motor") {
  TakeoffTuning tuning;
  tuning.launch_mps2 = 15;
  tuning.launch_mps = 4;
  const struct {
    double mps2, for_s, speed_mps, later_s;
    bool launched;
  } cases[] = {{20, 0.09, 6, 0, false},  {20, 0.3, 3.9, 0, false}, {14.9, 5, 9, 0, false},
               {20, 0.12, 4.1, 0, true}, {20, 0.12, 6, 0.4, true}, {20, 0.12, 6, 0.6, false}};
  for (const auto& c : cases) {
    CAPTURE(c.mps2);
    CAPTURE(c.for_s);
    CAPTURE(c.later_s);
    TakeoffRun run;
    VehicleState s = at(0, 0, 1.5);
    s.velocity_valid = true;
    run.begin(s);
    s.specific_force_mps2.x = c.mps2;
    s.ground_speed_mps = c.later_s > 0 ? 0 : c.speed_mps;
    for (double t = 0; t < c.for_s - 1e-9; t += 0.01) run.step(s, tuning, {}, 0.01);
    s.specific_force_mps2.x = 0;
    for (double t = 0; t < c.later_s - 1e-9; t += 0.01) run.step(s, tuning, {}, 0.01);
    s.ground_speed_mps = c.speed_mps;
    CHECK((run.step(s, tuning, {}, 0.01).throttle_frac == 1) == c.launched);
  }
}

TEST_CASE("what the take-off law asked for is not taken up as trim, what another controller asked for is") {
  OuterCommands commands;
  const VehicleState s = at(15, 15, 40);
  commands.start(OuterLaw::hold, s, {0, 0.05, 0.6});
  CHECK(commands.taking_up());
  commands.start(OuterLaw::takeoff, s, {0, 0.2, 1});
  commands.start(OuterLaw::hold, s, {0, 0.2, 1});
  CHECK_FALSE(commands.taking_up());
  CHECK(commands.finish(0, 0, 0, {}, 0.01).throttle_frac ==
        doctest::Approx(0.98));  // but the command continues from it
}

TEST_CASE(
    "where nobody's command is in force a law begins at the aircraft's attitude within its limits, and at "
    "cruise throttle") {
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  limits.throttle_cruise_frac = 0.5;
  limits.pitch_min_rad = -0.35;
  limits.pitch_max_rad = 0.4;
  OuterTuning tuning;
  tuning.course.roll_max_rad = 0.785;
  OuterCommands commands;
  const auto begins = [&](const VehicleState& s, const AttitudeCommand* last) {
    const bool somebodys = commands.take_over(OuterLaw::hold, s, last, tuning, limits);
    CHECK(somebodys == (last != nullptr));
    CHECK(somebodys == commands.taking_up());
    return commands.last();
  };
  const AttitudeCommand turn{0.2, 0, 0}, glide;
  VehicleState s = at(15, 15, 70);
  s.attitude_valid = true;
  s.roll_rad = 2.5;
  s.pitch_rad = -1.2;
  CHECK(begins(s, nullptr).roll_rad == 0.785);
  CHECK(commands.last().pitch_rad == -0.35);
  CHECK(commands.last().throttle_frac == 0.5);
  s.roll_rad = 0.3;
  s.pitch_rad = 0.1;
  CHECK(begins(s, nullptr).roll_rad == 0.3);
  CHECK(commands.last().pitch_rad == 0.1);
  CHECK(begins(s, &glide).roll_rad == 0);  // zeros are a command
  CHECK(commands.last().pitch_rad == 0);
  CHECK(commands.last().throttle_frac == 0);
  s.attitude_valid = false;
  CHECK(begins(s, nullptr).roll_rad == 0);
  CHECK(commands.last().throttle_frac == 0.5);
  CHECK(begins(s, &turn).roll_rad == 0.2);  // of a previous component: taken up unchanged
  CHECK(commands.last().throttle_frac == 0);
  for (const double wind : {0.0, 5.0}) {  // on the ground the engine stays off
    VehicleState ground = at(wind, 0, 0.2);
    ground.attitude_valid = true;
    ground.pitch_rad = 0.15;
    CHECK(begins(ground, nullptr).throttle_frac == 0);
    CHECK(commands.last().pitch_rad == 0);
  }
}

TEST_CASE("of two lowest pitches the higher one holds, and near the stall the ceiling") {
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  limits.pitch_max_rad = 0.4;
  limits.pitch_min_rad = -0.2;
  CHECK(PitchLimits(Envelope{}, limits, 0.35).min == -0.2);
  CHECK(PitchLimits(Envelope{}, limits, 0.1).min == -0.1);
  CHECK(PitchLimits(Envelope{}, limits, 0.35).max == 0.35);
  CHECK(PitchLimits(Envelope{.pitch_max_rad = 0.2}, limits, 0.35).max == 0.2);
  CHECK(PitchLimits(Envelope{.pitch_max_rad = -0.3}, limits, 0.35).min == -0.3);
}

TEST_CASE(
    "the airspeed that a law divides by is never below half the minimum, and cruise when it is not known") {
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  limits.airspeed_cruise_mps = 16;
  CHECK(scheduling_airspeed(at(12, 12, 70), limits) == 12);
  CHECK(scheduling_airspeed(at(1, 12, 70), limits) == 5);
  CHECK(scheduling_airspeed(at(1, 12, 70, false), limits) == 16);
}

TEST_CASE("a take-off run that loses its airspeed after rotation lowers the nose") {
  TakeoffRun run;
  FlightLimits limits;
  limits.airspeed_min_mps = 10;
  limits.pitch_max_rad = 0.4;
  const TakeoffTuning tuning{
      .throttle_frac = 1, .pitch_rad = 0.25, .rotate_mps = 12, .course_kp = 1, .roll_max_rad = 0.1};
  run.begin(at(0, 0, 0));
  CHECK(run.step(at(13, 13, 1), tuning, limits).pitch_rad == 0.25);
  CHECK(run.step(at(9, 9, 3), tuning, limits).pitch_rad == doctest::Approx(0.2));
  CHECK(run.step(at(7, 7, 3), tuning, limits).pitch_rad == 0);
}

TEST_CASE("course hold's integral grows with ground speed as its gain does") {
  const CourseTuning tuning{
      .kp = 0, .ki = 0.1, .cruise_mps = 15, .roll_max_rad = 2, .roll_rate_max_radps = 100, .smoothing_s = 0};
  for (const double ratio : {1.0, 1.5}) {
    CourseHold hold;
    double roll = 0;
    for (int i = 0; i < 200; ++i) roll = hold.step(at(15, 15 * ratio, 70), 0.1, 0, tuning, 0.01);
    CHECK(roll / (0.1 * ratio * 0.1 * 2) == doctest::Approx(1));  // 2 s
  }
}

TEST_CASE("an acceleration empties the course's integral and ends at the roll limit") {
  const CourseTuning tuning{.kp = 2,
                            .ki = 0.5,
                            .cruise_mps = 15,
                            .roll_max_rad = 0.7,
                            .roll_rate_max_radps = 1000,
                            .smoothing_s = 0};
  CourseHold hold;
  for (int i = 0; i < 300; ++i) hold.step(at(15, 15, 70), 0.05, 0, tuning, 0.01);
  CHECK(std::tan(hold.accelerate(4, tuning, 0.01)) * 9.80665 / 4 == doctest::Approx(1));
  CHECK(hold.error_rad() == 0);
  CHECK_FALSE(hold.saturated());
  CHECK(hold.accelerate(-12, tuning, 0.01) == -0.7);
  CHECK(hold.saturated());
  CHECK(hold.step(at(15, 15, 70), 0, 0, tuning, 0.01) == 0);
  CHECK_FALSE(hold.saturated());
}

}  // namespace outer_commands_test
