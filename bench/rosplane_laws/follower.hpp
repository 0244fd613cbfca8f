// SPDX-License-Identifier: BSD-3-Clause
// The path follower of ROSplane 2.0 (path_follower_example.cpp at ba7e114), written from its formulas, with
// the gains of its anaconda.yaml. Beard & McLain, Small Unmanned Aircraft (2012), chapter 10. Its faults:
// README.
#pragma once
#include <cmath>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/path.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

namespace fulmar::rosplane {

struct Follower {  // fills the role `guide`
  static constexpr const char* doc = "ROSplane's vector field onto lines and orbits.";
  struct Inputs {
    In<VehicleState> state;
    In<Path> path;
  };
  struct Outputs {
    GuidanceCommand command;
  };
  struct Params {
    Param chi_infty{1.2, "rad", 0, 1.57, "approach angle to a line from far away"};
    Param k_path{0.0175, "1/m", 0, 1, "gain of the line's field"};
    Param k_orbit{0.5, "ratio", 0, 20, "gain of the orbit's field"};
    Param gravity{9.81, "m/s2", 1, 20, "of the bank fed forward"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    constexpr double pi = std::numbers::pi;
    const VehicleState& s = *in.state;
    const Path& path = *in.path;
    const double n = s.position_m.north - path.origin_m.north, e = s.position_m.east - path.origin_m.east;
    const double d = std::hypot(n, e), chi = s.course_rad;
    GuidanceCommand& c = out.command;
    c.climb_rate_mps = 0;
    c.airspeed_mps = path.airspeed_mps;
    if (path.kind == PathKind::line) {
      const Vec3<Ned>& q = path.direction_ratio;
      const double chi_q = chi + wrap_pi(std::atan2(q.east, q.north) - chi);
      const double e_py = -std::sin(chi_q) * n + std::cos(chi_q) * e;
      const double level = std::hypot(q.north, q.east);
      c.course_rad = wrap_pi(chi_q - p.chi_infty * (2 / pi) * std::atan(p.k_path * e_py));
      // The whole distance from the point, not its projection: behind it the slope has the wrong sign.
      c.height_m = -path.origin_m.down - (level > 0 ? d * q.down / level : 0);
      c.roll_feedforward_rad = 0;
    } else {
      const double rho = path.radius_m, lambda = path.turn == Turn::right ? 1 : -1;
      const double phi = chi + wrap_pi(std::atan2(e, n) - chi);
      c.course_rad = wrap_pi(phi + lambda * (pi / 2 + std::atan(p.k_orbit * (d - rho) / rho)));
      c.height_m = -path.origin_m.down;
      c.roll_feedforward_rad =
          lambda * std::atan(s.airspeed_mps * s.airspeed_mps / (p.gravity * rho * std::cos(chi - s.yaw_rad)));
    }
    return Status::ok;
  }
};

}  // namespace fulmar::rosplane
