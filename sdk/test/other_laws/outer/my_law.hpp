// SPDX-License-Identifier: BSD-3-Clause
// A law unlike the template of `fulmar new`: course by a turn rate, height and speed by integrals, no probes.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
  };
  struct Params {
    Param turn_time{3, "s", 0.5, 20, "to take a course error away"};
  };

  Status activate(const Tick&, const Inputs& in, const Params&, const Applied<Outputs>& last) {
    if (!last.has(last->attitude)) return Status::ok;
    const double h_error = in.command->height_m - in.state->height_m;
    pitch_ = last->attitude.pitch_rad - 0.02 * h_error;
    throttle_ = last->attitude.throttle_frac - 0.05 * (in.command->airspeed_mps - in.state->airspeed_mps);
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double chi_dot = wrap_pi(in.command->course_rad - in.state->course_rad) / p.turn_time;
    const double h_error = std::clamp(in.command->height_m - in.state->height_m, -10.0, 10.0),
                 Va_error = in.command->airspeed_mps - in.state->airspeed_mps;
    pitch_ = std::clamp(pitch_ + 0.004 * h_error * tick.dt_s(), -0.2, 0.2);
    throttle_ = std::clamp(throttle_ + 0.02 * Va_error * tick.dt_s(), 0.0, 1.0);
    out.attitude.roll_rad = std::clamp(std::atan(chi_dot * in.state->airspeed_mps / 9.80665), -0.7, 0.7);
    out.attitude.pitch_rad = std::clamp(pitch_ + 0.02 * h_error, -0.3, 0.3);
    out.attitude.throttle_frac = std::clamp(throttle_ + 0.05 * Va_error, 0.0, 1.0);
    return Status::ok;
  }

 private:
  double pitch_ = 0.02, throttle_ = 0.4;
};
