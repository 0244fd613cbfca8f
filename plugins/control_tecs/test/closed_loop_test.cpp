// SPDX-License-Identifier: BSD-3-Clause
// The energy laws fly the nonlinear Anaconda of sdk/test/flight through plain attitude loops.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#include "plugins/control_tecs/error_law.hpp"
#include "plugins/control_tecs/outer.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace closed_loop_test {

using namespace fulmar;

namespace {
constexpr double deg = std::numbers::pi / 180;

/// Proportional attitude loops with damping about the turn's rates, sufficient for a test of the outer loops.
Actuators attitude_loops(const VehicleState& s, const AttitudeCommand& c, const Airframe& a) {
  const TurnRates turn = turn_rates(s.roll_rad, s.pitch_rad, s.airspeed_mps);
  const double density = standard_air(s.origin_altitude_m + s.height_m).density_kgm3;
  const double trim = turn_trim(a, s.roll_rad, std::max(s.airspeed_mps, 10.0), density).elevator_rad;
  return {c.throttle_frac, 1.5 * (c.roll_rad - s.roll_rad) - 0.05 * s.rate_radps.x,
          trim - 5 * (c.pitch_rad - s.pitch_rad) + 0.5 * (s.rate_radps.y - turn.q_radps),
          0.3 * (s.rate_radps.z - turn.r_radps)};
}

template <class Law>
struct FlightOf {
  test::FlightModel model;
  Bench<Law> outer;
  GuidanceCommand command{
      .course_rad = 0, .height_m = 70, .climb_rate_mps = 0, .airspeed_mps = 17, .roll_feedforward_rad = 0};
  VehicleState state;

  explicit FlightOf(Turbulence turbulence = Turbulence::none, std::uint64_t seed = 1)
      : model(test::anaconda(), turbulence, seed) {
    outer.params.common.airframe.value = model.airframe;
    outer.params.common.airframe.is_given = true;
    state = model.state();
  }
  template <class Observe>
  void run(double seconds, Observe observe) {
    for (int k = 0; k < static_cast<int>(seconds * 100 + 0.5); ++k) {
      state = model.state();
      outer.set(outer.in.state, state);
      outer.set(outer.in.command, command);
      outer.step(0.01);
      const Actuators u = attitude_loops(state, outer.out.attitude, model.airframe);
      for (int i = 0; i < 4; ++i) model.step(u, 0.0025);
      observe();
    }
  }
  void run(double seconds) {
    run(seconds, [] {});
  }
};
using Flight = FlightOf<tecs::Outer>;
}  // namespace

TEST_CASE("height steps keep the airspeed and end where they should") {
  for (double step : {20.0, -20.0}) {
    Flight flight;
    flight.run(20);
    flight.command.height_m += step;
    double most = 0, speed = 0;
    flight.run(30, [&] {
      most = std::max(most, (flight.state.height_m - 70) * (step > 0 ? 1 : -1));
      speed = std::max(speed, std::abs(flight.state.airspeed_mps - 17));
    });
    CHECK(most < 21);
    CHECK(speed < 0.8);
    CHECK(std::abs(flight.state.height_m - flight.command.height_m) < 0.3);
  }
}

TEST_CASE("airspeed steps keep the height") {
  for (double step : {3.0, -3.0}) {
    Flight flight;
    flight.run(20);
    flight.command.airspeed_mps += step;
    double most = 0, height = 0;
    flight.run(20, [&] {
      most = std::max(most, (flight.state.airspeed_mps - 17) * (step > 0 ? 1 : -1));
      height = std::max(height, std::abs(flight.state.height_m - 70));
    });
    CHECK(most < 3.5);
    CHECK(std::abs(flight.state.airspeed_mps - flight.command.airspeed_mps) < 0.2);
    CHECK(height < 1);
  }
}

