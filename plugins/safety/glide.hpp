// SPDX-License-Identifier: BSD-3-Clause
// An outer law without motor: airspeed by pitch, and a flare. Beard & McLain, Small Unmanned Aircraft (2012),
// section 6.4.3, with the glide of the airframe's model as feed-forward; the flare is the exponential one of
// Stevens, Lewis & Johnson, Aircraft Control and Simulation (2016), 4.6.
#pragma once
#include "fulmar/flight/control/energy.hpp"
#include "fulmar/flight/control/outer_law.hpp"
#include "fulmar/flight/control/pid.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/controller_internals.hpp"
#include "fulmar/msg/home_progress.hpp"
#include "glide_model.hpp"

namespace fulmar::safety {

struct Glide {
  static constexpr const char* doc =
      "Glide with closed throttle: airspeed by pitch, course by bank; wings level and flare above the "
      "ground.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;      // its course and airspeed are used
    Optional<HomeProgress> progress;  // height of the ground; without it `ground`
  };
  struct Outputs {
    AttitudeCommand attitude;
    ControllerInternals internals;
    Probe sink_expected_mps;  // sink of the steady glide by the model
    Probe flare_ratio;        // 1: in the flare
  };
  struct Params {
    OuterParams common;
    Param airspeed_kp{0.06, "rad/(m/s)", 0, 1, "pitch per airspeed excess"};
    Param airspeed_ki{0.015, "rad/m", 0, 1, "pitch per integrated airspeed excess"};
    Param airspeed_kd{0.03, "rad/(m/s2)", 0, 1, "pitch per acceleration along the flight path"};
    Param flare_time{1.5, "s", 0.1, 10,
                     "time to the ground at the present sink rate at the start of the flare"};
    Param flare_kd{0.06, "rad/(m/s)", 0, 1, "pitch per sink rate excess in the flare"};
    Param ground{0, "m", -1000, 10000, "height of the ground above the origin, without the input `progress`"};
    Param touch_sink{1.0, "m/s", 0, 3, "sink rate at the end of the flare"};
    Param level_time{2.6, "s", 0, 60,
                     "time to the ground at the present sink rate below which the wings are levelled"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    loop_.activate(*in.state, p.common, last);
    airspeed_.reset();
    flares_ = false;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    GuidanceCommand c = *in.command;
    const bool reported = in.progress && !in.progress.stale();
    const double height = s.height_m - (reported ? in.progress->ground_m : p.ground.value);
    out.sink_expected_mps = out.flare_ratio = 0.0;
    const double sink = std::max(-s.climb_rate_mps, 1.0);
    if (s.height_valid && height < p.level_time * sink) {
      c.lateral = LateralMode::acceleration;
      c.lateral_acceleration_mps2 = 0;
    }
    const auto rest = [&] { airspeed_.reset(); };
    const auto hold = [&](const LevelTurn& turn, double dt) -> PitchThrottle {
      return {pitch(s, c, p, turn, height, dt, out), 0};
    };
    loop_.flares = flares_;
    const Status status = loop_.step(tick, s, c, p.common, out, rest, hold);
    out.attitude.throttle_frac = 0;  // that of level flight is unknown while the state is invalid
    return status;
  }

 private:
  double pitch(const VehicleState& s, const GuidanceCommand& c, const Params& p, const LevelTurn& turn,
               double height, double dt, Outputs& out) {
    const Airframe& a = *p.common.airframe;
    const FlightLimits& limits = a.limits;
    const double sink = sink_rate(a, turn.Va_mps, s.roll_rad, air_density(s));
    out.sink_expected_mps = sink;
    const double sinks = std::max(-s.climb_rate_mps, sink);
    if (flares_ && height > 2 * from_m_ + 5) flares_ = false;  // the ground is lower than expected
    if (!flares_ && height < p.flare_time * sinks) {
      flares_ = true;
      from_m_ = height;
      sink_mps_ = sinks;
    }
    if (flares_) {
      out.flare_ratio = 1.0;
      const double left = from_m_ > 0 ? std::clamp(height / from_m_, 0.0, 1.0) : 0;
      const double wanted = -(p.touch_sink + left * std::max(sink_mps_ - p.touch_sink, 0.0));
      // A dead-reckoned airspeed may be too low. A limit at the pitch of the stalling speed is sufficient.
      const double stall_mps = limits.airspeed_min_mps / 1.2;
      const double level =
          turn.Va_mps < stall_mps ? level_turn(s.roll_rad, stall_mps, s, p.common).pitch_rad : turn.pitch_rad;
      const double theta = level + wanted / turn.Va_mps + p.flare_kd * (wanted - s.climb_rate_mps);
      // Near the stall pitch has no upper limit, because the speed must decrease.
      return std::clamp(theta, limits.pitch_min_rad, limits.pitch_max_rad);
    }
    const PitchLimits within(turn.within, limits, p.common.pitch_limit);
    const double trim = turn.pitch_rad - std::asin(std::clamp(sink / turn.Va_mps, 0.0, 0.5));
    if (!s.airspeed_valid) return std::clamp(trim, within.min, within.max);
    const PidInput in{.error = s.airspeed_mps - c.airspeed_mps,
                      .rate = -airspeed_rate(s),
                      .feedforward = trim,
                      .min = within.min,
                      .max = within.max};
    out.internals.airspeed_error_mps = -in.error;
    return airspeed_.step({p.airspeed_kp, p.airspeed_ki, p.airspeed_kd}, in, dt);
  }

  OuterLoop loop_;
  Pid airspeed_;
  bool flares_ = false;
  double from_m_ = 0, sink_mps_ = 0;  ///< height and sink at the begin of the flare
};

}  // namespace fulmar::safety
