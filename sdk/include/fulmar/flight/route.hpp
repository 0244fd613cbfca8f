// SPDX-License-Identifier: BSD-3-Clause
// The route that a plan describes: legs of straight lines and arcs, joined without a kink, each leg computed on its own from its
// neighbourhood. Sources: Beard & McLain, Small Unmanned Aircraft (2012), sections 11.1 (fillets) and 11.2 (Dubins paths).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/flight/angles.hpp"
#include "fulmar/flight/dubins.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"

namespace fulmar {

constexpr double sign_of(Turn turn) { return turn == Turn::right ? 1 : -1; }

/// The pose after `length_m` along a path of constant curvature (right positive).
inline Pose advance(const Pose& from, double curvature, double length_m) {
  const double half = curvature * length_m / 2;
  const double chord = std::abs(half) < 1e-6 ? length_m : length_m * std::sin(half) / half;
  const double course = from.course_rad + half;
  return {from.north_m + chord * std::cos(course), from.east_m + chord * std::sin(course), from.course_rad + 2 * half};
}

/// A line or an arc, seen from above, with the height along it.
struct RoutePiece {
  PathKind kind = PathKind::line;
  Turn turn = Turn::right;
  double north_m = 0, east_m = 0;                    ///< line: where it begins; arc: its centre
  double unit_north_ratio = 1, unit_east_ratio = 0;  ///< line: along it; arc: from the centre to its middle
  double radius_m = 0, start_rad = 0;                ///< arc; azimuth, from the centre, where it begins
  double half_cos_ratio = -1;                        ///< arc: cosine of half its angle, -1 when it is a full circle or more
  double length_m = 0;
  double height_m = 0, climb_ratio = 0;  ///< at its beginning; metres up per metre along

  double curvature() const { return kind == PathKind::line ? 0 : sign_of(turn) / radius_m; }
  double height_at(double along_m) const { return height_m + climb_ratio * along_m; }

  /// Metres from the beginning to the projection of a point. On an arc in [-pi, pi] radii: who flies a longer one unwraps.
  double along(double north, double east) const {
    const double n = north - north_m, e = east - east_m;
    if (kind == PathKind::line) return n * unit_north_ratio + e * unit_east_ratio;
    return radius_m * sign_of(turn) * wrap_pi(std::atan2(e, n) - start_rad);
  }
  Pose pose_at(double along_m) const {
    if (kind == PathKind::line) {
      return {north_m + along_m * unit_north_ratio, east_m + along_m * unit_east_ratio, std::atan2(unit_east_ratio, unit_north_ratio)};
    }
    const double azimuth = start_rad + sign_of(turn) * along_m / radius_m;
    return {north_m + radius_m * std::cos(azimuth), east_m + radius_m * std::sin(azimuth),
            wrap_pi(azimuth + sign_of(turn) * std::numbers::pi / 2)};
  }
};

/// Closest point of a route to a given one.
struct RoutePoint {
  double north_m = 0, east_m = 0, height_m = 0;
  double distance_m = unknown_std;  ///< horizontal
};

/// The way from one waypoint to the next: from the middle of one corner to the middle of the other.
struct RouteLeg {
  std::array<RoutePiece, 6> pieces{};
  std::uint32_t count = 0;
  double length_m = 0;
  double airspeed_mps = 15;
  Pose end;  ///< the path's point of the waypoint that the leg leads to

  const RoutePiece& operator[](std::size_t i) const { return pieces[i]; }
};

namespace detail {

/// Builds a leg piece by piece, each beginning where the one before ends.
struct LegBuilder {
  RouteLeg leg;
  Pose at;

