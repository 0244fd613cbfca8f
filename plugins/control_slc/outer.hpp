// SPDX-License-Identifier: BSD-3-Clause
// Outer loops by successive loop closure: course -> roll, height -> pitch, airspeed -> throttle.
// Beard & McLain, Small Unmanned Aircraft (2012), chapter 6. The README gives every equation.
#pragma once
#include <fulmar/flight/control/outer_law.hpp>
#include <fulmar/flight/control/pid.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/controller_internals.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::slc {

struct Outer {
  static constexpr const char* doc =
      "Course, height and airspeed hold by successive loop closure; take-off law.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    ControllerInternals internals;
    OutQueue<Notice, 3> notices;  // stall, end of a stall, loss of height
    Probe climb_rate_demand_mps;
    Probe pitch_integral_rad;
    Probe throttle_integral_frac;
  };
  struct Params {
    OuterParams common;

    Param altitude_kp{0.09, "rad/m", 0, 1, "pitch per height error: height bandwidth = kp Va"};
    Param altitude_ki{0.01, "rad/(m s)", 0, 0.5, "pitch per integrated height error"};
    Param altitude_kd{0.03, "rad s/m", 0, 0.5, "pitch per climb rate error"};

    Param airspeed_kp{0.15, "1/(m/s)", 0, 1, "throttle per airspeed error"};
    Param airspeed_ki{0.06, "1/m", 0, 1, "throttle per integrated airspeed error"};
    Param airspeed_kff{0.03, "1/(m/s)", 0, 0.2, "throttle per airspeed command above cruise"};
    Param climb_kff{0.04, "1/(m/s)", 0, 0.5, "throttle per climb rate command"};
    Param thrust{50.0, "N", 1, 10000,
                 "thrust per throttle near cruise: converts the drag of a turn to throttle"};
  };

  void configure(const Params& p) { loop_.configure(p.common); }

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    if (!loop_.activate(*in.state, p.common, last)) {
      altitude_.reset();
      airspeed_.reset();
    }
    late_.reset();
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& state = *in.state;
    const GuidanceCommand& command = *in.command;
    out.climb_rate_demand_mps = 0.0;
    const auto rest = [&] {
      altitude_.reset();
      airspeed_.reset();
      late_.reset();
    };
    const auto hold = [&](const LevelTurn& turn, double dt) -> PitchThrottle {
      const double theta = height_to_pitch(state, command, p, turn, dt, out);
      const double feedforward = p.climb_kff * out.climb_rate_demand_mps.value + turn.drag_newton / p.thrust;
      return {theta, airspeed_to_throttle(state, command, p, turn.within, feedforward, dt, out)};
    };
    const Status status = loop_.step(tick, state, command, p.common, out, rest, hold);
    out.pitch_integral_rad = altitude_.integral();
    out.throttle_integral_frac = airspeed_.integral();
    return status;
  }

 private:
  /// theta = theta_trim + hdot_c / Va + integral + kd (hdot_c - hdot),  hdot_c = feed-forward + kp Va (h_c -
  /// h) within the climb limits.
  double height_to_pitch(const VehicleState& state, const GuidanceCommand& command, const Params& p,
                         const LevelTurn& turn, double dt, Outputs& out) {
    const FlightLimits& limits = p.common.airframe->limits;
    const PitchLimits pitch(turn.within, limits, p.common.pitch_limit);
    const double error = command.height_m - state.height_m;
    const double wanted = command.climb_rate_mps + p.altitude_kp * turn.Va_mps * error;
    const double climb_rate = std::clamp(wanted, -limits.sink_rate_max_mps, limits.climb_rate_max_mps);
    // Far from the commanded height the climb limit governs, and the error is not integrated. The shortfall
    // of a demand counts as the height error that would demand it, within a second at the fastest.
    const double gain = turn.Va_mps * std::max<double>({p.altitude_kp, p.altitude_ki, 1e-6});
    const double missing = late_.missing(climb_rate != wanted, climb_rate, state.climb_rate_mps,
                                         altitude_.integral(), -max_bias, dt);
    const PidInput in{.error = climb_rate == wanted ? error : missing / gain,
                      .rate = state.climb_rate_mps - climb_rate,
                      .feedforward = turn.pitch_rad + climb_rate / turn.Va_mps,
                      .min = pitch.min,
                      .max = pitch.max};
    const PidGains gains{0, p.altitude_ki, p.altitude_kd};
    if (loop_.commands.taking_up()) altitude_.reset_to(loop_.commands.last().pitch_rad, gains, in, max_bias);
    const double theta = altitude_.step(gains, in, dt);
    out.internals.height_error_m = error;
    out.internals.pitch_saturated = altitude_.saturated() || climb_rate != wanted;
    out.climb_rate_demand_mps = climb_rate;
    return theta;
  }

  /// delta_t = trim + feed-forward of climb, turn and speed + kp e + integral. Without airspeed: trim and
  /// feed-forward alone.
  double airspeed_to_throttle(const VehicleState& state, const GuidanceCommand& command, const Params& p,
                              const Envelope& within, double feedforward, double dt, Outputs& out) {
    const FlightLimits& limits = p.common.airframe->limits;
    const double trim = limits.throttle_cruise_frac + feedforward;
    if (!state.airspeed_valid) return std::clamp(trim, 0.0, 1.0);
    const double Va_c = within.airspeed(command.airspeed_mps, limits);
    const PidInput in{.error = Va_c - state.airspeed_mps,
                      .rate = 0,
                      .feedforward = trim + p.airspeed_kff * (Va_c - limits.airspeed_cruise_mps),
                      .min = 0,
                      .max = 1};
    const PidGains gains{p.airspeed_kp, p.airspeed_ki, 0};
    if (loop_.commands.taking_up()) airspeed_.reset_to(loop_.commands.last().throttle_frac, gains, in, 0.2);
    const double throttle = airspeed_.step(gains, in, dt);
    out.internals.airspeed_error_mps = in.error;
    out.internals.throttle_saturated = airspeed_.saturated();
    return throttle;
  }

  static constexpr double max_bias = 0.1;  // rad
  OuterLoop loop_;
  Pid altitude_, airspeed_;
  LateDemand late_;
};

}  // namespace fulmar::slc
