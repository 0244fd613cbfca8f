// SPDX-License-Identifier: BSD-3-Clause
// Upright cylinders as no-fly zones, and the clearance of a path from them.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/path/route.hpp"
#include "fulmar/message.hpp"

namespace fulmar::slow_planner {

struct Zone {
  double north_m = 0, east_m = 0;  ///< centre of the zone, from the origin
  double radius_m = 0;             ///< radius of the zone
};

/// A file of zones. A zone has no height limit.
struct Zones {
  List<Zone, 16> zones;
};

struct Point {
  double north_m = 0, east_m = 0;
};

inline double distance(const Point& a, const Point& b) {
  return std::hypot(b.north_m - a.north_m, b.east_m - a.east_m);
}

/// Distance from a straight line to a point.
inline double line_distance(const Point& a, const Point& b, const Point& p) {
  const double n = b.north_m - a.north_m, e = b.east_m - a.east_m, square = n * n + e * e;
  const double dot = (p.north_m - a.north_m) * n + (p.east_m - a.east_m) * e;
  const double t = square > 0 ? std::clamp(dot / square, 0.0, 1.0) : 0;
  return std::hypot(a.north_m + t * n - p.north_m, a.east_m + t * e - p.east_m);
}

/// Distance to the rim of the nearest zone; negative inside. `unknown_std` without zones.
inline double clearance(const Zones& zones, const Point& a, const Point& b) {
  double least = unknown_std;
  for (const Zone& z : zones.zones)
    least = std::min(least, line_distance(a, b, {z.north_m, z.east_m}) - z.radius_m);
  return least;
}

/// The same along a leg of a route, with its fillets and turns.
inline double clearance(const Zones& zones, const RouteLeg& leg) {
  double least = unknown_std;
  for (const Zone& z : zones.zones)
    least = std::min(least, nearest(leg, z.north_m, z.east_m).distance_m - z.radius_m);
  return least;
}

}  // namespace fulmar::slow_planner
