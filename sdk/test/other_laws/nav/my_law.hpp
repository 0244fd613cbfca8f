// SPDX-License-Identifier: BSD-3-Clause
// An estimator unlike the template of `fulmar new`: position and velocity of the receiver, height of the
// barometer, and no valid attitude.
#pragma once
#include <cmath>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {
  struct Inputs {
    In<Imu> imu;
    In<Gnss> gnss;
    In<Mag> mag;
    In<Baro> baro;
    In<Pitot> pitot;
  };
  struct Outputs {
    VehicleState state;
  };
  struct Params {};

  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    VehicleState& s = out.state;
    s = {};
    s.rate_radps = in.imu->rate_radps;
    s.velocity_mps = in.gnss->velocity_mps;
    s.height_m = 44330.77 * (1 - std::pow(in.baro->pressure_pa / 101325.0, 0.190263));
    s.position_m.down = -s.height_m;
    s.velocity_valid = s.height_valid = in.gnss->fix >= FixType::fix_3d;
    return Status::ok;
  }
};
