// SPDX-License-Identifier: BSD-3-Clause
// Common part of outer laws: parameters, the sequence of a step, and the demands of a banked turn. A law
// supplies a function from a turn to pitch and throttle.
//
//   struct Params { OuterParams common;  Param height_kp{...}; };
//   void configure(const Params& p) { loop_.configure(p.common); }
//   Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
//     if (!loop_.activate(*in.state, p.common, last)) integral_.reset();
//     return Status::ok;
//   }
//   Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
//     const auto rest = [&] { integral_.reset(); };
//     const auto hold = [&](const LevelTurn& turn, double dt_s) {
//       ...
//       return PitchThrottle{theta, throttle};
//     };
//     return loop_.step(tick, *in.state, *in.command, p.common, out, rest, hold);
//   }
#pragma once
#include "fulmar/flight/control/envelope.hpp"
#include "fulmar/flight/control/envelope_reports.hpp"
#include "fulmar/flight/control/outer_commands.hpp"
#include "fulmar/flight/control/turn_trim.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar {

/// Parameters of every outer law: course and bank, limits of the commands, take-off. A group: its members are
/// parameters of the law itself.
struct OuterParams {
  Choice<OuterLaw> law{
      OuterLaw::hold,
      "active law; hold: follow guidance; takeoff: full throttle, wings level, rotation, course of the "
      "runway; roll_out: closed throttle, wings level, pitch of the aircraft on its wheels"};

  Param course_kp{2.0, "rad/rad", 0, 10,
                  "roll per course error at cruise ground speed: course bandwidth = kp g / Va"};
  Param course_ki{0.0, "rad/(rad s)", 0, 2, "roll per integrated course error"};
  Param roll_limit{
      0.785, "rad", 0.05, 1.2,
      "limit of the roll command, with the limits of the airframe and of the lift near the stall"};
  Param roll_rate_limit{1.0, "rad/s", 0.1, 6, "rate limit of the roll command"};
  Param roll_smoothing{0.1, "s", 0, 2, "time constant of the roll command"};

  Param pitch_limit{0.35, "rad", 0.1, 1.0,
                    "limit of the pitch command, either way, with the limits of the airframe"};
  Param pitch_rate_limit{0.8, "rad/s", 0.05, 6, "rate limit of the pitch command"};
  Param throttle_rate_limit{2.0, "1/s", 0.1, 20, "rate limit of the throttle"};
  Param turn_kff{1.0, "ratio", 0, 2, "fed-forward share of the pitch and throttle for a banked turn"};

  Param takeoff_throttle{1.0, "ratio", 0, 1, "throttle of the take-off law"};
  Param takeoff_pitch{0.21, "rad", 0, 0.6, "pitch of the take-off law after rotation"};
  Param takeoff_airspeed{13.0, "m/s", 3, 60, "rotation airspeed of the take-off law"};
  Param takeoff_kp{1.0, "rad/rad", 0, 5, "roll per course error of the take-off law, airborne"};
  Param takeoff_roll_limit{0.15, "rad", 0, 0.5, "limit of the roll command of the take-off law"};

  Param launch_acceleration{
      0, "m/s2", 0, 200,
      "acceleration along the nose that counts as a launch; motor off before it; 0: rolling take-off"};
  Param launch_speed{4.0, "m/s", 0.5, 60, "minimum ground speed of a launch"};
  Param launch_delay{0.3, "s", 0, 5,
                     "delay from the end of the push to the motor start: clearance of the propeller"};

  Param airspeed_smoothing{0.5, "s", 0, 10, "time constant of the airspeed for the trim"};

  Flag stall_guard{true, "switch for stall recovery and the pitch limit by angle of attack; off in a flare"};

  Record<Airframe> airframe{"airframe with limits, trims and derivatives for the feed-forward of turns"};
};

/// Tuning from the parameters; the roll limit is the smaller of the parameter and the airframe's.
inline OuterTuning tuning(const OuterParams& p) {
  const FlightLimits& limits = p.airframe->limits;
  OuterTuning t;
  t.course = {p.course_kp,
              p.course_ki,
              limits.airspeed_cruise_mps,
              std::min<double>(p.roll_limit, limits.roll_max_rad),
              p.roll_rate_limit,
              p.roll_smoothing};
  t.takeoff = {p.takeoff_throttle,   p.takeoff_pitch,       p.takeoff_airspeed, p.takeoff_kp,
               p.takeoff_roll_limit, p.launch_acceleration, p.launch_speed,     p.launch_delay};
  t.pitch_rate_max_radps = p.pitch_rate_limit;
  t.throttle_rate_max_hz = p.throttle_rate_limit;
  return t;
}

