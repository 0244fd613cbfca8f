// SPDX-License-Identifier: BSD-3-Clause
// Inner loops: roll -> aileron, pitch -> elevator, yaw damper -> rudder. Beard & McLain, Small Unmanned
// Aircraft (2012), section 6.3, with dynamic-pressure scaling, rate feed-forward, and the rates and elevator
// of a coordinated turn as reference.
#pragma once
#include <algorithm>
#include <fulmar/flight/control/outer_commands.hpp>
#include <fulmar/flight/control/pid.hpp>
#include <fulmar/flight/control/turn_trim.hpp>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/math/filters.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/sideslip_command.hpp>
#include <fulmar/plugin.hpp>
#include <optional>

#include "attitude_loss.hpp"
#include "hand_over_fade.hpp"
#include "quiet_axes.hpp"
#include "slip_trim.hpp"

namespace fulmar::slc {

struct Inner {
  static constexpr const char* doc = "Roll and pitch hold, yaw damper with wash-out and turn coordination.";
  struct Inputs {
    In<VehicleState> state;
    In<AttitudeCommand> attitude;
    Optional<SideslipCommand> sideslip;  // in a landing with cross wind; else without a value
  };
  struct Outputs {
    Actuators actuators;
    Probe roll_error_rad;
    Probe pitch_error_rad;
    Probe surface_scale_ratio;
    OutQueue<Notice, 3> notices;  // an axis oscillated, and its gains were reduced
  };
  struct Params {
    Param roll_kp{1.2, "rad/rad", 0, 20, "aileron per roll error"};
    Param roll_ki{0.1, "rad/(rad s)", 0, 10, "aileron per integrated roll error"};
    Param roll_kd{0.02, "rad s/rad", 0, 5, "aileron per roll rate"};
    Param roll_kff{0.15, "rad s/rad", 0, 5,
                   "aileron per commanded roll rate: the roll damping of the airframe"};
    Param roll_from_sideslip{0.0, "rad/rad", -5, 5,
                             "aileron per sideslip: dutch roll damping for an aircraft without a rudder"};

    Param pitch_kp{4.0, "rad/rad", 0, 20, "nose-up elevator per pitch error"};
    Param pitch_ki{2.0, "rad/(rad s)", 0, 40, "nose-up elevator per integrated pitch error"};
    Param pitch_kd{0.5, "rad s/rad", 0, 10, "elevator per pitch rate beyond that of the turn"};
    Param turn_kff{1.0, "ratio", 0, 2, "fed-forward share of the elevator for bank and airspeed"};

    Param yaw_kd{0.3, "rad s/rad", 0, 5, "rudder per yaw rate beyond that of the turn"};
    Param yaw_washout{0.6, "rad/s", 0.01, 10, "pole of the wash-out filter of the yaw damper"};

    Param command_filter{0.04, "s", 0.005, 1, "time constant of the differentiated roll command"};
    Param airspeed_smoothing{0.5, "s", 0, 10, "time constant of the airspeed for gains, trim and turn rates"};
    Param scale_limit{2.5, "ratio", 1, 10,
                      "limit of the gain factor at low dynamic pressure, and of its inverse at high"};
    Flag quieten{true, "switch for the gain reduction and report of an axis that oscillates"};
    Record<Airframe> airframe{
        "airframe with throws, trims, cruise speed and derivatives for the feed-forward of turns"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& params, const Applied<Outputs>& last) {
    last_ = last->actuators;
    // Without actuators of a law before, after a pilot or at a start in the air, trim and feed-forward are
    // the initial values.
    take_up_ = last.has(last->actuators);
    fade_.stop();
    if (!take_up_) {
      roll_.reset();
      pitch_.reset();
    }
    loss_.begin();
    roll_command_rate_.reset_to(in.attitude->roll_rad);
    airspeed_.reset_to(scheduling_airspeed(*in.state, params.airframe->limits));
    washout_.reset_to(yaw_rate_error(*in.state, airspeed_.value()));
    quiet_.begin();
    return Status::ok;
  }

  void configure(const Params& p) { quiet_.configure(gains_of(p)); }
  void retune(const Params& p) { quiet_.retune(gains_of(p)); }

