// SPDX-License-Identifier: BSD-3-Clause
// Heading of the navigator (navigator.hpp): magnetometer, course in the take-off run, and the accelerations
// that show a magnetometer that is mounted wrong.
#pragma once
#include "fulmar/flight/navigation/navigator.hpp"

namespace fulmar::navigation {

inline constexpr double heading_sure_rad = 0.15;      ///< largest standard deviation of a heading that counts
inline constexpr double heading_confirmed_rad = 0.2;  ///< the same of one that confirms a magnetometer
inline constexpr double heading_most_std = 5;         ///< standard deviations by which it contradicts
inline constexpr double heading_most_deviation = 4;   ///< beyond, a magnetometer is mounted wrong

/// Heading that the accelerations show. True when it contradicts the estimate, which is then turned. The
/// delay that is estimated follows a wrong heading, and is not used.
inline bool Navigator::test_heading(const Gnss& g, double valid_s, const Params& p) {
  const double v_std = known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_floor);
  heading_.corrected(filter_.R_nb());
  heading_.fix(eigen(g.velocity_mps).head<2>(), v_std, valid_s - p.gnss_delay);
  const double error = heading_.error_rad(), std = heading_.std_rad(), bias = heading_.bias_rad();
  if (resting_ || !seen_.yaw || std > heading_sure_rad) return false;
  const bool off = std::abs(error) > bias + heading_most_std * std::hypot(std, filter_.std(ekf::theta + 2));
  // The estimate may be right, or on its way, although the magnetometer is not: at first alone. One that was
  // right is not mounted wrong.
  const double mag_rad = std::abs(wrap_pi(error - mount_.off_rad)),
               least_rad = heading_most_deviation * p.mag_deviation;
  const bool asked = !mount_.confirmed && time_s_ - mount_.seen_s < 0.5,
             mag_off = asked && mag_rad > bias + heading_most_std * std + least_rad;
  mount_.confirmed = mount_.confirmed || (asked && bias + std < heading_confirmed_rad && mag_rad < least_rad);
  mount_.unknown = mount_.unknown || mag_off;
  if (!off && !(mag_off && std::abs(error) > std)) return false;
  turn_heading(g, valid_s, p);
  return true;
}

inline void Navigator::turn_heading(const Gnss& g, double valid_s, const Params& p) {
  const ekf::Nominal before = filter_.state();
  const Quaterniond turn = exp_map({0, 0, heading_.error_rad()});
  ekf::Nominal x = before;
  x.q_nb = turn * before.q_nb;
  x.v_n = eigen(g.velocity_mps) + turn * (before.v_n - filter_.at(valid_s - p.gnss_delay).v_n);
  // The air comes from where it came from in body axes.
  if (airborne_) x.wind = (x.v_n - turn * ekf::air_velocity(before)).head<2>();
  x.gnss_delay_s = 0;
  // The errors of tilt and biases belong together in body axes, as before.
  ekf::Covariance P = filter_.covariance();
  const Matrix3d T = turn.toRotationMatrix();
  P.middleRows<3>(ekf::theta) = (T * P.middleRows<3>(ekf::theta)).eval();
  P.middleCols<3>(ekf::theta) = (P.middleCols<3>(ekf::theta) * T.transpose()).eval();
  filter_.set_covariance(P);
  // What the wrong heading has done to tilt, biases and position.
  filter_.inflate(ekf::theta, 2, 0.03);
  filter_.inflate(ekf::gyro_bias, 3, 1e-3);
  filter_.inflate(ekf::accel_bias, 3, 0.1);
  filter_.inflate(ekf::pos, 2, (x.v_n - before.v_n).head<2>().norm());
  filter_.forget(ekf::theta + 2, 1, 2 * heading_.std_rad() + 0.05);
  filter_.forget(ekf::vel, 3, std::max(known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_floor), 0.5));
  filter_.forget(ekf::wind, 2, p.wind_std);
  filter_.forget(ekf::gust, 1, p.gust_std);
  filter_.forget(ekf::delay, 1, p.gnss_delay_std);
  // The past before the turn is that of another heading.
  P = filter_.covariance();
  filter_.reset(x, ekf::Vector::Zero(), time_s_);
  filter_.set_covariance(P);
  forget_gusts(time_s_, p);
  heading_.clear();
  mount_.unknown = true;
  health_.velocity.accepted_s = time_s_;
  count_reset(before);
}

