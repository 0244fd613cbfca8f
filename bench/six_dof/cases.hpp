// SPDX-License-Identifier: BSD-3-Clause
// Six of the atmospheric check cases of NASA/TM-2015-218675, appendix B, flown with the equations of motion,
// Earth and atmosphere of the SDK.
#pragma once
#include <numbers>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/flight/model/round_earth.hpp"
#include "recording.hpp"

namespace fulmar::six_dof {

inline constexpr double degree = std::numbers::pi / 180, slug = 14.59390294,
                        slug_foot2 = 1.3558179483314;  // kg, kg m2

struct Case {
  const char *number, *what;
  MassProperties body;
  double drag_area_m2 = 0;              ///< CD S
  Eigen::Vector3d damping_m3{0, 0, 0};  ///< -S b^2 Clp / 4 and the others alike: with rho V, moment per rate
  double wind_mps = 0, wind_slope_per_s = 0;  ///< to the east: at sea level, and per metre of altitude
  int faulty = 0;                             ///< simulator that is left out, 0: none
  int faulty_airspeed = 0;                    ///< simulator whose airspeed is left out, 0: none
};

/// One slug, half a foot across, CD 0.1.
inline MassProperties sphere() { return {slug, 3.6 * slug_foot2 * Eigen::Matrix3d::Identity()}; }
inline constexpr double sphere_drag_area = 0.1 * std::numbers::pi / 4 * 0.25 * foot * foot;

/// models/brick_inertia.dml
inline MassProperties brick() {
  return {0.155404754 * slug,
          slug_foot2 * Eigen::Vector3d(0.00189422, 0.006211019, 0.007194665).asDiagonal()};
}

/// models/brick_aero.dml: Clp = Cmq = Cnr = -1. Its drag is not in the case: all simulators give the fall of
/// case 2.
inline Eigen::Vector3d brick_damping() {
  const double S = 0.22222, b = 0.33333, c = 0.66667;
  return std::pow(foot, 4) * S / 4 * Eigen::Vector3d(b * b, c * c, b * b);
}

/// Simulator 2 has another attitude than the others in case 2; the airspeed of simulator 6 in cases 7 and 8
/// excludes the wind.
inline std::vector<Case> cases() {
  return {{"01", "dropped sphere without drag", sphere()},
          {.number = "02", .what = "tumbling brick without damping", .body = brick(), .faulty = 2},
          {.number = "03", .what = "tumbling brick, damped", .body = brick(), .damping_m3 = brick_damping()},
          {.number = "06",
           .what = "dropped sphere with drag",
           .body = sphere(),
           .drag_area_m2 = sphere_drag_area},
          {.number = "07",
           .what = "sphere in steady wind",
           .body = sphere(),
           .drag_area_m2 = sphere_drag_area,
           .wind_mps = 20 * foot,
           .faulty_airspeed = 6},
          {.number = "08",
           .what = "sphere in wind shear",
           .body = sphere(),
           .drag_area_m2 = sphere_drag_area,
           .wind_mps = -20 * foot,
           .wind_slope_per_s = 0.003,
           .faulty_airspeed = 6}};
}

struct Start {
  Geodetic place;
  Eigen::Vector3d v_l;  ///< north, east, down
  Euler euler;
  Eigen::Vector3d omega_b;  ///< relative to inertial space
};

class Fall {
 public:
  Fall(const Case& c, const Start& start)
      : case_(c),
        earth_({start.place.lat_rad, start.place.lon_rad, 0}),
        level_(earth_, Eigen::Vector3d::Zero()) {
    RigidBody seen;
    seen.p_n.z() = -start.place.alt_m;
    seen.v_n = start.v_l;
    seen.q_nb = quaternion_from(start.euler);
    x_ = level_.in_frame(seen);
    x_.omega_b = start.omega_b;
    level_ = LocalLevel(earth_, x_.p_n);
  }

  void advance(double dt) {
    const auto load_at = [&](const RigidBody& x, double) { return load(x); };
    x_ = runge_kutta(x_, load(x_), dt, case_.body, earth_, load_at);
    level_ = LocalLevel(earth_, x_.p_n);
  }

  /// Appends the compared quantities to a recording.
  void record(Recording& out) const {
    const RigidBody seen = level_.seen(x_);
    const Euler e = euler_from(seen.q_nb);
    const Eigen::Vector3d rate = x_.omega_b / degree;
    const Geodetic g = earth_.geodetic(x_.p_n);
    const std::array<double, columns> values{g.alt_m,
                                             g.lat_rad / degree,
                                             g.lon_rad / degree,
                                             seen.v_n.x(),
                                             seen.v_n.y(),
                                             seen.v_n.z(),
                                             e.roll_rad / degree,
                                             e.pitch_rad / degree,
                                             e.yaw_rad / degree,
                                             rate.x(),
                                             rate.y(),
                                             rate.z(),
                                             air_velocity(seen).norm()};
    for (std::size_t c = 0; c < columns; ++c) out.of[c].push_back(values[c]);
  }

 private:
  /// In local axes, of a state in these axes.
  Eigen::Vector3d air_velocity(const RigidBody& seen) const {
    return seen.v_n - Eigen::Vector3d(0, case_.wind_mps - case_.wind_slope_per_s * seen.p_n.z(), 0);
  }

  Load load(const RigidBody& x) const {
    const RigidBody seen = level_.seen(x);
    const double rho = standard_air(geopotential_altitude(-seen.p_n.z())).density_kgm3;
    const Eigen::Vector3d v_r = air_velocity(seen);
    const double V = v_r.norm();
    Load out;
    out.force_b = seen.q_nb.conjugate() * (-0.5 * rho * V * case_.drag_area_m2 * v_r);
    out.moment_b = -rho * V * case_.damping_m3.cwiseProduct(seen.omega_b);  // the air turns with the Earth
    return out;
  }

  Case case_;
  RotatingEarth earth_;
  LocalLevel level_;
  RigidBody x_;
};

inline Recording flown(const Case& c, const Start& start, double dt = 0.0025) {
  const int steps = static_cast<int>(std::lround(sample_s / dt));
  Fall fall(c, start);
  Recording out;
  for (int i = 0;; ++i) {
    fall.record(out);
    if (i == samples - 1) return out;
    for (int k = 0; k < steps; ++k) fall.advance(dt);
  }
}

}  // namespace fulmar::six_dof
