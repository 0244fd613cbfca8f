// SPDX-License-Identifier: BSD-3-Clause
// First attitude of the filter: at rest from gravity and the magnetic field, in the air from the acceleration
// that the GNSS velocity shows.
#pragma once
#include <array>
#include <cmath>
#include <optional>

#include "fulmar/flight/attitude.hpp"

namespace fulmar::navigation {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Says whether the inertial unit rests: a second of quarter-second blocks with little noise, whose means
/// agree. Absolute values do not count: the gyros may have any bias.
class Stillness {
 public:
  void update(const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    if (dt > 0.1) *this = {};
    if (n_ == 0) {
      first_omega_ = omega_b;
      first_f_ = f_b;
    }
    const Vector3d domega = omega_b - first_omega_,
                   df = f_b - first_f_;  // shifted: a large bias costs no digits
    omega_sum_ += domega;
    f_sum_ += df;
    omega_squares_ += domega.cwiseAbs2();
    f_squares_ += df.cwiseAbs2();
    ++n_;
    time_ += dt;
    if (time_ >= block_s && n_ >= 8) close_block();
  }

  bool still() const { return blocks_still_ >= blocks; }
  Vector3d omega() const { return mean(omega_); }  ///< over the last second
  Vector3d f() const { return mean(f_); }

 private:
  static constexpr int blocks = 4;
  static constexpr double block_s = 0.25, gyro_noise = 0.03, gyro_step = 0.02, accel_noise = 0.6,
                          accel_step = 0.25;

  void close_block() {
    const Vector3d omega_mean = omega_sum_ / n_, f_mean = f_sum_ / n_;
    const double omega_std = std::sqrt((omega_squares_ / n_ - omega_mean.cwiseAbs2()).maxCoeff());
    const double f_std = std::sqrt((f_squares_ / n_ - f_mean.cwiseAbs2()).maxCoeff());
    const Vector3d w = first_omega_ + omega_mean, f = first_f_ + f_mean;
    const std::size_t last = (next_ + blocks - 1) % blocks;
    const bool calm = omega_std < gyro_noise && f_std < accel_noise;
    const bool agrees = (w - omega_[last]).cwiseAbs().maxCoeff() < gyro_step &&
                        (f - f_[last]).cwiseAbs().maxCoeff() < accel_step;
    blocks_still_ = !calm ? 0 : agrees && blocks_still_ > 0 ? blocks_still_ + 1 : 1;
    omega_[next_] = w;
    f_[next_] = f;
    next_ = (next_ + 1) % blocks;
    n_ = 0;
    time_ = 0;
    omega_sum_ = f_sum_ = omega_squares_ = f_squares_ = Vector3d::Zero();
  }
  static Vector3d mean(const std::array<Vector3d, blocks>& v) { return 0.25 * (v[0] + v[1] + v[2] + v[3]); }

