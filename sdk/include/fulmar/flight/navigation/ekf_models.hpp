// SPDX-License-Identifier: BSD-3-Clause
// Measurement models of the error-state filter in ekf.hpp: each gives an innovation and its row of
// derivatives. Notation: u_n = v_n - w_n is the air-relative velocity, r_y the body y axis in NED.
// Derivatives are by the small rotation theta about NED, R' = exp(theta) R.
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/navigation/ekf.hpp"

namespace fulmar::ekf {

/// Air-relative velocity without gusts, NED, m/s; the vertical wind is 0.
inline Eigen::Vector3d air_velocity(const Nominal& x) {
  return {x.v_n.x() - x.wind.x(), x.v_n.y() - x.wind.y(), x.v_n.z()};
}

/// Latency of a fix by the state `delay`: `rate` is the derivative of the expected value by time.
inline Scalar late(Scalar z, double rate) {
  z.H(delay) = -rate;
  return z;
}

/// Velocity, NED axis 0 to 2. A measurement that is `past.age_s` late is compared with the velocity then,
/// whose error is dv - age (-[f]x (theta + age/2 R bg) - R ba): `f_age` = v_n - past.v_n - g age is the
/// specific force integrated over the age.
inline Scalar velocity(const ErrorStateEkf& f, const ErrorStateEkf::Past& past, int axis,
                       double measured_mps) {
  Scalar z;
  z.innovation = measured_mps - past.v_n(axis);
  z.H(vel + axis) = 1;
  if (past.age_s > 0) {
    const Eigen::Vector3d f_age =
        f.state().v_n - past.v_n - Eigen::Vector3d(0, 0, f.gravity_mps2 * past.age_s);
    z.H.segment<3>(theta) = skew(f_age).row(axis);
    z.H.segment<3>(gyro_bias) = 0.5 * past.age_s * skew(f_age).row(axis) * f.R_nb();
    z.H.segment<3>(accel_bias) = past.age_s * f.R_nb().row(axis);
  }
  return z;
}

/// Position, NED axis 0 to 2, late as above: dp - age dv + age^2/2 (-[f]x (theta + age/3 R bg) - R ba). A
/// horizontal one includes the slow GNSS error.
inline Scalar position(const ErrorStateEkf& f, const ErrorStateEkf::Past& past, int axis, double measured_m) {
  Scalar z;
  z.innovation = measured_m - past.p_n(axis);
  z.H(pos + axis) = 1;
  if (axis < 2) z.H(gnss + axis) = 1;
  if (past.age_s > 0) {
    const Eigen::Vector3d f_age =
        f.state().v_n - past.v_n - Eigen::Vector3d(0, 0, f.gravity_mps2 * past.age_s);
    z.H(vel + axis) = -past.age_s;
    z.H.segment<3>(theta) = -0.5 * past.age_s * skew(f_age).row(axis);
    z.H.segment<3>(gyro_bias) = -past.age_s * past.age_s / 6 * skew(f_age).row(axis) * f.R_nb();
    z.H.segment<3>(accel_bias) = -0.5 * past.age_s * past.age_s * f.R_nb().row(axis);
  }
  return z;
}

/// Height above the origin by static pressure: altitude of that pressure in the standard atmosphere, minus
/// the origin's. The whole nonlinearity is in the conversion; the day's pressure and temperature are in the
/// state `baro`.
inline Scalar baro_height(const Nominal& x, double pressure_pa, double origin_altitude_m) {
  Scalar z;
  z.innovation = pressure_altitude(pressure_pa) - origin_altitude_m - (-x.p_n.z() + x.baro_m);
  z.H(pos + 2) = -1;
  z.H(baro) = 1;
  return z;
}

/// The same in flight, where the static port sees a share of the dynamic pressure (the position error of a
/// static source: Gracey, NASA RP 1046 (1980)): the height of a pressure rho u^2 / 2 is u^2 / 2g.
inline Scalar baro_height_in_flight(const Nominal& x, double pressure_pa, double origin_altitude_m) {
  Scalar z = baro_height(x, pressure_pa, origin_altitude_m);
  const Eigen::Vector3d u_n = air_velocity(x);
  const double head_m = u_n.squaredNorm() / (2 * isa::g0);
  z.innovation += x.port_ratio * head_m;
  z.H(port) = -head_m;
  z.H.segment<3>(vel) = -x.port_ratio / isa::g0 * u_n.transpose();
  z.H.segment<2>(wind) = x.port_ratio / isa::g0 * u_n.head<2>().transpose();
  return z;
}

/// Metres per pascal in the standard atmosphere: converts a pressure error into a height error.
inline double metres_per_pascal(const Air& air) { return 1 / (air.density_kgm3 * isa::g0); }

/// True airspeed |u_n| plus the gust along the flight. A pitot reads the magnitude of the air velocity up to
/// some 15 degrees of incidence.
inline Scalar true_airspeed(const Nominal& x, double measured_mps) {
  const Eigen::Vector3d u_n = air_velocity(x);
  const double Va = std::max(u_n.norm(), 1e-3);
  Scalar z;
  z.innovation = measured_mps - Va - x.gust_mps;
  z.H.segment<3>(vel) = u_n.transpose() / Va;
  z.H.segment<2>(wind) = -u_n.head<2>().transpose() / Va;
  z.H(gust) = 1;
  return z;
}

/// The air comes from ahead: the side component of the air velocity is zero (and the true one is noise).
inline Scalar zero_sideslip(const Nominal& x) {
  const Eigen::Vector3d u_n = air_velocity(x), r_y = x.q_nb * Eigen::Vector3d::UnitY();
  Scalar z;
  z.innovation = -r_y.dot(u_n);
  z.H.segment<3>(theta) = r_y.cross(u_n).transpose();
  z.H.segment<3>(vel) = r_y.transpose();
  z.H.segment<2>(wind) = -r_y.head<2>().transpose();
  return z;
}

/// Heading by the magnetic field: the measured field turned into NED must point to the declination. Uses the
/// tilt of the estimate, and its derivative by it: the dip (m_down / m_horizontal) couples them. Valid in
/// both hemispheres; not above the magnetic poles.
inline Scalar magnetic_heading(const Nominal& x, const Eigen::Vector3d& field_b, double declination_rad) {
  const Eigen::Vector3d m = x.q_nb * field_b;
  const double horizontal = std::max(m.x() * m.x() + m.y() * m.y(), 1e-30);
  Scalar z;
  z.innovation = wrap_pi(declination_rad - std::atan2(m.y(), m.x()) - x.heading_rad);
  z.H.segment<3>(theta) << -m.z() * m.x() / horizontal, -m.z() * m.y() / horizontal, 1;
  z.H(heading) = 1;
  return z;
}

/// At rest: the gyro reads its bias.
inline Scalar zero_rate(const Nominal& x, int axis, double measured_radps) {
  Scalar z;
  z.innovation = measured_radps - x.gyro_bias(axis);
  z.H(gyro_bias + axis) = 1;
  return z;
}

}  // namespace fulmar::ekf