  void add(double curvature, double length_m) {
    constexpr double shortest_m = 1e-6;
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

  /// One slope over the whole leg. A steeper one than 45 degrees is not drawn: the leg then begins at another height.
  void finish(double from_height_m, double to_height_m) {
    if (leg.count == 0) {  // the leg of a duplicate point
      leg.count = 1;
      leg.pieces[0] = {};
      leg.pieces[0].north_m = at.north_m;
      leg.pieces[0].east_m = at.east_m;
      leg.pieces[0].unit_north_ratio = std::cos(at.course_rad);
      leg.pieces[0].unit_east_ratio = std::sin(at.course_rad);
    }
    const double climb = leg.length_m > 0 ? std::clamp((to_height_m - from_height_m) / leg.length_m, -1.0, 1.0) : 0;
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

/// How the route passes one waypoint: along a fillet, or through the point itself.
struct Passage {
  Pose entry, middle, exit;  ///< all the same when it passes through the point
  double turn_rad = 0;       ///< of the fillet, right positive
};

/// A circle to stay on.
struct RouteOrbit {
  double north_m = 0, east_m = 0, height_m = 0, radius_m = 50;
  Turn turn = Turn::right;
};

/// The direction of a circle that needs the least turning from a pose: of two tangents when outside, of two headings when inside.
inline Turn least_turning(const Pose& from, double north_m, double east_m, double radius_m) {
  const double n = north_m - from.north_m, e = east_m - from.east_m, d = std::hypot(n, e);
  const double bearing = d > 1e-9 ? std::atan2(e, n) : from.course_rad;
  // outside, a right turn around the centre passes to the left of it; inside, it goes square to the bearing
  const double offset = d > radius_m ? std::asin(radius_m / d) : std::numbers::pi / 2;
  const double right = std::abs(wrap_pi(bearing - offset - from.course_rad)), left = std::abs(wrap_pi(bearing + offset - from.course_rad));
  return right <= left + 1e-9 ? Turn::right : Turn::left;
}

/// A plan, seen as a route. Nothing is stored: every question is answered from the waypoints nearby.
/// Rules: a corner is rounded by a fillet of the plan's radius if both its tangents fit on their legs beside those of the neighbouring
/// corners. A waypoint with a course is passed through in that course. A corner that is too tight is passed through too, in the direction
/// of its longer leg. Poses are joined by Dubins paths, so that every piece can be flown. Points less than a metre apart are one.
class Route {
 public:
  explicit Route(const Plan& plan) : plan_(plan), n_(plan.waypoints.count) {}

  std::uint32_t size() const { return n_; }
  bool closed() const { return plan_.end == PlanEnd::circuit; }
  double radius_m() const { return std::max(plan_.turn_radius_m, 1.0); }
  double height_m(std::uint32_t i) const { return -plan_.waypoints[i].position_m.down; }
  double airspeed_mps(std::uint32_t i) const {
    const double Va = plan_.waypoints[i].airspeed_mps;
    return Va > 0 ? Va : plan_.airspeed_mps;
  }

  /// All waypoints are in one place: there is nothing to fly along, only an orbit.
  bool is_point() const {
    for (std::uint32_t i = 1; i < n_; ++i) {
      if (!same_place(i - 1, i)) return false;
    }
    return true;
  }

  /// The circle around the last waypoint, for a plan that ends in one. The turn is the lesser one, coming from the waypoint before.
  RouteOrbit final_orbit() const;
  Passage passage(std::uint32_t i) const;
  /// From the waypoint before (of a circuit: cyclically) to waypoint `i`. Not for waypoint 0 of a plan that ends in an orbit.
  RouteLeg leg(std::uint32_t i) const;
  /// From anywhere to waypoint `i`, arriving as the route passes it. Climbs at once, descends evenly.
  RouteLeg join(const Pose& from, double height_m, std::uint32_t i) const;

  /// The waypoint before and after; the same one at the ends of an open plan.
  std::uint32_t before(std::uint32_t i) const { return i > 0 ? i - 1 : (closed() ? n_ - 1 : 0); }
  std::uint32_t after(std::uint32_t i) const { return i + 1 < n_ ? i + 1 : (closed() ? 0 : i); }

 private:
  static constexpr double same_place_m = 1;
  static constexpr double fillet_max_rad = 2.62;  // 150 deg: beyond, a fillet stays three radii away from its waypoint
  struct Corner {
    double in_rad = 0, out_rad = 0;  // courses of the legs
    double in_m = 0, out_m = 0;      // their lengths
    double tangent_m = 0;            // from the waypoint to where its fillet would begin
    bool wanted = false;             // a fillet, which fits on both legs if the neighbours need nothing
  };

  const Vec3<Ned>& point(std::uint32_t i) const { return plan_.waypoints[i].position_m; }
  bool same_place(std::uint32_t i, std::uint32_t j) const {
    return std::hypot(point(i).north - point(j).north, point(i).east - point(j).east) < same_place_m;
  }
  bool is_orbit_entry(std::uint32_t i) const { return !closed() && i + 1 == n_; }
  std::uint32_t first_of_place(std::uint32_t i) const;
  std::uint32_t last_of_place(std::uint32_t i) const;
  Pose orbit_entry() const;
  Pose place(std::uint32_t i) const;  // where the route passes, course not set but for the entry of the final orbit
  Corner corner(std::uint32_t i) const;
  bool has_fillet(std::uint32_t i, const Corner& c) const;

  const Plan& plan_;
  std::uint32_t n_;
};

inline std::uint32_t Route::first_of_place(std::uint32_t i) const {
  for (std::uint32_t k = 0; k < n_; ++k) {
    const std::uint32_t j = before(i);
    if (j == i || !same_place(i, j)) break;
    i = j;
  }
  return i;
}

inline std::uint32_t Route::last_of_place(std::uint32_t i) const {
  for (std::uint32_t k = 0; k < n_; ++k) {
    const std::uint32_t j = after(i);
    if (j == i || is_orbit_entry(j) || !same_place(i, j)) break;
    i = j;
  }
  return i;
}

inline RouteOrbit Route::final_orbit() const {
  const std::uint32_t last = n_ - 1;
  RouteOrbit orbit{point(last).north, point(last).east, height_m(last), radius_m(), Turn::right};
  if (last == 0) return orbit;
  const std::uint32_t q = first_of_place(last - 1);
  const std::uint32_t p = before(q);
  Pose from{point(q).north, point(q).east, std::atan2(orbit.east_m - point(q).east, orbit.north_m - point(q).north)};
  if (p != q) from.course_rad = std::atan2(point(q).east - point(p).east, point(q).north - point(p).north);
  orbit.turn = least_turning(from, orbit.north_m, orbit.east_m, orbit.radius_m);
  return orbit;
}

/// Where the last leg touches the final orbit. From within the circle: where it is reached square to the way to the centre.
inline Pose Route::orbit_entry() const {
  const RouteOrbit orbit = final_orbit();
  const std::uint32_t q = n_ > 1 ? first_of_place(n_ - 2) : 0;
  const double n = orbit.north_m - point(q).north, e = orbit.east_m - point(q).east, d = std::hypot(n, e);
  const double ratio = d > orbit.radius_m ? orbit.radius_m / d : 0;
  const double side = sign_of(orbit.turn);
  const double course = std::atan2(e, n) - side * std::asin(ratio);
  const double azimuth = course - side * std::numbers::pi / 2;
  return {orbit.north_m + orbit.radius_m * std::cos(azimuth), orbit.east_m + orbit.radius_m * std::sin(azimuth), course};
}

inline Pose Route::place(std::uint32_t i) const {
  if (is_orbit_entry(i)) return orbit_entry();
  const Vec3<Ned>& p = point(first_of_place(i));
  return {p.north, p.east, 0};
}

inline Route::Corner Route::corner(std::uint32_t i) const {
  const std::uint32_t first = first_of_place(i), last = last_of_place(i);
  const Pose here = place(i), from = place(before(first)), to = place(after(last));
  Corner c;
  c.in_m = std::hypot(here.north_m - from.north_m, here.east_m - from.east_m);
  c.out_m = std::hypot(to.north_m - here.north_m, to.east_m - here.east_m);
  c.in_rad = std::atan2(here.east_m - from.east_m, here.north_m - from.north_m);
  c.out_rad = std::atan2(to.east_m - here.east_m, to.north_m - here.north_m);
  if (before(first) == first) c.in_rad = c.out_rad;
  if (after(last) == last) c.out_rad = c.in_rad;
  const double turn = std::abs(wrap_pi(c.out_rad - c.in_rad));
  c.wanted = first == last && before(i) != i && after(i) != i && !plan_.waypoints[i].has_course && turn <= fillet_max_rad;
  if (c.wanted) {
    c.tangent_m = radius_m() * std::tan(turn / 2);
    c.wanted = c.tangent_m <= std::min(c.in_m, c.out_m);
  }
  return c;
}

inline bool Route::has_fillet(std::uint32_t i, const Corner& c) const {
  if (!c.wanted) return false;
  const auto fits = [&](std::uint32_t j, double leg_m) {
    if (is_orbit_entry(j)) return true;
    const Corner other = corner(j);
    return !other.wanted || c.tangent_m + other.tangent_m <= leg_m + 1e-9;
  };
  return fits(before(i), c.in_m) && fits(after(i), c.out_m);
}

inline Passage Route::passage(std::uint32_t i) const {
  Passage result;
  result.middle = place(i);
  if (!is_orbit_entry(i)) {
    const Corner c = corner(i);
    if (has_fillet(i, c)) {
      result.turn_rad = wrap_pi(c.out_rad - c.in_rad);
      result.middle.course_rad = c.in_rad;
      result.entry = advance(result.middle, 0, -c.tangent_m);
      result.middle.course_rad = c.out_rad;
      result.exit = advance(result.middle, 0, c.tangent_m);
      const double curvature = (result.turn_rad > 0 ? 1 : -1) / radius_m();
      result.middle = advance(result.entry, curvature, radius_m() * std::abs(result.turn_rad) / 2);
      return result;
    }
    const Waypoint& w = plan_.waypoints[i];
    const bool alone = first_of_place(i) == last_of_place(i);
    result.middle.course_rad = w.has_course ? w.course_rad : (alone && c.out_m > c.in_m ? c.out_rad : c.in_rad);
  }
  result.entry = result.exit = result.middle;
  return result;
}

inline RouteLeg Route::leg(std::uint32_t i) const {
  const Passage from = passage(before(i)), to = passage(i);
  const auto half_fillet = [&](detail::LegBuilder& b, double turn_rad) {
    b.add((turn_rad > 0 ? 1 : -1) / radius_m(), radius_m() * std::abs(turn_rad) / 2);
  };
  detail::LegBuilder builder{{}, from.middle};
  half_fillet(builder, from.turn_rad);
  builder.at = from.exit;
  if (from.turn_rad != 0 && to.turn_rad != 0) {  // two fillets on one straight leg
    builder.add(0, std::hypot(to.entry.north_m - from.exit.north_m, to.entry.east_m - from.exit.east_m));
    builder.at = to.entry;
  } else {
    builder.add_dubins(to.entry, radius_m());
  }
  half_fillet(builder, to.turn_rad);
  builder.at = to.middle;
  builder.leg.airspeed_mps = airspeed_mps(i);
  builder.finish(height_m(before(i)), height_m(i));
  return builder.leg;
}

inline RouteLeg Route::join(const Pose& from, double from_height_m, std::uint32_t i) const {
  const Passage to = passage(i);
  detail::LegBuilder builder{{}, from};
  builder.add_dubins(to.entry, radius_m());
  builder.add((to.turn_rad > 0 ? 1 : -1) / radius_m(), radius_m() * std::abs(to.turn_rad) / 2);
  builder.at = to.middle;
  builder.leg.airspeed_mps = airspeed_mps(i);
  builder.finish(std::max(from_height_m, height_m(i)), height_m(i));
  return builder.leg;
}

/// Closest point of a leg: exact, ends included.
inline RoutePoint nearest(const RouteLeg& leg, double north_m, double east_m) {
  RoutePoint best;
  const RoutePiece* of = nullptr;
  double best_square = unknown_std * unknown_std;
  for (std::size_t i = 0; i < leg.count; ++i) {
    const RoutePiece& piece = leg.pieces[i];
    const double n = north_m - piece.north_m, e = east_m - piece.east_m;
    double point_n = 0, point_e = 0;
    const double dot = n * piece.unit_north_ratio + e * piece.unit_east_ratio;
    if (piece.kind == PathKind::line) {
      const double s = std::clamp(dot, 0.0, piece.length_m);
      point_n = s * piece.unit_north_ratio;
      point_e = s * piece.unit_east_ratio;
    } else {
      const double d = std::sqrt(n * n + e * e);
      double unit_n = d > 0 ? n / d : piece.unit_north_ratio, unit_e = d > 0 ? e / d : piece.unit_east_ratio;
      if (dot < piece.half_cos_ratio * d) {  // beyond an end: turn the middle's direction by half the arc, to the point's side
        const double side = n * piece.unit_east_ratio - e * piece.unit_north_ratio > 0 ? -1 : 1;
        const double c = piece.half_cos_ratio, s = side * std::sqrt(std::max(0.0, 1 - c * c));
        unit_n = c * piece.unit_north_ratio - s * piece.unit_east_ratio;
        unit_e = c * piece.unit_east_ratio + s * piece.unit_north_ratio;
      }
      point_n = piece.radius_m * unit_n;
      point_e = piece.radius_m * unit_e;
    }
    const double square = (n - point_n) * (n - point_n) + (e - point_e) * (e - point_e);
    if (square < best_square) {
      best_square = square;
      best.north_m = piece.north_m + point_n;
      best.east_m = piece.east_m + point_e;
      of = &piece;
    }
  }
  if (of) {
    best.distance_m = std::sqrt(best_square);
    double s = of->along(best.north_m, best.east_m);
    // an arc of more than half a turn: its far end is measured backwards from its beginning
    if (s < -1e-6 * of->radius_m && of->kind == PathKind::orbit) s += 2 * std::numbers::pi * of->radius_m;
    best.height_m = of->height_at(std::clamp(s, 0.0, of->length_m));
  }
  return best;
}

}  // namespace fulmar
