// SPDX-License-Identifier: BSD-3-Clause
// Beginnings of the navigator (navigator.hpp): at rest, in flight, after a gap, from another estimate.
#pragma once
#include "bench/second_filter/navigator.hpp"

namespace fulmar::second_filter {

/// After a gap that was too long to be bridged: attitude lost, alignment begins.
inline void Navigator::lose() {
  if (mode_ == Mode::trying) return try_again();
  mode_ = Mode::lost;
  resting_ = false;
  rest_since_s_ = never;
  flight_.clear();
}

/// The first attitude in flight was none: from the beginning.
inline void Navigator::try_again() {
  mode_ = Mode::aligning;
  filter_.restart({}, time_s_);
  seen_.yaw = seen_.position = seen_.height = seen_.baro_zero = false;
  flight_.clear();
}

/// Aligned again after a gap: new attitude and velocity. Slow states are kept with larger standard
/// deviations.
inline void Navigator::begin_again(const Quaterniond& q_nb, const Vector3d& v_n, const Params& p,
                                   double tilt_std, double yaw_std) {
  const double gap = std::sqrt(std::max(time_s_ - filter_.time_s(), 0.0));
  Nominal n = filter_.state();
  n.q_nb = q_nb;
  n.x.segment<3>(vel) = v_n;
  n.x.segment<2>(gust).setZero();
  filter_.forget(theta, 2, tilt_std);
  filter_.forget(theta + 2, 1, yaw_std);
  filter_.forget(vel, 3, 1);
  filter_.forget(pos, 3, unplaced_m);
  filter_.forget(gust, 2, filter_.block(gust).std);
  filter_.inflate(gyro_bias, 3, std::max(p.gyro_bias_walk * gap, 5e-3));
  filter_.inflate(accel_bias, 3, std::max(p.accel_bias_walk * gap, 0.02));
  filter_.inflate(wind, 2, std::max(p.wind_walk * gap, 0.3));
  filter_.inflate(baro_bias, 1, p.baro_walk * gap);
  filter_.inflate(port, 1, p.static_port_walk * gap);
  filter_.restart(n, time_s_);
  mode_ = Mode::regained;
  aligned_s_ = time_s_;
  seen_.yaw = yaw_std < 0.5;
}

inline void Navigator::align_at_rest(const Params& p) {
  if (rest_since_s_ == never) rest_since_s_ = time_s_;  // flight time may be negative
  const bool has_mag = time_s_ - mag_s_ < 0.5;
  if (!has_mag && time_s_ - rest_since_s_ < 2) return;  // a magnetometer may still wake up
  const bool again = regaining();
  const Nominal before = filter_.state();
  Nominal n;
  const Vector3d f_b = still_.f();
  n.q_nb = has_mag ? attitude_at_rest(f_b, mag_b_, declination()) : attitude_at_rest(f_b);
  n.x.segment<3>(gyro_bias) = still_.omega();
  // At rest only the accelerometers observe the tilt, and tilt gives the yaw by the dip of the field: no
  // priors of their own, the updates at rest tie them to the prior of the accelerometer bias.
  begin(n, p, time_s_, 0.5, has_mag ? 1 : 1.8);
  seen_.yaw = has_mag;
  seen_.position = seen_.height = seen_.baro_zero = false;
  filter_.forget(gyro_bias, 3, 0.01);
  if (again) count_reset(before);
  rest();
  if (has_mag) {
    strength_ = mag_b_.norm();
    mag(mag_b_, p);
  }
}

inline void Navigator::align_in_flight(const Gnss& g, double time_s, const Params& p) {
  const Vector3d v_n = eigen(g.velocity_mps);
  const bool has_mag = seen_.field && time_s_ - mag_s_ < 0.5;
  const Vector3d wind_n(filter_(wind), filter_(wind + 1), 0);
  const auto found =
      flight_.fix(v_n, {p.gravity, has_mag ? &field_n_ : nullptr, regaining() ? &wind_n : nullptr,
                        std::clamp(time_s_ - time_s, 0.0, 1.0)});
  if (!found || v_n.head<2>().norm() < p.min_airspeed) return;
  if (regaining())
    regain(g, *found, has_mag, time_s, p);
  else
    begin_in_flight(g, *found, time_s, p);
}

/// Takes over from an estimate that flies already.
inline void Navigator::resume(const VehicleState& s, const Params& p, double time_s) {
  start(p);
  if (s.origin_valid && !seen_.origin)
    set_origin(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
  Nominal n;
  n.q_nb = eigen(s.attitude);
  n.x.segment<3>(vel) = eigen(s.velocity_mps);
  n.x.segment<3>(pos) = eigen(s.position_m);
  n.x.segment<3>(gyro_bias) = eigen(s.gyro_bias_radps);
  n.x.segment<3>(accel_bias) = eigen(s.accel_bias_mps2);
  n.x.segment<2>(wind) = eigen(s.wind_mps).head<2>();
  begin(n, p, time_s, 0.05, 0.05);
  filter_.forget(gyro_bias, 3, 0.02);
  for (int i = 0; i < 2; ++i)
    filter_.forget(wind + i, 1,
                   std::clamp(i == 0 ? s.wind_std_mps.north : s.wind_std_mps.east, 0.5, p.wind_std.value));
  seen_.position = located_ = s.position_valid;
  filter_.forget(pos, 3, s.position_valid ? 5 : unplaced_m);
  seen_.yaw = true;
  resets_ = {s.reset_count, eigen(s.reset_position_m), eigen(s.reset_velocity_mps), s.reset_yaw_rad, never};
}

/// Bridges a gap that is too long to be coasted by `turn_b`, the rotation of the body measured by another
/// unit. The air-relative velocity in body axes stays.
inline void Navigator::bridge(const Quaterniond& turn_b) {
  constexpr double tilt_std = 0.01, tilt_rate = 0.01, accel_std = 1;  // rad, rad/s, m/s2: of the other unit
  const double T = time_s_ - filter_.time_s();
  Nominal n = filter_.state();
  const Vector3d v_before = n.v_n(), air_n = n.air_n(), u_b = n.q_nb.conjugate() * n.through_air_n();
  n.q_nb = (n.q_nb * turn_b).normalized();
  n.x.segment<3>(vel) = n.q_nb * u_b + air_n;
  n.x.segment<3>(pos) += 0.5 * T * (v_before + n.v_n());
  filter_.inflate(theta, 3, tilt_std + tilt_rate * T);
  filter_.inflate(vel, 3, accel_std * T);
  filter_.inflate(pos, 3, accel_std * T * T);
  filter_.forget(gust, 2, filter_.block(gust).std);
  filter_.restart(n, time_s_);
  mode_ = Mode::running;
  aligned_s_ = time_s_;
}

/// Sets the position to a fix: the first one.
inline void Navigator::place(const Gnss& g, double time_s, const Params& p) {
  if (!seen_.origin) return;
  const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
  for (int i = 0; i < 3; ++i) filter_.correct(fix_pos + i, -filter_(fix_pos + i));
  filter_.place(p_n + std::max(time_s_ - time_s, 0.0) * filter_.state().v_n(), filter_.state().v_n());
  forget_level();
  // On the ground the start height is more accurate than the receiver, unless the receiver contradicts.
  if (resting_) {
    Scalar z;
    z.innovation = -p.start_height - filter_(pos + 2);
    z.H(pos + 2) = 1;
    filter_.fuse(z, p.start_height_std * p.start_height_std, p.gate, all_);
  }
  seen_.position = seen_.height = true;
  seen_.baro_zero = false;
}

/// The position was set to that of the receiver: the sum of position and GNSS error is known.
inline void Navigator::forget_level() {
  filter_.forget(pos, 3, unplaced_m);
  filter_.forget(fix_pos, 2, filter_.block(fix_pos).std);
  filter_.forget(fix_pos + 2, 1, filter_.block(fix_pos + 2).std);
  const Past now = filter_.at(time_s_);
  for (int i = 0; i < 3; ++i) {
    const double white = 0.2 * filter_.std(fix_pos + i);
    filter_.fuse(fix_position(filter_, now, i, now.p_n(i) + filter_(fix_pos + i)), white * white, 1e9, all_);
  }
}

/// The first attitude in flight: that of the fix, then integrated to the present by the inertial samples. Its
/// errors come from the velocities, their age, the biases and the second direction, and correlate with them:
/// e is the error of the mean specific force, theta = f x e / f^2, and the turn about f that keeps the second
/// direction m in the plane of both.
inline void Navigator::begin_in_flight(const Gnss& g, const FlightAlignment::Found& found, double time_s,
                                       const Params& p) {
  const double now_s = time_s_, T = found.window_s;
  const double v_std = std::hypot(known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_least), 0.05);
  Nominal n;
  n.q_nb = found.then_nb;
  n.x.segment<3>(vel) = eigen(g.velocity_mps);
  const FieldDrift::Bias gyro = flight_.drift().bias(p.gyro_bias_std, 2 * p.hard_iron_std);
  const Matrix3d gyro_std = gyro.covariance.llt().matrixL();
  n.x.segment<3>(gyro_bias) = gyro.bias_b;
  n.q_nb = n.q_nb * exp_map(-0.5 * T * gyro.bias_b);
  begin(n, p, std::min(time_s, now_s), 0, 0);
  const Vector3d& f_n = found.f_n;
  const Vector3d up = f_n.normalized(), across = found.second_n - up * up.dot(found.second_n);
  const Matrix3d tilt = skew(f_n) / f_n.squaredNorm(),
                 theta_e =
                     tilt + up * (up.dot(found.second_n) / across.squaredNorm()) * across.transpose() * tilt;
  const Matrix3d R_nb = n.q_nb.toRotationMatrix(), one = Matrix3d::Identity();
  Eigen::Matrix<double, size, 20> A = Eigen::Matrix<double, size, 20>::Zero();
  const auto part = [&](int row, int column) { return A.block<3, 3>(row, column); };
  part(theta, 0) = -v_std / T * theta_e;  // of the first velocity, of the second
  part(theta, 3) = v_std / T * theta_e;
  part(vel, 3) = v_std * one;
  part(theta, 6) = -0.5 * T * R_nb * gyro_std;
  part(gyro_bias, 6) = gyro_std;
  part(theta, 9) = p.accel_bias_std * theta_e * R_nb;
  part(accel_bias, 9) = p.accel_bias_std * one;
  part(theta, 12) = 0.5 * p.gap_accel_std * found.unseen_s / T * theta_e;
  const auto row = [&](int first, int column) { return A.block<3, 1>(first, column); };
  row(theta, 15) = p.gnss_delay_std * theta_e * found.jerk_n;
  row(vel, 15) = p.gnss_delay_std * found.a_n;
  A(delay, 15) = p.gnss_delay_std;
  // The direction of the field is off by the hard iron across the specific force.
  const double share = found.by_field ? field_n_.norm() / across.norm() : 0;
  if (found.by_field) {
    const Matrix3d by_iron = share * up * up.cross(across.normalized()).transpose() * R_nb;
    part(theta, 16) = -p.hard_iron_std * by_iron;
    part(iron, 16) = p.hard_iron_std * one;
  }
  row(theta, 19) = (found.by_field ? p.mag_noise * share : 0.4) * up;
  for (const auto& [first, count] : {std::pair{+theta, 6}, {+gyro_bias, 6}, {+delay, 1}})
    filter_.forget(first, count, 0);
  if (found.by_field) filter_.forget(iron, 3, 0);
  filter_.widen<20>(A);
  strength_ = mag_b_.norm();
  seen_.yaw = true;
  place(g, time_s_, p);
  located_ = seen_.position;
  flight_.since(now_s - time_s_, [&](const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    filter_.predict(omega_b, f_b, dt);
  });
  time_s_ = aligned_s_ = now_s;
  mode_ = Mode::trying;
}

/// After a fix: whether it confirms the first attitude in flight. The attitude is valid when the acceleration
/// that it gives with the specific force is known; tilt and accelerometer biases cannot be separated before a
/// turn.
inline void Navigator::try_attitude(const Params& p) {
  constexpr double max_ratio = 3;
  const double tilt_std = std::max(0.046, 1.3 * p.accel_bias_std / p.gravity);
  if (health_.velocity.accepted_s != time_s_) {
    if (health_.velocity.refused_from_s != time_s_) try_again();  // the second in a row
    return;
  }
  const Vector3d f_n = filter_.R_nb() * filter_.specific_force_b();
  double std = 0;
  for (int i = 0; i < 2; ++i) {
    Scalar a;
    a.H.segment<3>(theta) = -skew(f_n).row(i);
    a.H.segment<3>(accel_bias) = -filter_.R_nb().row(i);
    std = std::max(std, filter_.expected_std(a, 0) / filter_.gravity_mps2);
  }
  std = std::max({std, filter_.std(theta), filter_.std(theta + 1)});
  if (std < tilt_std && std::abs(health_.velocity.ratio) < max_ratio) mode_ = Mode::running;
}

/// The first fix after a gap that ends an alignment.
inline void Navigator::regain(const Gnss& g, const FlightAlignment::Found& found, bool has_mag, double time_s,
                              const Params& p) {
  const Nominal before = filter_.state();
  const double tilt = known(g.speed_std_mps, p.gnss_speed_std, 0.1) / (p.gravity * found.window_s);
  begin_again(found.q_nb, eigen(g.velocity_mps) + found.since_n, p, std::clamp(1.5 * tilt, 0.05, 0.2),
              has_mag ? 0.15 : 0.4);
  seen_.yaw = true;
  if (seen_.position) {  // the errors of receiver and barometer are those of before the gap
    const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m) +
                         std::max(time_s_ - time_s, 0.0) * filter_.state().v_n();
    for (int i = 0; i < 3; ++i) {
      const double white = p.gnss_white * (i < 2 ? fix_std_.x() : fix_std_.y());
      filter_.fuse(fix_position(filter_, filter_.at(time_s_), i, p_n(i)), white * white, 1e9, all_);
    }
  } else {
    place(g, time_s, p);
  }
  count_reset(before);
  health_.horizontal.accepted_s = health_.velocity.accepted_s = health_.height.accepted_s = time_s_;
}

}  // namespace fulmar::second_filter
