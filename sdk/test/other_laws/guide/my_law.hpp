// SPDX-License-Identifier: BSD-3-Clause
// A law unlike the template of `fulmar new`: a lateral acceleration towards a point ahead, all of it as bank.
// Source: Park, Deyst & How, A new nonlinear guidance logic for trajectory tracking, AIAA 2004-4900.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/path.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct MyLaw {
  struct Inputs {
    In<VehicleState> state;
    In<Path> path;
  };
  struct Outputs {
    GuidanceCommand command;
  };
  struct Params {
    Param distance{60, "m", 5, 500, "of the point ahead"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const Path& path = *in.path;
    const double n = in.state->position_m.north - path.origin_m.north,
                 e = in.state->position_m.east - path.origin_m.east, Vg = in.state->ground_speed_mps;
    double ahead_n, ahead_e;
    if (path.kind == PathKind::line) {
      const double q_n = path.direction_ratio.north, q_e = path.direction_ratio.east;
      const double along = q_n * n + q_e * e + p.distance;
      ahead_n = along * q_n - n;
      ahead_e = along * q_e - e;
    } else {
      const double side = path.turn == Turn::right ? 1 : -1, R = path.radius_m;
      const double azimuth = std::atan2(e, n) + side * std::min(p.distance / R, 2.0);
      ahead_n = R * std::cos(azimuth) - n;
      ahead_e = R * std::sin(azimuth) - e;
    }
    const double eta = wrap_pi(std::atan2(ahead_e, ahead_n) - in.state->course_rad);
    const double a = 2 * Vg * Vg / p.distance * std::sin(std::clamp(eta, -1.5, 1.5));
    out.command = {};
    out.command.course_rad = in.state->course_rad;
    out.command.height_m = -path.origin_m.down;
    out.command.airspeed_mps = path.airspeed_mps;
    out.command.roll_feedforward_rad = std::clamp(std::atan(a / 9.80665), -0.7, 0.7);
    return Status::ok;
  }
};