TEST_CASE(
    "a course step of 90 degrees costs less than half a metre of height and a third of a metre per second") {
  Flight flight;
  flight.run(20);
  flight.command.course_rad = 90 * deg;
  double sag = 0, speed = 0;
  flight.run(15, [&] {
    sag = std::max(sag, std::abs(flight.state.height_m - 70));
    speed = std::max(speed, std::abs(flight.state.airspeed_mps - 17));
  });
  CHECK(std::abs(flight.state.course_rad - 90 * deg) < 1 * deg);
  CHECK(sag < 0.5);
  CHECK(speed < 0.33);
}

TEST_CASE_TEMPLATE("what no aircraft can do is limited, told, and not followed into a stall", Law,
                   tecs::Outer, tecs::ErrorLaw) {
  struct {
    double height_m, climb_mps, airspeed_mps;
    bool climbs;
  } const wanted[] = {{70, 0, 5, false},     // half of the stalling speed
                      {1070, 30, 17, true},  // six times the climb that it has
                      {1070, 30, 5, true},   // both
                      {-930, -30, 60, false}};
  for (const auto& w : wanted) {
    CAPTURE(w.airspeed_mps);
    CAPTURE(w.climb_mps);
    FlightOf<Law> flight;
    flight.run(10);
    flight.command.height_m = w.height_m;
    flight.command.climb_rate_mps = w.climb_mps;
    flight.command.airspeed_mps = w.airspeed_mps;
    double slowest = 99, fastest = 0;
    unsigned reported = 0, steps = 0;
    flight.run(8, [&] {
      slowest = std::min(slowest, flight.state.airspeed_mps);
      fastest = std::max(fastest, flight.state.airspeed_mps);
      ++steps;
      reported += flight.outer.out.internals.pitch_saturated;
    });
    CHECK(slowest > 11);  // it stalls at 10, and 12 is the least that is flown
    CHECK(fastest < 28);
    if (w.climb_mps != 0) CHECK(reported > steps / 2);
    if (w.climbs) CHECK(flight.state.climb_rate_mps > 2);
    if (w.climb_mps == 0)
      CHECK(flight.outer.out.internals.airspeed_error_mps ==
            doctest::Approx(12 - flight.state.airspeed_mps).epsilon(0.05));
  }
}

TEST_CASE_TEMPLATE("a command that is no number levels the wings at cruise, says so, and poisons nothing",
                   Law, tecs::Outer, tecs::ErrorLaw) {
  const double nan = std::nan("");
  for (double GuidanceCommand::*field :
       {&GuidanceCommand::course_rad, &GuidanceCommand::height_m, &GuidanceCommand::climb_rate_mps,
        &GuidanceCommand::airspeed_mps, &GuidanceCommand::roll_feedforward_rad}) {
    FlightOf<Law> flight;
    flight.run(10);
    const GuidanceCommand before = flight.command;
    flight.command.*field = nan;
    flight.run(3, [&] {
      const AttitudeCommand& a = flight.outer.out.attitude;
      REQUIRE(std::isfinite(a.roll_rad + a.pitch_rad + a.throttle_frac));
    });
    CHECK(std::abs(flight.outer.out.attitude.roll_rad) < 1e-3);
    CHECK(flight.outer.step(0.01) == Status::degraded);
    flight.command = before;
    flight.run(10);
    CHECK(flight.outer.step(0.01) == Status::ok);
    CHECK(std::abs(flight.state.height_m - 70) < 0.5);
    CHECK(std::abs(flight.state.airspeed_mps - 17) < 0.3);
  }
}

TEST_CASE("a dead engine ends in a glide at the commanded airspeed, not in a stall") {
  Flight flight;
  flight.run(20);
  flight.model.airframe.propulsion.battery_volt = 0;
  flight.model.propeller = Propeller(flight.model.airframe.propulsion);
  double slowest = 99;
  flight.run(12, [&] { slowest = std::min(slowest, flight.state.airspeed_mps); });
  CHECK(slowest > 10.2);  // stalls at 10
  CHECK(flight.state.climb_rate_mps < 0);
}

}  // namespace closed_loop_test
