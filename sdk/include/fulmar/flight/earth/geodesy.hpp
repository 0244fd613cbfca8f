// SPDX-License-Identifier: BSD-3-Clause
// Geodetic coordinates to the local north-east-down frame and back. Needs GeographicLib:
// fulmar_add_plugin(... GEODESY), or without CMake -lGeographicLib (older: -lGeographic). Source: C. F. F.
// Karney, GeographicLib, LocalCartesian (exact: geodetic -> geocentric -> rotated and shifted Cartesian).
#pragma once
#include <Eigen/Core>
#include <GeographicLib/LocalCartesian.hpp>

namespace fulmar {

/// A plane that touches the WGS-84 ellipsoid at the origin. It does not follow the curvature of the Earth: a
/// point at the altitude of the origin, 5 km away, lies 2 m below the plane (`down` = +2 m). Altitudes above
/// mean sea level are used as heights above the ellipsoid. The separation of the geoid is nearly constant
/// over a flight, and cancels in the difference. A scale error of separation / Earth radius remains (100 m of
/// separation: 16 mm per kilometre).
class LocalFrame {
 public:
  struct Geodetic {
    double lat_deg = 0, lon_deg = 0, alt_m = 0;
  };

  LocalFrame() = default;
  LocalFrame(double lat_deg, double lon_deg, double alt_m) : enu_(lat_deg, lon_deg, alt_m) {}

  /// Degrees, degrees, metres -> metres north, east, down from the origin.
  Eigen::Vector3d to_ned(double lat_deg, double lon_deg, double alt_m) const {
    double e = 0, n = 0, u = 0;
    enu_.Forward(lat_deg, lon_deg, alt_m, e, n, u);
    return {n, e, -u};
  }

  Geodetic from_ned(const Eigen::Vector3d& p_n) const {
    Geodetic g;
    enu_.Reverse(p_n.y(), p_n.x(), -p_n.z(), g.lat_deg, g.lon_deg, g.alt_m);
    return g;
  }

  Geodetic origin() const { return {enu_.LatitudeOrigin(), enu_.LongitudeOrigin(), enu_.HeightOrigin()}; }

 private:
  GeographicLib::LocalCartesian enu_;
};

}  // namespace fulmar
