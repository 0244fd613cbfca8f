// SPDX-License-Identifier: BSD-3-Clause
// The same flight in another world: mirrored, rotated about the vertical, moved. A law without a preferred
// side and direction must give the same result there; swapped signs and axes differ.
#pragma once
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::test {

struct World {
  bool mirrored = false;  ///< east becomes west, before the rotation
  double turned_rad = 0, north_m = 0, east_m = 0;

  double side() const { return mirrored ? -1 : 1; }
  double course(double rad) const { return wrap_pi(side() * rad + turned_rad); }
  Vec3<Ned> way(const Vec3<Ned>& v) const {
    const double c = std::cos(turned_rad), s = std::sin(turned_rad), e = side() * v.east;
    return {c * v.north - s * e, s * v.north + c * e, v.down};
  }
  Vec3<Ned> place(const Vec3<Ned>& p) const { return way(p) + Vec3<Ned>{north_m, east_m, 0}; }
  Turn turn(Turn t) const {
    if (!mirrored) return t;
    return t == Turn::right ? Turn::left : Turn::right;
  }

  VehicleState of(VehicleState s) const {
    s.position_m = place(s.position_m);
    s.velocity_mps = way(s.velocity_mps);
    s.wind_mps = way(s.wind_mps);
    s.roll_rad *= side();
    s.beta_rad *= side();
    s.yaw_rad = course(s.yaw_rad);
    s.course_rad = course(s.course_rad);
    s.rate_radps = {side() * s.rate_radps.x, s.rate_radps.y, side() * s.rate_radps.z};
    s.specific_force_mps2.y *= side();
    s.attitude = from_eigen(quaternion_from({s.roll_rad, s.pitch_rad, s.yaw_rad}));
    s.reset_position_m = way(s.reset_position_m);
    s.reset_velocity_mps = way(s.reset_velocity_mps);
    s.reset_yaw_rad *= side();
    return s;
  }
  GuidanceCommand of(GuidanceCommand c) const {
    c.course_rad = course(c.course_rad);
    c.roll_feedforward_rad *= side();
    c.lateral_acceleration_mps2 *= side();
    return c;
  }
  Path of(Path p) const {
    p.turn = turn(p.turn);
    p.origin_m = place(p.origin_m);
    p.direction_ratio = way(p.direction_ratio);
    p.start_rad = course(p.start_rad);
    p.next_curvature_ratio *= side();
    for (Vec3<Ned>& c : p.control_m) c = place(c);
    return p;
  }
  Plan of(Plan p) const {
    for (std::uint32_t i = 0; i < p.waypoints.count; ++i) {
      p.waypoints[i].position_m = place(p.waypoints[i].position_m);
      p.waypoints[i].course_rad = course(p.waypoints[i].course_rad);
    }
    return p;
  }
};

inline constexpr std::array<World, 4> worlds{
    {{true, 0, 0, 0}, {false, 2.1, 0, 0}, {false, 0, -210, 90}, {true, -0.7, 340, -120}}};

inline void check_near(const Vec3<Ned>& is, const Vec3<Ned>& wanted, double within = 1e-6) {
  CHECK(std::abs(is.north - wanted.north) < within);
  CHECK(std::abs(is.east - wanted.east) < within);
  CHECK(std::abs(is.down - wanted.down) < within);
}

inline void check_same(const GuidanceCommand& is, const GuidanceCommand& wanted) {
  CHECK(std::abs(wrap_pi(is.course_rad - wanted.course_rad)) < 1e-7);
  CHECK(std::abs(is.height_m - wanted.height_m) < 1e-6);
  CHECK(std::abs(is.climb_rate_mps - wanted.climb_rate_mps) < 1e-7);
  CHECK(std::abs(is.airspeed_mps - wanted.airspeed_mps) < 1e-7);
  CHECK(std::abs(is.roll_feedforward_rad - wanted.roll_feedforward_rad) < 1e-7);
  CHECK(is.lateral == wanted.lateral);
  CHECK(std::abs(is.lateral_acceleration_mps2 - wanted.lateral_acceleration_mps2) < 1e-7);
}

inline void check_same(const Path& is, const Path& wanted) {
  CHECK(is.kind == wanted.kind);
  check_near(is.origin_m, wanted.origin_m);
  if (is.kind == PathKind::line) {
    check_near(is.direction_ratio, wanted.direction_ratio, 1e-8);
  } else {
    CHECK(is.turn == wanted.turn);
    CHECK(std::abs(wrap_pi(is.start_rad - wanted.start_rad)) < 1e-7);
    CHECK(std::abs(is.climb_ratio - wanted.climb_ratio) < 1e-8);
  }
  CHECK(std::abs(is.radius_m - wanted.radius_m) < 1e-6);
  CHECK(is.airspeed_mps == wanted.airspeed_mps);
  CHECK(std::abs(is.remaining_m - wanted.remaining_m) < 1e-5);
  CHECK(std::abs(is.next_curvature_ratio - wanted.next_curvature_ratio) < 1e-8);
  CHECK(is.has_next == wanted.has_next);
}

}  // namespace fulmar::test
