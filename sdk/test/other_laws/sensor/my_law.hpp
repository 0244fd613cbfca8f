// SPDX-License-Identifier: BSD-3-Clause
// A sensor unlike the template of `fulmar new`: without noise, twice a second, and silent at first.
#pragma once
#include <cmath>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLawRange {
  double range_m = 0;
};

struct MyLaw {
  struct Inputs {
    In<VehicleState> state;
  };
  struct Outputs {
    OutQueue<MyLawRange, 1> range;
  };
  struct Params {};

  explicit MyLaw(std::uint64_t) {}

  Status step(const Tick& tick, const Inputs& in, const Params&, Outputs& out) {
    if (++steps_ % 10 == 0) out.range.push({std::abs(in.state->height_m)}, tick.now_ns);
    return Status::ok;
  }

 private:
  int steps_ = 0;
};
