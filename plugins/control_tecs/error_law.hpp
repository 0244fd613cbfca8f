// SPDX-License-Identifier: BSD-3-Clause
// Outer loops by the errors of the energies. The error of the total energy moves the throttle, that of the
// balance between height and speed moves pitch, each through a PI law. Beard & McLain, Small Unmanned
// Aircraft, supplement to chapter 6, "Total energy control". Equations: README.
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

struct ErrorLaw {
  static constexpr const char* doc =
      "Course hold, and height and airspeed hold by the errors of total energy and energy balance; take-off "
      "law.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    ControllerInternals internals;
    OutQueue<Notice, 3> notices;  // stall, end of a stall, loss of height
    Probe total_error_ratio;      // m2/s2, within its limits
    Probe balance_error_ratio;    // m2/s2, within its limits
    Probe pitch_integral_rad;
    Probe throttle_integral_frac;
    Probe underspeed_ratio;
  };
  struct Params {
    OuterParams common;

    Param total_gain{1.5, "1/s", 0, 5, "total energy rate per total energy error, by throttle"};
    Param total_integral{0.2, "1/s2", 0, 5, "total energy rate per integrated total energy error"};
    Param balance_gain{1.2, "1/s", 0, 5, "energy balance rate per energy balance error, by pitch"};
    Param balance_integral{0.1, "1/s2", 0, 5, "energy balance rate per integrated energy balance error"};
    Param speed_weight{
        1.0, "ratio", 0, 2,
        "weight of airspeed in pitch; 0: height alone; 1: both, as in the book; 2: airspeed alone"};
    Param airspeed_filter{0.5, "s", 0, 10, "time constant of the airspeed for pitch"};
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
    airspeed_.reset();
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const auto rest = [&] {
      pitch_.reset();
      throttle_.reset();
      airspeed_.reset();
      late_climb_.reset();
      late_rate_.reset();
      out.total_error_ratio = 0.0;
      out.balance_error_ratio = 0.0;
      out.underspeed_ratio = 0.0;
    };
    const auto hold = [&](const LevelTurn& turn, double dt) -> PitchThrottle {
      const Errors e = errors(*in.state, *in.command, p, turn.within, dt, out);
      const double theta = balance_to_pitch(*in.state, p, e, turn, dt, out);
      return {theta, total_to_throttle(*in.state, p, e, turn, dt, out)};
    };
    const Status status = loop_.step(tick, *in.state, *in.command, p.common, out, rest, hold);
    out.pitch_integral_rad = pitch_.integral();
    out.throttle_integral_frac = throttle_.integral();
    return status;
  }

 private:
  /// Errors of the energies per mass, wanted minus present, m2/s2.
  struct Errors {
    double potential = 0, kinetic = 0;
    double steady_kinetic = 0;   ///< by the airspeed without gusts
    double climb_rate_mps = 0;   ///< of the path
    double underspeed = 0;       ///< 0: none; 1: speed has full priority
    double Va_c = 0;             ///< m/s
    double most = 0, least = 0;  ///< limits of the energy rate, m2/s3, by engine and drag

    /// Limits the errors to those whose gain gives the climb and sink that the path leaves. The kinetic error
    /// is limited to half of that. At a limit the error is not integrated.
    EnergyRates held(double kinetic_m2ps2, double gain) const {
      if (gain <= 0) return {potential, kinetic_m2ps2};
      const double ahead = isa::g0 * climb_rate_mps;
      return {std::clamp(potential, (least - ahead) / gain, (most - ahead) / gain),
              std::clamp(kinetic_m2ps2, 0.5 * least / gain, 0.5 * most / gain)};
    }
  };

  Errors errors(const VehicleState& state, const GuidanceCommand& command, const Params& p,
                const Envelope& within, double dt, Outputs& out) {
    const FlightLimits& limits = p.common.airframe->limits;
    const double error = command.height_m - state.height_m;
    Errors e;
    e.most = isa::g0 * limits.climb_rate_max_mps;
    e.least = -isa::g0 * limits.sink_rate_max_mps;
    e.climb_rate_mps =
        std::clamp(command.climb_rate_mps, -limits.sink_rate_max_mps, limits.climb_rate_max_mps);
    e.potential = isa::g0 * error;
    e.Va_c = limits.airspeed_cruise_mps;
    if (state.airspeed_valid) {
      e.underspeed = within.underspeed(state.airspeed_mps, p.underspeed_band);
      e.Va_c = within.airspeed(command.airspeed_mps, limits);
      const auto kinetic = [&](double V) { return 0.5 * (e.Va_c * e.Va_c - V * V); };
      e.kinetic = kinetic(state.airspeed_mps);
      e.steady_kinetic =
          kinetic(airspeed_.step(state.airspeed_mps, airspeed_rate(state), p.airspeed_filter, dt));
      out.internals.airspeed_error_mps = e.Va_c - state.airspeed_mps;
    } else {
      airspeed_.reset();
    }
    out.internals.height_error_m = error;
    out.underspeed_ratio = e.underspeed;
    return e;
  }

  /// Gain that turns an error into a rate. With a small gain the integral moves within a second at the
  /// fastest.
  static double gain_of(double gain, double integral) { return std::max({gain, integral, 1e-6}); }

  /// theta = theta_trim + hdot_path / Va + 1/(g Va) [ k B + k_i int B ],  B = w_h e_U - w_V e_K.
  double balance_to_pitch(const VehicleState& state, const Params& p, const Errors& e, const LevelTurn& turn,
                          double dt, Outputs& out) {
    const double given = state.airspeed_valid ? p.speed_weight.value : 0;
    const double weight = 2 * e.underspeed + (1 - e.underspeed) * given;
    const double w_h = std::clamp(2 - weight, 0.0, 1.0), w_V = std::clamp(weight, 0.0, 1.0);
    const EnergyRates held = e.held(e.steady_kinetic, p.balance_gain);
    const bool limited = held.potential != e.potential || held.kinetic != e.steady_kinetic;
    const double B = held.balance(w_h, w_V);
    const double per_gV = 1 / (isa::g0 * turn.Va_mps);
    const PitchLimits pitch(turn.within, p.common.airframe->limits, p.common.pitch_limit);
    const double ahead = (1 - e.underspeed) * e.climb_rate_mps;
    const double climb_rate = ahead + p.balance_gain * w_h * held.potential / isa::g0;
    const double missing = late_climb_.missing(limited, climb_rate, state.climb_rate_mps, pitch_.integral(),
                                               -max_pitch_bias, dt);
    const PidInput in{
        .error = limited ? missing / (gain_of(p.balance_gain, p.balance_integral) * turn.Va_mps) : B * per_gV,
        .rate = 0,
        .feedforward = turn.pitch_rad + ahead / turn.Va_mps + p.balance_gain * (B * per_gV),
        .min = pitch.min,
        .max = pitch.max};
    const PidGains gains{0, p.balance_integral, 0};
    if (loop_.commands.taking_up())
      pitch_.reset_to(loop_.commands.last().pitch_rad, gains, in, max_pitch_bias);
    const double theta = pitch_.step(gains, in, dt);
    out.internals.pitch_saturated = pitch_.saturated() || limited;
    out.balance_error_ratio = B;
    return theta;
  }

  /// delta_t = trim + m/(Va T) [ g hdot_path + E_turn + k E + k_i int E ],  E = e_U + e_K.
  double total_to_throttle(const VehicleState& state, const Params& p, const Errors& e, const LevelTurn& turn,
                           double dt, Outputs& out) {
    const FlightLimits& limits = p.common.airframe->limits;
    const double per_rate = p.common.airframe->mass_kg / (turn.Va_mps * p.thrust);
    const double feedforward = limits.throttle_cruise_frac +
                               p.airspeed_kff * (e.Va_c - limits.airspeed_cruise_mps) +
                               per_rate * isa::g0 * e.climb_rate_mps + turn.drag_newton / p.thrust;
    const EnergyRates held = e.held(e.kinetic, p.total_gain);
    const bool limited = held.potential != e.potential || held.kinetic != e.kinetic;
    const double E = held.total();
    out.total_error_ratio = E;
    if (!state.airspeed_valid)  // without airspeed: trim and the climb that pitch asks for
      return std::clamp(feedforward + per_rate * p.balance_gain * e.held(0, p.balance_gain).potential, 0.0,
                        1.0);
    const double rate = isa::g0 * e.climb_rate_mps + p.total_gain * E;
    const double flown = isa::g0 * state.climb_rate_mps + state.airspeed_mps * airspeed_rate(state);
    const double missing =
        late_rate_.missing(limited, rate, flown, throttle_.integral(), -max_throttle_bias, dt);
    const double learnt = limited ? missing / gain_of(p.total_gain, p.total_integral) : E;
    const PidInput in{.error = e.underspeed == 0 ? per_rate * learnt : 0,
                      .rate = 0,
                      .feedforward = feedforward + p.total_gain * (per_rate * E),
                      .min = 0,
                      .max = 1};
    const PidGains gains{0, p.total_integral, 0};
    if (loop_.commands.taking_up())
      throttle_.reset_to(loop_.commands.last().throttle_frac, gains, in, max_throttle_bias);
    const double throttle = throttle_.step(gains, in, dt);
    out.internals.throttle_saturated = throttle_.saturated();
    return e.underspeed + (1 - e.underspeed) * throttle;
  }

  static constexpr double max_pitch_bias = 0.1, max_throttle_bias = 0.2;  // rad, of 1
  OuterLoop loop_;
  Pid pitch_, throttle_;
  LateDemand late_climb_, late_rate_;
  SteadyAirspeed airspeed_;
};

}  // namespace fulmar::tecs
