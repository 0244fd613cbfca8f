// SPDX-License-Identifier: BSD-3-Clause
// A law unlike the template of `fulmar new`: an integral on both angles, gains by airspeed, no airframe.
#pragma once
#include <algorithm>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {
  struct Inputs {
    In<VehicleState> state;
    In<AttitudeCommand> attitude;
  };
  struct Outputs {
    Actuators actuators;
  };
  struct Params {
    Param gain{0.8, "rad/rad", 0, 5, "surface per angle"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    if (!last.has(last->actuators)) return Status::ok;
    const VehicleState& x = *in.state;
    aileron_ = last->actuators.aileron_rad - p.gain * (in.attitude->roll_rad - x.roll_rad);
    elevator_ = last->actuators.elevator_rad + p.gain * (in.attitude->pitch_rad - x.pitch_rad);
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& x = *in.state;
    const double roll = in.attitude->roll_rad - x.roll_rad, pitch = in.attitude->pitch_rad - x.pitch_rad;
    aileron_ = std::clamp(aileron_ + 0.1 * roll * tick.dt_s(), -0.1, 0.1);
    elevator_ = std::clamp(elevator_ - 0.1 * pitch * tick.dt_s(), -0.1, 0.1);
    out.actuators.throttle_frac = in.attitude->throttle_frac;
    out.actuators.aileron_rad = std::clamp(aileron_ + p.gain * roll - 0.1 * x.rate_radps.x, -0.4, 0.4);
    out.actuators.elevator_rad = std::clamp(elevator_ - p.gain * pitch + 0.2 * x.rate_radps.y, -0.4, 0.4);
    return Status::ok;
  }

 private:
  double aileron_ = 0, elevator_ = 0;
};
