// SPDX-License-Identifier: BSD-3-Clause
// The route of a plan: legs of straight lines and arcs, joined without a kink. Each leg is computed from the
// waypoints near it alone. Sources: Beard & McLain, Small Unmanned Aircraft (2012), sections 11.1 (fillets)
// and 11.2 (Dubins paths).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "fulmar/flight/path/route_leg.hpp"
#include "fulmar/msg/plan.hpp"

namespace fulmar {

/// Passage of the route at one waypoint: along a fillet, or through the point itself.
struct Passage {
  Pose entry, middle, exit;  ///< all equal for a passage through the point
  double turn_rad = 0;       ///< turn of the fillet, right positive
  double radius_m = 0;       ///< radius of the fillet
};

/// A corner with a wider fillet than the plan has, by the id of its waypoint; 0: none.
struct WideCorner {
  std::uint32_t id = 0;
  double radius_m = 0;
};

/// A circle at the end of a route.
struct RouteOrbit {
  double north_m = 0, east_m = 0, height_m = 0, radius_m = 50;
  Turn turn = Turn::right;
};

/// Direction of the circle with the least turn from a pose: outside, of two tangents; inside, of two
/// headings.
inline Turn min_turning(const Pose& from, double north_m, double east_m, double radius_m) {
  const double n = north_m - from.north_m, e = east_m - from.east_m, d = std::hypot(n, e);
  const double bearing = d > 1e-9 ? std::atan2(e, n) : from.course_rad;
  // outside, a right turn passes to the left of the centre; inside, it goes normal to the bearing
  const double offset = d > radius_m ? std::asin(radius_m / d) : std::numbers::pi / 2;
  const double right = std::abs(wrap_pi(bearing - offset - from.course_rad)),
               left = std::abs(wrap_pi(bearing + offset - from.course_rad));
  return right <= left + 1e-9 ? Turn::right : Turn::left;
}

/// A plan as a route. The class stores no geometry, and computes each answer from the waypoints near it.
/// Rules:
/// - A fillet of the plan's radius rounds a corner if its tangents fit on the legs, next to those of the
/// adjacent corners.
/// - The route passes a waypoint with a course in that course.
/// - A corner too tight for a fillet is passed too, in the direction of its longer leg.
/// - Dubins paths join the poses, so that every piece can be flown.
/// - Points less than a metre apart are one.
class Route {
 public:
  explicit Route(const Plan& plan, std::span<const WideCorner> wide = {})
      : plan_(plan), n_(plan.waypoints.count), wide_(wide) {}

  std::uint32_t size() const { return n_; }
  bool closed() const { return plan_.end == PlanEnd::circuit; }
  double radius_m() const { return std::max(plan_.turn_radius_m, 1.0); }
  /// Radius of the fillet at waypoint `i`.
  double fillet_radius_m(std::uint32_t i) const {
    for (const WideCorner& corner : wide_)
      if (corner.id != 0 && corner.id == id(i)) return corner.radius_m;
    return radius_m();
  }
  std::uint32_t id(std::uint32_t i) const { return plan_.waypoints[i].id; }
  double height_m(std::uint32_t i) const { return -plan_.waypoints[i].position_m.down; }
  double airspeed_mps(std::uint32_t i) const {
    const double Va = plan_.waypoints[i].airspeed_mps;
    return Va > 0 ? Va : plan_.airspeed_mps;
  }

  /// True if all waypoints are at one place: the route is an orbit alone.
  bool is_point() const {
    for (std::uint32_t i = 1; i < n_; ++i) {
      if (!same_place(i - 1, i)) return false;
    }
    return true;
  }

  /// The circle around the last waypoint, for a plan that ends in an orbit. Its direction needs the smaller
  /// turn from the waypoint before.
  RouteOrbit final_orbit() const;
  Passage passage(std::uint32_t i) const;
  /// Largest radius of a fillet at waypoint `i` that fits on its legs, next to the fillets of its neighbours;
  /// 0 without a fillet.
  double widest_fillet_m(std::uint32_t i) const;
  /// Leg to waypoint `i` from the one before it (in a circuit: cyclically). Not for waypoint 0 of a plan that
  /// ends in an orbit.
  RouteLeg leg(std::uint32_t i) const;
  /// Leg from any pose to waypoint `i`, in the course of the route there. Climbs at once, descends evenly.
  RouteLeg join(const Pose& from, double height_m, std::uint32_t i) const;

  /// Index of the waypoint before and after; at the ends of an open plan the same one.
  std::uint32_t before(std::uint32_t i) const { return i > 0 ? i - 1 : (closed() ? n_ - 1 : 0); }
  std::uint32_t after(std::uint32_t i) const { return i + 1 < n_ ? i + 1 : (closed() ? 0 : i); }

 private:
  static constexpr double same_place_m = 1;
  static constexpr double fillet_max_rad =
      2.62;  // 150 deg: beyond it a fillet is more than three radii away from its waypoint
  struct Corner {
    double in_rad = 0, out_rad = 0;  // courses of the legs
    double in_m = 0, out_m = 0;      // lengths of the legs
    double tangent_m = 0;            // from the waypoint to the start of its fillet
    bool wanted = false;             // a fillet that fits on both legs if the neighbours have none
  };

