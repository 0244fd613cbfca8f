// SPDX-License-Identifier: BSD-3-Clause
// Outer loops by total energy: throttle controls the rate of the total energy, pitch the rate of its exchange
// between height and speed. Lambregts, AIAA 83-2239 (1983); rate demands and limits are arranged as in the
// open autopilots of the field. Equations: README.
#pragma once
#include <fulmar/flight/control/energy.hpp>
#include <fulmar/flight/control/outer_law.hpp>
#include <fulmar/flight/control/pid.hpp>
#include <fulmar/flight/math/filters.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/controller_internals.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::tecs {

struct Outer {
  static constexpr const char* doc =
      "Course hold, and height and airspeed hold by total energy rate; take-off law.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    ControllerInternals internals;
    OutQueue<Notice, 3> notices;  // stall, end of a stall, loss of height
    Probe climb_rate_demand_mps;
    Probe acceleration_demand_mps2;
    Probe total_rate_error_ratio;    // m2/s3
    Probe balance_rate_error_ratio;  // m2/s3
    Probe pitch_integral_rad;
    Probe throttle_integral_frac;
    Probe underspeed_ratio;
  };
  struct Params {
    OuterParams common;

    Param altitude_gain{1.2, "1/s", 0, 5, "climb rate command per height error"};
    Param airspeed_gain{1.2, "1/s", 0, 5, "acceleration command per airspeed error"};
    Param climb_acceleration_limit{4.0, "m/s2", 0.1, 30, "rate limit of the climb rate command"};
    Param acceleration_filter{0.25, "s", 0, 5, "time constant of the filter of the measured acceleration"};
    Param airspeed_filter{0.5, "s", 0, 10, "time constant of the airspeed for pitch"};
    Param speed_weight{0.4, "ratio", 0, 2,
                       "weight of airspeed in pitch; 0: height alone; 1: both; 2: airspeed alone"};

    Param throttle_damping{0.5, "ratio", 0, 5,
                           "throttle per total energy rate error, as a share of the thrust model"};
    Param throttle_integral{
        0.6, "1/s", 0, 5, "throttle per integrated total energy rate error, as a share of the thrust model"};
    Param pitch_damping{0.6, "ratio", 0, 5, "flight path angle per energy balance rate error over g V"};
    Param pitch_integral{0.2, "1/s", 0, 5,
                         "flight path angle per integrated energy balance rate error over g V"};
    Param airspeed_kff{0.03, "1/(m/s)", 0, 0.2, "throttle per airspeed command above cruise"};
    Param thrust{50.0, "N", 1, 10000, "thrust per throttle near cruise: converts energy rates to throttle"};
    Param underspeed_band{
        0.15, "ratio", 0.01, 0.5,
        "share of the minimum airspeed below it at which airspeed has all priority at full throttle"};
  };

  void configure(const Params& p) { loop_.configure(p.common); }

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    if (!loop_.activate(*in.state, p.common, last)) {
      pitch_.reset();
      throttle_.reset();
    }
    climb_rate_.reset_to(in.state->climb_rate_mps);
    acceleration_.reset();
    airspeed_.reset();
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const auto resting = [&] { rest(*in.state, out); };
    const auto holding = [&](const LevelTurn& turn, double dt) {
      return hold(*in.state, *in.command, p, turn, dt, out);
    };
    const Status status = loop_.step(tick, *in.state, *in.command, p.common, out, resting, holding);
    out.pitch_integral_rad = pitch_.integral();
    out.throttle_integral_frac = throttle_.integral();
    return status;
  }

 private:
  /// Demanded and present energy rates, m2/s3.
  struct Energy {
    EnergyRates wanted, present;
    double steady_kinetic = 0;  ///< demand by the airspeed without gusts, which pitch follows
    double total_wanted = 0;    ///< total demand, within the limits of the engine
    double turn_drag = 0;       ///< energy rate that the turn takes from the engine
    double underspeed = 0;      ///< 0: none; 1: speed has full priority
    double Va = 0, Va_c = 0;
    Envelope within;
    bool limited = false;  ///< the demanded climb is at a limit
  };

  void rest(const VehicleState& state, Outputs& out) {
    pitch_.reset();
    throttle_.reset();
    acceleration_.reset();
    airspeed_.reset();
    climb_rate_.reset_to(state.climb_rate_mps);
    out.climb_rate_demand_mps = 0.0;
    out.acceleration_demand_mps2 = 0.0;
    out.total_rate_error_ratio = 0.0;
    out.balance_rate_error_ratio = 0.0;
    out.underspeed_ratio = 0.0;
  }

  PitchThrottle hold(const VehicleState& state, const GuidanceCommand& command, const Params& p,
                     const LevelTurn& turn, double dt, Outputs& out) {
    Energy e;
    e.within = turn.within;
    e.Va = turn.Va_mps;
    e.turn_drag = turn.drag_newton * e.Va / p.common.airframe->mass_kg;
    demand(state, command, p, dt, e, out);
    const double theta = balance_to_pitch(state, p, e, turn.pitch_rad, dt, out);
    return {theta, total_to_throttle(state, p, e, dt, out)};
  }

  /// Gain times error near the goal. Further away, the rate from which the goal can be reached at that
  /// acceleration. The acceleration is half of the rate limit of the demand, which leaves a reserve for
  /// corrections.
  static double approach_rate(double error, double gain, double acceleration) {
    const double linear = gain > 0 ? acceleration / (gain * gain) : 0;
    if (std::abs(error) <= linear || gain <= 0) return gain * error;
    return std::copysign(std::sqrt(2 * acceleration * (std::abs(error) - 0.5 * linear)), error);
  }

  /// Demanded rates of height and speed, within the limits of engine and drag.
  void demand(const VehicleState& state, const GuidanceCommand& command, const Params& p, double dt,
              Energy& e, Outputs& out) {
    const FlightLimits& limits = p.common.airframe->limits;
    const double most = isa::g0 * limits.climb_rate_max_mps,
                 least = -isa::g0 * limits.sink_rate_max_mps;  // of the total energy rate
    if (state.airspeed_valid) {
      e.underspeed = e.within.underspeed(state.airspeed_mps, p.underspeed_band);
      e.Va_c = e.within.airspeed(command.airspeed_mps, limits);
      const double rate = airspeed_rate(state);
      const double steady = airspeed_.step(state.airspeed_mps, rate, p.airspeed_filter, dt);
      const auto acceleration = [&](double V) {
        return std::clamp(p.airspeed_gain * (e.Va_c - V), 0.5 * least / e.Va, 0.5 * most / e.Va);
      };
      const double V_dot = acceleration(state.airspeed_mps);
      e.wanted.kinetic = e.Va * V_dot;
      e.steady_kinetic = e.Va * acceleration(steady);
      e.present.kinetic = e.Va * acceleration_.step(rate, p.acceleration_filter, dt);
      out.acceleration_demand_mps2 = V_dot;
      out.internals.airspeed_error_mps = e.Va_c - state.airspeed_mps;
    } else {
      e.Va_c = limits.airspeed_cruise_mps;
      airspeed_.reset();
      out.acceleration_demand_mps2 = 0.0;
    }
    const double error = command.height_m - state.height_m;
    const double wanted =
        command.climb_rate_mps + approach_rate(error, p.altitude_gain, 0.5 * p.climb_acceleration_limit);
    const double climb_rate = std::clamp(wanted, -limits.sink_rate_max_mps, limits.climb_rate_max_mps);
    e.limited = climb_rate != wanted;
    if (loop_.commands.taking_up()) climb_rate_.reset_to(state.climb_rate_mps);
    e.wanted.potential = isa::g0 * climb_rate_.step(climb_rate, p.climb_acceleration_limit, dt);
    e.present.potential = isa::g0 * state.climb_rate_mps;
    e.total_wanted = std::clamp(e.wanted.total(), least, most);
    out.internals.height_error_m = error;
    out.climb_rate_demand_mps = climb_rate_.value();
    out.underspeed_ratio = e.underspeed;
  }

  /// theta = theta_trim + [g hdot_c - w_V Va Vadot_c + k (B_c - B)] / (g Va) + integral,  B = w_h g hdot -
  /// w_V Va Vadot.
  double balance_to_pitch(const VehicleState& state, const Params& p, const Energy& e, double theta_trim,
                          double dt, Outputs& out) {
    const double given = state.airspeed_valid ? p.speed_weight.value : 0;
    const double weight = 2 * e.underspeed + (1 - e.underspeed) * given;
    const double w_h = std::clamp(2 - weight, 0.0, 1.0), w_V = std::clamp(weight, 0.0, 1.0);
    const double B_c = EnergyRates{e.wanted.potential, e.steady_kinetic}.balance(w_h, w_V),
                 error = B_c - e.present.balance(w_h, w_V);
    // The weights select the error that pitch corrects. The demanded climb needs its flight path angle with
    // any weights, as long as the engine follows its command.
    const double missing = throttle_.saturated() ? e.total_wanted - e.present.total() : 0;
    const double climb = e.wanted.potential * (1 - e.underspeed) - (1 - w_h) * missing;
    const double B_ff = climb - w_V * e.steady_kinetic;
    const double per_gV = 1 / (isa::g0 * e.Va);
    const PitchLimits pitch(e.within, p.common.airframe->limits, p.common.pitch_limit);
    const PidInput in{.error = error * per_gV,
                      .rate = 0,
                      .feedforward = theta_trim + B_ff * per_gV,
                      .min = pitch.min,
                      .max = pitch.max};
    const PidGains gains{p.pitch_damping, p.pitch_integral, 0};
    if (loop_.commands.taking_up()) pitch_.reset_to(loop_.commands.last().pitch_rad, gains, in, 0.1);
    const double theta = pitch_.step(gains, in, dt);
    out.internals.pitch_saturated = pitch_.saturated() || e.limited;
    out.balance_rate_error_ratio = error;
    return theta;
  }

  /// delta_t = trim + m / (Va T) [E_c + E_turn + k (E_c - E)] + integral, E = g hdot + Va Vadot.
  double total_to_throttle(const VehicleState& state, const Params& p, const Energy& e, double dt,
                           Outputs& out) {
    const FlightLimits& limits = p.common.airframe->limits;
    const double E_c = e.total_wanted;
    const double per_rate = p.common.airframe->mass_kg / (e.Va * p.thrust);
    const double trim = limits.throttle_cruise_frac + p.airspeed_kff * (e.Va_c - limits.airspeed_cruise_mps);
    const double feedforward = trim + per_rate * (E_c + e.turn_drag);
    if (!state.airspeed_valid) {
      out.total_rate_error_ratio = 0.0;
      return std::clamp(feedforward, 0.0, 1.0);
    }
    const double error = E_c - e.present.total();
    const PidInput in{.error = per_rate * error, .rate = 0, .feedforward = feedforward, .min = 0, .max = 1};
    const PidGains gains{p.throttle_damping, p.throttle_integral * (1 - e.underspeed), 0};
    if (loop_.commands.taking_up()) throttle_.reset_to(loop_.commands.last().throttle_frac, gains, in, 0.2);
    const double throttle = throttle_.step(gains, in, dt);
    out.internals.throttle_saturated = throttle_.saturated();
    out.total_rate_error_ratio = error;
    return e.underspeed + (1 - e.underspeed) * throttle;
  }

  OuterLoop loop_;
  Pid pitch_, throttle_;
  RateLimiter climb_rate_;
  LowPass acceleration_;
  SteadyAirspeed airspeed_;
};

}  // namespace fulmar::tecs