  Vector3d omega_sum_ = Vector3d::Zero(), f_sum_ = Vector3d::Zero(), omega_squares_ = Vector3d::Zero(),
           f_squares_ = Vector3d::Zero();
  Vector3d first_omega_ = Vector3d::Zero(), first_f_ = Vector3d::Zero();
  int n_ = 0, blocks_still_ = 0;
  double time_ = 0;
  std::size_t next_ = 0;
  std::array<Vector3d, blocks> omega_{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()},
      f_ = omega_;
};

/// A magnetic field in NED from declination and dip.
inline Vector3d field_direction(double declination_rad, double dip_rad) {
  return {std::cos(dip_rad) * std::cos(declination_rad), std::cos(dip_rad) * std::sin(declination_rad),
          std::sin(dip_rad)};
}

/// Attitude at rest. Only the horizontal direction of the field is used: its dip may be disturbed by the
/// ground.
inline Quaterniond attitude_at_rest(const Vector3d& f_b, const Vector3d& field_b, double declination_rad) {
  return attitude_from_directions(f_b, -Vector3d::UnitZ(), field_b,
                                  field_direction(declination_rad, 0) + Vector3d::UnitZ());
}
inline Quaterniond attitude_at_rest(const Vector3d& f_b) {  // yaw unknown: north
  const Vector3d ahead = std::abs(f_b.normalized().x()) < 0.99 ? Vector3d::UnitX() : Vector3d::UnitZ();
  return attitude_from_directions(f_b, -Vector3d::UnitZ(), ahead, Vector3d::UnitX());
}

/// Attitude in flight. Between two fixes at least half a second apart the mean specific force is (v2 - v1)/T
/// - g in NED, and it was measured in body axes, each sample turned back to the beginning by the gyros. The
/// second direction is the magnetic field, or, without one, the course: an aircraft flies nose first.
class FlightAlignment {
 public:
  void imu(const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    if (dt > 0.1) started_ = false;
    if (!started_) return;
    q_ = q_ * exp_map(omega_b * dt);
    f_sum_ += dt * (q_ * f_b);
    ahead_sum_ += dt * (q_ * Vector3d::UnitX());
    time_ += dt;
  }
  void mag(const Vector3d& field_b) {
    if (started_) field_sum_ += q_ * field_b;
  }
  struct Found {
    Quaterniond q_nb;
    Vector3d a_n;  ///< mean acceleration of the window
    double window_s;
  };
  /// What is known beside the inertial samples; a null pointer is not known.
  struct Known {
    double gravity_mps2;
    const Vector3d* field_n;
    const Vector3d* wind_n;
    double late_s;  ///< age of the fix: the window of the fixes lies so long before that of the samples
  };
  /// Attitude now, when this fix ends a window.
  std::optional<Found> fix(const Vector3d& v_n, const Known& known) {
    std::optional<Found> found;
    if (started_ && time_ >= 0.45) {
      if (time_ < 2.5) found = solve(v_n, known);
      started_ = false;
    }
    if (!started_) {
      *this = {};
      started_ = true;
      v_first_ = v_n;
    }
    return found;
  }

 private:
  std::optional<Found> solve(const Vector3d& v_n, const Known& known) const {
    const Matrix3d turned = turn_since_fix(v_n, known.late_s);
    const Vector3d a_n = turned * ((v_n - v_first_) / time_), f_n = a_n - Vector3d(0, 0, known.gravity_mps2);
    const Vector3d f_b = f_sum_ / time_;
    if (f_n.norm() < 3 || f_b.norm() < 3) return std::nullopt;  // near free fall: no direction in it
    Vector3d second_b = ahead_sum_, second_n = turned * (0.5 * (v_n + v_first_));
    if (known.wind_n) second_n -= *known.wind_n;
    // In a turn the field may lie along the specific force. The nose never does, but without the wind it is
    // known less well.
    const double enough = known.wind_n ? 0.6 : 0.3;
    if (known.field_n && field_sum_.norm() > 0 &&
        known.field_n->normalized().cross(f_n.normalized()).norm() > enough) {
      second_b = field_sum_;
      second_n = *known.field_n;
    }
    if (second_b.normalized().cross(f_b.normalized()).norm() < 0.2 ||
        second_n.normalized().cross(f_n.normalized()).norm() < 0.2)
      return std::nullopt;
    return Found{(attitude_from_directions(f_b, f_n, second_b, second_n) * q_).normalized(), a_n, time_};
  }
  /// A turn goes on from the time of the fix to its arrival.
  Matrix3d turn_since_fix(const Vector3d& v_n, double late_s) const {
    const double cross = v_first_.x() * v_n.y() - v_first_.y() * v_n.x(),
                 dot = v_first_.head<2>().dot(v_n.head<2>());
    return Eigen::AngleAxisd(late_s / time_ * std::atan2(cross, dot), Vector3d::UnitZ()).toRotationMatrix();
  }

  bool started_ = false;
  Quaterniond q_ = Quaterniond::Identity();  ///< body now -> body at the beginning
  Vector3d f_sum_ = Vector3d::Zero(), ahead_sum_ = Vector3d::Zero(), field_sum_ = Vector3d::Zero(),
           v_first_ = Vector3d::Zero();
  double time_ = 0;
};

}  // namespace fulmar::navigation
