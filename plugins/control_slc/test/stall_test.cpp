// SPDX-License-Identifier: BSD-3-Clause
// The outer law near the stall, with the nonlinear aircraft of sdk/test/flight: heavier than in its
// parameters, in turbulence, with little static margin, in an updraft.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#include "plugins/control_slc/inner.hpp"
#include "plugins/control_slc/outer.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace stall_test {

using namespace fulmar;

namespace {

/// The laws have the parameters of `nominal`; `body` is the simulated aircraft.
struct Flight {
  test::FlightModel model;
  Bench<slc::Outer> outer;
  Bench<slc::Inner> inner;
  GuidanceCommand command{.course_rad = 0, .height_m = 70, .climb_rate_mps = 0, .airspeed_mps = 12};
  VehicleState state;
  double stalled_s = 0, max_s = 0, lowest_m = 1e9;
  int reported = 0;
  bool pitot = true;

  Flight(const Airframe& nominal, const Airframe& body, Turbulence turbulence, std::uint64_t seed)
      : model(body, turbulence, seed) {
    for (Record<Airframe>* record : {&outer.params.common.airframe, &inner.params.airframe}) {
      record->value = nominal;
      record->is_given = true;
    }
  }

  /// The estimator assumes level air: an updraft changes its angle of attack.
  VehicleState seen() const {
    VehicleState s = model.state();
    const double Va = std::max(s.airspeed_mps, 1.0);
    s.alpha_rad = (s.pitch_rad - std::asin(std::clamp(s.climb_rate_mps / Va, -1.0, 1.0))) /
                  std::max(std::cos(s.roll_rad), 0.5);
    s.airspeed_valid = s.airspeed_valid && pitot;
    s.wind_valid = true;
    return s;
  }

  void run(double seconds) {
    for (int k = 0; k < static_cast<int>(100 * seconds + 0.5); ++k) {
      state = seen();
      outer.set(outer.in.state, state);
      outer.set(outer.in.command, command);
      outer.step(0.01);
      inner.set(inner.in.state, state);
      inner.set(inner.in.attitude, outer.out.attitude);
      inner.step(0.01);
      for (int i = 0; i < 4; ++i) model.step(inner.out.actuators, 0.0025);
      const bool stalled = model.state().alpha_rad > model.airframe.wing.stall_alpha_rad;
      stalled_s = stalled ? stalled_s + 0.01 : 0;
      max_s = std::max(max_s, stalled_s);
      lowest_m = std::min(lowest_m, state.height_m);
      reported += outer.out.internals.stalled;
    }
  }
};

Airframe glider() {
  Airframe a = test::anaconda();
  a.aero.pitch.alpha_ratio = -0.15 * a.aero.lift.alpha_ratio;
  a.aero.parasite_drag_ratio = 0.02;
  return a;
}

}  // namespace

TEST_CASE("a tenth heavier than said, at its least airspeed, in moderate turbulence and turns: it stays up") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    Airframe heavy = test::anaconda();
    heavy.mass_kg *= 1.1;
    Flight f(test::anaconda(), heavy, Turbulence::moderate, seed);
    f.run(10);
    for (int leg = 0; leg < 6; ++leg) {
      f.command.course_rad = wrap_pi(f.command.course_rad + 2.4);
      f.run(15);
    }
    CHECK(f.lowest_m > 52);
    CHECK(f.max_s < 2);
    CHECK(f.state.airspeed_mps > 11);
  }
}

TEST_CASE("an aircraft with little static margin leaves the stall that an updraft of 16 m/s makes") {
  for (const bool pitot : {true, false})
    for (const Airframe& a : {test::anaconda(), glider()}) {
      CAPTURE(pitot);
      CAPTURE(a.aero.pitch.alpha_ratio);
      Flight f(a, a, Turbulence::none, 1);
      f.command.airspeed_mps = 14;
      f.run(20);
      f.pitot = pitot;
      f.model.wind_n.z() = -16;
      f.run(1.5);
      f.model.wind_n.z() = 0;
      f.run(30);
      CHECK(f.max_s < 2);
      CHECK(f.lowest_m > 40);
      CHECK(std::abs(f.state.height_m - 70) < 5);
    }
}

TEST_CASE("nose up and slow without power, as a pilot may hand over: out of it within seconds") {
  Flight f(test::anaconda(), test::anaconda(), Turbulence::none, 1);
  f.run(5);
  for (int i = 0; i < 800; ++i) f.model.step({0, 0, -0.6, 0}, 0.0025);  // elevator up, motor off
  f.run(30);
  CHECK(f.max_s < 2);
  CHECK(f.lowest_m > 25);
  CHECK(std::abs(f.state.height_m - 70) < 3);
}

TEST_CASE("in calm air at cruise nothing of it shows: no flag, and the airspeed that is commanded") {
  Flight f(test::anaconda(), test::anaconda(), Turbulence::light, 3);
  f.command.airspeed_mps = 17;
  f.run(10);
  for (int leg = 0; leg < 4; ++leg) {
    f.command.course_rad = wrap_pi(f.command.course_rad + 1.6);
    f.run(10);
    CHECK_FALSE(f.outer.out.internals.airspeed_raised);
    CHECK_FALSE(f.outer.out.internals.bank_limited);
  }
  CHECK(f.reported == 0);
  CHECK(std::abs(f.state.airspeed_mps - 17) < 1.5);
}

}  // namespace stall_test
