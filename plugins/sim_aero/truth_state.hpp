// SPDX-License-Identifier: BSD-3-Clause
// Navigation without an estimator: publishes the simulator's truth as the state.
#pragma once
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::sim {

struct TruthState {
  static constexpr const char* doc = "The simulator's truth as navigation state.";
  struct Inputs {
    In<VehicleState> truth;
  };
  struct Outputs {
    Out<VehicleState> state;
  };
  struct Params {
    Param position_std{0.01, "m", 1e-6, 1e3, "reported standard deviation of the position, each axis"};
    Param velocity_std{0.01, "m/s", 1e-6, 1e3, "reported standard deviation of the velocity, each axis"};
    Param attitude_std{0.001, "rad", 1e-6, 1, "reported standard deviation of the attitude, each axis"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (!in.truth.fresh()) return Status::ok;
    VehicleState s = *in.truth;
    s.position_std_m = {p.position_std, p.position_std, p.position_std};
    s.velocity_std_mps = s.wind_std_mps = {p.velocity_std, p.velocity_std, p.velocity_std};
    s.attitude_std_rad = {p.attitude_std, p.attitude_std, p.attitude_std};
    s.airspeed_std_mps = p.velocity_std;
    out.state.publish(s, in.truth.valid_at_ns());
    return Status::ok;
  }
};

}  // namespace fulmar::sim
