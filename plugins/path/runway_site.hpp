// SPDX-License-Identifier: BSD-3-Clause
// The runway of a landing: its place in the local frame, the circle and the line that lead onto it, and the
// checks at set-up.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/path/fence.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/runway.hpp"
#include "messages.hpp"

namespace fulmar::path {

/// Parameters of the landing that define the pattern.
struct Pattern {
  double glide_slope_rad = 0.07, aim_m = 50, final_length_m = 400, circle_radius_m = 70;
  Turn circle = Turn::left;
};

class RunwaySite {
 public:
  /// Takes the record `runway`, called `name` in messages. Throws when it is incomplete.
  void take(const Runway& runway, const std::string& name, bool from_plan) {
    runway_ = runway;
    const auto given = [](double a, double b, double c) {
      return (a != unknown_std) + (b != unknown_std) + (c != unknown_std);
    };
    const int local = given(runway_.north_m, runway_.east_m, runway_.up_m),
              geodetic = given(runway_.lat_deg, runway_.lon_deg, runway_.alt_msl_m);
    if (runway_.length_m <= 0 && local + geodetic > 0)
      throw std::runtime_error(fulmar::located(name, path_messages::runway_length_missing()).line());
    if (runway_.length_m <= 0)
      throw std::runtime_error(
          fulmar::located(from_plan ? "plan" : "runway", path_messages::runway_missing()).line());
    if (local + geodetic != 3 || (local != 0 && geodetic != 0))
      throw std::runtime_error(fulmar::located(name, path_messages::runway_place_ambiguous()).line());
    located_ = local == 3;
  }
  /// Places a geodetic runway, once the origin of the local frame is known.
  void put(double lat_deg, double lon_deg, double alt_m) {
    if (located_) return;
    const Eigen::Vector3d p_n =
        LocalFrame(lat_deg, lon_deg, alt_m).to_ned(runway_.lat_deg, runway_.lon_deg, runway_.alt_msl_m);
    runway_.north_m = p_n.x();
    runway_.east_m = p_n.y();
    runway_.up_m = -p_n.z();
    located_ = true;
  }
  bool located() const { return located_; }
  const Runway& runway() const { return runway_; }

  double fix_height(const Pattern& p) const {
    return runway_.up_m + std::tan(p.glide_slope_rad) * (p.final_length_m + p.aim_m);
  }
  /// The centre line as a path, from the foot of the slope, down along the slope.
  Path final_approach(const Pattern& p) const {
    const double c = std::cos(runway_.heading_rad), s = std::sin(runway_.heading_rad);
    Path path;
    path.kind = PathKind::line;
    path.origin_m = {runway_.north_m + p.aim_m * c, runway_.east_m + p.aim_m * s, -runway_.up_m};
    path.direction_ratio = {c * std::cos(p.glide_slope_rad), s * std::cos(p.glide_slope_rad),
                            std::sin(p.glide_slope_rad)};
    return path;
  }
  /// Touches the centre line at the begin of the final approach.
  Path circle(const Pattern& p) const {
    const double c = std::cos(runway_.heading_rad), s = std::sin(runway_.heading_rad);
    const double side = p.circle == Turn::right ? 1 : -1, R = p.circle_radius_m;
    Path path;
    path.kind = PathKind::orbit;
    path.turn = p.circle;
    path.radius_m = R;
    path.origin_m = {runway_.north_m - p.final_length_m * c - side * R * s,
                     runway_.east_m - p.final_length_m * s + side * R * c, -fix_height(p)};
    return path;
  }

  /// Rejects a fence that the way onto the runway, or along it again, leaves or comes too near to.
  void within_fence(const safety::Fence& record, const Origin& origin, double margin_m,
                    const Pattern& p) const {
    safety::Polygon fence;
    fence.set(record, origin);
    const Path orbit = circle(p);
    const double c = std::cos(runway_.heading_rad), s = std::sin(runway_.heading_rad);
    constexpr int points = 72;
    for (int i = 0; i < points; ++i) {
      const double a = 2 * std::numbers::pi * i / points;
      look(path_messages::landing_circle.c_str(), fence,
           orbit.origin_m.north + p.circle_radius_m * std::cos(a),
           orbit.origin_m.east + p.circle_radius_m * std::sin(a), margin_m);
    }
    for (int i = 0; i <= points; ++i) {
      const double along = -p.final_length_m + (p.final_length_m + runway_.length_m) * i / points;
      look((along < 0 ? path_messages::final_approach : path_messages::runway).c_str(), fence,
           runway_.north_m + along * c, runway_.east_m + along * s, margin_m);
    }
    if (fix_height(p) + margin_m > record.ceiling_m)
      throw std::runtime_error(
          fulmar::located("fence.ceiling_m", path_messages::landing_above_ceiling(
                                                 std::lround(fix_height(p)), std::lround(record.ceiling_m),
                                                 std::lround(margin_m)))
              .line());
  }

 private:
  static void look(const char* what, const safety::Polygon& fence, double north_m, double east_m,
                   double margin_m) {
    const double room = fence.room_m(north_m, east_m);
    if (room >= margin_m) return;
    const auto north = std::lround(north_m), east = std::lround(east_m);
    const Diagnostic fault =
        room < 0
            ? path_messages::landing_outside_fence(what, north, east, std::lround(-room))
            : path_messages::landing_near_fence(what, north, east, std::lround(room), std::lround(margin_m));
    throw std::runtime_error(fulmar::located("fence.corners", fault).line());
  }

  Runway runway_;  ///< in the local frame, if `located_`
  bool located_ = false;
};

/// A slope that the aircraft cannot follow would lead to a go-around each time. A head wind reduces the sink.
inline void check_slope(const FlightLimits& limits, double approach_ratio, double glide_slope_rad) {
  const double V = std::min(approach_ratio * limits.airspeed_min_mps, limits.airspeed_cruise_mps);
  const double sink = V * std::sin(glide_slope_rad), most = limits.sink_rate_max_mps;
  if (sink <= most) return;
  const auto number = [](double x) { return std::to_string(x).substr(0, 5); };
  throw std::runtime_error(located("glide_slope", path_messages::glide_slope_steep(
                                                      number(glide_slope_rad), number(V), number(sink),
                                                      number(most), number(std::asin(most / V))))
                               .line());
}

}  // namespace fulmar::path
