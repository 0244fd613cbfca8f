// SPDX-License-Identifier: BSD-3-Clause
// Surfaces, body rates or attitude from the sticks, each axis separately. The README gives the equations.
#pragma once
#include "envelope.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "pilot.hpp"
#include "rate_loops.hpp"

namespace fulmar::manual {

struct Inner {
  static constexpr const char* doc =
      "Aileron, elevator, rudder and throttle from the sticks: each axis as surface, rate or attitude.";
  enum class Law : std::uint8_t { surface, rate, attitude };
  enum class Rudder : std::uint8_t { surface, damper };
  enum class Throttle : std::uint8_t { stick, automatic };

  struct Inputs {
    In<VehicleState> state;
    Optional<Rc> rc;
    Optional<AttitudeCommand> attitude;  // from an outer law
  };
  struct Outputs {
    Actuators actuators;
    Probe roll_rate_demand_radps;  // 0 while the stick commands the surface directly
    Probe pitch_rate_demand_radps;
  };
  struct Params {
    StickParams sticks;
    EnvelopeParams envelope;
    Choice<Law> aileron{Law::rate,
                        "quantity commanded by the roll stick; attitude: roll command of the outer law"};
    Choice<Law> elevator{Law::rate,
                         "quantity commanded by the pitch stick; attitude: pitch command of the outer law"};
    Choice<Rudder> rudder{Rudder::damper, "mode of the yaw stick: surface alone, or surface and yaw damper"};
    Choice<Throttle> throttle{Throttle::stick, "source of the throttle; automatic: the outer law"};
    Param throw_share{1, "ratio", 0.05, 1, "share of the throw at full stick, from the trim"};
    Param roll_rate{1.5, "rad/s", 0.05, 6, "roll rate at full stick, and its limit in attitude mode"};
    Param pitch_rate{0.6, "rad/s", 0.05, 3,
                     "pitch rate at full stick beyond that of a turn, and its limit in attitude mode"};
    Param roll_gain{4, "1/s", 0.1, 20, "roll rate per roll error, also at the bank limit"};
    Param pitch_gain{3, "1/s", 0.1, 20, "pitch rate per pitch error, also at the pitch limit"};
    Param roll_damping{8, "1/s", 0, 50, "roll damping that the aileron adds to that of the airframe"};
    Param pitch_damping{12, "1/s", 0, 50, "pitch damping that the elevator adds to that of the airframe"};
    Param integral{3, "1/s", 0, 20, "ratio of integral to proportional gain of both rate loops"};
    Param yaw_damping{0.3, "rad s/rad", 0, 5, "rudder per yaw rate beyond that of the turn, at cruise speed"};
    Param yaw_washout{0.6, "rad/s", 0.01, 10, "pole of the wash-out filter of the yaw damper"};
    Param airspeed_smoothing{0.5, "s", 0, 10, "time constant of the airspeed for gains and trims"};
    Param blend{0.3, "s", 0.01, 5, "time constant of the bumpless transfer"};
    Record<Airframe> airframe{"airframe with throws, trims, limits and derivatives", required};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    p_loop_.reset();
    q_loop_.reset();
    for (Blend* blend : {&aileron_, &elevator_, &rudder_, &throttle_}) blend->reset();
    if (last.has(last->actuators)) {
      aileron_.begin(last->actuators.aileron_rad);
      elevator_.begin(last->actuators.elevator_rad);
      rudder_.begin(last->actuators.rudder_rad);
      throttle_.begin(last->actuators.throttle_frac);
    }
    airspeed_.reset_to(scheduling_airspeed(*in.state, p.airframe->limits));
    washout_.reset();
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& state = *in.state;
    const Now now = look(tick, in, p);
    const Demand roll = roll_demand(state, p, now), pitch = pitch_demand(state, p, now);
    out.actuators.aileron_rad = move(p_loop_, aileron_, roll, p.airframe->aileron, p, now);
    out.actuators.elevator_rad = move(q_loop_, elevator_, pitch, p.airframe->elevator, p, now);
    out.actuators.rudder_rad = rudder(state, p, now);
    out.actuators.throttle_frac = throttle(p, now);
    out.roll_rate_demand_radps = roll.law == Law::surface ? 0 : roll.rate_c;
    out.pitch_rate_demand_radps = pitch.law == Law::surface ? 0 : pitch.rate_c;
    const bool led =
        p.aileron != Law::attitude && p.elevator != Law::attitude && p.throttle != Throttle::automatic;
    return now.known && now.hand.there && (now.lawful || led) ? Status::ok : Status::degraded;
  }

