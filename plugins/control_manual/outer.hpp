// SPDX-License-Identifier: BSD-3-Clause
// Roll, pitch and throttle from the sticks, each axis separately; the other axes come from an outer law.
#pragma once
#include "envelope.hpp"
#include "fulmar/flight/control/turn_trim.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "pilot.hpp"

namespace fulmar::manual {

struct Outer {
  static constexpr const char* doc =
      "Roll, pitch and throttle commands: each axis from the sticks or from an outer law.";
  /// Source of an axis: its stick; an outer law; or the present attitude. With the present attitude a law
  /// that takes over later continues from it.
  enum class Source : std::uint8_t { stick, automatic, flown };

  struct Inputs {
    In<VehicleState> state;
    Optional<Rc> rc;
    Optional<AttitudeCommand> automatic;  // from an outer law
  };
  struct Outputs {
    AttitudeCommand attitude;
    Probe protecting_ratio;  // 1: the envelope changes the command
  };
  struct Params {
    StickParams sticks;
    EnvelopeParams envelope;
    Choice<Source> roll{Source::stick, "source of the roll command"};
    Choice<Source> pitch{Source::stick, "source of the pitch command"};
    Choice<Source> throttle{
        Source::stick, "source of the throttle command; flown: the stick, because throttle is not measured"};
    Param roll_range{0.5, "rad", 0.02, 1.5, "roll angle at full stick"};
    Param pitch_range{0.5, "rad", 0.02, 1.2, "pitch angle at full stick, relative to level flight at cruise"};
    Param roll_rate_limit{2.0, "rad/s", 0.1, 6, "rate limit of the roll command"};
    Param pitch_rate_limit{1.0, "rad/s", 0.05, 6, "rate limit of the pitch command"};
    Param blend{0.5, "s", 0.01, 5, "time constant of the bumpless transfer"};
    Record<Airframe> airframe{"airframe with limits and the pitch of level flight", required};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    roll_.reset();
    pitch_.reset();
    throttle_.reset();
    roll_slew_.reset();
    pitch_slew_.reset();
    if (last.has(last->attitude)) {
      begin_attitude(last->attitude.roll_rad, last->attitude.pitch_rad);
      throttle_.begin(last->attitude.throttle_frac);
    } else if (in.state->attitude_valid && flying(*in.state, p.airframe->limits)) {
      // No command is in force: the command starts from the present attitude. The present throttle is not
      // known.
      begin_attitude(in.state->roll_rad, in.state->pitch_rad);
    }
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const double decay = std::exp(-dt / p.blend);
    const VehicleState& state = *in.state;
    const FlightLimits& limits = p.airframe->limits;
    const Sticks hand = sticks(in.rc, tick, p.sticks);
    const bool lawful = in.automatic && !in.automatic.stale();
    const double level = level_pitch(state, p);
    const double rest = flying(state, limits) ? limits.throttle_cruise_frac : 0;
    const AttitudeCommand held = lawful ? *in.automatic : AttitudeCommand{0, level, rest};
    const AttitudeCommand asked{hand.roll * p.roll_range, level + hand.pitch * p.pitch_range, hand.throttle};
    const AttitudeCommand has{state.roll_rad, state.pitch_rad, hand.throttle};

    bool as_chosen = true;
    const auto axis = [&](Blend& blend, Source chosen, double AttitudeCommand::*of) {
      Source source = hand.there ? chosen : Source::automatic;
      if (source == Source::automatic && hand.there && !lawful) source = Source::stick;
      if (source == Source::flown && !state.attitude_valid) source = Source::stick;
      as_chosen = as_chosen && source == chosen;
      const AttitudeCommand& from = source == Source::stick ? asked : source == Source::flown ? has : held;
      return blend.step(from.*of, static_cast<int>(source), decay);
    };
    const AttitudeCommand wanted{axis(roll_, p.roll, &AttitudeCommand::roll_rad),
                                 axis(pitch_, p.pitch, &AttitudeCommand::pitch_rad),
                                 axis(throttle_, p.throttle, &AttitudeCommand::throttle_frac)};
    const Envelope e = envelope(state, limits, p.envelope);
    const AttitudeCommand kept = within(e, wanted);
    // Slewed from the limited command, not from that of the stick, and limited at once.
    out.attitude = within(e, {roll_slew_.step(kept.roll_rad, p.roll_rate_limit, dt),
                              pitch_slew_.step(kept.pitch_rad, p.pitch_rate_limit, dt), kept.throttle_frac});
    out.protecting_ratio = kept.roll_rad != wanted.roll_rad || kept.pitch_rad != wanted.pitch_rad ||
                           kept.throttle_frac != wanted.throttle_frac;
    return as_chosen && (hand.there || lawful) ? Status::ok : Status::degraded;
  }

 private:
  static AttitudeCommand within(const Envelope& e, const AttitudeCommand& a) {
    return {std::clamp(a.roll_rad, -e.roll_max, e.roll_max),
            std::clamp(a.pitch_rad, e.pitch_min, e.pitch_max),
            std::clamp(a.throttle_frac, e.throttle_min, e.throttle_max)};
  }
  void begin_attitude(double roll_rad, double pitch_rad) {
    roll_.begin(roll_rad);
    pitch_.begin(pitch_rad);
    roll_slew_.reset_to(roll_rad);
    pitch_slew_.reset_to(pitch_rad);
  }
  /// Pitch of level flight at cruise speed, rad: the middle of the pitch stick.
  static double level_pitch(const VehicleState& state, const Params& p) {
    const double rho = standard_air(state.origin_altitude_m + state.height_m).density_kgm3;
    return turn_trim(*p.airframe, 0, p.airframe->limits.airspeed_cruise_mps, rho).alpha_rad;
  }

  Blend roll_, pitch_, throttle_;
  RateLimiter roll_slew_, pitch_slew_;
};

}  // namespace fulmar::manual
