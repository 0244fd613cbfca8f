// SPDX-License-Identifier: BSD-3-Clause
// A geofence: a horizontal polygon with a floor and a ceiling; places to return to and to land at. Files of
// both, for plugins/safety and path/Landing.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/messages.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

inline constexpr double not_given = 1e9, same_place_m = 1;

/// Corner, in local or geodetic coordinates.
struct FencePoint {
  double north_m = not_given, east_m = not_given;   ///< local position, from the origin
  double lat_deg = not_given, lon_deg = not_given;  ///< geodetic position, WGS-84
};

/// A file. Corners in order, in either direction; the last one is joined to the first.
struct Fence {
  Text<64> name;
  List<FencePoint, 64> corners;
  double floor_m = -not_given, ceiling_m = not_given;  ///< floor and ceiling, above the origin
};

/// A landing place. `up`: height of the ground at it, above the origin.
struct Place {
  double north_m = not_given, east_m = not_given, up_m = 0;  ///< local position, from the origin
  double lat_deg = not_given, lon_deg = not_given;           ///< geodetic position, WGS-84
};

/// A file. The first place is home.
struct Places {
  Text<64> name;
  List<Place, 16> places;
};

/// A place in the local frame, m; `up_m` above the origin.
struct Spot {
  double north_m = 0, east_m = 0, up_m = 0;
};

/// Local position of a point, m. Throws std::runtime_error that names the point by `what`.
template <class P>
Spot spot_of(const P& p, const Origin& origin, const std::string& what) {
  const bool local = p.north_m < not_given && p.east_m < not_given;
  const bool global = p.lat_deg < not_given && p.lon_deg < not_given;
  if (local == global)
    throw std::runtime_error(
        located(what, (local ? flight_messages::place_given_twice : flight_messages::place_missing)())
            .line());
  if (local) return {p.north_m, p.east_m, 0};
  if (!origin.given) throw std::runtime_error(located(what, flight_messages::origin_missing()).line());
  const LocalFrame frame(origin.lat_deg, origin.lon_deg, origin.alt_msl_m);
  const Eigen::Vector3d at = frame.to_ned(p.lat_deg, p.lon_deg, origin.alt_msl_m);
  return {at.x(), at.y(), 0};
}

/// Local positions of all places. Throws std::runtime_error for two places within 1 m.
inline std::vector<Spot> places_of(const Places& file, const Origin& origin) {
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < file.places.size(); ++i) {
    spots.push_back(spot_of(file.places[i], origin, "places.places[" + std::to_string(i) + "]"));
    spots.back().up_m = file.places[i].up_m;
    for (std::size_t k = 0; k < i; ++k)
      if (std::hypot(spots[k].north_m - spots[i].north_m, spots[k].east_m - spots[i].east_m) < same_place_m)
        throw std::runtime_error(
            located("places.places[" + std::to_string(i) + "]", flight_messages::places_equal(k)).line());
  }
  return spots;
}

/// Twice the signed area of a, b, c: positive if c is to the right of a -> b.
inline double side_of(const Spot& a, const Spot& b, const Spot& c) {
  return (b.north_m - a.north_m) * (c.east_m - a.east_m) - (b.east_m - a.east_m) * (c.north_m - a.north_m);
}

/// True if the segments a b and c d have a common point.
inline bool meet(const Spot& a, const Spot& b, const Spot& c, const Spot& d) {
  const auto within = [](const Spot& p, const Spot& q, const Spot& r) {
    return std::min(p.north_m, q.north_m) <= r.north_m && r.north_m <= std::max(p.north_m, q.north_m) &&
           std::min(p.east_m, q.east_m) <= r.east_m && r.east_m <= std::max(p.east_m, q.east_m);
  };
  const double s1 = side_of(a, b, c), s2 = side_of(a, b, d), s3 = side_of(c, d, a), s4 = side_of(c, d, b);
  if (s1 * s2 < 0 && s3 * s4 < 0) return true;
  return (s1 == 0 && within(a, b, c)) || (s2 == 0 && within(a, b, d)) || (s3 == 0 && within(c, d, a)) ||
         (s4 == 0 && within(c, d, b));
}