/// The commanded level turn, and the share `turn_kff` of its demands beyond level flight at the same
/// airspeed, by the airframe's model (turn_trim.hpp).
struct LevelTurn {
  double Va_mps;       ///< true airspeed for divisions, smoothed, never near 0 (scheduling_airspeed)
  double pitch_rad;    ///< trim, including the share of the turn
  double drag_newton;  ///< drag beyond that of level flight
  Envelope within;     ///< limits of the commands
};
/// Result of a law's `hold`: pitch command in rad, throttle 0 to 1.
struct PitchThrottle {
  double pitch_rad, throttle_frac;
};

/// Air density at the aircraft, kg/m3, of the standard atmosphere.
inline double air_density(const VehicleState& state) {
  return standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
}

/// Level turn at bank `roll_rad`, true airspeed `Va`, m/s, and density `rho`, kg/m3. `within` stays at its
/// defaults.
inline LevelTurn level_turn(double roll_rad, double Va, double rho, const OuterParams& p) {
  const TurnTrims trims(*p.airframe, Va, rho);
  const TurnTrim turn = trims.at(roll_rad), level = trims.at(0);
  return {Va,
          level.alpha_rad + p.turn_kff * (turn.alpha_rad * std::cos(roll_rad) - level.alpha_rad),
          p.turn_kff * (turn.drag_newton - level.drag_newton),
          {}};
}

/// The same in the standard atmosphere at the aircraft's altitude.
inline LevelTurn level_turn(double roll_rad, double Va, const VehicleState& state, const OuterParams& p) {
  return level_turn(roll_rad, Va, air_density(state), p);
}

/// An outer law without its height and speed control. Its component publishes `attitude` and `internals`.
struct OuterLoop {
  OuterCommands commands;
  EnvelopeGuard guard;
  HeightWatch height;
  EnvelopeReports reports;
  LowPass airspeed;          ///< airspeed for trims, m/s
  NearbyDensity density;     ///< density of the standard atmosphere, kg/m3
  std::uint32_t resets = 0;  ///< resets of the state so far
  /// True from a switch to the first step. No command fades, unlike in the inner law: the rate limits, which
  /// always apply, start at the last commands (OuterCommands::start).
  bool took_over = false;
  bool flares =
      false;  ///< set by the law: in a flare the speed decreases on purpose, without stall protection

  /// Computes the lift limits. For a law without `configure`, the first step does so.
  void configure(const OuterParams& p) { guard.configure(*p.airframe); }

  /// Continues from the outputs applied last. Returns false without a previous component: integrals start at
  /// 0.
  template <class Outputs>
  bool activate(const VehicleState& state, const OuterParams& p, const Applied<Outputs>& last) {
    airspeed.reset_to(scheduling_airspeed(state, p.airframe->limits));
    const AttitudeCommand* attitude = last.has(last->attitude) ? &last->attitude : nullptr;
    took_over = attitude != nullptr;
    guard.reset();
    height.reset();
    return commands.take_over(p.law, state, attitude, tuning(p), p.airframe->limits);
  }

  /// One step. `rest()` is called when the law controls nothing (standing, take-off, invalid state), and
  /// clears its integrals. `hold(LevelTurn, dt_s)` is called when it holds height and speed, and returns a
  /// PitchThrottle.
  template <class Outputs, class Rest, class Hold>
  Status step(const Tick& tick, const VehicleState& state, const GuidanceCommand& command,
              const OuterParams& p, Outputs& out, Rest&& rest, Hold&& hold) {
    // A gap must not move the integrators far. In the tick of a switch the previous component has already
    // stepped, and a second step would exceed the rate limits.
    const double dt = took_over ? 0 : std::clamp(tick.dt_s(), 0.0, 0.1);
    took_over = false;
    if (!guard.configured()) configure(p);
    OuterTuning t = tuning(p);
    const FlightLimits& limits = p.airframe->limits;
    const double Va = scheduling_airspeed(state, limits);
    // The host stops commands that are not finite; without a host the law must not store them either.
    const bool sense = finite(command);
    const OuterAction action = commands.begin(p.law, state, sense);
    out.internals = {};
    const bool holds = action == OuterAction::hold;
    if (!holds) rest();
    if (!holds || state.reset_count != resets) guard.reset();
    // A reset of the state changes the airspeed: the smoothing restarts.
    if (!holds || state.reset_count != resets) airspeed.reset_to(Va);
    resets = state.reset_count;
    switch (action) {
      case OuterAction::wait: out.attitude = commands.wait(); break;
      case OuterAction::roll_out: out.attitude = commands.roll_out(state, t, limits, dt); break;
      case OuterAction::take_off: out.attitude = commands.take_off(state, t, limits, dt); break;
      case OuterAction::level: out.attitude = level(state, p, t, dt); break;
      case OuterAction::hold: {
        const double rho = density.at(state.origin_altitude_m + state.height_m);
        const double carried = guard.bank_max(Va, limits, rho);
        const bool banks_less = carried < t.course.roll_max_rad;
        t.course.roll_max_rad = std::min(t.course.roll_max_rad, carried);
        const double steady = airspeed.step(Va, p.airspeed_smoothing, dt);
        out.attitude = held(state, command, p, t, steady, rho, dt, out.internals, rest, hold);
        out.internals.bank_limited = banks_less && commands.roll_saturated();
      }
    }
    report(out.attitude, out.internals);
    return judge(tick, state, out, holds || action == OuterAction::level, sense, dt);
  }

