// SPDX-License-Identifier: BSD-3-Clause
// A guide as it was written for revision 0f1b247: north-east, level, at one speed.
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct Guide {  // fills the role `guide`
  static constexpr const char* doc = "Holds one course, height and speed.";
  struct Inputs {
    In<VehicleState> state;
  };
  struct Outputs {
    GuidanceCommand command;
  };
  struct Params {
    Param course{0.8, "rad", -3.2, 3.2, "to hold"};
  };
  Status step(const Tick&, const Inputs&, const Params& p, Outputs& out) {
    out.command = {p.course, 70, 0, 17, 0};
    return Status::ok;
  }
};

FULMAR_PLUGIN("1.0.0", Guide)
