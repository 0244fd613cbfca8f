// SPDX-License-Identifier: BSD-3-Clause
// Measurement models: each gives an innovation and its row of derivatives. u_n: velocity through the air,
// r_y: the body y axis in NED. Derivatives are by the small rotation theta about NED, R' = exp(theta) R.
#pragma once
#include <cmath>

#include "bench/second_filter/filter.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/angles.hpp"

namespace fulmar::second_filter {

/// Specific force integrated over the age of a late fix, NED, m/s.
inline Vector3d force_since(const Filter& f, const Past& past) {
  return f.state().v_n() - past.v_n - Vector3d(0, 0, f.gravity_mps2 * past.age_s);
}

/// Velocity of a fix, NED axis 0 to 2. A measurement that is `past.age_s` late is compared with the velocity
/// then, whose error is dv - age (-[f]x (theta + age/2 R bg) - R ba). `accel_mps2`: along this axis at the
/// time of the fix, the derivative by the delay.
inline Scalar fix_velocity(const Filter& f, const Past& past, int axis, double measured_mps,
                           double accel_mps2) {
  Scalar z;
  z.innovation = measured_mps - past.v_n(axis) - f(fix_vel + axis);
  z.H(vel + axis) = z.H(fix_vel + axis) = 1;
  z.H(delay) = -accel_mps2;
  if (past.age_s > 0) {
    const Matrix3d F = skew(force_since(f, past));
    z.H.segment<3>(theta) = F.row(axis);
    z.H.segment<3>(gyro_bias) = 0.5 * past.age_s * F.row(axis) * f.R_nb();
    z.H.segment<3>(accel_bias) = past.age_s * f.R_nb().row(axis);
  }
  return z;
}

/// Position of a fix, late as above: dp - age dv + age^2/2 (-[f]x (theta + age/3 R bg) - R ba).
inline Scalar fix_position(const Filter& f, const Past& past, int axis, double measured_m) {
  Scalar z;
  z.innovation = measured_m - past.p_n(axis) - f(fix_pos + axis);
  z.H(pos + axis) = z.H(fix_pos + axis) = 1;
  z.H(delay) = -past.v_n(axis);
  if (past.age_s > 0) {
    const double age = past.age_s;
    const Matrix3d F = skew(force_since(f, past));
    z.H(vel + axis) = -age;
    z.H.segment<3>(theta) = -0.5 * age * F.row(axis);
    z.H.segment<3>(gyro_bias) = -age * age / 6 * F.row(axis) * f.R_nb();
    z.H.segment<3>(accel_bias) = -0.5 * age * age * f.R_nb().row(axis);
  }
  return z;
}

/// Height above the origin by static pressure: altitude of that pressure in the standard atmosphere minus
/// that of the origin. In flight the static port sees a share of the dynamic pressure (Gracey, NASA RP 1046
/// (1980)): the height of a pressure rho u^2 / 2 is u^2 / 2g.
inline Scalar baro_height(const Filter& f, double pressure_pa, double origin_altitude_m, bool flies) {
  Scalar z;
  z.innovation = pressure_altitude(pressure_pa) - origin_altitude_m - (-f(pos + 2) + f(baro_bias));
  z.H(pos + 2) = -1;
  z.H(baro_bias) = 1;
  if (!flies) return z;
  const Vector3d u_n = f.state().through_air_n();
  const double head_m = u_n.squaredNorm() / (2 * isa::g0), ratio = f(port) / isa::g0;
  z.innovation += f(port) * head_m;
  z.H(port) = -head_m;
  z.H.segment<3>(vel) = -ratio * u_n.transpose();
  z.H.segment<2>(wind) = z.H.segment<2>(gust) = ratio * u_n.head<2>().transpose();
  return z;
}
inline double metres_per_pascal(const Air& air) { return 1 / (air.density_kgm3 * isa::g0); }

/// Pressure of the pitot: rho (s |u_n|)^2 / 2 with its scale s, and its bias. A pitot reads the magnitude of
/// the air velocity up to some 15 degrees of incidence. `scale`: ratio of measured to true airspeed.
inline Scalar tube_pressure(const Filter& f, double measured_pa, double density_kgm3, double scale) {
  const Vector3d u_n = f.state().through_air_n();
  const double s = scale * (1 + f(tube_scale)), by_speed = density_kgm3 * s * s;
  Scalar z;
  z.innovation = measured_pa - 0.5 * by_speed * u_n.squaredNorm() - f(tube_bias);
  z.H.segment<3>(vel) = by_speed * u_n.transpose();
  z.H.segment<2>(wind) = z.H.segment<2>(gust) = -by_speed * u_n.head<2>().transpose();
  z.H(tube_scale) = density_kgm3 * s * scale * u_n.squaredNorm();
  z.H(tube_bias) = 1;
  return z;
}

/// Airspeed by a model, given as its difference to the estimated airspeed, with the error of the model.
inline Scalar modelled_airspeed(const Filter& f, double difference_mps) {
  const Vector3d u_n = f.state().through_air_n(), ahead = u_n / std::max(u_n.norm(), 1e-3);
  Scalar z;
  z.innovation = difference_mps - f(model);
  z.H.segment<3>(vel) = ahead.transpose();
  z.H.segment<2>(wind) = z.H.segment<2>(gust) = -ahead.head<2>().transpose();
  z.H(model) = 1;
  return z;
}

/// The air comes from ahead: the side component of the air velocity is that of the sideslip.
inline Scalar coordinated(const Filter& f) {
  const Vector3d u_n = f.state().through_air_n(), r_y = f.R_nb().col(1);
  Scalar z;
  z.innovation = f(slip) - r_y.dot(u_n);
  z.H.segment<3>(theta) = r_y.cross(u_n).transpose();
  z.H.segment<3>(vel) = r_y.transpose();
  z.H.segment<2>(wind) = z.H.segment<2>(gust) = -r_y.head<2>().transpose();
  z.H(slip) = -1;
  return z;
}

/// One axis of the magnetometer, as a share of the field's strength. `field_n`: the Earth's field, NED, of
/// length 1. The sensor is turned by the state `mount` about the body z axis.
inline Scalar field(const Filter& f, const Vector3d& field_n, int axis, double measured) {
  const double c = std::cos(f(mount)), s = std::sin(f(mount)), scale = 1 + f(strength);
  const Vector3d x = f.R_nb().col(0), y = f.R_nb().col(1);
  const Vector3d r = axis == 0 ? c * x + s * y : axis == 1 ? c * y - s * x : Vector3d(f.R_nb().col(2));
  const Vector3d by_mount = axis == 0   ? c * y - s * x
                            : axis == 1 ? -c * x - s * y
                                        : Vector3d(Vector3d::Zero());
  const double along = r.dot(field_n);
  Scalar z;
  z.innovation = measured - scale * along - f(iron + axis);
  z.H.segment<3>(theta) = scale * r.cross(field_n).transpose();  // r' = r + theta x r
  z.H(iron + axis) = 1;
  z.H(strength) = along;
  z.H(mount) = scale * by_mount.dot(field_n);
  return z;
}

/// At rest: no velocity, and the gyro reads its bias.
inline Scalar zero_velocity(const Filter& f, int axis) {
  Scalar z;
  z.innovation = -f(vel + axis);
  z.H(vel + axis) = 1;
  return z;
}
inline Scalar zero_rate(const Filter& f, int axis, double measured_radps) {
  Scalar z;
  z.innovation = measured_radps - f(gyro_bias + axis);
  z.H(gyro_bias + axis) = 1;
  return z;
}

}  // namespace fulmar::second_filter