 private:
  static bool finite(const GuidanceCommand& c) {
    return std::isfinite(c.course_rad + c.height_m + c.climb_rate_mps + c.airspeed_mps +
                         c.roll_feedforward_rad + c.lateral_acceleration_mps2);
  }

  /// Height and speed by the law, or stall recovery and the climb after it.
  template <class Rest, class Hold>
  AttitudeCommand held(const VehicleState& state, const GuidanceCommand& command, const OuterParams& p,
                       const OuterTuning& t, double steady_mps, double rho, double dt,
                       ControllerInternals& internals, Rest&& rest, Hold&& hold) {
    const FlightLimits& limits = p.airframe->limits;
    const bool guarded = p.stall_guard && !flares;
    const double bank = guard.stalled() ? commands.wings_level(t, dt) : commands.roll(state, command, t, dt);
    Envelope within = guard.step(state, limits, rho, bank, command.climb_rate_mps, guarded, dt);
    internals.airspeed_raised = state.airspeed_valid && within.airspeed_min_mps > command.airspeed_mps;
    internals.stalled = guard.stalled();
    const double error = command.height_m - state.height_m;
    const bool regains = guarded && guard.regains(state, error, command.climb_rate_mps, dt);
    if (guard.stalled() || regains) {
      rest();
      internals.height_error_m = error;
      internals.pitch_saturated = true;
      return commands.recover(bank, regained_pitch(state, within, limits, dt), power(state, limits), t, dt);
    }
    LevelTurn turn = level_turn(bank, steady_mps, rho, p);
    turn.within = within;
    const PitchThrottle wanted = hold(turn, dt);
    return commands.finish(bank, wanted.pitch_rad, wanted.throttle_frac, t, dt);
  }

  double regained_pitch(const VehicleState& state, const Envelope& within, const FlightLimits& limits,
                        double dt) const {
    if (guard.stalled()) return guard.recovery_pitch(limits);
    const double pitch = guard.regaining_pitch(state, within, commands.last().pitch_rad, dt);
    return std::clamp(pitch, limits.pitch_min_rad, limits.pitch_max_rad);
  }
  /// Full power, but none in a spiral dive above the maximum airspeed.
  static double power(const VehicleState& state, const FlightLimits& limits) {
    constexpr double banked_rad = 1;
    const bool spirals = state.airspeed_valid && std::abs(state.roll_rad) > banked_rad;
    return spirals ? 1 - smoothly(state.airspeed_mps, limits.airspeed_cruise_mps, limits.airspeed_max_mps)
                   : 1;
  }

  /// Status and internals of the step, and reports of the envelope.
  template <class Outputs>
  Status judge(const Tick& tick, const VehicleState& state, Outputs& out, bool flying, bool sense,
               double dt) {
    ControllerInternals& said = out.internals;
    const HeightWatch::Finding finding = height.step(state, out.attitude, said, dt);
    said.height_uncontrolled = finding != HeightWatch::Finding::held;
    if constexpr (requires { out.notices; }) reports.step(tick, guard, said, out.notices);
    if (finding == HeightWatch::Finding::contradiction) return Status::failed;
    if (flying && !sense) return Status::degraded;
    if (said.stalled || said.height_uncontrolled) return Status::degraded;
    return flying && !enough_known(state) ? Status::degraded : Status::ok;
  }

  /// Invalid attitude or height: trim of level flight at cruise speed.
  AttitudeCommand level(const VehicleState& state, const OuterParams& p, const OuterTuning& t, double dt_s) {
    const FlightLimits& limits = p.airframe->limits;
    const double alpha = turn_trim(*p.airframe, 0, limits.airspeed_cruise_mps, air_density(state)).alpha_rad;
    return commands.level(alpha, limits.throttle_cruise_frac, t, dt_s);
  }

  void report(const AttitudeCommand& attitude, ControllerInternals& internals) const {
    internals.law = commands.law();
    internals.course_error_rad = commands.course_error_rad();
    internals.roll_saturated = commands.roll_saturated();
    internals.roll_rad = attitude.roll_rad;
    internals.pitch_rad = attitude.pitch_rad;
  }
};

}  // namespace fulmar