  using Axis = QuietAxes::Axis;
  /// Share of the gains that quietening has left to an axis.
  double gain_left(Axis axis) const { return quiet_.gain(axis); }

  Status step(const Tick& tick, const Inputs& in, const Params& params, Outputs& out) {
    const AttitudeCommand& command = *in.attitude;
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const double Va = airspeed_.step(scheduling_airspeed(*in.state, params.airframe->limits),
                                     params.airspeed_smoothing, dt);
    if (loss_.look(in.state, in.attitude)) take_up(in, Va);
    const bool blind = loss_.blind();
    const double slip = slip_asked(tick, in.sideslip);
    std::optional<VehicleState> commanded;
    if (blind) commanded = as_commanded(*in.state, command, Va);
    const VehicleState& state = blind ? *commanded : *in.state;
    const double rho = density_.at(state.origin_altitude_m + state.height_m);
    const TurnRates turn = turn_rates(state.roll_rad, state.pitch_rad, Va);
    const double speed_ratio = params.airframe->limits.airspeed_cruise_mps / Va;
    const double scale =
        std::clamp(speed_ratio * speed_ratio, 1 / params.scale_limit, params.scale_limit.value);
    const bool integrating = flying(state, params.airframe->limits);
    if (!integrating) {
      roll_.reset();
      pitch_.reset();
    }
    // the ground holds the attitude, so its error is not integrated
    const double integrate = integrating ? dt : 0;

    out.actuators.throttle_frac = std::clamp(command.throttle_frac, 0.0, 1.0);
    out.actuators.aileron_rad = roll_to_aileron(state, command, params, slip, scale, integrate, dt);
    out.actuators.elevator_rad = pitch_to_elevator(state, command, params, turn, scale, Va, rho, integrate);
    out.actuators.rudder_rad = yaw_to_rudder(state, params, turn, slip, scale, dt);
    fade_.step(take_up_ ? &last_ : nullptr, *params.airframe, integrating, dt, out.actuators);
    take_up_ = false;
    if (params.quieten) quieten(tick, command, params, scale, integrating && !blind, dt, out);
    out.roll_error_rad = command.roll_rad - state.roll_rad;
    out.pitch_error_rad = command.pitch_rad - state.pitch_rad;
    out.surface_scale_ratio = scale;
    if (blind) last_ = out.actuators;
    return blind || quiet_.quietened() ? Status::degraded : Status::ok;
  }

 private:
  static QuietAxes::Gains gains_of(const Params& p) {
    return {p.roll_kp,  p.roll_ki,  p.roll_kd, p.pitch_kp,
            p.pitch_ki, p.pitch_kd, p.yaw_kd,  p.quieten ? 1.0 : 0.0};
  }

  /// A swinging aileron also yaws the aircraft. The rudder is not judged meanwhile.
  void quieten(const Tick& tick, const AttitudeCommand& command, const Params& p, double scale, bool watching,
               double dt, Outputs& out) {
    if (!watching) return quiet_.begin();
    const Actuators& u = out.actuators;
    const QuietAxes::Surfaces surfaces{
        .deflection = {u.aileron_rad, u.elevator_rad, u.rudder_rad},
        .commanded = {scale * quiet_.gain(Axis::roll) * p.roll_kp * command.roll_rad +
                          std::sqrt(scale) * p.roll_kff * p_c_,
                      scale * quiet_.gain(Axis::pitch) * p.pitch_kp * command.pitch_rad, u.aileron_rad},
        .limit = {p.airframe->aileron.limit_rad, p.airframe->elevator.limit_rad,
                  p.airframe->rudder.limit_rad}};
    quiet_.step(tick, surfaces, dt, out.notices);
  }

  /// Resumes control when the attitude is known again.
  void take_up(const Inputs& in, double Va) {
    take_up_ = true;
    roll_command_rate_.reset_to(in.attitude->roll_rad);
    washout_.reset_to(yaw_rate_error(*in.state, Va));
  }

