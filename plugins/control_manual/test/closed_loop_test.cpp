// SPDX-License-Identifier: BSD-3-Clause
// The laws fly the nonlinear Anaconda of sdk/test/flight, which stalls at 10 m/s and at 15 degrees.
#include "kit.hpp"
#include "plugins/control_manual/inner.hpp"
#include "plugins/control_manual/outer.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace closed_loop_test {

using namespace fulmar;
using kit::deg;
using kit::stick;
using manual::Inner;
using manual::Outer;
using Law = Inner::Law;

namespace {

struct Flight {
  test::FlightModel model;
  kit::Hand<Outer> outer;
  kit::Hand<Inner> inner;
  Rc rc = stick();
  VehicleState state;
  double slowest = 1e9, fastest = 0, alpha = 0, bank = 0, lowest = 1e9;

  explicit Flight(Law law, Turbulence turbulence = Turbulence::none,
                  const Airframe& airframe = test::anaconda())
      : model(airframe, turbulence, 1) {
    outer.params.airframe.value = inner.params.airframe.value = airframe;
    inner.params.aileron.value = inner.params.elevator.value = law;
    inner.params.throttle.value = Inner::Throttle::automatic;
    outer.params.pitch_range.value = outer.params.roll_range.value = 0.8;
    model.x.p_n.z() = -500;
  }
  void protect(bool on) {
    outer.params.envelope.protection.value = inner.params.envelope.protection.value = on;
    outer.configure();
    inner.configure();
  }

  template <class Observe>
  void run(double seconds, Observe observe) {
    slowest = lowest = 1e9;
    fastest = alpha = bank = 0;
    for (int i = 0; i < static_cast<int>(seconds * 100); ++i) {
      state = model.state();
      outer.fly(rc, state);
      inner.set(inner.in.attitude, outer.out.attitude);
      inner.fly(rc, state);
      for (int k = 0; k < 4; ++k) model.step(inner.out.actuators, 0.0025);
      slowest = std::min(slowest, state.airspeed_mps);
      fastest = std::max(fastest, state.airspeed_mps);
      alpha = std::max(alpha, state.alpha_rad);
      bank = std::max(bank, std::abs(state.roll_rad));
      lowest = std::min(lowest, state.height_m);
      observe();
    }
  }
  void run(double seconds) {
    run(seconds, [] {});
  }
};

}  // namespace

TEST_CASE(
    "stick full back and the motor off: a tenth over the stall is kept in every law, also in turbulence and "
    "turns" *
    doctest::test_suite("amounts")) {
  for (const Law law : {Law::attitude, Law::rate, Law::surface})
    for (const Turbulence turbulence : {Turbulence::none, Turbulence::light})
      for (const double roll : {0.0, 1.0}) {
        Flight flight(law, turbulence);
        flight.run(10);
        flight.rc = stick(roll, 1, 0);
        flight.run(40);
        CAPTURE(static_cast<int>(law));
        CAPTURE(roll);
        CHECK(flight.slowest > 11);
        CHECK(flight.alpha < 13 * deg);
        CHECK(flight.bank < 50 * deg);
      }
}

TEST_CASE("with the protection off the same sticks stall it" * doctest::test_suite("amounts")) {
  for (const Law law : {Law::attitude, Law::rate, Law::surface}) {
    Flight flight(law);
    flight.protect(false);
    flight.run(10);
    flight.rc = stick(0, 1, 0);
    flight.run(40);
    CHECK(flight.alpha > 25 * deg);
  }
}

TEST_CASE("stick full forward and full throttle: 5 % over the largest airspeed is not passed" *
          doctest::test_suite("amounts")) {
  for (const Law law : {Law::attitude, Law::rate, Law::surface}) {
    Flight flight(law);
    flight.run(10);
    flight.rc = stick(0, -1, 1);
    flight.run(30);
    CHECK(flight.fastest < 26);
    flight.model.x.p_n.z() = -500;
    flight.protect(false);
    flight.run(30);
    CHECK(flight.fastest > 1.2 * 25);
  }
}