/// The slow error of the heading, which then is 0.
inline double Navigator::take_deviation() {
  ekf::Vector dx = ekf::Vector::Zero();
  dx(ekf::heading) = -filter_.state().heading_rad;
  filter_.correct(dx);
  return -dx(ekf::heading);
}

/// After the turn of the estimate the magnetometer follows it: turned by a constant angle, not by the slow
/// error, which decays.
inline void Navigator::find_mount(const Vector3d& sample_b, const Params& p) {
  const Vector3d expected_b = filter_.R_nb().transpose() * field_n_;
  const auto across = [](const Vector3d& v) { return v.head<2>().norm() / v.norm(); };
  if (std::min(across(expected_b), across(sample_b)) < 0.2) return;  // along the body z axis
  mount_.unknown = false;
  mount_.turn_rad =
      wrap_pi(std::atan2(expected_b.y(), expected_b.x()) - std::atan2(sample_b.y(), sample_b.x()));
  if (std::abs(mount_.turn_rad) < heading_most_deviation * p.mag_deviation) mount_.turn_rad = 0;
  health_.mag_turn_rad = mount_.turn_rad;
  take_deviation();
  filter_.forget(ekf::heading, 1, std::hypot(filter_.std(ekf::theta + 2), p.mag_deviation));
}

/// Without a magnetometer the take-off run shows the yaw.
inline void Navigator::yaw_from_course(const Vector3d& v_n) {
  if (v_n.head<2>().norm() < 5) return;
  const ekf::Nominal before = filter_.state();
  Euler e = euler_from(filter_.R_nb());
  e.yaw_rad = std::atan2(v_n.y(), v_n.x());
  filter_.set_attitude(quaternion_from(e));
  filter_.forget(ekf::theta + 2, 1, 0.35);
  filter_.place(filter_.state().p_n, v_n);
  filter_.forget(ekf::vel, 3, 1);
  seen_.yaw = true;
  count_reset(before);
}

inline void Navigator::mag(const Vector3d& sample_b, const Params& p) {
  const double strength = sample_b.norm();
  if (!(strength > 1e-6) || !sample_b.allFinite()) return;
  const Vector3d field_b = exp_map({0, 0, mount_.turn_rad}) * sample_b;
  mag_s_ = time_s_;
  mag_b_ = field_b;
  health_.field.sampled(strength, time_s_);
  health_.heading.contradicts = (airborne_ && health_.field.changed()) || health_.mag_turn_rad != 0;
  if (!aligned()) {
    flight_.mag(field_b);
    return;
  }
  const double horizontal = field_n_.head<2>().norm() / field_n_.norm();
  if (!seen_.field || horizontal < 0.15) return;  // near the magnetic poles there is no heading
  if (time_s_ - mag_fused_s_ < 0.1 - 1e-4)
    return;  // its errors are correlated: more samples would not be more information
  mag_fused_s_ = time_s_;
  if (stuck(health_.heading)) return;
  if (!seen_.yaw) yaw_from_field(field_b);
  if (mount_.unknown) return find_mount(sample_b, p);
  const double std = p.mag_noise / horizontal;
  const ekf::Scalar z = ekf::magnetic_heading(filter_.state(), field_b, declination());
  mount_.off_rad = z.innovation + filter_.state().heading_rad;
  mount_.seen_s = time_s_;
  fuse(z, std * std, p.mag_gate, health_.heading);
  if (mount_.turn_rad == 0) return;
  // Part of the constant angle, which does not decay.
  mount_.turn_rad = wrap_pi(mount_.turn_rad + take_deviation());
  health_.mag_turn_rad =
      std::abs(mount_.turn_rad) < heading_most_deviation * p.mag_deviation ? 0 : mount_.turn_rad;
}

/// A magnetometer that wakes up after the alignment.
inline void Navigator::yaw_from_field(const Vector3d& field_b) {
  const ekf::Nominal before = filter_.state();
  const double turn = ekf::magnetic_heading(before, field_b, declination()).innovation;
  filter_.set_attitude(exp_map({0, 0, turn}) * filter_.state().q_nb);
  filter_.forget(ekf::theta + 2, 1, 1);
  seen_.yaw = true;
  count_reset(before);
}

}  // namespace fulmar::navigation
