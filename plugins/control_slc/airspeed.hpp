// SPDX-License-Identifier: BSD-3-Clause
// Airspeed to throttle, for an attitude that another component commands: a pilot, a test signal, a policy.
// The thrust comes from the energy balance, m dV/dt = T - D - m g sin(gamma): Beard & McLain, Small Unmanned
// Aircraft (2012), (5.36) and section 6.4.3.
#pragma once
#include <fulmar/flight/control/outer_commands.hpp>
#include <fulmar/flight/control/pid.hpp>
#include <fulmar/flight/control/turn_trim.hpp>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/flight/math/filters.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::slc {

struct Airspeed {
  static constexpr const char* doc = "Airspeed hold by throttle for a commanded attitude.";
  struct Inputs {
    In<VehicleState> state;
    In<AttitudeCommand> wanted;   ///< roll and pitch; its throttle is not used
    In<GuidanceCommand> command;  ///< only the airspeed is used
  };
  struct Outputs {
    AttitudeCommand attitude;
    Probe airspeed_error_mps;
  };
  struct Params {
    Param speed_kp{0.6, "1/s", 0, 10, "acceleration per airspeed error"};
    Param speed_ki{0.1, "1/s^2", 0, 10, "acceleration per integrated airspeed error"};
    Param speed_filter{0.3, "s", 0, 10, "time constant of the airspeed filter for the error"};
    Param energy_kff{1.0, "ratio", 0, 2,
                     "share of the fed-forward thrust for climb, drag and a changing airspeed command"};
    Param command_filter{0.2, "s", 0.005, 5, "time constant of the differentiated airspeed command"};
    Param thrust{50.0, "N", 1, 10000, "thrust per throttle near cruise"};
    Param throttle_rate_limit{2.0, "1/s", 0.1, 100, "rate limit of the throttle"};
    // Inner fades exponentially. Here a fixed rate is used: an exponential begins with a rate proportional to
    // the difference, and no inner loop follows so fast an attitude. The outer laws limit every command to
    // these rates.
    Param take_over_rate{0.5, "rad/s", 0.05, 6,
                         "rate limit of the roll and pitch commands in the bumpless transfer"};
    Param pitch_trade{0, "rad", 0, 0.2,
                      "largest change of pitch with saturated throttle and an airspeed error: down when too "
                      "slow, up when too fast"};
    Record<Airframe> airframe{"airframe with mass, trims, limits and drag"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    airspeed_.reset_to(in.state->airspeed_mps);
    command_rate_.reset_to(wanted_airspeed(*in.command, p));
    loop_.reset();
    traded_.reset_to(0);
    take_up_ = last.has(last->attitude);
    throttle_.reset_to(take_up_ ? last->attitude.throttle_frac : p.airframe->limits.throttle_cruise_frac);
    // The component that supplies `wanted` was not active until now and may ask for a very different
    // attitude.
    const AttitudeCommand &from = last->attitude, &to = *in.wanted;
    roll_left_.reset_to(take_up_ ? wrap_pi(from.roll_rad - to.roll_rad) : 0);
    pitch_left_.reset_to(take_up_ ? from.pitch_rad - to.pitch_rad : 0);
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& state = *in.state;
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);  // bound of the integration step after a gap
    out.attitude = *in.wanted;
    out.airspeed_error_mps = 0.0;
    if (standing(state)) return rest(out);
    const double roll_left = roll_left_.step(0, p.take_over_rate, dt);
    if (roll_left != 0) out.attitude.roll_rad = wrap_pi(out.attitude.roll_rad + roll_left);
    out.attitude.pitch_rad += pitch_left_.step(0, p.take_over_rate, dt);
    const FlightLimits& limits = p.airframe->limits;
    const double Va_c = wanted_airspeed(*in.command, p);
    const double per_throttle = p.thrust / p.airframe->mass_kg;  // m/s2
    const double acceleration_c = command_rate_.step(Va_c, p.command_filter, dt);
    const double steady = needed(state, out.attitude, *p.airframe, Va_c);
    const double Va = airspeed_.step(state.airspeed_valid ? state.airspeed_mps : Va_c, p.speed_filter, dt);
    const PidInput input{
        .error = state.airspeed_valid ? Va_c - Va : 0,
        .rate = 0,
        .feedforward = limits.throttle_cruise_frac + p.energy_kff * (steady + acceleration_c) / per_throttle,
        .min = 0,
        .max = 1};
    const PidGains gains{p.speed_kp / per_throttle, p.speed_ki / per_throttle, 0};
    if (take_up_) loop_.reset_to(throttle_.value(), gains, input, 0.2);
    take_up_ = false;
    const double throttle = loop_.step(gains, input, dt);
    out.attitude.throttle_frac = throttle_.step(throttle, p.throttle_rate_limit, dt);
    out.attitude.pitch_rad -= trade(input.error, throttle, p, dt);
    out.airspeed_error_mps = input.error;
    return state.airspeed_valid ? Status::ok : Status::degraded;
  }

 private:
  /// Pitch, rad, reduced in favour of airspeed while the thrust is at its limit.
  double trade(double error_mps, double throttle_frac, const Params& p, double dt) {
    constexpr double bearable_mps = 0.5, rad_per_mps = 0.05, smoothed_s = 0.3;
    const double beyond_mps = error_mps - std::clamp(error_mps, -bearable_mps, bearable_mps);
    const bool at_stop = beyond_mps > 0 ? throttle_frac >= 1 : throttle_frac <= 0;
    const double wanted =
        at_stop ? std::clamp<double>(rad_per_mps * beyond_mps, -p.pitch_trade, p.pitch_trade) : 0;
    return p.pitch_trade > 0 ? traded_.step(wanted, smoothed_s, dt) : 0;
  }

  static double wanted_airspeed(const GuidanceCommand& command, const Params& p) {
    const FlightLimits& limits = p.airframe->limits;
    return std::clamp(command.airspeed_mps, limits.airspeed_min_mps, limits.airspeed_max_mps);
  }

  /// Standing on the ground: engine off, state cleared.
  Status rest(Outputs& out) {
    loop_.reset();
    airspeed_.reset();
    command_rate_.reset();
    throttle_.reset_to(0);
    roll_left_.reset_to(0);
    pitch_left_.reset_to(0);
    traded_.reset();
    take_up_ = false;
    out.attitude.throttle_frac = 0;
    return Status::ok;
  }

  /// Acceleration, m/s2, that the thrust must give beyond level flight at cruise: for the climb, and for the
  /// drag at the commanded airspeed and bank. Both come from the command, so that gusts have no effect.
  static double needed(const VehicleState& state, const AttitudeCommand& wanted, const Airframe& a,
                       double Va_c) {
    const double rho = standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
    const TurnTrim there = turn_trim(a, wanted.roll_rad, Va_c, rho);
    const TurnTrim cruise = turn_trim(a, 0, a.limits.airspeed_cruise_mps, rho);
    const double gamma = wanted.pitch_rad - there.alpha_rad * std::cos(wanted.roll_rad);
    return g_mps2 * std::sin(gamma) + (there.drag_newton - cruise.drag_newton) / a.mass_kg;
  }

  static constexpr double g_mps2 = 9.80665;
  LowPass airspeed_;  ///< m/s
  LowPass traded_;    ///< rad
  Differentiator command_rate_;
  RateLimiter throttle_;
  RateLimiter roll_left_, pitch_left_;  ///< rad, left of the attitude before the hand-over
  Pid loop_;
  bool take_up_ = false;
};

}  // namespace fulmar::slc