  /// delta_a = trim + slip's + scale [kp e + kd (p_c - p) + I + k_beta beta] + kff p_c
  double roll_to_aileron(const VehicleState& state, const AttitudeCommand& command, const Params& p,
                         double slip_rad, double scale, double integrate, double dt) {
    const Surface& aileron = p.airframe->aileron;
    const double p_c = std::clamp(roll_command_rate_.step(command.roll_rad, p.command_filter, dt), -3.0, 3.0);
    p_c_ = p_c;
    const double beta = state.airspeed_valid ? state.beta_rad : 0;
    // Damping by the air is proportional to the speed, the power of the aileron to its square: the
    // feed-forward scales by the quotient.
    const PidInput in{.error = command.roll_rad - state.roll_rad,
                      .rate = state.rate_radps.x - p_c,
                      .feedforward = aileron.trim_rad + aileron_for(slip_rad, p.airframe->aero) +
                                     p.roll_kff * std::sqrt(scale) * p_c +
                                     scale * p.roll_from_sideslip * beta,
                      .min = -aileron.limit_rad,
                      .max = aileron.limit_rad};
    const double k = scale * quiet_.gain(Axis::roll);
    const PidGains gains{k * p.roll_kp, k * p.roll_ki, k * p.roll_kd};
    if (take_up_) roll_.reset_to(last_.aileron_rad, gains, in, 0.1);
    return roll_.step(gains, in, integrate);
  }

  /// delta_e = trim(turn, speed) - scale [kp e + kd (q_turn - q) + I]: positive elevator is nose down.
  double pitch_to_elevator(const VehicleState& state, const AttitudeCommand& command, const Params& p,
                           const TurnRates& present, double scale, double Va, double rho, double integrate) {
    const Surface& elevator = p.airframe->elevator;
    const FlightLimits& limits = p.airframe->limits;
    const double turn =
        turn_trim(*p.airframe, state.roll_rad, std::max(Va, limits.airspeed_min_mps), rho).elevator_rad;
    const double cruise = turn_trim(*p.airframe, 0, limits.airspeed_cruise_mps, rho).elevator_rad;
    const PidInput in{.error = command.pitch_rad - state.pitch_rad,
                      .rate = state.rate_radps.y - present.q_radps,
                      .feedforward = -(elevator.trim_rad + p.turn_kff * (turn - cruise)),
                      .min = -elevator.limit_rad,
                      .max = elevator.limit_rad};
    const double k = scale * quiet_.gain(Axis::pitch);
    const PidGains gains{k * p.pitch_kp, k * p.pitch_ki, k * p.pitch_kd};
    if (take_up_) pitch_.reset_to(-last_.elevator_rad, gains, in, 0.2);
    return -pitch_.step(gains, in, integrate);
  }

  static double yaw_rate_error(const VehicleState& state, double Va) {
    return state.rate_radps.z - turn_rates(state.roll_rad, state.pitch_rad, Va).r_radps;
  }

  /// delta_r = trim + slip's + scale kd s / (s + p_wo) (r - r_turn): positive rudder is nose left.
  double yaw_to_rudder(const VehicleState& state, const Params& p, const TurnRates& turn, double slip_rad,
                       double scale, double dt) {
    const Surface& rudder = p.airframe->rudder;
    const double damping = washout_.step(state.rate_radps.z - turn.r_radps, p.yaw_washout, dt);
    const double held = rudder.trim_rad + rudder_for(slip_rad, p.airframe->aero);
    return std::clamp(held + quiet_.gain(Axis::yaw) * (scale * p.yaw_kd * damping), -rudder.limit_rad,
                      rudder.limit_rad);
  }

  Pid roll_, pitch_;
  Differentiator roll_command_rate_;
  double p_c_ = 0;  ///< roll rate commanded
  WashOut washout_;
  QuietAxes quiet_;
  NearbyDensity density_;
  LowPass airspeed_;      ///< m/s, for gains, trim and turn rates
  Actuators last_;        ///< of the law before, or before the loss of attitude
  bool take_up_ = false;  ///< start from `last_` in this step
  HandOverFade fade_;
  AttitudeLoss loss_;
};

}  // namespace fulmar::slc
