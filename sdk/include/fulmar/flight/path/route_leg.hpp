// SPDX-License-Identifier: BSD-3-Clause
// Parts of a route: lines and arcs with heights, legs of several pieces, and the closest point of a leg.
// Source: Beard & McLain, Small Unmanned Aircraft (2012), chapter 11.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/path/dubins.hpp"
#include "fulmar/msg/path.hpp"

namespace fulmar {

/// 1 for a right turn, -1 for a left turn.
constexpr double sign_of(Turn turn) { return turn == Turn::right ? 1 : -1; }

/// The pose after `length_m` along a path of constant curvature (right positive).
inline Pose advance(const Pose& from, double curvature, double length_m) {
  const double half = curvature * length_m / 2;
  const double chord = std::abs(half) < 1e-6 ? length_m : length_m * std::sin(half) / half;
  const double course = from.course_rad + half;
  return {from.north_m + chord * std::cos(course), from.east_m + chord * std::sin(course),
          from.course_rad + 2 * half};
}

/// A line or an arc, horizontal, with the height along it.
struct RoutePiece {
  PathKind kind = PathKind::line;
  Turn turn = Turn::right;
  double north_m = 0, east_m = 0;                    ///< line: start; arc: centre
  double unit_north_ratio = 1, unit_east_ratio = 0;  ///< line: along it; arc: from the centre to its middle
  double radius_m = 0, start_rad = 0;                ///< arc; azimuth of its start from the centre
  double half_cos_ratio = -1;  ///< arc: cosine of half its angle, -1 for a full circle or more
  double length_m = 0;
  double height_m = 0, climb_ratio = 0;  ///< height at its start; metres up per metre along

  double curvature() const { return kind == PathKind::line ? 0 : sign_of(turn) / radius_m; }
  double height_at(double along_m) const { return height_m + climb_ratio * along_m; }

  /// Distance from the start to the projection of a point, m. On an arc in [-pi, pi] radii; callers unwrap
  /// longer arcs.
  double along(double north, double east) const {
    const double n = north - north_m, e = east - east_m;
    if (kind == PathKind::line) return n * unit_north_ratio + e * unit_east_ratio;
    return radius_m * sign_of(turn) * wrap_pi(std::atan2(e, n) - start_rad);
  }
  Pose pose_at(double along_m) const {
    if (kind == PathKind::line) {
      return {north_m + along_m * unit_north_ratio, east_m + along_m * unit_east_ratio,
              std::atan2(unit_east_ratio, unit_north_ratio)};
    }
    const double azimuth = start_rad + sign_of(turn) * along_m / radius_m;
    return {north_m + radius_m * std::cos(azimuth), east_m + radius_m * std::sin(azimuth),
            wrap_pi(azimuth + sign_of(turn) * std::numbers::pi / 2)};
  }
};

/// Closest point of a route to a given one.
struct RoutePoint {
  double north_m = 0, east_m = 0, height_m = 0;
  double distance_m = unknown_std;  ///< horizontal distance
};

/// The route from one waypoint to the next: from the middle of one corner to the middle of the other.
struct RouteLeg {
  std::array<RoutePiece, 6> pieces{};
  std::uint32_t count = 0;
  double length_m = 0;
  double airspeed_mps = 15;
  Pose end;  ///< pose at the waypoint of the leg

  const RoutePiece& operator[](std::size_t i) const { return pieces[i]; }
};

namespace detail {

/// Builds a leg piece by piece; each piece starts at the end of the one before.
struct LegBuilder {
  RouteLeg leg;
  Pose at;

  void add(double curvature, double length_m) {
    constexpr double shortest_m = 1e-9;
    if (length_m < shortest_m || leg.count == leg.pieces.size()) return;
    RoutePiece& piece = leg.pieces[leg.count++];
    piece.length_m = length_m;
    leg.length_m += length_m;
    if (curvature == 0) {
      piece.north_m = at.north_m;
      piece.east_m = at.east_m;
      piece.unit_north_ratio = std::cos(at.course_rad);
      piece.unit_east_ratio = std::sin(at.course_rad);
    } else {
      const double side = curvature > 0 ? 1 : -1, half = curvature * length_m / 2;
      piece.kind = PathKind::orbit;
      piece.turn = curvature > 0 ? Turn::right : Turn::left;
      piece.radius_m = 1 / std::abs(curvature);
      piece.start_rad = wrap_pi(at.course_rad - side * std::numbers::pi / 2);
      piece.north_m = at.north_m - piece.radius_m * std::cos(piece.start_rad);
      piece.east_m = at.east_m - piece.radius_m * std::sin(piece.start_rad);
      piece.unit_north_ratio = std::cos(piece.start_rad + half);
      piece.unit_east_ratio = std::sin(piece.start_rad + half);
      piece.half_cos_ratio = std::abs(half) < std::numbers::pi ? std::cos(half) : -1;
    }
    at = advance(at, curvature, length_m);
  }