TEST_CASE("angles: each axis comes to where its stick says, without the other one") {
  Flight flight(Law::attitude);
  flight.run(15);
  const double pitch = flight.state.pitch_rad, height = flight.state.height_m;
  CHECK(std::abs(flight.state.roll_rad) < 0.5 * deg);
  CHECK(std::abs(height - 500) < 10);  // hands off at cruise throttle it stays level
  flight.rc = stick(0.5);
  flight.run(3);
  CHECK(flight.state.roll_rad == doctest::Approx(0.4).epsilon(0.03));
  flight.rc = stick(0, 0.1);
  flight.run(3);
  CHECK(flight.state.pitch_rad - pitch == doctest::Approx(0.08).epsilon(0.1));
  CHECK(std::abs(flight.state.roll_rad) < 1 * deg);
}

TEST_CASE("rates: a stick is a rate, and let go the attitude stays") {
  Flight flight(Law::rate);
  flight.run(15);
  flight.rc = stick(0.2);  // 0.3 rad/s
  double begin = 0, end = 0;
  int i = 0;
  flight.run(1.5, [&] {
    if (++i == 50) begin = flight.state.roll_rad;
    end = flight.state.roll_rad;
  });
  CHECK((end - begin) / 1.0 == doctest::Approx(0.3).epsilon(0.05));
  flight.rc = stick();
  flight.run(1);
  const double bank = flight.state.roll_rad;
  flight.run(10);
  CHECK(std::abs(flight.state.roll_rad - bank) < 3 * deg);
  Flight other(Law::rate);
  other.run(15);
  other.rc = stick(0, 0.5);  // 0.3 rad/s of pitch
  i = 0;
  other.run(0.7, [&] {
    if (++i == 30) begin = other.state.pitch_rad;
    end = other.state.pitch_rad;
  });
  CHECK((end - begin) / 0.4 == doctest::Approx(0.3).epsilon(0.12));
}

TEST_CASE(
    "a pilot who is lost in a steep turn leaves it with its wings level, near its speed, in every law") {
  for (const Law law : {Law::attitude, Law::rate, Law::surface}) {
    Flight flight(law);
    flight.run(10);
    flight.rc = stick(law == Law::surface ? 0.1 : 0.6, 0.1);
    flight.run(2);
    CHECK(flight.bank > 20 * deg);
    flight.rc.link = false;
    flight.run(20);
    CHECK(std::abs(flight.state.roll_rad) < 1 * deg);
    CHECK(flight.state.airspeed_mps == doctest::Approx(17).epsilon(0.1));
  }
}

TEST_CASE("one set of bandwidths flies at every speed: roll rate at 12.5 and at 24 m/s") {
  for (const double airspeed : {12.5, 24.0}) {
    Flight flight(Law::rate);
    flight.protect(false);
    flight.model.x.v_n = {airspeed, 0, 0};
    flight.rc = stick(0.4, 0, airspeed > 20 ? 0.8 : 0.5);
    double most = 0;
    flight.run(1, [&] { most = std::max(most, flight.state.rate_radps.x); });
    CHECK(flight.state.rate_radps.x == doctest::Approx(0.6).epsilon(0.12));
    CHECK(most < 0.72);
  }
}

TEST_CASE("the same bandwidths fly the Aerosonde of 11 kg: angles, rates, and its stall") {
  const Airframe aerosonde = test::airframe_file("aerosonde");
  for (const Law law : {Law::attitude, Law::rate}) {
    Flight flight(law, Turbulence::none, aerosonde);
    flight.rc = stick(0, 0, aerosonde.limits.throttle_cruise_frac);
    flight.run(15);
    CHECK(std::abs(flight.state.roll_rad) < 2 * deg);
    const double bank = flight.state.roll_rad;
    flight.rc.roll_frac = law == Law::rate ? 0.2 : 0.5;
    flight.run(law == Law::rate ? 1 : 3);
    CHECK(flight.state.roll_rad - bank == doctest::Approx(law == Law::rate ? 0.3 : 0.4).epsilon(0.12));
    flight.rc = stick(0, 1, 0);
    flight.run(40);
    CHECK(flight.slowest > 1.1 * aerosonde.limits.airspeed_min_mps / 1.2);
    CHECK(flight.alpha < aerosonde.wing.stall_alpha_rad);
  }
}

}  // namespace closed_loop_test