  const Vec3<Ned>& point(std::uint32_t i) const { return plan_.waypoints[i].position_m; }
  bool same_place(std::uint32_t i, std::uint32_t j) const {
    const double n = point(i).north - point(j).north, e = point(i).east - point(j).east;
    return n * n + e * e < same_place_m * same_place_m;
  }
  bool is_orbit_entry(std::uint32_t i) const { return !closed() && i + 1 == n_; }
  std::uint32_t first_of_place(std::uint32_t i) const;
  std::uint32_t last_of_place(std::uint32_t i) const;
  Pose orbit_entry() const;
  Pose place(std::uint32_t i)
      const;  // pose of the route at a waypoint; course set only for the entry of the final orbit
  Corner corner(std::uint32_t i) const;
  bool has_fillet(std::uint32_t i, const Corner& c) const;
  /// Adds half of a fillet, up to or from its middle; nothing without a fillet.
  static void add_half(detail::LegBuilder& leg, const Passage& passage) {
    if (passage.turn_rad != 0)
      leg.add((passage.turn_rad > 0 ? 1 : -1) / passage.radius_m,
              passage.radius_m * std::abs(passage.turn_rad) / 2);
  }

  const Plan& plan_;
  std::uint32_t n_;
  std::span<const WideCorner> wide_;
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
  Pose from{point(q).north, point(q).east,
            std::atan2(orbit.east_m - point(q).east, orbit.north_m - point(q).north)};
  if (p != q) from.course_rad = std::atan2(point(q).east - point(p).east, point(q).north - point(p).north);
  orbit.turn = min_turning(from, orbit.north_m, orbit.east_m, orbit.radius_m);
  return orbit;
}

/// Tangent point of the last leg on the final orbit. From inside the circle: the point normal to the
/// direction of the centre.
inline Pose Route::orbit_entry() const {
  const RouteOrbit orbit = final_orbit();
  const std::uint32_t q = n_ > 1 ? first_of_place(n_ - 2) : 0;
  const double n = orbit.north_m - point(q).north, e = orbit.east_m - point(q).east, d = std::hypot(n, e);
  const double ratio = d > orbit.radius_m ? orbit.radius_m / d : 0;
  const double side = sign_of(orbit.turn);
  const double course = std::atan2(e, n) - side * std::asin(ratio);
  const double azimuth = course - side * std::numbers::pi / 2;
  return {orbit.north_m + orbit.radius_m * std::cos(azimuth),
          orbit.east_m + orbit.radius_m * std::sin(azimuth), course};
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
  c.wanted = first == last && before(i) != i && after(i) != i && !plan_.waypoints[i].has_course &&
             turn <= fillet_max_rad;
  if (c.wanted) {
    c.tangent_m = fillet_radius_m(i) * std::tan(turn / 2);
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

inline double Route::widest_fillet_m(std::uint32_t i) const {
  const Corner c = corner(i);
  if (!has_fillet(i, c)) return 0;
  const auto beside = [&](std::uint32_t j, double leg_m) {
    const Corner other = is_orbit_entry(j) ? Corner{} : corner(j);
    return leg_m - (other.wanted ? other.tangent_m : 0);
  };
  const double room_m = std::min(beside(before(i), c.in_m), beside(after(i), c.out_m));
  return room_m / std::max(std::tan(std::abs(wrap_pi(c.out_rad - c.in_rad)) / 2), 1e-9);
}

inline Passage Route::passage(std::uint32_t i) const {
  Passage result;
  result.middle = place(i);
  if (!is_orbit_entry(i)) {
    const Corner c = corner(i);
    if (has_fillet(i, c)) {
      result.turn_rad = wrap_pi(c.out_rad - c.in_rad);
      result.radius_m = fillet_radius_m(i);
      result.middle.course_rad = c.in_rad;
      result.entry = advance(result.middle, 0, -c.tangent_m);
      result.middle.course_rad = c.out_rad;
      result.exit = advance(result.middle, 0, c.tangent_m);
      const double curvature = (result.turn_rad > 0 ? 1 : -1) / result.radius_m;
      result.middle = advance(result.entry, curvature, result.radius_m * std::abs(result.turn_rad) / 2);
      return result;
    }
    const Waypoint& w = plan_.waypoints[i];
    const bool alone = first_of_place(i) == last_of_place(i);
    result.middle.course_rad =
        w.has_course ? w.course_rad : (alone && c.out_m > c.in_m ? c.out_rad : c.in_rad);
  }
  result.entry = result.exit = result.middle;
  return result;
}

inline RouteLeg Route::leg(std::uint32_t i) const {
  const Passage from = passage(before(i)), to = passage(i);
  detail::LegBuilder builder{{}, from.middle};
  add_half(builder, from);
  builder.at = from.exit;
  if (from.turn_rad != 0 && to.turn_rad != 0) {  // two fillets on one straight leg
    builder.add(0, std::hypot(to.entry.north_m - from.exit.north_m, to.entry.east_m - from.exit.east_m));
    builder.at = to.entry;
  } else {
    builder.add_dubins(to.entry, radius_m());
  }
  add_half(builder, to);
  builder.at = to.middle;
  builder.leg.airspeed_mps = airspeed_mps(i);
  builder.finish(height_m(before(i)), height_m(i));
  return builder.leg;
}

inline RouteLeg Route::join(const Pose& from, double from_height_m, std::uint32_t i) const {
  const Passage to = passage(i);
  detail::LegBuilder builder{{}, from};
  builder.add_dubins(to.entry, radius_m());
  add_half(builder, to);
  builder.at = to.middle;
  builder.leg.airspeed_mps = airspeed_mps(i);
  builder.finish(std::max(from_height_m, height_m(i)), height_m(i));
  return builder.leg;
}

}  // namespace fulmar