 private:
  /// Values that all axes share in a step.
  struct Now {
    double dt = 0, Va = 1, rho = 1;  ///< s, m/s, kg/m3
    double decay = 1;                ///< of the blends
    Sticks hand;
    Envelope envelope;
    AttitudeCommand to;          ///< command of the outer law; without one, wings level at cruise
    TurnRates turn;              ///< of a coordinated turn at the present bank
    double cruise_elevator = 0;  ///< rad, of level flight at cruise, by the airframe's model
    bool lawful = false;         ///< an outer law is present
    bool known = false;          ///< attitude and rates are valid
    bool flying = false;
  };
  /// Demand of one axis: the wanted rate and the limits of the envelope.
  struct Demand {
    Law law;                         ///< active law
    double stick;                    ///< -1 to 1, with the sign of the surface
    double rate, rate_c, low, high;  ///< rad/s
    RateLoop loop;
  };

  Now look(const Tick& tick, const Inputs& in, const Params& p) {
    const VehicleState& state = *in.state;
    const FlightLimits& limits = p.airframe->limits;
    Now now;
    now.dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    now.decay = std::exp(-now.dt / p.blend);
    now.Va = airspeed_.step(scheduling_airspeed(state, limits), p.airspeed_smoothing, now.dt);
    now.rho = standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
    now.hand = sticks(in.rc, tick, p.sticks);
    now.envelope = envelope(state, limits, p.envelope);
    now.turn = turn_rates(state.roll_rad, state.pitch_rad, now.Va);
    now.lawful = in.attitude && !in.attitude.stale();
    now.known = state.attitude_valid;
    now.flying = flying(state, limits);
    const TurnTrim cruise = turn_trim(*p.airframe, 0, limits.airspeed_cruise_mps, now.rho);
    now.cruise_elevator = cruise.elevator_rad;
    now.to = now.lawful ? *in.attitude
                        : AttitudeCommand{0, cruise.alpha_rad, now.flying ? limits.throttle_cruise_frac : 0};
    return now;
  }

  /// Law in force: without a pilot an axis holds the attitude; without an attitude a stick moves its surface.
  static Law in_force(Law chosen, const Now& now) {
    if (!now.hand.there) return Law::attitude;
    return now.known || chosen == Law::attitude ? chosen : Law::surface;
  }

  /// Rates that lead to the limits of the envelope, as for an attitude: rate = gain (limit - attitude).
  static void limit(Demand& d, const Params& p, double turn, double gain, double attitude, double min,
                    double max, double most) {
    d.low = -no_limit;
    d.high = no_limit;
    if (!p.envelope.protection) return;
    d.low = turn + std::min(gain * (min - attitude), most);
    d.high = turn + std::max(gain * (max - attitude), -most);
    d.rate_c = std::clamp(d.rate_c, d.low, d.high);
  }

  Demand roll_demand(const VehicleState& state, const Params& p, const Now& now) const {
    Demand d{in_force(p.aileron, now),
             now.hand.roll,
             state.rate_radps.x,
             0,
             0,
             0,
             RateLoop(aileron_authority(*p.airframe, now.Va, now.rho), p.airframe->aileron.trim_rad,
                      p.roll_damping)};
    const double wanted = d.law == Law::attitude ? p.roll_gain * (now.to.roll_rad - state.roll_rad)
                                                 : now.hand.roll * p.roll_rate;
    d.rate_c = now.turn.p_radps + std::clamp<double>(wanted, -p.roll_rate, p.roll_rate);
    limit(d, p, now.turn.p_radps, p.roll_gain, state.roll_rad, -now.envelope.roll_max, now.envelope.roll_max,
          p.roll_rate);
    return d;
  }

