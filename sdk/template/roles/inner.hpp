// SPDX-License-Identifier: BSD-3-Clause
// ports in: state VehicleState, attitude AttitudeCommand
// ports out: actuators Actuators
// Attitude hold in its simplest form: proportional to the angle error, damped by the body rate; throttle
// passed through. Source: Beard & McLain, Small Unmanned Aircraft (2012), section 6.3, without integrators.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/airframe.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {  // fills the role `inner`
  static constexpr const char* doc = "Proportional and damping attitude hold.";
  struct Inputs {
    In<VehicleState> state;
    In<AttitudeCommand> attitude;
  };
  struct Outputs {
    Actuators actuators;
    Probe roll_error_rad;
    Probe pitch_error_rad;
  };
  struct Params {
    Param roll_kp{1.2, "rad/rad", 0, 10, "aileron per roll error"};
    Param roll_kd{0.1, "rad s/rad", 0, 5, "aileron per roll rate"};
    Param pitch_kp{4.0, "rad/rad", 0, 20, "nose-up elevator per pitch error"};
    Param pitch_kd{0.5, "rad s/rad", 0, 5, "elevator per pitch rate"};
    Param yaw_kd{0.2, "rad s/rad", 0, 5, "rudder per yaw rate of a sideslip"};
    Record<Airframe> airframe{"airframe with throws and trims"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& x = *in.state;
    const double roll_error = in.attitude->roll_rad - x.roll_rad;
    const double pitch_error = in.attitude->pitch_rad - x.pitch_rad;
    // A steady turn needs pitch and yaw rates: only the rate beyond them is damped. B&M (5.1), beta = 0.
    const double Va = std::max(x.airspeed_mps, p.airframe->limits.airspeed_min_mps);
    const double chi_dot = 9.80665 / Va * std::tan(std::clamp(x.roll_rad, -1.2, 1.2));
    const double q = x.rate_radps.y - chi_dot * std::sin(x.roll_rad),
                 r = x.rate_radps.z - chi_dot * std::cos(x.roll_rad);
    out.actuators.throttle_frac = std::clamp(in.attitude->throttle_frac, 0.0, 1.0);
    out.actuators.aileron_rad =
        deflected(p.airframe->aileron, p.roll_kp * roll_error - p.roll_kd * x.rate_radps.x);
    out.actuators.elevator_rad =
        deflected(p.airframe->elevator, -p.pitch_kp * pitch_error + p.pitch_kd * q);  // positive is nose down
    out.actuators.rudder_rad = deflected(p.airframe->rudder, p.yaw_kd * r);           // positive is nose left
    out.roll_error_rad = roll_error;
    out.pitch_error_rad = pitch_error;
    return Status::ok;
  }

 private:
  static double deflected(const Surface& surface, double by) {
    return std::clamp(surface.trim_rad + by, -surface.limit_rad, surface.limit_rad);
  }
};
