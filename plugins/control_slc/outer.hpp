// SPDX-License-Identifier: BSD-3-Clause
// Outer loops by successive loop closure: course -> roll, height -> pitch, airspeed -> throttle.
// Beard & McLain, Small Unmanned Aircraft (2012), chapter 6. The README gives every equation.
#pragma once
#include <fulmar/flight/atmosphere.hpp>
#include <fulmar/flight/outer_commands.hpp>
#include <fulmar/flight/turn_trim.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/controller_internals.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::slc {

struct Outer {
  static constexpr const char* doc = "Course, height and airspeed hold by successive loop closure; take-off law.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    ControllerInternals internals;
    Probe climb_rate_demand_mps;
    Probe pitch_integral_rad;
    Probe throttle_integral_frac;
  };
  struct Params {
    Choice<OuterLaw> law{OuterLaw::hold, "hold: follow guidance; takeoff: full throttle, wings level, rotate, keep the runway's course"};

    Param course_kp{2.0, "rad/rad", 0, 10, "roll per course error at cruise ground speed: course bandwidth = kp g / Va"};
    Param course_ki{0.0, "rad/(rad s)", 0, 2, "roll per integrated course error"};
    Param roll_limit{0.785, "rad", 0.05, 1.2, "largest roll command; the airframe's own limit holds as well"};
    Param roll_rate_limit{1.0, "rad/s", 0.1, 6, "fastest change of the roll command"};
    Param roll_smoothing{0.1, "s", 0, 2, "time constant of the roll command"};

    Param altitude_kp{0.09, "rad/m", 0, 1, "pitch per height error: height bandwidth = kp Va"};
    Param altitude_ki{0.01, "rad/(m s)", 0, 0.5, "pitch per integrated height error"};
    Param altitude_kd{0.03, "rad s/m", 0, 0.5, "pitch per error of climb rate"};
    Param pitch_limit{0.35, "rad", 0.02, 1.0, "largest pitch command, either way; the airframe's own limits hold as well"};
    Param pitch_rate_limit{0.8, "rad/s", 0.05, 6, "fastest change of the pitch command"};
    Param turn_kff{1.0, "ratio", 0, 2, "share of the pitch and throttle that a banked turn needs, fed forward"};

    Param airspeed_kp{0.15, "1/(m/s)", 0, 1, "throttle per airspeed error"};
    Param airspeed_ki{0.06, "1/m", 0, 1, "throttle per integrated airspeed error"};
    Param airspeed_kff{0.03, "1/(m/s)", 0, 0.2, "throttle per airspeed demand above cruise"};
    Param climb_kff{0.04, "1/(m/s)", 0, 0.5, "throttle per demanded climb rate"};
    Param thrust{50.0, "N", 1, 10000, "force per unit of throttle near cruise: turns the drag of a turn into throttle"};
    Param throttle_rate_limit{2.0, "1/s", 0.1, 20, "fastest change of the throttle"};

    Param takeoff_throttle{1.0, "ratio", 0, 1, "throttle of the take-off law"};
    Param takeoff_pitch{0.21, "rad", 0, 0.6, "pitch of the take-off law after rotation"};
    Param takeoff_airspeed{13.0, "m/s", 3, 60, "airspeed at which the take-off law rotates"};
    Param takeoff_kp{1.0, "rad/rad", 0, 5, "roll per course error of the take-off law, airborne"};
    Param takeoff_roll_limit{0.15, "rad", 0, 0.5, "largest roll command of the take-off law"};

    Record<Airframe> airframe{"limits, trims, and the derivatives for the feed-forward of turns"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& params, const Applied<Outputs>& last) {
    const AttitudeCommand* attitude = last.has(last->attitude) ? &last->attitude : nullptr;
    if (!commands_.take_over(params.law, *in.state, attitude, tuning(params), params.airframe->limits))
      altitude_.reset(), airspeed_.reset();
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& params, Outputs& out) {
    const VehicleState& state = *in.state;
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);  // a gap must not throw the integrators
    const OuterAction action = commands_.begin(params.law, state);
    out.internals = {};
    out.climb_rate_demand_mps = 0.0;
    if (action != OuterAction::hold) altitude_.reset(), airspeed_.reset();
    if (action == OuterAction::wait) out.attitude = commands_.wait();
    if (action == OuterAction::take_off) out.attitude = commands_.take_off(state, tuning(params), params.airframe->limits, dt);
    if (action == OuterAction::hold) hold(state, *in.command, params, dt, out);
    if (action == OuterAction::level) level(state, params, dt, out);
    out.internals.law = commands_.law();
    out.internals.course_error_rad = commands_.course_error_rad();
    out.internals.roll_saturated = commands_.roll_saturated();
    out.internals.roll_rad = out.attitude.roll_rad;
    out.internals.pitch_rad = out.attitude.pitch_rad;
    out.pitch_integral_rad = altitude_.integral();
    out.throttle_integral_frac = airspeed_.integral();
    const bool flying = action == OuterAction::hold || action == OuterAction::level;
    return flying && !enough_known(state) ? Status::degraded : Status::ok;
  }

 private:
  static OuterTuning tuning(const Params& p) {
    const FlightLimits& limits = p.airframe->limits;
    OuterTuning t;
    t.course = {p.course_kp,       p.course_ki,     limits.airspeed_cruise_mps, std::min<double>(p.roll_limit, limits.roll_max_rad),
                p.roll_rate_limit, p.roll_smoothing};
    t.takeoff = {p.takeoff_throttle, p.takeoff_pitch, p.takeoff_airspeed, p.takeoff_kp, p.takeoff_roll_limit};
    t.pitch_rate_max_radps = p.pitch_rate_limit;
    t.throttle_rate_max_hz = p.throttle_rate_limit;
    return t;
  }

  /// Attitude or height is not known.
  void level(const VehicleState& state, const Params& p, double dt, Outputs& out) {
    const FlightLimits& limits = p.airframe->limits;
    const double rho = standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
    const double alpha = turn_trim(*p.airframe, 0, limits.airspeed_cruise_mps, rho).alpha_rad;
    out.attitude = commands_.level(alpha, limits.throttle_cruise_frac, tuning(p), dt);
  }

  void hold(const VehicleState& state, const GuidanceCommand& command, const Params& p, double dt, Outputs& out) {
    const OuterTuning t = tuning(p);
    const double phi = commands_.roll(state, command, t, dt);
    const double Va = scheduling_airspeed(state, p.airframe->limits);
    const double rho = standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
    const TurnTrim turn = turn_trim(*p.airframe, phi, Va, rho), level = turn_trim(*p.airframe, 0, Va, rho);
    const double theta_trim = level.alpha_rad + p.turn_kff * (turn.alpha_rad * std::cos(phi) - level.alpha_rad);
    const double theta = height_to_pitch(state, command, p, Va, theta_trim, dt, out);
    const double turn_throttle = p.turn_kff * (turn.drag_newton - level.drag_newton) / p.thrust;
    const double throttle = airspeed_to_throttle(state, command, p, p.climb_kff * out.climb_rate_demand_mps.value + turn_throttle, dt, out);
    out.attitude = commands_.finish(phi, theta, throttle, t, dt);
  }

  /// theta = theta_trim + hdot_c / Va + integral + kd (hdot_c - hdot),  hdot_c = feed-forward + kp Va (h_c - h) within the climb limits.
  double height_to_pitch(const VehicleState& state, const GuidanceCommand& command, const Params& p, double Va, double theta_trim,
                         double dt, Outputs& out) {
    const FlightLimits& limits = p.airframe->limits;
    const PitchLimits pitch(state, limits, p.pitch_limit);
    const double error = command.height_m - state.height_m;
    const double wanted = command.climb_rate_mps + p.altitude_kp * Va * error;
    const double climb_rate = std::clamp(wanted, -limits.sink_rate_max_mps, limits.climb_rate_max_mps);
    // Far from the height wanted the climb limit governs and there is nothing to learn from the error.
    const PidInput in{.error = climb_rate == wanted ? error : 0,
                      .rate = state.climb_rate_mps - climb_rate,
                      .feedforward = theta_trim + climb_rate / Va,
                      .min = pitch.min,
                      .max = pitch.max};
    const PidGains gains{0, p.altitude_ki, p.altitude_kd};
    if (commands_.taking_up()) altitude_.reset_to(commands_.last().pitch_rad, gains, in, 0.1);
    const double theta = altitude_.step(gains, in, dt);
    out.internals.height_error_m = error;
    out.internals.pitch_saturated = altitude_.saturated() || climb_rate != wanted;
    out.climb_rate_demand_mps = climb_rate;
    return theta;
  }

  /// delta_t = trim + feed-forward of climb, turn and speed + kp e + integral. Without airspeed: trim and feed-forward alone.
  double airspeed_to_throttle(const VehicleState& state, const GuidanceCommand& command, const Params& p, double feedforward, double dt,
                              Outputs& out) {
    const FlightLimits& limits = p.airframe->limits;
    const double trim = limits.throttle_cruise_frac + feedforward;
    if (!state.airspeed_valid) return std::clamp(trim, 0.0, 1.0);
    const double Va_c = std::clamp(command.airspeed_mps, limits.airspeed_min_mps, limits.airspeed_max_mps);
    const PidInput in{.error = Va_c - state.airspeed_mps,
                      .rate = 0,
                      .feedforward = trim + p.airspeed_kff * (Va_c - limits.airspeed_cruise_mps),
                      .min = 0,
                      .max = 1};
    const PidGains gains{p.airspeed_kp, p.airspeed_ki, 0};
    if (commands_.taking_up()) airspeed_.reset_to(commands_.last().throttle_frac, gains, in, 0.2);
    const double throttle = airspeed_.step(gains, in, dt);
    out.internals.airspeed_error_mps = in.error;
    out.internals.throttle_saturated = airspeed_.saturated();
    return throttle;
  }

  OuterCommands commands_;
  Pid altitude_, airspeed_;
};

}  // namespace fulmar::slc
