// SPDX-License-Identifier: BSD-3-Clause
// Checks and prediction of the state of another aircraft.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::formation {

/// True if both positions have the same origin: within 0.1 m on the ground and 0.5 m in height. False if an
/// origin is not known.
inline bool same_origin(const VehicleState& a, const VehicleState& b) {
  constexpr double close_deg = 1e-6, close_m = 0.5;
  return a.origin_valid && b.origin_valid &&
         std::abs(a.origin_latitude_deg - b.origin_latitude_deg) < close_deg &&
         std::abs(a.origin_longitude_deg - b.origin_longitude_deg) < close_deg &&
         std::abs(a.origin_altitude_m - b.origin_altitude_m) < close_m;
}

inline bool located(const VehicleState& s) { return s.position_valid && s.height_valid && s.velocity_valid; }

/// Present motion of an aircraft, predicted along its turn from a state some seconds old. A radio gap of a
/// second or two is normal.
struct Motion {
  Eigen::Vector3d p, v;  // NED
  double chi = 0, chi_dot = 0;

  explicit Motion(const VehicleState& s, double age_s = 0)
      : p(eigen(s.position_m)), v(eigen(s.velocity_mps)), chi(s.course_rad) {
    constexpr double g = 9.80665, slow_mps = 3, bank_max = 1.0, crab_min = 0.5, turn_max = 1.0;
    const double Vg = std::hypot(v.x(), v.y());
    if (Vg > slow_mps) {
      chi = std::atan2(v.y(), v.x());
      if (s.attitude_valid)  // B&M (9.14)
        chi_dot = g / Vg * std::tan(std::clamp(s.roll_rad, -bank_max, bank_max)) *
                  std::max(std::cos(chi - s.yaw_rad), crab_min);
    }
    const double turn = std::clamp(chi_dot * age_s, -turn_max, turn_max);
    const double chord = Vg * age_s * (std::abs(turn) > 1e-6 ? std::sin(turn / 2) / (turn / 2) : 1);
    p += Eigen::Vector3d(chord * std::cos(chi + turn / 2), chord * std::sin(chi + turn / 2), age_s * v.z());
    if (Vg > slow_mps) {
      chi += turn;
      v.head<2>() = Vg * Eigen::Vector2d(std::cos(chi), std::sin(chi));
    }
  }
};

/// Position and velocity of `other` relative to `own`, NED.
struct Relative {
  Eigen::Vector3d p, v;

  Relative(const VehicleState& own, const Motion& other)
      : p(other.p - eigen(own.position_m)), v(other.v - eigen(own.velocity_mps)) {}

  double distance() const { return p.norm(); }
  /// Least distance within the next `ahead_s` if both fly straight.
  double nearest(double ahead_s) const {
    const double v2 = v.squaredNorm();
    const double t = v2 > 1e-9 ? std::clamp(-p.dot(v) / v2, 0.0, ahead_s) : 0;
    return (p + t * v).norm();
  }
};

}  // namespace fulmar::formation