  void add_dubins(const Pose& to, double radius_m) {
    const DubinsPath path = dubins(at, to, radius_m);
    for (int part = 0; part < 3; ++part)
      add(dubins_turn(path.word, part) / radius_m, path.parts[static_cast<std::size_t>(part)] * radius_m);
    at = to;
  }

  /// Sets one slope over the whole leg. It is limited to 45 degrees: then the leg starts at another height.
  void finish(double from_height_m, double to_height_m) {
    if (leg.count == 0) {  // leg of a duplicate point
      leg.count = 1;
      leg.pieces[0] = {};
      leg.pieces[0].north_m = at.north_m;
      leg.pieces[0].east_m = at.east_m;
      leg.pieces[0].unit_north_ratio = std::cos(at.course_rad);
      leg.pieces[0].unit_east_ratio = std::sin(at.course_rad);
    }
    const double climb =
        leg.length_m > 0 ? std::clamp((to_height_m - from_height_m) / leg.length_m, -1.0, 1.0) : 0;
    double height_m = to_height_m - climb * leg.length_m;
    for (std::size_t i = 0; i < leg.count; ++i) {
      leg.pieces[i].height_m = height_m;
      leg.pieces[i].climb_ratio = climb;
      height_m += climb * leg.pieces[i].length_m;
    }
    leg.end = at;
  }
};

}  // namespace detail

/// Search for the closest point of one or several legs: exact, ends included.
class NearestSearch {
 public:
  NearestSearch(double north_m, double east_m) : north_(north_m), east_(east_m) {}

  void consider(const RouteLeg& leg) {
    for (std::size_t i = 0; i < leg.count; ++i)
      leg.pieces[i].kind == PathKind::line ? line(leg.pieces[i]) : arc(leg.pieces[i]);
  }

  RoutePoint result() const {
    RoutePoint point{best_north_, best_east_, 0, best_};
    if (!of_) return point;
    double s = of_->along(best_north_, best_east_);
    // an arc of more than half a turn: its far end has a negative distance from the start
    if (s < -1e-6 * of_->radius_m && of_->kind == PathKind::orbit) s += 2 * std::numbers::pi * of_->radius_m;
    point.height_m = of_->height_at(std::clamp(s, 0.0, of_->length_m));
    return point;
  }

 private:
  void line(const RoutePiece& piece) {
    const double n = north_ - piece.north_m, e = east_ - piece.east_m;
    const double s = std::clamp(n * piece.unit_north_ratio + e * piece.unit_east_ratio, 0.0, piece.length_m);
    take(piece, s * piece.unit_north_ratio, s * piece.unit_east_ratio);
  }

  void arc(const RoutePiece& piece) {
    const double n = north_ - piece.north_m, e = east_ - piece.east_m, square = n * n + e * e;
    const double outer = piece.radius_m + best_, inner = piece.radius_m - best_;
    if (square > outer * outer || (inner > 0 && square < inner * inner))
      return;  // even the full circle is farther than the best point
    const double d = std::sqrt(square);
    const double dot = n * piece.unit_north_ratio + e * piece.unit_east_ratio;
    double unit_n = d > 0 ? n / d : piece.unit_north_ratio, unit_e = d > 0 ? e / d : piece.unit_east_ratio;
    if (dot < piece.half_cos_ratio * d) {  // beyond an end: rotate the direction of the middle by half the
                                           // arc, to the side of the point
      const double side = n * piece.unit_east_ratio - e * piece.unit_north_ratio > 0 ? -1 : 1;
      const double c = piece.half_cos_ratio, s = side * std::sqrt(std::max(0.0, 1 - c * c));
      unit_n = c * piece.unit_north_ratio - s * piece.unit_east_ratio;
      unit_e = c * piece.unit_east_ratio + s * piece.unit_north_ratio;
    }
    take(piece, piece.radius_m * unit_n, piece.radius_m * unit_e);
  }

  /// Point of a piece, relative to the reference point of the piece.
  void take(const RoutePiece& piece, double n, double e) {
    const double dn = north_ - piece.north_m - n, de = east_ - piece.east_m - e, square = dn * dn + de * de;
    if (square >= best_square_) return;
    best_square_ = square;
    best_ = std::sqrt(square);
    best_north_ = piece.north_m + n;
    best_east_ = piece.east_m + e;
    of_ = &piece;
  }

  double north_, east_;
  double best_north_ = 0, best_east_ = 0, best_ = unknown_std, best_square_ = unknown_std * unknown_std;
  const RoutePiece* of_ = nullptr;
};

/// Closest point of one leg.
inline RoutePoint nearest(const RouteLeg& leg, double north_m, double east_m) {
  NearestSearch search(north_m, east_m);
  search.consider(leg);
  return search.result();
}

}  // namespace fulmar
