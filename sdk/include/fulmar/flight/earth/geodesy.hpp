// SPDX-License-Identifier: BSD-3-Clause
// Geodetic coordinates to the local north-east-down frame and back. Needs GeographicLib:
// fulmar_add_plugin(... GEODESY), or without CMake -lGeographicLib (older: -lGeographic). Source: C. F. F.
// Karney, GeographicLib, LocalCartesian (exact: geodetic -> geocentric -> rotated and shifted Cartesian).
#pragma once
#include <Eigen/Core>
#include <GeographicLib/LocalCartesian.hpp>

namespace fulmar {

/// A plane touching the WGS-84 ellipsoid at the origin. The frame does not follow the Earth's curvature: a
/// point at the origin's altitude, 5 km away, lies 2 m below the plane (`down` = +2 m). Altitudes above mean
/// sea level are used as if they were heights above the ellipsoid: the geoid's separation is nearly constant
/// over a flight and cancels in the difference; what remains is the scale error separation / Earth radius
/// (100 m of separation: 16 mm per kilometre).
class LocalFrame {
 public:
  struct Geodetic {
    double lat_deg = 0, lon_deg = 0, alt_m = 0;
  };

  LocalFrame() = default;
  LocalFrame(double lat_deg, double lon_deg, double alt_m) : enu_(lat_deg, lon_deg, alt_m) {}

  /// Degrees, degrees, metres -> metres north, east, down of the origin.
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
