// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/safety/glide.hpp"

#include "kit.hpp"

namespace glide_test {

using namespace fulmar;
using namespace fulmar::safety;

namespace {

struct Law : Bench<Glide> {
  VehicleState state = kit::level(0, 0, 0.5, 14);
  GuidanceCommand command;

  Law() {
    kit::give_anaconda(params.common);
    params.airspeed_ki.value = params.airspeed_kd.value = 0;
    command.course_rad = 0.5;
    command.airspeed_mps = 14;
    state.climb_rate_mps = -4;
  }
  AttitudeCommand fly(double seconds = 3) {
    for (double t = 0; t < seconds; t += 0.01) {
      set(in.state, state, -0.01);
      set(in.command, command, -0.01);
      REQUIRE(step(0.01) != Status::failed);
      REQUIRE(validation_error() == "");
    }
    return out.attitude;
  }
};

}  // namespace

TEST_CASE("without propeller the best glide is that of a parabolic polar") {
  Airframe a = test::anaconda();
  a.propulsion.ct0_ratio = a.propulsion.ct1_ratio = a.propulsion.ct2_ratio = 0;
  a.limits.airspeed_min_mps = 6;
  // CD = CD0 + k CL^2: V = sqrt(2 m g / (rho S)) (k / CD0)^(1/4), L/D = 1 / (2 sqrt(CD0 k))
  const double rho = 1.063, k = 1 / (std::numbers::pi * 0.9 * 2.08 * 2.08 / 0.52), CD0 = 0.043;
  const double V = std::sqrt(2 * 4.5 * 9.80665 / (rho * 0.52) * std::sqrt(k / CD0));
  const BestGlide best = best_glide(a, rho, 0, 1);
  CHECK(std::abs(best.airspeed_mps - V) < 0.5);
  CHECK(best.airspeed_mps / best.sink_mps == doctest::Approx(1 / (2 * std::sqrt(CD0 * k))).epsilon(0.01));
  CHECK(best_glide(a, rho, 6, 1).airspeed_mps > best.airspeed_mps + 0.5);
  CHECK(best_glide(a, rho, -6, 1).airspeed_mps < best.airspeed_mps);
}

TEST_CASE("a propeller that the motor brakes sinks the Anaconda at 7.1 m/s, and in a bank faster") {
  // 4.5 N of drag and 14.1 N of the propeller at 17 m/s: computed apart, with B&M's polynomials.
  const Airframe a = test::anaconda();
  CHECK(sink_rate(a, 17, 0, 1.063) == doctest::Approx(7.14).epsilon(0.02));
  CHECK(sink_rate(a, 13, 0, 1.063) == doctest::Approx(3.53).epsilon(0.02));
  CHECK(sink_rate(a, 13, 0.6, 1.063) > 1.05 * sink_rate(a, 13, 0, 1.063));
  CHECK(best_glide(a, 1.063, 0, 1.2).airspeed_mps == doctest::Approx(14.4));  // the least that is allowed
}

TEST_CASE("in the steady glide pitch is angle of attack less the glide's angle, the throttle closed") {
  Law law;
  const AttitudeCommand a = law.fly();
  const double rho = standard_air(test::FlightModel::field_m + 70).density_kgm3;
  const double alpha = turn_trim(test::anaconda(), 0, 14, rho).alpha_rad;
  CHECK(law.out.sink_expected_mps.value == doctest::Approx(4.24).epsilon(0.03));
  CHECK(a.pitch_rad == doctest::Approx(alpha - std::asin(4.24 / 14)).epsilon(0.03));
  CHECK(a.throttle_frac == 0);
  CHECK(std::abs(a.roll_rad) < 0.01);
}

TEST_CASE("too fast pitches up, too slow pitches down, and the acceleration damps") {
  Law law;
  const double steady = law.fly().pitch_rad;
  law.command.airspeed_mps = 13;
  CHECK(law.fly().pitch_rad - steady == doctest::Approx(0.06).epsilon(0.02));
  law.command.airspeed_mps = 15;
  CHECK(law.fly().pitch_rad - steady == doctest::Approx(-0.06).epsilon(0.02));
  law.command.airspeed_mps = 14;
  law.params.airspeed_kd.value = 0.03;
  law.retune();
  law.state.pitch_rad = 0;
  law.state.specific_force_mps2.x = 1;
  CHECK(law.fly().pitch_rad - steady == doctest::Approx(0.03).epsilon(0.02));
}

TEST_CASE("it turns to its course either way") {
  for (const double sign : {-1.0, 1.0}) {
    Law law;
    law.command.course_rad = 0.5 + sign * 0.3;
    CHECK(law.fly().roll_rad * sign > 0.2);
  }
}

TEST_CASE(
    "above the ground it levels its wings and flares, by the sink, and the ground is where the guide says") {
  for (const double ground : {0.0, 40.0}) {
    Law law;
    HomeProgress progress;
    progress.ground_m = ground;
    law.set(law.in.progress, progress);
    law.command.lateral = LateralMode::acceleration;
    law.command.lateral_acceleration_mps2 = 3;
    law.state.height_m = ground + 4.5 * 2.6;
    const AttitudeCommand above = law.fly();
    CHECK(above.roll_rad > 0.2);
    CHECK(law.out.flare_ratio.value == 0);
    law.state.height_m = ground + 3.9 * 2.6;  // 2.6 s at 4 m/s are 10.4 m
    CHECK(std::abs(law.fly().roll_rad) < 0.01);
    CHECK(law.out.flare_ratio.value == 0);
    const double steady = law.out.attitude.pitch_rad;
    law.state.height_m = ground + 4;
    CHECK(std::abs(law.fly().pitch_rad - steady) < 0.02);  // begins with the present sink
    CHECK(law.out.flare_ratio.value == 1);
    const double begun = law.out.attitude.pitch_rad;
    law.state.height_m = ground + 1;  // lower, as fast: more
    CHECK(law.fly().pitch_rad > begun + 0.05);
    law.state.height_m = ground + 60;  // the ground has fallen away
    law.fly();
    CHECK(law.out.flare_ratio.value == 0);
  }
  Law deaf;  // without a guide: the parameter
  deaf.params.ground.value = 66;
  deaf.fly(0.1);
  CHECK(deaf.out.flare_ratio.value == 1);
}

TEST_CASE("an airspeed that is reckoned too low pulls no more in the flare than the stalling speed takes") {
  const auto pitch = [](double airspeed) {
    Law law;
    law.state.height_m = 1;
    law.state.airspeed_mps = airspeed;
    return law.fly(4).pitch_rad;
  };
  const double stall = 12 / 1.2, rho = standard_air(test::FlightModel::field_m + 1).density_kgm3;
  const double alpha = turn_trim(test::anaconda(), 0, stall, rho).alpha_rad;
  CHECK(pitch(8) - pitch(stall) < 0.03);  // its sink is divided by a lower speed, no more
  CHECK(turn_trim(test::anaconda(), 0, 8, rho).alpha_rad - alpha > 0.1);
}

TEST_CASE("whatever is not known, the throttle stays closed") {
  Law law;
  law.state.attitude_valid = false;
  CHECK(law.fly().throttle_frac == 0);
  law.state = kit::level(0, 0, 0.5, 14);
  law.state.airspeed_valid = false;
  CHECK(law.fly().throttle_frac == 0);
}

}  // namespace glide_test