  Demand pitch_demand(const VehicleState& state, const Params& p, const Now& now) const {
    const double turn =
        turn_trim(*p.airframe, state.roll_rad, std::max(now.Va, p.airframe->limits.airspeed_min_mps), now.rho)
            .elevator_rad;
    const Authority authority = elevator_authority(*p.airframe, now.Va, now.rho);
    // The trim of the turn includes its pitch rate: only the rate beyond it needs steady deflection.
    const double trim =
        p.airframe->elevator.trim_rad + turn - now.cruise_elevator - authority.steady * now.turn.q_radps;
    Demand d{in_force(p.elevator, now),
             -now.hand.pitch,
             state.rate_radps.y,
             0,
             0,
             0,
             RateLoop(authority, trim, p.pitch_damping)};
    const double wanted = d.law == Law::attitude ? p.pitch_gain * (now.to.pitch_rad - state.pitch_rad)
                                                 : now.hand.pitch * p.pitch_rate;
    d.rate_c = now.turn.q_radps + std::clamp<double>(wanted, -p.pitch_rate, p.pitch_rate);
    limit(d, p, now.turn.q_radps, p.pitch_gain, state.pitch_rad, now.envelope.pitch_min,
          now.envelope.pitch_max, p.pitch_rate);
    return d;
  }

  /// Deflection by the stick, limited to that of the rate loop at the limits; or by the rate loop.
  static double move(Pid& pid, Blend& blend, const Demand& d, const Surface& surface, const Params& p,
                     const Now& now) {
    double u = 0;
    if (!now.known || d.law == Law::surface) {
      const double stick = d.law == Law::attitude ? 0 : d.stick;
      pid.reset();
      u = blend.step(surface.trim_rad + stick * p.throw_share * surface.limit_rad, 0, now.decay);
      if (now.known) {
        const auto [low, high] =
            std::minmax({d.loop.proportional(d.low, d.rate), d.loop.proportional(d.high, d.rate)});
        u = std::clamp(u, low, high);
      }
    } else {
      const PidInput in{.error = d.rate_c - d.rate,
                        .rate = 0,
                        .feedforward = d.loop.feedforward(d.rate_c),
                        .min = -surface.limit_rad,
                        .max = surface.limit_rad};
      if (!now.flying) pid.reset();
      u = pid.step({d.loop.kp, d.loop.kp * p.integral, 0}, in, now.dt);
      u = blend.step(u, static_cast<int>(d.law), now.decay);
    }
    return blend.kept(std::clamp(u, -surface.limit_rad, surface.limit_rad));
  }

  /// delta_r = trim - stick throw + kd (V_cruise/Va)^2 s/(s + washout) (r - r_turn): positive is nose left.
  double rudder(const VehicleState& state, const Params& p, const Now& now) {
    const Surface& surface = p.airframe->rudder;
    const double ratio = p.airframe->limits.airspeed_cruise_mps / now.Va;
    if (!now.known) washout_.reset();
    const double slip =
        now.known ? washout_.step(state.rate_radps.z - now.turn.r_radps, p.yaw_washout, now.dt) : 0;
    const bool damps = p.rudder == Rudder::damper || !now.hand.there;
    const double damping = damps ? p.yaw_damping * std::clamp(ratio * ratio, 0.4, 2.5) * slip : 0;
    const double stick = -now.hand.yaw * p.throw_share * surface.limit_rad;
    const double u = rudder_.step(surface.trim_rad + stick + damping, damps, now.decay);
    return rudder_.kept(std::clamp(u, -surface.limit_rad, surface.limit_rad));
  }

  double throttle(const Params& p, const Now& now) {
    const bool by_stick = now.hand.there && (p.throttle == Throttle::stick || !now.lawful);
    const double u = throttle_.step(by_stick ? now.hand.throttle : now.to.throttle_frac, by_stick, now.decay);
    return throttle_.kept(std::clamp(u, now.envelope.throttle_min, now.envelope.throttle_max));
  }

  static constexpr double no_limit = 1e3;  ///< rad/s
  Pid p_loop_, q_loop_;
  Blend aileron_, elevator_, rudder_, throttle_;
  LowPass airspeed_;  ///< m/s
  WashOut washout_;
};

}  // namespace fulmar::manual
