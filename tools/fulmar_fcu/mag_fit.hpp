// SPDX-License-Identifier: BSD-3-Clause
// From samples to the twelve parameters of the controller's magnetometer, and whether they are good enough.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/ellipsoid_fit.hpp"

namespace fulmar::fcu {

/// What the sensor read, from what the firmware reports: it applies A (m - b). ROSflight firmware 2.0,
/// sensors.cpp.
Vector3 uncorrected(const Vector3& reported, const Matrix3& A, const Vector3& b);

double determinant(const Matrix3& A);

/// Why a fit is not to be used, in one sentence with what to do; "" when it is good. `micro` is a microtesla
/// in the samples' unit.
std::string objection(const EllipsoidFit& fit, double micro);

/// Three numbers a line: tesla, as the sensor read them. A first line that is no numbers is a title. Throws
/// Error with file:line.
std::vector<Vector3> read_samples(const std::string& path);
std::string samples_text(const std::vector<Vector3>& samples);

/// Six sides to lay the aircraft on, told by gravity; on each it is turned once around the vertical, told by
/// the gyroscope.
class MagGuide {
 public:
  static constexpr int sides = 6, parts = 12, enough = 3, most = 12;
  /// An inertial sample, body axes: m/s2, rad/s, and the time since the one before.
  void turn(const Vector3& accel, const Vector3& gyro, double dt_s);
  /// A reading of the magnetometer: kept when it is wanted.
  void take(const Vector3& m);
  bool done() const { return done_sides() == sides; }
  int done_sides() const;
  std::string text() const;  ///< what to do now
  const std::vector<Vector3>& samples() const { return samples_; }

 private:
  int parts_of(int side) const;
  std::array<std::array<int, parts>, sides> count_{};
  std::vector<Vector3> samples_;
  double angle_rad_ = 0;
  int side_ = -1;
};

}  // namespace fulmar::fcu
