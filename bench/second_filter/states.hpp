// SPDX-License-Identifier: BSD-3-Clause
// The states of the estimator in one table: a block for each slow error, with its model. A sensor that brings
// an error of its own appends a block at set-up (Filter::append).
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fulmar/flight/math/attitude.hpp"

namespace fulmar::second_filter {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where each block begins in the error state. Attitude is a small rotation about the NED axes: R_true =
/// exp(theta) R_estimate. `fix_` blocks are errors of the GNSS receiver, `tube_` of the pitot.
enum State : int {
  theta = 0,        ///< rad, NED
  vel = 3,          ///< m/s, NED
  pos = 6,          ///< m, NED
  gyro_bias = 9,    ///< rad/s, body
  accel_bias = 12,  ///< m/s2, body
  wind = 15,        ///< m/s, north and east: mean wind
  gust = 17,        ///< m/s, north and east: turbulence
  fix_pos = 19,     ///< m, NED: reported position minus true position
  fix_vel = 22,     ///< m/s, NED: reported velocity minus true velocity
  delay = 25,       ///< s: age of a fix beyond its time stamp
  baro_bias = 26,   ///< m: positive when the barometer reads high
  port = 27,        ///< share of the dynamic pressure at the static port
  iron = 28,        ///< share of the Earth's field, body axes: hard iron
  strength = 31,    ///< share by which the magnetometer reads high
  tube_scale = 32,  ///< share: measured airspeed over true airspeed minus 1
  tube_bias = 33,   ///< Pa
  slip = 34,        ///< m/s: side component of the air velocity, to which the aircraft has not yet turned
  mount = 35,       ///< rad: turn of the magnetometer about the body z axis
  model = 36,       ///< m/s: airspeed by thrust and drag minus true airspeed
  appended = 37,    ///< of components with more sensors
  size = 40
};

using Vector = Eigen::Matrix<double, size, 1>;
using Row = Eigen::Matrix<double, 1, size>;
using Covariance = Eigen::Matrix<double, size, size>;

/// Means of the inertial samples over a step, without biases.
struct Motion {
  double time_s = 0;
  Matrix3d R_nb = Matrix3d::Identity();
  Vector3d rate_b = Vector3d::Zero(), force_b = Vector3d::Zero();  ///< rad/s, m/s2
};
/// Change of attitude (rad, NED), velocity (m/s) and position (m) over a step per unit of a state.
using Drive = Eigen::Matrix<double, 9, 1> (*)(const Motion&);

/// Model of one block: a random walk, with `time_s` > 0 beside a first-order Gauss-Markov process of the
/// stationary standard deviation `std`.
struct Block {
  int first, count;
  double std;             ///< before it is measured, in the unit of the state
  double walk = 0;        ///< unit/sqrt(s)
  double time_s = 0;      ///< correlation time
  Drive drive = nullptr;  ///< effect on the motion, of an appended state; null: only measurements see it
};

/// Estimate: attitude, and a value for each other state at its index.
struct Nominal {
  Quaterniond q_nb = Quaterniond::Identity();
  Vector x = Vector::Zero();

  template <int n>
  auto at(int first) const {
    return x.segment<n>(first);
  }
  Vector3d v_n() const { return x.segment<3>(vel); }
  Vector3d p_n() const { return x.segment<3>(pos); }
  /// Velocity of the air, NED; the vertical wind is 0.
  Vector3d air_n() const { return {x(wind) + x(gust), x(wind + 1) + x(gust + 1), 0}; }
  /// Velocity relative to the air.
  Vector3d through_air_n() const { return v_n() - air_n(); }

  void add(const Vector& dx) {
    q_nb = exp_map(dx.segment<3>(theta)) * q_nb;
    q_nb.coeffs() *= 1.5 - 0.5 * q_nb.squaredNorm();  // first-order normalisation
    x.tail<size - 3>() += dx.tail<size - 3>();
  }
  /// The state moved by an error: x (+) dx.
  Nominal plus(const Vector& dx) const {
    Nominal n = *this;
    n.add(dx);
    return n;
  }
  /// The error that leads from `from` to here.
  Vector minus(const Nominal& from) const {
    Vector dx = x - from.x;
    dx.segment<3>(theta) = log_map(q_nb * from.q_nb.conjugate());
    return dx;
  }
};

/// A scalar measurement: measured minus expected value, and the derivative of the expected value by the error
/// state.
struct Scalar {
  double innovation = 0;
  Row H = Row::Zero();
};

struct Fused {  ///< result of one scalar update
  bool accepted = false;
  double ratio = 0;  ///< innovation / its standard deviation
};

}  // namespace fulmar::second_filter
