// SPDX-License-Identifier: BSD-3-Clause
// ports in: state VehicleState, command GuidanceCommand
// ports out: attitude AttitudeCommand
// Outer loops in their simplest form: course to roll, height to pitch, airspeed to throttle, all
// proportional. Source: Beard & McLain, Small Unmanned Aircraft (2012), chapter 6.
#pragma once
#include <algorithm>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct MyLaw {  // fills the role `outer`
  static constexpr const char* doc = "Proportional course, height and airspeed hold.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    Probe height_error_m;
  };
  struct Params {
    Param course_kp{1.2, "rad/rad", 0, 5, "roll per course error"};
    Param height_kp{0.03, "rad/m", 0, 1, "pitch per height error"};
    Param airspeed_kp{0.1, "s/m", 0, 1, "throttle per airspeed error"};
    Param throttle_trim{0.4, "", 0, 1, "throttle in level flight"};
    Param roll_max{0.6, "rad", 0, 1.2, "limit of the roll command, either way"};
    Param pitch_trim{0.02, "rad", -0.3, 0.3, "pitch in level flight"};
    Param pitch_max{0.25, "rad", 0, 0.6, "limit of the pitch command, either way"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const double chi_error = wrap_pi(in.command->course_rad - in.state->course_rad);
    const double h_error = in.command->height_m - in.state->height_m;
    const double Va_error = in.command->airspeed_mps - in.state->airspeed_mps;
    out.attitude.roll_rad = std::clamp<double>(in.command->roll_feedforward_rad + p.course_kp * chi_error,
                                               -p.roll_max, p.roll_max);
    out.attitude.pitch_rad =
        std::clamp<double>(p.pitch_trim + p.height_kp * h_error, -p.pitch_max, p.pitch_max);
    out.attitude.throttle_frac = std::clamp<double>(p.throttle_trim + p.airspeed_kp * Va_error, 0, 1);
    out.height_error_m = h_error;
    return Status::ok;
  }
};