/// The polygon of the geofence, horizontal.
class Polygon {
 public:
  bool given() const { return !corners_.empty(); }
  const std::vector<Spot>& corners() const { return corners_; }

  /// Throws std::runtime_error for an invalid geofence.
  void set(const Fence& fence, const Origin& origin) {
    corners_.clear();
    for (std::size_t i = 0; i < fence.corners.size(); ++i)
      corners_.push_back(spot_of(fence.corners[i], origin, "fence.corners[" + std::to_string(i) + "]"));
    const std::size_t n = corners_.size();
    if (n < 3)
      throw std::runtime_error(located("fence.corners", flight_messages::fence_corners_few(n)).line());
    if (fence.floor_m >= fence.ceiling_m)
      throw std::runtime_error(
          located("fence.floor_m",
                  flight_messages::fence_floor_high(std::lround(fence.floor_m), std::lround(fence.ceiling_m)))
              .line());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i + 1; k < n; ++k) {
        const bool next = k == i + 1, last = i == 0 && k == n - 1;
        if (next || last) {  // neighbours share one corner alone
          const Spot &before = corner(next ? i : k), &at = corner(next ? k : i),
                     &after = corner(next ? k + 1 : i + 1);
          const double back = (before.north_m - at.north_m) * (after.north_m - at.north_m) +
                              (before.east_m - at.east_m) * (after.east_m - at.east_m);
          if (side_of(before, at, after) != 0 || back < 0) continue;
        } else if (!meet(corner(i), corner(i + 1), corner(k), corner(k + 1))) {
          continue;
        }
        throw std::runtime_error(located("fence.corners", flight_messages::fence_sides_cross(i, k)).line());
      }
  }

  /// Distance to the nearest side, m; negative outside.
  double room_m(double north_m, double east_m) const {
    double nearest2 = std::numeric_limits<double>::max();
    bool inside = false;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Spot &a = corners_[i], &b = corner(i + 1);
      const double dn = b.north_m - a.north_m, de = b.east_m - a.east_m;
      const double pn = north_m - a.north_m, pe = east_m - a.east_m;
      const double t = std::clamp((pn * dn + pe * de) / (dn * dn + de * de), 0.0, 1.0);
      const double n = pn - t * dn, e = pe - t * de;
      nearest2 = std::min(nearest2, n * n + e * e);
      if ((a.east_m > east_m) != (b.east_m > east_m) &&  // even-odd rule
          north_m < a.north_m + (east_m - a.east_m) / de * dn)
        inside = !inside;
    }
    return inside ? std::sqrt(nearest2) : -std::sqrt(nearest2);
  }

 private:
  const Spot& corner(std::size_t i) const { return corners_[i % corners_.size()]; }
  std::vector<Spot> corners_;
};

}  // namespace fulmar::safety

namespace fulmar {

template <>
inline constexpr std::array<FieldRange, 4> field_ranges<safety::FencePoint>{
    {{"north_m", -1e5, 1e5}, {"east_m", -1e5, 1e5}, {"lat_deg", -90, 90}, {"lon_deg", -180, 180}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<safety::Fence>{
    {{"floor_m", -1e5, 1e5}, {"ceiling_m", -1e5, 1e5}}};
template <>
inline constexpr std::array<FieldRange, 5> field_ranges<safety::Place>{{{"north_m", -1e5, 1e5},
                                                                        {"east_m", -1e5, 1e5},
                                                                        {"up_m", -1e4, 1e4},
                                                                        {"lat_deg", -90, 90},
                                                                        {"lon_deg", -180, 180}}};
template <>
inline constexpr std::array<std::string_view, 1> required_fields<safety::Fence>{"corners"};
template <>
inline constexpr std::array<std::string_view, 1> required_fields<safety::Places>{"places"};

}  // namespace fulmar
