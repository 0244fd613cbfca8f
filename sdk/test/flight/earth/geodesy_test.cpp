// SPDX-License-Identifier: BSD-3-Clause
// Local frame against the textbook: WGS-84 radii of curvature, and a geocentric rotation by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/earth/geodesy.hpp>
#include <numbers>

namespace geodesy_test {

using namespace fulmar;

namespace {

constexpr double rad = std::numbers::pi / 180;

Eigen::Vector3d geocentric(double lat_deg, double lon_deg, double h) {
  constexpr double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double s = std::sin(lat_deg * rad), c = std::cos(lat_deg * rad), N = a / std::sqrt(1 - e2 * s * s);
  return {(N + h) * c * std::cos(lon_deg * rad), (N + h) * c * std::sin(lon_deg * rad),
          (N * (1 - e2) + h) * s};
}

Eigen::Vector3d ned_by_hand(double lat0, double lon0, double h0, double lat, double lon, double h) {
  const double sp = std::sin(lat0 * rad), cp = std::cos(lat0 * rad), sl = std::sin(lon0 * rad),
               cl = std::cos(lon0 * rad);
  Eigen::Matrix3d R;
  R << -sp * cl, -sp * sl, cp, -sl, cl, 0, -cp * cl, -cp * sl, -sp;
  return R * (geocentric(lat, lon, h) - geocentric(lat0, lon0, h0));
}

}  // namespace

TEST_CASE("positions agree with the geocentric rotation done by hand, in all quadrants of the Earth") {
  for (const double lat0 : {-75.0, -37.9, 0.0, 40.2463724, 80.0})
    for (const double lon0 : {-179.99, -111.6474138, 0.0, 144.76, 179.995}) {
      const LocalFrame frame(lat0, lon0, 1387);
      for (const double d : {-0.03, 0.01, 0.05}) {
        const Eigen::Vector3d p = frame.to_ned(lat0 + d, lon0 - 0.7 * d, 1387 + 1e4 * d);
        const Eigen::Vector3d expected =
            ned_by_hand(lat0, lon0, 1387, lat0 + d, lon0 - 0.7 * d, 1387 + 1e4 * d);
        CHECK((p - expected).norm() < 1e-6);
      }
    }
}

TEST_CASE("near the origin a degree is as long as the radii of curvature say") {
  constexpr double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f), lat = 40.2463724, h = 1387;
  const double w = 1 - e2 * std::pow(std::sin(lat * rad), 2);
  const double M = a * (1 - e2) / std::pow(w, 1.5), N = a / std::sqrt(w);
  const LocalFrame frame(lat, -111.6474138, h);
  CHECK(frame.to_ned(lat + 1e-4, -111.6474138, h).x() == doctest::Approx(1e-4 * rad * (M + h)).epsilon(1e-6));
  CHECK(frame.to_ned(lat, -111.6474138 + 1e-4, h).y() ==
        doctest::Approx(1e-4 * rad * (N + h) * std::cos(lat * rad)).epsilon(1e-6));
}

TEST_CASE(
    "the plane does not follow the curvature: five kilometres away the Earth lies two metres below it") {
  const LocalFrame frame(40, -111, 0);
  const Eigen::Vector3d p = frame.to_ned(40 + 5000 / 111000.0, -111, 0);
  CHECK(p.z() == doctest::Approx(p.head<2>().squaredNorm() / (2 * 6.36e6)).epsilon(0.01).scale(0));
}

TEST_CASE("there and back again is a micrometre") {
  const LocalFrame frame(-37.96, 144.76, 25);
  const Eigen::Vector3d p(1234.5, -6789, -321);
  const LocalFrame::Geodetic g = frame.from_ned(p);
  CHECK((frame.to_ned(g.lat_deg, g.lon_deg, g.alt_m) - p).norm() < 1e-6);
  CHECK(frame.origin().lat_deg == doctest::Approx(-37.96));
}

}  // namespace geodesy_test
