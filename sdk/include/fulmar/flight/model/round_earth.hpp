// SPDX-License-Identifier: BSD-3-Clause
// The Earth as a rotating ellipsoid: WGS-84 with gravitation to J2, geodetic coordinates, and the motion of a
// rigid body in the north-east-down frame of an origin. This frame is that of geodesy.hpp: Cartesian, fixed
// to the Earth, not following its curvature. Sources: NIMA TR8350.2, third edition (2000); Montenbruck &
// Gill, Satellite Orbits (2000), 3.2; Stevens, Lewis & Johnson, Aircraft Control and Simulation (2016), 1.7.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "fulmar/flight/model/rigid_body.hpp"

namespace fulmar {

/// TR8350.2, tables 3.1, 3.3 and 3.4.
namespace wgs84 {
inline constexpr double a = 6378137;                                   ///< m, semi-major axis
inline constexpr double f = 1 / 298.257223563;                         ///< flattening
inline constexpr double e2 = f * (2 - f);                              ///< first eccentricity, squared
inline constexpr double GM = 3.986004418e14;                           ///< m3/s2, atmosphere included
inline constexpr double omega = 7.292115e-5;                           ///< rad/s
inline constexpr double J2 = 1.08262982131e-3;                         ///< -sqrt(5) C20 of the ellipsoid
inline constexpr double g_equator = 9.7803253359;                      ///< m/s2, normal gravity
inline constexpr double somigliana = 0.00193185265241;                 ///< k = b g_pole / (a g_equator) - 1
inline constexpr double m = omega * omega * a * a * a * (1 - f) / GM;  ///< centrifugal to gravitational
}  // namespace wgs84

/// Gravity including the centrifugal part, on the ellipsoid (Somigliana) and at a height above it to second
/// order. TR8350.2 (4-1), (4-3).
inline double normal_gravity(double lat_rad, double height_m) {
  const double s2 = std::sin(lat_rad) * std::sin(lat_rad), h = height_m / wgs84::a;
  const double g = wgs84::g_equator * (1 + wgs84::somigliana * s2) / std::sqrt(1 - wgs84::e2 * s2);
  return g * (1 - 2 * (1 + wgs84::f + wgs84::m - 2 * wgs84::f * s2) * h + 3 * h * h);
}

/// Latitude and longitude on the ellipsoid, and height above it.
struct Geodetic {
  double lat_rad = 0, lon_rad = 0, alt_m = 0;
};

/// Earth-centred, Earth-fixed position. TR8350.2 (4-14).
inline Eigen::Vector3d ecef_from(const Geodetic& g) {
  const double s = std::sin(g.lat_rad), c = std::cos(g.lat_rad);
  const double N = wgs84::a / std::sqrt(1 - wgs84::e2 * s * s);
  return {(N + g.alt_m) * c * std::cos(g.lon_rad), (N + g.alt_m) * c * std::sin(g.lon_rad),
          (N * (1 - wgs84::e2) + g.alt_m) * s};
}

/// The inverse in closed form, accurate to rounding more than 43 km from the centre of the Earth. H.
/// Vermeille, Journal of Geodesy 76 (2002) 451-454. The height is not by his formula, but by one in which an
/// error of the latitude has second order only.
inline Geodetic geodetic_from(const Eigen::Vector3d& p_e) {
  constexpr double a = wgs84::a, e2 = wgs84::e2, e4 = e2 * e2;
  const double rho = std::hypot(p_e.x(), p_e.y());
  const double p = rho * rho / (a * a), q = (1 - e2) / (a * a) * p_e.z() * p_e.z();
  const double r = (p + q - e4) / 6, r3 = r * r * r, S = e4 * p * q / 4;
  const double T = std::cbrt(S + r3 + std::sqrt(S * (2 * r3 + S)));
  const double u = r + T + r * r / T, v = std::sqrt(u * u + e4 * q);
  const double w = e2 * (u + v - q) / (2 * v), k = (u + v) / (std::sqrt(u + v + w * w) + w);
  Geodetic g;
  g.lat_rad = std::atan2(p_e.z(), k * rho / (k + e2));
  g.lon_rad = std::atan2(p_e.y(), p_e.x());
  const double s = std::sin(g.lat_rad), c = std::cos(g.lat_rad);
  g.alt_m = rho * c + p_e.z() * s - a * std::sqrt(1 - e2 * s * s);
  return g;
}

/// North, east and down at a place as columns, in Earth-fixed axes.
inline Eigen::Matrix3d ned_in_ecef(double lat_rad, double lon_rad) {
  const double sp = std::sin(lat_rad), cp = std::cos(lat_rad), sl = std::sin(lon_rad), cl = std::cos(lon_rad);
  Eigen::Matrix3d R_en;
  R_en << -sp * cl, -sl, -cp * cl, -sp * sl, cl, -cp * sl, cp, 0, -sp;
  return R_en;
}

/// The rotating ellipsoid in the north-east-down frame of an origin: all vectors are in that frame.
class RotatingEarth {
 public:
  explicit RotatingEarth(const Geodetic& origin)
      : origin_(origin),
        r0_e_(ecef_from(origin)),
        R_en_(ned_in_ecef(origin.lat_rad, origin.lon_rad)),
        r0_n_(R_en_.transpose() * r0_e_),
        axis_n_(R_en_.row(2).transpose()) {}

