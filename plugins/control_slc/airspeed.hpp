// SPDX-License-Identifier: BSD-3-Clause
// Airspeed to throttle for an attitude that somebody else commands: a pilot, a test signal, a policy. It asks
// for the thrust that the energy balance wants, m dV/dt = T - D - m g sin(gamma): Beard & McLain, Small
// Unmanned Aircraft (2012), (5.36) and section 6.4.3; and where the throttle has no more to give, for a
// bounded share of pitch.
#pragma once
#include <fulmar/flight/atmosphere.hpp>
#include <fulmar/flight/filters.hpp>
#include <fulmar/flight/outer_commands.hpp>
#include <fulmar/flight/pid.hpp>
#include <fulmar/flight/turn_trim.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::slc {

struct Airspeed {
  static constexpr const char* doc = "Airspeed hold by throttle for a commanded attitude.";
  struct Inputs {
    In<VehicleState> state;
    In<AttitudeCommand> wanted;   ///< its roll and pitch; the throttle is not looked at
    In<GuidanceCommand> command;  ///< its airspeed alone
  };
  struct Outputs {
    AttitudeCommand attitude;
    Probe airspeed_error_mps;
    Probe pitch_share_rad;
  };
  struct Params {
    Param speed_kp{0.6, "1/s", 0, 10, "acceleration per airspeed error"};
    Param speed_ki{0.1, "1/s^2", 0, 10, "acceleration per integrated airspeed error"};
    Param speed_filter{0.3, "s", 0, 10, "time constant of the airspeed that the error is taken of"};
    Param energy_kff{1.0, "ratio", 0, 2,
                     "share of the thrust fed forward that climb, drag and a moving airspeed command need"};
    Param command_filter{0.2, "s", 0.005, 5, "time constant of the differentiated airspeed command"};
    Param thrust{50.0, "N", 1, 10000, "force per unit of throttle near cruise"};
    Param throttle_rate_limit{2.0, "1/s", 0.1, 100, "fastest change of the throttle"};
    Param pitch_share{0.0, "rad", 0, 0.3,
                      "pitch that may be given away where the throttle cannot hold the airspeed; 0: none"};
    Param pitch_filter{0.5, "s", 0, 10, "time constant of the pitch given away"};
    Record<Airframe> airframe{"mass, trims, limits, and the drag that is fed forward"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    const VehicleState& state = *in.state;
    const FlightLimits& limits = p.airframe->limits;
    airspeed_.reset_to(state.airspeed_mps);
    command_rate_.reset_to(in.command->airspeed_mps);
    share_.reset_to(0);
    loop_.reset();
    take_up_ = last.has(last->attitude);
    throttle_.reset_to(take_up_ ? last->attitude.throttle_frac
                                : (flying(state, limits) ? limits.throttle_cruise_frac : 0));
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& state = *in.state;
    const FlightLimits& limits = p.airframe->limits;
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const double Va_c =
        std::clamp(in.command->airspeed_mps, limits.airspeed_min_mps, limits.airspeed_max_mps);
    const double Va = airspeed_.step(state.airspeed_valid ? state.airspeed_mps : Va_c, p.speed_filter, dt);
    const double rate_c = command_rate_.step(Va_c, p.command_filter, dt);
    const double per_throttle = p.thrust / p.airframe->mass_kg;  // m/s2
    const double trim = limits.throttle_cruise_frac;
    const double feedforward =
        trim + p.energy_kff * (needed(state, *in.wanted, *p.airframe, Va_c) + rate_c) / per_throttle;
    const PidInput input{.error = Va_c - Va, .rate = 0, .feedforward = feedforward, .min = 0, .max = 1};
    const PidGains gains{p.speed_kp / per_throttle, p.speed_ki / per_throttle, 0};
    if (take_up_) loop_.reset_to(throttle_.value(), gains, input, 0.2);
    take_up_ = false;
    const double throttle = loop_.step(gains, input, flying(state, limits) ? dt : 0);
    const double unmet =
        (input.feedforward + gains.kp * input.error + loop_.integral() - throttle) * per_throttle;
    const double share = share_.step(std::clamp(-unmet / 9.80665, -p.pitch_share.value, p.pitch_share.value),
                                     p.pitch_filter, dt);
    out.attitude.roll_rad = in.wanted->roll_rad;
    out.attitude.pitch_rad = in.wanted->pitch_rad + share;
    out.attitude.throttle_frac = throttle_.step(throttle, p.throttle_rate_limit, dt);
    out.airspeed_error_mps = input.error;
    out.pitch_share_rad = share;
    return state.airspeed_valid ? Status::ok : Status::degraded;
  }

 private:
  /// Acceleration, m/s2, beyond that of level flight at cruise: climb and drag at the airspeed and attitude
  /// wanted.
  static double needed(const VehicleState& state, const AttitudeCommand& wanted, const Airframe& a,
                       double Va) {
    const double rho = standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
    const TurnTrim turn = turn_trim(a, wanted.roll_rad, Va, rho);
    const TurnTrim cruise = turn_trim(a, 0, a.limits.airspeed_cruise_mps, rho);
    const double gamma = wanted.pitch_rad - turn.alpha_rad * std::cos(wanted.roll_rad);
    return 9.80665 * std::sin(gamma) + (turn.drag_newton - cruise.drag_newton) / a.mass_kg;
  }

  LowPass airspeed_, share_;
  Differentiator command_rate_;
  RateLimiter throttle_;
  Pid loop_;
  bool take_up_ = false;
};

}  // namespace fulmar::slc
