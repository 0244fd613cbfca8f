// SPDX-License-Identifier: BSD-3-Clause
// A circle at a height: waits, climbs and comes down without a plan. The circle is that of the vector field,
// Beard & McLain, Small Unmanned Aircraft (2012), section 10.2.
#pragma once
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/loiter_progress.hpp"
#include "vector_field.hpp"

namespace fulmar::path {

enum class LoiterAt : std::uint8_t { here, point };

struct Loiter {
  static constexpr const char* doc =
      "Circle at the present position or around a point, with a change of height.";
  struct Inputs {
    In<VehicleState> state;
  };
  struct Outputs {
    GuidanceCommand command;
    LoiterProgress progress;
  };
  struct Params {
    FieldParams field;
    Record<Airframe> airframe{"airframe with the cruise airspeed", required};
    Choice<LoiterAt> at{LoiterAt::here,
                        "kind of circle; here: starts at the present position; point: around north, east"};
    Param north{0, "m", -1e5, 1e5, "north position of the point, from the origin"};
    Param east{0, "m", -1e5, 1e5, "east position of the point, from the origin"};
    Param height{-1, "m", -1, 1e5, "height of the circle above the origin; below 0: height at activation"};
    Param rate{2, "m/s", 0.1, 50, "rate of the height command, up or down"};
    Param radius{80, "m", 10, 1e4, "radius of the circle"};
    Choice<Turn> turn{Turn::left, "turn direction of the circle"};
    Param airspeed{0, "m/s", 0, 100, "true airspeed command; 0: cruise airspeed of the airframe"};
  };

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>&) {
    begin(*in.state, p);
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    if (!begun_) begin(s, p);
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const double wanted = p.height < 0 ? taken_at_m_ : p.height.value;
    const double left = wanted - asked_m_, most = p.rate * dt;
    asked_m_ += std::clamp(left, -most, most);

    GuidanceCommand& c = out.command;
    c = {};
    c.height_m = asked_m_;
    c.climb_rate_mps = std::abs(left) > most ? std::copysign(p.rate, left) : 0;
    c.airspeed_mps = p.airspeed > 0 ? p.airspeed.value : p.airframe->limits.airspeed_cruise_mps;
    const double side = p.turn == Turn::right ? 1 : -1;
    if (!s.position_valid || !s.height_valid) {  // a circle through the air, of the same radius
      c.course_rad = s.course_rad;
      c.roll_feedforward_rad = s.attitude_valid && s.velocity_valid
                                   ? bank_for(side / p.radius, s.airspeed_mps, 0, p.field.roll_max)
                                   : 0;
      out.progress = progress_;
      out.progress.there = false;
      return Status::degraded;
    }
    const Path path = circle(p);
    const double k = p.field.reference_speed / std::max(s.ground_speed_mps, 0.3 * p.field.reference_speed);
    const VectorField::Aim aim = VectorField::at_orbit(path, s, p.field, k);
    c.course_rad = wrap_pi(aim.chi_c);
    c.roll_feedforward_rad = bank_for(VectorField::curvature_ahead(path, s, p.field, aim), s.ground_speed_mps,
                                      angle_difference(s.course_rad, s.yaw_rad), p.field.roll_max);
    count(aim, s, p, side, wanted);
    out.progress = progress_;
    return Status::ok;
  }

 private:
  void begin(const VehicleState& s, const Params& p) {
    begun_ = true;
    asked_m_ = taken_at_m_ = s.height_m;
    progress_ = {};
    azimuth_known_ = false;
    // Next to the aircraft, so that it is on the circle, along its tangent.
    const double side = p.turn == Turn::right ? 1 : -1;
    north_m_ = s.position_m.north - side * p.radius * std::sin(s.course_rad);
    east_m_ = s.position_m.east + side * p.radius * std::cos(s.course_rad);
  }
  Path circle(const Params& p) const {
    Path path;
    path.kind = PathKind::orbit;
    path.turn = p.turn;
    path.radius_m = p.radius;
    path.origin_m = p.at == LoiterAt::point ? Vec3<Ned>{p.north, p.east, -asked_m_}
                                            : Vec3<Ned>{north_m_, east_m_, -asked_m_};
    return path;
  }
  /// Laps count near the circle only: on the way to it the azimuth has no meaning.
  void count(const VectorField::Aim& aim, const VehicleState& s, const Params& p, double side,
             double wanted) {
    constexpr double near_ratio = 0.3, level_m = 3;
    const bool near = std::abs(aim.cross) < near_ratio * p.radius;
    const double azimuth = aim.path_course - side * std::numbers::pi / 2;
    if (near && azimuth_known_)
      progress_.laps_ratio += side * angle_difference(azimuth, azimuth_rad_) / (2 * std::numbers::pi);
    azimuth_rad_ = azimuth;
    azimuth_known_ = near;
    progress_.cross_m = aim.cross;
    progress_.height_error_m = s.height_m - wanted;
    progress_.there = near && std::abs(progress_.height_error_m) < level_m;
  }

  LoiterProgress progress_;
  double asked_m_ = 0, taken_at_m_ = 0, north_m_ = 0, east_m_ = 0, azimuth_rad_ = 0;
  bool begun_ = false, azimuth_known_ = false;
};

}  // namespace fulmar::path