  const Geodetic& origin() const { return origin_; }
  const Eigen::Matrix3d& R_en() const { return R_en_; }
  Eigen::Vector3d rotation() const { return wgs84::omega * axis_n_; }
  Geodetic geodetic(const Eigen::Vector3d& p_n) const { return geodetic_from(r0_e_ + R_en_ * p_n); }

  /// Gravitation alone, to J2. Montenbruck & Gill 3.2, in vector form.
  Eigen::Vector3d gravitation(const Eigen::Vector3d& p_n) const {
    const Eigen::Vector3d r = r0_n_ + p_n;
    const double d = r.norm(), s = r.dot(axis_n_) / d, j = 1.5 * wgs84::J2 * std::pow(wgs84::a / d, 2);
    return -wgs84::GM / (d * d) * ((1 + j * (1 - 5 * s * s)) / d * r + 2 * j * s * axis_n_);
  }

  /// Gravity: gravitation plus the centrifugal part.
  Eigen::Vector3d gravity(const Eigen::Vector3d& p_n) const {
    const Eigen::Vector3d r = r0_n_ + p_n;
    return gravitation(p_n) + wgs84::omega * wgs84::omega * (r - r.dot(axis_n_) * axis_n_);
  }

  /// Acceleration of a body without forces, relative to the frame, including the Coriolis part.
  Eigen::Vector3d free_acceleration(const Eigen::Vector3d& p_n, const Eigen::Vector3d& v_n) const {
    return gravity(p_n) - 2 * rotation().cross(v_n);
  }

  /// Body rate relative to the Earth, of a body with `omega_b` relative to inertial space.
  Eigen::Vector3d relative_rate(const RigidBody& x) const {
    return x.omega_b - x.q_nb.conjugate() * rotation();
  }

 private:
  Geodetic origin_;
  Eigen::Vector3d r0_e_;  ///< the origin, from the Earth's centre
  Eigen::Matrix3d R_en_;
  Eigen::Vector3d r0_n_, axis_n_;
};

/// Equations of motion on the rotating Earth, for `runge_kutta` in place of constant gravity. Velocity and
/// attitude are relative to the frame; `omega_b` is relative to inertial space, as in Euler's equation and in
/// a gyro.
inline RigidBodyRate rate_of(const RigidBody& x, const Load& load, const MassProperties& body,
                             const RotatingEarth& earth) {
  RigidBodyRate d = rate_of(x, load, body, earth.free_acceleration(x.p_n, x.v_n));
  const Eigen::Vector3d w = earth.relative_rate(x);
  d.q_nb = 0.5 * (x.q_nb * Eigen::Quaterniond(0, w.x(), w.y(), w.z())).coeffs();
  return d;
}

/// North, east and down at the place of the vehicle, for wind, gravity, heading and altitude. Valid for the
/// distance of one step: at 100 m the altitude error is 1 mm.
class LocalLevel {
 public:
  LocalLevel(const RotatingEarth& earth, const Eigen::Vector3d& p_n)
      : place_(earth.geodetic(p_n)),
        origin_alt_m_(earth.origin().alt_m),
        p_n_(p_n),
        rotation_n_(earth.rotation()),
        R_nl_(earth.R_en().transpose() * ned_in_ecef(place_.lat_rad, place_.lon_rad)),
        q_nl_(R_nl_) {}

  const Geodetic& place() const { return place_; }
  double altitude(const Eigen::Vector3d& p_n) const { return place_.alt_m - R_nl_.col(2).dot(p_n - p_n_); }

  /// The state relative to the ground below: velocity and attitude in the axes of this place, body rate
  /// relative to the Earth, `p_n.z()` minus the height above the altitude of the origin.
  RigidBody seen(const RigidBody& x) const {
    RigidBody y;
    y.p_n = {x.p_n.x(), x.p_n.y(), origin_alt_m_ - altitude(x.p_n)};
    y.v_n = R_nl_.transpose() * x.v_n;
    y.q_nb = q_nl_.conjugate() * x.q_nb;
    y.omega_b = x.omega_b - x.q_nb.conjugate() * rotation_n_;
    return y;
  }

  /// The inverse of `seen` for all but the position, which is the point of that height above or below this
  /// place.
  RigidBody in_frame(const RigidBody& seen) const {
    RigidBody x;
    x.p_n = p_n_ + (seen.p_n.z() - (origin_alt_m_ - place_.alt_m)) * R_nl_.col(2);
    x.v_n = R_nl_ * seen.v_n;
    x.q_nb = q_nl_ * seen.q_nb;
    x.omega_b = seen.omega_b + x.q_nb.conjugate() * rotation_n_;
    return x;
  }

 private:
  Geodetic place_;
  double origin_alt_m_;
  Eigen::Vector3d p_n_, rotation_n_;
  Eigen::Matrix3d R_nl_;  ///< axes of this place, in the frame
  Eigen::Quaterniond q_nl_;
};

}  // namespace fulmar
