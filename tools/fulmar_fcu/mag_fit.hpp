// SPDX-License-Identifier: BSD-3-Clause
// From samples to the twelve parameters of the controller's magnetometer, with a check of their quality.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/ellipsoid_fit.hpp"

namespace fulmar::fcu {

/// Raw reading of the sensor from the reported value: the firmware applies A (m - b). ROSflight firmware 2.0,
/// sensors.cpp.
Vector3 uncorrected(const Vector3& reported, const Matrix3& A, const Vector3& b);

double determinant(const Matrix3& A);

/// Reason to reject a fit, with the remedy, in one sentence; "" for a good one. `micro`: a microtesla in the
/// unit of the samples.
std::string objection(const EllipsoidFit& fit, double micro);

/// Three numbers a line: tesla, raw readings. A first line without numbers is a title. Throws Error with
/// file:line.
std::vector<Vector3> read_samples(const std::string& path);
std::string samples_text(const std::vector<Vector3>& samples);

/// Six sides on which the aircraft is laid, detected by gravity. On each it is turned once around the
/// vertical, measured by the gyroscope.
class MagGuide {
 public:
  static constexpr int sides = 6, parts = 12, enough = 3, most = 12;
  /// An inertial sample, body axes: m/s2, rad/s, and the time since the one before.
  void turn(const Vector3& accel, const Vector3& gyro, double dt_s);
  /// A reading of the magnetometer: stored if it is needed.
  void take(const Vector3& m);
  bool done() const { return done_sides() == sides; }
  int done_sides() const;
  std::string text() const;  ///< next step for the user
  const std::vector<Vector3>& samples() const { return samples_; }

 private:
  int parts_of(int side) const;
  std::array<std::array<int, parts>, sides> count_{};
  std::vector<Vector3> samples_;
  double angle_rad_ = 0;
  int side_ = -1;
};

}  // namespace fulmar::fcu
