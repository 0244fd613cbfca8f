// SPDX-License-Identifier: BSD-3-Clause
// The law of examples/python/my_law.py in C++: what bench_python compares with. Equations: Beard & McLain (2012), chapter 6.
#include <algorithm>
#include <fulmar/flight/angles.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

namespace {

struct MyLaw {
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
    Param height_kp{0.02, "rad/m", 0, 0.2, "pitch per height error"};
    Param airspeed_kp{0.08, "s/m", 0, 1, "throttle per airspeed error"};
    Param roll_max{0.698, "rad", 0, 1, "largest bank"};
    Param pitch_trim{0.0349, "rad", -0.3, 0.3, "pitch of level cruise"};
    Param throttle_trim{0.5, "", 0, 1, "throttle of level cruise"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const double course_error = wrap_pi(in.command->course_rad - in.state->course_rad);
    const double height_error = in.command->height_m - in.state->height_m;
    out.height_error_m = height_error;
    out.attitude.roll_rad = std::clamp<double>(in.command->roll_feedforward_rad + p.course_kp * course_error, -p.roll_max, p.roll_max);
    out.attitude.pitch_rad = std::clamp(p.pitch_trim + p.height_kp * height_error, -0.3, 0.3);
    out.attitude.throttle_frac =
        std::clamp(p.throttle_trim + p.airspeed_kp * (in.command->airspeed_mps - in.state->airspeed_mps), 0.0, 1.0);
    return Status::ok;
  }
};

}  // namespace

FULMAR_PLUGIN("1.0.0", MyLaw)
