// SPDX-License-Identifier: BSD-3-Clause
// ports in: state VehicleState, path Path
// ports out: command GuidanceCommand
// Carrot chasing. On a line the law steers to the point `lookahead` ahead of the aircraft's projection. On an
// orbit it follows the tangent, bent towards the orbit. Sources: line: Micaelli & Samson (1993); orbit: Beard
// & McLain, Small Unmanned Aircraft (2012), (10.13).
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

struct MyLaw {  // fills the role `guide`
  static constexpr const char* doc = "Carrot chasing on lines, tangents on orbits.";
  struct Inputs {
    In<VehicleState> state;
    In<Path> path;
  };
  struct Outputs {
    GuidanceCommand command;
    Probe cross_track_m;
  };
  struct Params {
    Param lookahead{35, "m", 1, 500, "distance of the carrot ahead on a line"};
    Param k_orbit{2.5, "ratio", 0.1, 20, "gain of the approach to an orbit"};
    Param roll_max{0.785, "rad", 0, 1.4, "limit of the bank that is fed forward"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const Path& path = *in.path;
    const double Vg = in.state->ground_speed_mps;
    const double n = in.state->position_m.north - path.origin_m.north,
                 e = in.state->position_m.east - path.origin_m.east;
    GuidanceCommand& command = out.command;
    command = {};
    command.height_m = -path.origin_m.down;
    command.airspeed_mps = path.airspeed_mps;
    if (path.kind == PathKind::line) {
      const double along = std::max(std::hypot(path.direction_ratio.north, path.direction_ratio.east), 1e-6);
      const double q_n = path.direction_ratio.north / along, q_e = path.direction_ratio.east / along,
                   slope = -path.direction_ratio.down / along;
      const double cross = q_n * e - q_e * n;  // right of the line is positive
      command.course_rad = wrap_pi(std::atan2(q_e, q_n) - std::atan2(cross, p.lookahead.value));
      command.height_m += slope * (q_n * n + q_e * e);
      command.climb_rate_mps = slope * Vg;
      out.cross_track_m = cross;
      return Status::ok;
    }
    const double side = path.turn == Turn::right ? 1 : -1, R = std::max(path.radius_m, 1.0),
                 azimuth = std::atan2(e, n);
    const double cross = std::hypot(n, e) - R;  // outside is positive
    command.course_rad = wrap_pi(azimuth + side * (std::numbers::pi / 2 + std::atan(p.k_orbit * cross / R)));
    command.height_m += path.climb_ratio * side * R * wrap_pi(azimuth - path.start_rad);
    command.climb_rate_mps = path.climb_ratio * Vg;
    if (std::abs(cross) < 0.5 * R)
      command.roll_feedforward_rad = side * std::min(std::atan(Vg * Vg / (9.80665 * R)), p.roll_max.value);
    out.cross_track_m = cross;
    return Status::ok;
  }
};
