// SPDX-License-Identifier: BSD-3-Clause
// Clearance of a flight from the no-fly zones.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "zones.hpp"

namespace fulmar::slow_planner {

struct ZoneClearance {
  double least_m = unknown_std;  ///< smallest distance to the border of a zone so far; negative: inside
  double now_m = unknown_std;    ///< present distance to the border of the nearest zone
};

struct Watch {
  static constexpr const char* doc = "Distance of the aircraft from the no-fly zones.";
  struct Inputs {
    In<VehicleState> state;
  };
  struct Outputs {
    Out<ZoneClearance> clearance;
  };
  struct Params {
    Record<Zones> zones{"no-fly zones", required};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (!in.state->position_valid) return Status::ok;
    const Point here{in.state->position_m.north, in.state->position_m.east};
    result_.now_m = clearance(*p.zones, here, here);
    result_.least_m = std::min(result_.least_m, result_.now_m);
    out.clearance.publish(result_);
    return Status::ok;
  }

 private:
  ZoneClearance result_;
};

}  // namespace fulmar::slow_planner
