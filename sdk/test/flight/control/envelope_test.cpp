// SPDX-License-Identifier: BSD-3-Clause
// Stall protection of an outer law: minimum airspeed, maximum bank, maximum pitch, and stall recovery. The
// expected values come from the lift equation, computed here.
#include <doctest/doctest.h>

#include <fulmar/flight/control/envelope.hpp>
#include <fulmar/flight/control/envelope_reports.hpp>

#include "sdk/test/flight/flight_model.hpp"

namespace envelope_test {

using namespace fulmar;

namespace {
constexpr double rho = 1.0635, g = 9.80665;

VehicleState level(double airspeed_mps, double alpha_rad = 0.05) {
  VehicleState s;
  s.airspeed_mps = s.ground_speed_mps = airspeed_mps;
  s.pitch_rad = s.alpha_rad = alpha_rad;
  s.height_m = 70;
  s.specific_force_mps2.z = -g;
  s.attitude_valid = s.velocity_valid = s.height_valid = s.airspeed_valid = s.wind_valid = true;
  return s;
}

struct Guarded {
  Airframe airframe = test::anaconda();
  EnvelopeGuard guard;
  Envelope now;
  bool guarded = true;

  void fly(const VehicleState& s, double seconds, double bank_rad = 0, double climb_rate_mps = 0) {
    if (!guard.configured()) guard.configure(airframe);
    for (int i = 0; i < static_cast<int>(100 * seconds + 0.5); ++i)
      now = guard.step(s, airframe.limits, rho, bank_rad, climb_rate_mps, guarded, 0.01);
  }
};

/// Acceleration along the level velocity: the accelerometer reading without gravity.
void own_acceleration(VehicleState& s, double mps2) {
  s.specific_force_mps2.x = mps2 * std::cos(s.alpha_rad) + g * std::sin(s.pitch_rad);
  s.specific_force_mps2.z = mps2 * std::sin(s.alpha_rad) - g * std::cos(s.pitch_rad);
}

/// Nose 20 degrees up with a sink: the angle of attack is the sum of both.
VehicleState mushing(double sink_mps, double airspeed_mps = 13) {
  VehicleState s = level(airspeed_mps);
  s.pitch_rad = 0.35;
  s.climb_rate_mps = -sink_mps;
  s.alpha_rad = s.pitch_rad + std::asin(sink_mps / airspeed_mps);
  s.specific_force_mps2.z = -0.6 * g;
  return s;
}
}  // namespace

TEST_CASE("the wing's own model says where lift ends: as far as the stall blending lets it grow") {
  const WingEnvelope w(test::anaconda());
  CHECK(w.max_lift == doctest::Approx(1.515).epsilon(0.005));
  CHECK(w.stall_alpha_rad == doctest::Approx(0.209).epsilon(0.01));
  // Slope with the elevator that balances the moment: 5.61 - 0.13 * 2.74 / 0.99; zero lift at -(0.506 + ..)
  // over it.
  const double slope = 5.61 - 0.13 * 2.74 / 0.99, zero = -(0.506 + 0.13 * 0.135 / 0.99) / slope;
  CHECK(w.zero_alpha_rad == doctest::Approx(zero).epsilon(0.01));
  CHECK(w.share(zero + 0.1) == doctest::Approx(0.1 * slope / w.max_lift).epsilon(0.01));
  CHECK(w.alpha_of(w.share(0.07)) == doctest::Approx(0.07));
}

TEST_CASE("the stalling speed is that of the weight and the density, and not below what the limits say") {
  Airframe a = test::anaconda();
  const double slowest = std::sqrt(2 * 4.5 * g / (rho * 0.52 * 1.515));
  CHECK(WingEnvelope(a).stall_mps(a.limits, rho) == doctest::Approx(slowest).epsilon(0.003));
  a.mass_kg *= 1.15;
  CHECK(WingEnvelope(a).stall_mps(a.limits, rho) ==
        doctest::Approx(slowest * std::sqrt(1.15)).epsilon(0.003));
  a.limits.airspeed_min_mps = 18;
  CHECK(WingEnvelope(a).stall_mps(a.limits, rho) == doctest::Approx(15));
  a = {};  // without a lift model
  a.limits.airspeed_min_mps = 12;
  CHECK(WingEnvelope(a).stall_mps(a.limits, rho) == doctest::Approx(10));
}

TEST_CASE("the least airspeed grows with the root of the load factor, to both sides, and with the mass") {
  for (const double bank : {0.0, 0.5, -0.5, 0.78}) {
    CAPTURE(bank);
    Guarded f;
    f.fly(level(17), 1, bank);
    CHECK(f.now.airspeed_min_mps == doctest::Approx(12 / std::sqrt(std::cos(bank))).epsilon(1e-6));
    CHECK(f.now.slowest_mps == f.now.airspeed_min_mps);
    CHECK(f.now.pitch_max_rad >= f.airframe.limits.pitch_max_rad);  // no limit far from the stall
  }
  Guarded heavy;
  heavy.airframe.mass_kg *= 1.15;
  heavy.fly(level(17), 1);
  const double stall = std::sqrt(2 * 1.15 * 4.5 * g / (rho * 0.52 * 1.515));
  CHECK(heavy.now.airspeed_min_mps == doctest::Approx(1.15 * stall).epsilon(0.003));
  CHECK(heavy.now.airspeed_min_mps > 12.5);
  heavy.airframe.limits.airspeed_max_mps = 12.2;
  heavy.fly(level(17), 1);
  CHECK(heavy.now.airspeed_min_mps == 12.2);
}

TEST_CASE("an angle of attack that is too large for the airspeed raises the least airspeed: a mass unsaid") {
  Guarded f;
  VehicleState s = level(12);
  const WingEnvelope w(f.airframe);
  s.alpha_rad = s.pitch_rad = w.alpha_of(0.95);
  own_acceleration(s, 0);
  f.fly(s, 10);
  CHECK(f.now.airspeed_min_mps > 12.5);
  CHECK(f.now.airspeed_min_mps < 14);
  CHECK(f.now.slowest_mps == doctest::Approx(12));  // the limit for priorities does not change
  s.wind_valid = false;
  f.fly(s, 1);
  CHECK(f.now.airspeed_min_mps == doctest::Approx(12));
}

TEST_CASE("gusts that take airspeed raise the least airspeed; a change that the aircraft makes does not") {
  Guarded calm, gusty;
  for (int i = 0; i < 3000; ++i) {
    VehicleState s = level(17 + std::sin(0.01 * i));
    own_acceleration(s, std::cos(0.01 * i));
    calm.fly(s, 0.01);
    s = level(17 + 2 * std::sin(0.02 * i));
    own_acceleration(s, 0);
    gusty.fly(s, 0.01);
  }
  CHECK(calm.now.airspeed_min_mps < 12.5);
  CHECK(gusty.now.airspeed_min_mps > 14);
}

TEST_CASE(
    "at cruise airspeed neither gusts nor a turn nor the angle of attack ask for more, or limit pitch") {
  for (const double cruise : {15.0, 17.0}) {
    CAPTURE(cruise);
    Guarded f;
    f.airframe.limits.airspeed_min_mps = 13;
    f.airframe.limits.airspeed_cruise_mps = cruise;
    const double used = WingEnvelope(f.airframe).alpha_of(1.0);
    for (int i = 0; i < 3000; ++i) {
      VehicleState s = level(cruise + 2 * std::sin(0.02 * i), used);
      own_acceleration(s, 0);
      s.specific_force_mps2.z *= 1.4;
      f.fly(s, 0.01, 0.785);
    }
    CHECK(f.now.airspeed_min_mps == cruise);
    CHECK(f.now.slowest_mps <= cruise);
    VehicleState s = level(cruise, used);
    f.fly(s, 1, 0.785);
    CHECK(f.now.pitch_max_rad >= f.airframe.limits.pitch_max_rad);
    s.airspeed_mps = 0.88 * cruise;
    f.fly(s, 1, 0.785);
    CHECK(f.now.pitch_max_rad < f.airframe.limits.pitch_max_rad);
  }
}

TEST_CASE(
    "the wing carries a bank with a twentieth above its own stall, and a tenth above that of the limits") {
  Guarded f;
  f.guard.configure(f.airframe);
  const double stall = std::sqrt(2 * 4.5 * g / (rho * 0.52 * 1.515));
  f.airframe.limits.airspeed_min_mps = 10;
  CHECK(f.guard.bank_max(14, f.airframe.limits, rho) ==
        doctest::Approx(std::acos(std::pow(1.05 * stall / 14, 2))).epsilon(0.005));
  f.airframe.limits.airspeed_min_mps = 13.2;
  CHECK(f.guard.bank_max(14, f.airframe.limits, rho) == doctest::Approx(std::acos(std::pow(12.1 / 14, 2))));
}

TEST_CASE("a stall is seen by the angle of attack within half a second, and left when the wing flies again") {
  Guarded f;
  f.fly(level(13), 2);
  f.fly(mushing(5, 12), 0.25);
  CHECK_FALSE(f.guard.stalled());
  f.fly(mushing(5, 12), 0.25);
  CHECK(f.guard.stalled());
  const double path = -std::asin(5.0 / 12);
  const double pitch = path + WingEnvelope(f.airframe).alpha_of(0.6);
  CHECK(f.guard.recovery_pitch(f.airframe.limits) == doctest::Approx(std::max(pitch, -0.35)).epsilon(0.01));
  f.fly(mushing(5, 12), 5);
  CHECK(f.guard.stalled());
  f.fly(level(14), 0.15);
  CHECK(f.guard.stalled());
  f.fly(level(14), 0.3);
  CHECK_FALSE(f.guard.stalled());
}

TEST_CASE(
    "without airspeed or wind a stall is what pitch and sink leave, of which more is asked, for longer") {
  for (const bool tube : {true, false}) {
    CAPTURE(tube);
    Guarded f;
    VehicleState s = mushing(5);
    s.alpha_rad = 0;
    s.wind_valid = false;
    s.airspeed_valid = tube;
    f.fly(s, 0.8);
    CHECK_FALSE(f.guard.stalled());
    f.fly(s, 0.4);
    CHECK(f.guard.stalled());
  }
}

TEST_CASE("well above the stalling speed an angle of attack that is too large is a stall after a second") {
  const double stall = std::sqrt(2 * 4.5 * g / (rho * 0.52 * 1.515));
  for (const double bank : {0.0, 0.7}) {
    CAPTURE(bank);
    const double edge = 1.2 * stall / std::sqrt(std::cos(bank));
    Guarded near, away;
    near.fly(mushing(5, edge - 0.2), 0.5, bank);
    CHECK(near.guard.stalled());
    away.fly(mushing(5, edge + 0.2), 0.8, bank);
    CHECK_FALSE(away.guard.stalled());
    away.fly(mushing(5, edge + 0.2), 0.4, bank);
    CHECK(away.guard.stalled());
  }
}

TEST_CASE(
    "no stall: air that sinks, a fast aircraft, a dive that is asked for, a flare, a velocity unknown") {
  struct Case {
    const char* what;
    VehicleState s;
    double climb_rate_mps = 0;
    bool guarded = true;
  };
  VehicleState downdraft = mushing(5), blind = mushing(5), holding = level(17, 0.3);
  downdraft.specific_force_mps2.z = 2;  // the wing pushes down
  blind.velocity_valid = false;
  for (const Case& c : {Case{"downdraft", downdraft}, Case{"height is held in it", holding},
                        Case{"fast", mushing(5, 18)}, Case{"asked for", mushing(5), -6},
                        Case{"flare", mushing(5), 0, false}, Case{"velocity unknown", blind}}) {
    CAPTURE(c.what);
    Guarded f;
    f.guarded = c.guarded;
    f.fly(c.s, 5, 0, c.climb_rate_mps);
    CHECK_FALSE(f.guard.stalled());
  }
}

TEST_CASE("a stall whose recovery takes the lift away was air that sinks, and is left") {
  Guarded f;
  VehicleState s = mushing(5, 12);
  f.fly(s, 1);
  CHECK(f.guard.stalled());
  s.specific_force_mps2.z = 0;
  f.fly(s, 0.6);
  CHECK_FALSE(f.guard.stalled());
}

TEST_CASE(
    "beyond the stall pitch stays limited though lift is gone; in air that sinks it is free after seconds") {
  Guarded f;
  VehicleState s = level(12);
  s.alpha_rad = s.pitch_rad = 0.3;
  f.fly(s, 1);
  const double most = f.now.pitch_max_rad;
  CHECK(most < 0.2);
  s.specific_force_mps2.z = -0.3 * g;
  f.fly(s, 0.01);
  CHECK(f.now.pitch_max_rad < most + 0.15);
  f.fly(s, 4);
  CHECK(f.now.pitch_max_rad > most + 0.15);
}

TEST_CASE("after a fall height is regained: not for a descent that is asked for, until the height is near") {
  Guarded f;
  VehicleState s = level(14);
  f.fly(s, 1);
  s.climb_rate_mps = -4;
  CHECK_FALSE(f.guard.regains(s, 20, -3, 0.6));  // a descent
  CHECK_FALSE(f.guard.regains(s, 4, 0, 0.6));
  CHECK_FALSE(f.guard.regains(s, 6, 0, 0.4));  // as after a switch
  CHECK(f.guard.regains(s, 6, 0, 0.4));
  CHECK(f.guard.bank_max(30, f.airframe.limits, rho) == doctest::Approx(0.26));
  s.climb_rate_mps = 3;
  CHECK(f.guard.regains(s, 12, 0, 0.6));
  s.airspeed_valid = false;
  CHECK_FALSE(f.guard.regains(s, 12, 0, 0.6));  // the law flies until the airspeed is valid again
  s.airspeed_valid = true;
  CHECK(f.guard.regains(s, 12, 0, 0.6));
  CHECK_FALSE(f.guard.regains(s, 10.9, 0, 0.6));  // two seconds of climb and 5 m
  CHECK(f.guard.bank_max(30, f.airframe.limits, rho) > 1);
}

TEST_CASE("on the way up airspeed that is too much raises the nose, as far as the wing's lift allows") {
  Guarded f;
  VehicleState s = level(25);
  f.fly(s, 2);
  const WingEnvelope w(f.airframe);
  const double lift = 4.5 * g / (0.5 * rho * 25 * 25 * 0.52 * w.max_lift);
  // 25 m/s against 1.1 times the slowest airspeed; the flight is level, and pitch is 0.05 rad above it.
  const double rate = 0.05 * (25 - 1.1 * f.now.slowest_mps) + 0.1 * airspeed_rate(s);
  CHECK(f.guard.regaining_pitch(s, f.now, 0.1, 0.01) == doctest::Approx(0.1 + 0.01 * rate).epsilon(1e-3));
  const double used = std::min(w.share(0.05), 1.2 * lift);
  CHECK(f.guard.regaining_pitch(s, f.now, 2, 0.01) ==
        doctest::Approx(std::min(0.05 + (0.9 - used) / w.share_per_rad, f.now.pitch_max_rad)).epsilon(1e-3));
  CHECK(f.guard.regaining_pitch(s, f.now, -2, 0.01) ==
        doctest::Approx(0.05 + (0.3 - lift) / w.share_per_rad).epsilon(1e-3));
}

TEST_CASE("near the stall pitch is no more than nine tenths of the lift above the flight path") {
  Guarded f;
  VehicleState s = level(12);
  const double alpha = WingEnvelope(f.airframe).alpha_of(0.9);
  s.alpha_rad = s.pitch_rad = 1.02 * alpha;
  f.fly(s, 1);
  CHECK(f.now.pitch_max_rad == doctest::Approx(alpha).epsilon(0.01));
  s.climb_rate_mps = -2;
  f.fly(s, 1);
  CHECK(f.now.pitch_max_rad == doctest::Approx(alpha - std::asin(2.0 / 12)).epsilon(0.02));
  s.climb_rate_mps = -11;  // sinking air: not below the limit
  f.fly(s, 1);
  CHECK(f.now.pitch_max_rad == f.airframe.limits.pitch_min_rad);
  f.guarded = false;
  f.fly(s, 1);
  CHECK(f.now.pitch_max_rad == doctest::Approx(f.airframe.limits.pitch_max_rad));
}

TEST_CASE(
    "height is lost when it sinks for seconds at the pitch limit; with the throttle closed it is refused") {
  using Finding = HeightWatch::Finding;
  VehicleState s = level(13);
  s.climb_rate_mps = -2;
  ControllerInternals internals;
  internals.height_error_m = 15;
  internals.pitch_saturated = true;
  const auto after = [&](double seconds, const AttitudeCommand& asked) {
    HeightWatch watch;
    Finding found = Finding::held;
    for (int i = 0; i < static_cast<int>(100 * seconds); ++i) found = watch.step(s, asked, internals, 0.01);
    return found;
  };
  const AttitudeCommand power{0, 0.3, 1}, idle{0, 0.3, 0};
  CHECK(after(4.5, power) == Finding::held);
  CHECK(after(5.5, power) == Finding::lost);
  CHECK(after(3.5, idle) == Finding::held);
  CHECK(after(4.5, idle) == Finding::contradiction);
  CHECK(after(60, power) == Finding::lost);  // a dead motor is no fault of the law
  internals.pitch_saturated = false;
  CHECK(after(60, idle) == Finding::held);
  internals.pitch_saturated = true;
  internals.height_error_m = 5;
  CHECK(after(60, idle) == Finding::held);
  internals.height_error_m = 15;
  s.climb_rate_mps = 0.5;
  CHECK(after(60, idle) == Finding::held);
}

}  // namespace envelope_test
