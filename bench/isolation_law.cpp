// SPDX-License-Identifier: BSD-3-Clause
// A law of typical size with negligible computation: the measurement is the cost of its call.
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

using namespace fulmar;

namespace {

struct Law {
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
  };
  struct Params {};
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    out.attitude = {in.command->course_rad - in.state->course_rad, in.command->height_m - in.state->height_m,
                    0.5};
    return Status::ok;
  }
};

}  // namespace

FULMAR_PLUGIN("1.0.0", Law)
