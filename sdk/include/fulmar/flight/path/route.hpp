// SPDX-License-Identifier: BSD-3-Clause
// The route that a plan describes: legs of straight lines and arcs, joined without a kink, each leg computed
// on its own from its neighbourhood. Sources: Beard & McLain, Small Unmanned Aircraft (2012), sections 11.1
// (fillets) and 11.2 (Dubins paths).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "fulmar/flight/path/route_leg.hpp"
#include "fulmar/msg/plan.hpp"

namespace fulmar {

/// How the route passes one waypoint: along a fillet, or through the point itself.
struct Passage {
  Pose entry, middle, exit;  ///< all the same when it passes through the point
  double turn_rad = 0;       ///< of the fillet, right positive
  double radius_m = 0;       ///< of the fillet
};

/// A corner whose fillet is flown wider than the plan asks for. By the id of its waypoint; 0: none.
struct WideCorner {
  std::uint32_t id = 0;
  double radius_m = 0;
};

/// A circle to stay on.
struct RouteOrbit {
  double north_m = 0, east_m = 0, height_m = 0, radius_m = 50;
  Turn turn = Turn::right;
};

/// The direction of a circle that needs the least turning from a pose: of two tangents when outside, of two
/// headings when inside.
inline Turn min_turning(const Pose& from, double north_m, double east_m, double radius_m) {
  const double n = north_m - from.north_m, e = east_m - from.east_m, d = std::hypot(n, e);
  const double bearing = d > 1e-9 ? std::atan2(e, n) : from.course_rad;
  // outside, a right turn around the centre passes to the left of it; inside, it goes square to the bearing
  const double offset = d > radius_m ? std::asin(radius_m / d) : std::numbers::pi / 2;
  const double right = std::abs(wrap_pi(bearing - offset - from.course_rad)),
               left = std::abs(wrap_pi(bearing + offset - from.course_rad));
  return right <= left + 1e-9 ? Turn::right : Turn::left;
}

/// A plan, seen as a route. Nothing is stored: every question is answered from the waypoints nearby.
/// Rules: a corner is rounded by a fillet of the plan's radius if both its tangents fit on their legs beside
/// those of the neighbouring corners. A waypoint with a course is passed through in that course. A corner
/// that is too tight is passed through too, in the direction of its longer leg. Poses are joined by Dubins
/// paths, so that every piece can be flown. Points less than a metre apart are one.
class Route {
 public:
  explicit Route(const Plan& plan, std::span<const WideCorner> wide = {})
      : plan_(plan), n_(plan.waypoints.count), wide_(wide) {}

  std::uint32_t size() const { return n_; }
  bool closed() const { return plan_.end == PlanEnd::circuit; }
  double radius_m() const { return std::max(plan_.turn_radius_m, 1.0); }
  /// Of the fillet at waypoint `i`, if there is one.
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

  /// All waypoints are in one place: there is nothing to fly along, only an orbit.
  bool is_point() const {
    for (std::uint32_t i = 1; i < n_; ++i) {
      if (!same_place(i - 1, i)) return false;
    }
    return true;
  }

  /// The circle around the last waypoint, for a plan that ends in one. The turn is the lesser one, coming
  /// from the waypoint before.
  RouteOrbit final_orbit() const;
  Passage passage(std::uint32_t i) const;
  /// Largest radius of a fillet at waypoint `i` that fits on its legs beside those of the neighbours; 0 where
  /// the route has no fillet.
  double widest_fillet_m(std::uint32_t i) const;
  /// From the waypoint before (of a circuit: cyclically) to waypoint `i`. Not for waypoint 0 of a plan that
  /// ends in an orbit.
  RouteLeg leg(std::uint32_t i) const;
  /// From anywhere to waypoint `i`, arriving as the route passes it. Climbs at once, descends evenly.
  RouteLeg join(const Pose& from, double height_m, std::uint32_t i) const;

  /// The waypoint before and after; the same one at the ends of an open plan.
  std::uint32_t before(std::uint32_t i) const { return i > 0 ? i - 1 : (closed() ? n_ - 1 : 0); }
  std::uint32_t after(std::uint32_t i) const { return i + 1 < n_ ? i + 1 : (closed() ? 0 : i); }

 private:
  static constexpr double same_place_m = 1;
  static constexpr double fillet_max_rad =
      2.62;  // 150 deg: beyond, a fillet stays three radii away from its waypoint
  struct Corner {
    double in_rad = 0, out_rad = 0;  // courses of the legs
    double in_m = 0, out_m = 0;      // their lengths
    double tangent_m = 0;            // from the waypoint to where its fillet would begin
    bool wanted = false;             // a fillet, which fits on both legs if the neighbours need nothing
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
  Pose place(
      std::uint32_t i) const;  // where the route passes, course not set but for the entry of the final orbit
  Corner corner(std::uint32_t i) const;
  bool has_fillet(std::uint32_t i, const Corner& c) const;
  /// Half a fillet, to its middle or from there; nothing where there is none.
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

/// Where the last leg touches the final orbit. From within the circle: where it is reached square to the way
/// to the centre.
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
