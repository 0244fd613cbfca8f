// SPDX-License-Identifier: BSD-3-Clause
// Updates of the navigator (navigator.hpp): GNSS, and the noise of the inertial unit. navigator_air.hpp has
// barometer and pitot, navigator_heading.hpp the magnetometer.
#pragma once
#include <utility>

#include "fulmar/flight/navigation/navigator.hpp"
#include "fulmar/flight/navigation/navigator_air.hpp"
#include "fulmar/flight/navigation/navigator_heading.hpp"

namespace fulmar::navigation {

inline bool Navigator::within(std::initializer_list<double> ratios, double gate, Aid& aid) {
  ekf::Fused fused{true, 0};
  for (const double ratio : ratios) {
    if (!(std::abs(ratio) <= std::abs(fused.ratio))) fused.ratio = ratio;
    if (!(std::abs(ratio) <= gate)) fused.accepted = false;  // no number as well
  }
  aid.record(fused, time_s_, ratios);
  health_.refused += !fused.accepted;
  return fused.accepted;
}

inline void Navigator::doubt(std::initializer_list<int> parts, double std, Aid& aid) {
  for (const int i : parts)
    filter_.inflate(i, 1, std::sqrt(std::max(std * std - filter_.std(i) * filter_.std(i), 0.0)));
  aid.refused_from_s = never;
}

inline void Navigator::learn_noise(const Vector3d& omega_b, const Vector3d& f_b, double dt, const Params& p) {
  if (health_.rates.was_clipped() || health_.forces.was_clipped()) clipped_s_ = time_s_;
  const bool reported = at_stop();
  if (reported) heading_.clear();
  if (!reported) {
    gyro_noise_.sampled(omega_b, dt);
    accel_noise_.sampled(f_b, dt);
  }
  filter_.noise.gyro = reported ? p.gyro_noise.value : gyro_noise_.density(p.gyro_noise);
  filter_.noise.accel = reported ? p.accel_noise.value : accel_noise_.density(p.accel_noise);
}

/// Origin by averaging on the ground, by the first fix in the air.
inline void Navigator::collect_origin(const Gnss& g, const Params& p) {
  if (gnss_speed_ < 2 && !airborne_) {
    const Vector3d fix(g.latitude_deg, g.longitude_deg, g.altitude_m);
    origin_sum_ += fix;
    ++origin_count_;
    if (origin_count_ < p.origin_fixes) return;
    origin_sum_ /= static_cast<double>(origin_count_);
    set_origin(origin_sum_.x(), origin_sum_.y(), origin_sum_.z());
  } else {
    set_origin(g.latitude_deg, g.longitude_deg, g.altitude_m);
  }
  seen_.baro_zero = false;
}

inline void Navigator::gnss(const Gnss& g, double valid_s, const Params& p) {
  if (!good(g)) return;
  gnss_s_ = time_s_;
  gnss_speed_ = eigen(g.velocity_mps).norm();
  if (g.utc_ns > 0 && !seen_.year) {
    year_ = decimal_year(g.utc_ns);
    seen_.year = true;
    seen_.field = false;
  }
  if (!seen_.field) magnetic_model(g.latitude_deg, g.longitude_deg, g.altitude_m);
  if (!seen_.origin) collect_origin(g, p);
  if (!aligned()) {
    if (!resting_) align_in_flight(g, valid_s - p.gnss_delay, p);
    return;
  }
  if (!at_fix(valid_s, p).known) return;
  if (!seen_.yaw) yaw_from_course(eigen(g.velocity_mps));
  if (!stuck(health_.velocity)) {
    if (test_heading(g, valid_s, p)) return;
    gnss_velocity(g, valid_s, p);
    if (mode_ == Mode::trying) try_attitude(p);
    if (!aligned()) return;
  }
  if (seen_.origin) gnss_position(g, valid_s, p);
  bound_delay(p);
}

/// A receiver whose velocity lags for another reason looks late. Beyond the filter's memory of the past no
/// fix would be used any more.
inline void Navigator::bound_delay(const Params& p) {
  const double most = 4 * p.gnss_delay_std, delay_s = filter_.state().gnss_delay_s;
  if (std::abs(delay_s) <= most) return;
  ekf::Vector dx = ekf::Vector::Zero();
  dx(ekf::delay) = std::clamp(delay_s, -most, most) - delay_s;
  filter_.correct(dx);
}

/// State at the time of the fix, by the estimated delay. It may be a little ahead of the present for a fix
/// with hardly any delay.
inline ErrorStateEkf::Past Navigator::at_fix(double valid_s, const Params& p) const {
  const double time_s = valid_s - p.gnss_delay - filter_.state().gnss_delay_s;
  ErrorStateEkf::Past past = filter_.at(std::min(time_s, time_s_));
  const double ahead = std::clamp(time_s - time_s_, 0.0, 0.1);
  if (ahead > 0) {
    past.p_n += ahead * past.v_n;
    past.v_n += ahead * acceleration_at(time_s_);
  }
  return past;
}
/// m/s2, NED, from the velocities around that time.
inline Vector3d Navigator::acceleration_at(double time_s) const {
  constexpr double span_s = 0.03;
  const ErrorStateEkf::Past after = filter_.at(time_s + span_s), before = filter_.at(time_s - span_s);
  const double span = before.age_s - after.age_s;
  if (!before.known || span < 0.5 * span_s) return Vector3d::Zero();
  return (after.v_n - before.v_n) / span;
}

/// Adds the change since `before` to the published reset. Changes at one time are one reset.
inline void Navigator::count_reset(const ekf::Nominal& before) {
  const ekf::Nominal& now = filter_.state();
  if (resets_.at_s != time_s_) resets_ = {resets_.count + 1, Vector3d::Zero(), Vector3d::Zero(), 0, time_s_};
  resets_.position_m += now.p_n - before.p_n;
  resets_.velocity_mps += now.v_n - before.v_n;
  resets_.yaw_rad = wrap_pi(resets_.yaw_rad +
                            angle_difference(euler_from(now.q_nb).yaw_rad, euler_from(before.q_nb).yaw_rad));
}

inline void Navigator::gnss_velocity(const Gnss& g, double valid_s, const Params& p) {
  const Vector3d v_n = eigen(g.velocity_mps);
  const ErrorStateEkf::Past past = at_fix(valid_s, p);
  const Vector3d a_n = acceleration_at(time_s_ - past.age_s);
  const auto z = [&](int i) {
    return ekf::late(ekf::velocity(filter_, at_fix(valid_s, p), i, v_n(i)), a_n(i));
  };
  const double std = known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_floor), variance = std * std;
  Vector3d& off = health_.velocity_innovation;
  const std::array fix{z(0), z(1), z(2)};
  for (int i = 0; i < 3; ++i) {
    const ekf::Scalar& one = fix[static_cast<std::size_t>(i)];
    off(i) = one.innovation / filter_.expected_std(one, variance);
  }
  const double slow = samples_in(p.gnss_climb_time, health_.velocity.accepted_s),
               slow_level = samples_in(p.gnss_speed_time, health_.velocity.accepted_s);
  const double n = climb_samples(fix[2].innovation, std, slow, p);
  if (!within({off.x(), off.y(), off.z()}, p.gnss_gate, health_.velocity)) {
    if (time_s_ - std::max(health_.velocity.accepted_s, aligned_s_) < p.gnss_reset_after) return;
    const ekf::Nominal before = filter_.state();
    health_.velocity.believed_s = time_s_;
    filter_.place(filter_.state().p_n, filter_.state().v_n + v_n - past.v_n);
    filter_.forget(ekf::vel, 3, 3 * std);
    filter_.inflate(ekf::theta, 3, 0.1);
    count_reset(before);
  } else {
    health_.level.add({fix[0].innovation, fix[1].innovation}, time_s_);
    // Without another heading, the accelerations of the fixes determine the yaw: then the correlation of
    // their errors counts, or the yaw drifts with them.
    const bool heading = resting_ || time_s_ - health_.heading.accepted_s < heading_lost_s;
    fix_noise_.add({fix[0].innovation, fix[1].innovation, fix[2].innovation}, std, time_s_);
    // After saturation of the unit the attitude is wrong, and every fix has its full weight.
    const double level = !heading ? slow * variance : at_stop() ? variance : fix_noise_.level(slow_level);
    for (int i = 0; i < 3; ++i) {
      const double by_stamp = fix_stamp_std_s * a_n(i);  // jitter of the time stamp
      filter_.fuse(z(i), by_stamp * by_stamp + (i < 2 ? level : fix_noise_.climb(n)), 1e3);
    }
  }
  health_.velocity.accepted_s = time_s_;
}

/// By how much the variance of a climb is multiplied: by `slow`, as its error is, but for one that goes on
/// contradicting.
inline double Navigator::climb_samples(double innovation_mps, double std, double slow, const Params& p) {
  const double dt = std::clamp(time_s_ - climb_seen_s_, 0.0, 10.0);
  climb_seen_s_ = time_s_;
  climb_off_mps_ += (innovation_mps - climb_off_mps_) * (1 - std::exp(-dt / climb_off_s));
  const double doubt = std::pow(climb_off_mps_ / std::max(p.gnss_climb_doubt.value, std), 8);
  return 1 + (slow - 1) / (1 + doubt);
}

/// Sets the position to a fix: the first one, or one accepted after a time-out.
inline void Navigator::place(const Gnss& g, double time_s, const Params& p) {
  if (!seen_.origin) return;
  const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
  filter_.place(p_n + std::max(time_s_ - time_s, 0.0) * filter_.state().v_n, filter_.state().v_n);
  filter_.noise.gnss_std = known(g.horizontal_std_m, p.gnss_horizontal_std, p.gnss_position_floor);
  forget_level();
  filter_.forget(ekf::pos + 2, 1, known(g.vertical_std_m, p.gnss_vertical_std, 1));
  // On the ground the start height is more accurate than the receiver, unless the receiver contradicts.
  if (resting_)
    filter_.fuse(ekf::position(filter_, filter_.at(time_s_), 2, -p.start_height),
                 p.start_height_std * p.start_height_std, p.gnss_gate);
  seen_.position = seen_.height = true;
  seen_.baro_zero = false;
  height_off_m_ = 0;
}

/// The horizontal position was set to that of the receiver: the sum of position and GNSS error is known.
inline void Navigator::forget_level() {
  const double std = filter_.noise.gnss_std;
  filter_.forget(ekf::pos, 2, 1e3);
  filter_.forget(ekf::gnss, 2, std);
  const ErrorStateEkf::Past now = filter_.at(time_s_);
  for (int i = 0; i < 2; ++i) filter_.fuse(ekf::position(filter_, now, i, now.p_n(i)), std * std, 1e9);
}

inline void Navigator::align_in_flight(const Gnss& g, double time_s, const Params& p) {
  const Vector3d v_n = eigen(g.velocity_mps);
  const bool has_mag = seen_.field && time_s_ - mag_s_ < 0.5;
  const Vector3d wind_n(filter_.state().wind.x(), filter_.state().wind.y(), 0);
  const auto found =
      flight_.fix(v_n, {p.gravity, has_mag ? &field_n_ : nullptr, regaining() ? &wind_n : nullptr,
                        std::clamp(time_s_ - time_s, 0.0, 1.0)});
  if (!found || v_n.head<2>().norm() < p.min_airspeed) return;
  if (regaining()) {
    regain(g, *found, has_mag, time_s, p);
    return;
  }
  begin_in_flight(g, *found, time_s, p);
}

/// The first attitude in flight: that of the fix, then integrated to the present by the inertial samples. Its
/// errors come from the velocities, their age, the biases and the second direction, and correlate with them:
/// e is the error of the mean specific force, theta = f x e / f^2, and the turn about f that keeps the second
/// direction m in the plane of both.
inline void Navigator::begin_in_flight(const Gnss& g, const FlightAlignment::Found& found, double time_s,
                                       const Params& p) {
  const double now_s = time_s_, T = found.window_s;
  const double v_std = std::hypot(known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_floor), 0.05);
  ekf::Nominal x;
  x.q_nb = found.then_nb;
  x.v_n = eigen(g.velocity_mps);
  const FieldDrift::Bias gyro = flight_.drift().bias(p.gyro_bias_std, p.mag_deviation);
  const Matrix3d gyro_std = gyro.covariance.llt().matrixL();
  x.gyro_bias = gyro.bias_b;
  x.q_nb = x.q_nb * exp_map(-0.5 * T * gyro.bias_b);
  begin(x, p, std::min(time_s, now_s), 0, 0);
  const Vector3d& f_n = found.f_n;
  const Vector3d up = f_n.normalized(), across = found.second_n - up * up.dot(found.second_n);
  const Matrix3d tilt = skew(f_n) / f_n.squaredNorm(),
                 theta_e =
                     tilt + up * (up.dot(found.second_n) / across.squaredNorm()) * across.transpose() * tilt;
  const Matrix3d R_nb = x.q_nb.toRotationMatrix(), one = Matrix3d::Identity();
  Eigen::Matrix<double, ekf::size, 21> A = Eigen::Matrix<double, ekf::size, 21>::Zero();
  const auto part = [&](int row, int column) { return A.block<3, 3>(row, column); };
  part(ekf::theta, 0) = -v_std / T * theta_e;  // of the first velocity, of the second
  part(ekf::theta, 3) = v_std / T * theta_e;
  part(ekf::vel, 3) = v_std * one;
  part(ekf::theta, 6) = -0.5 * T * R_nb * gyro_std;
  part(ekf::gyro_bias, 6) = gyro_std;
  part(ekf::theta, 9) = p.accel_bias_std * theta_e * R_nb;
  part(ekf::accel_bias, 9) = p.accel_bias_std * one;
  part(ekf::theta, 12) = 0.5 * p.gap_accel_std * found.unseen_s / T * theta_e;
  const auto row = [&](int first, int column) { return A.block<3, 1>(first, column); };
  row(ekf::theta, 15) = p.gnss_delay_std * theta_e * found.jerk_n;
  row(ekf::vel, 15) = p.gnss_delay_std * found.a_n;
  A(ekf::delay, 15) = p.gnss_delay_std;
  // The heading of the field is less certain than its direction, by its horizontal share; only the part of
  // the direction across the specific force counts.
  const double field = field_n_.head<2>().norm() / across.norm();
  if (found.by_field) row(ekf::theta, 16) = p.mag_deviation * field * up;
  A(ekf::heading, 16) = p.mag_deviation;
  row(ekf::theta, 17) = (found.by_field ? 0.04 * field : 0.4) * up;
  for (const auto& [first, count] :
       {std::pair{+ekf::theta, 6}, {+ekf::gyro_bias, 6}, {+ekf::delay, 1}, {+ekf::heading, 1}})
    filter_.forget(first, count, 0);
  filter_.set_covariance(filter_.covariance() + A * A.transpose());
  seen_.yaw = true;
  place(g, time_s_, p);
  located_ = seen_.position;
  flight_.since(now_s - time_s_, [&](const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    filter_.predict(omega_b, f_b, dt);
  });
  time_s_ = aligned_s_ = now_s;
  nose_until_s_ = now_s + 10;
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
    ekf::Scalar a;
    a.H.segment<3>(ekf::theta) = -skew(f_n).row(i);
    a.H.segment<3>(ekf::accel_bias) = -filter_.R_nb().row(i);
    std = std::max(std, filter_.expected_std(a, 0) / filter_.gravity_mps2);
  }
  std = std::max({std, filter_.std(ekf::theta), filter_.std(ekf::theta + 1)});
  if (std < tilt_std && std::abs(health_.velocity.ratio) < max_ratio) mode_ = Mode::running;
}

/// The first fix after a gap that ends an alignment. The barometer goes on from where it was, if the receiver
/// does not contradict it: its offset is known better than the height by one fix, and the height must not
/// jump.
inline void Navigator::regain(const Gnss& g, const FlightAlignment::Found& found, bool has_mag, double time_s,
                              const Params& p) {
  const bool zeroed = seen_.baro_zero;
  const ekf::Nominal before = filter_.state();
  const double tilt = known(g.speed_std_mps, p.gnss_speed_std, 0.1) / (p.gravity * found.window_s);
  begin_again(found.q_nb, eigen(g.velocity_mps) + found.since_n, p, std::clamp(1.5 * tilt, 0.05, 0.2),
              has_mag ? 0.15 : 0.4);
  seen_.yaw = true;
  place(g, time_s, p);
  count_reset(before);
  health_.horizontal.accepted_s = health_.velocity.accepted_s = health_.height.accepted_s = time_s_;
  if (!zeroed || time_s_ - baro_s_ > 0.5) return;
  const double std =
      p.baro_noise * ekf::metres_per_pascal(standard_air(altitude_m_ - filter_.state().p_n.z())) + 0.5;
  seen_.baro_zero = filter_.fuse(pressure_height(baro_pa_), std * std, 3).accepted;
}

inline void Navigator::gnss_position(const Gnss& g, double valid_s, const Params& p) {
  const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
  if (!seen_.position) {
    const ekf::Nominal before = filter_.state();
    place(g, time_s_ - at_fix(valid_s, p).age_s, p);
    if (std::exchange(located_, true)) count_reset(before);
    health_.horizontal.accepted_s = health_.height.accepted_s = time_s_;
    return;
  }
  const double h_std = known(g.horizontal_std_m, p.gnss_horizontal_std, p.gnss_position_floor);
  const double v_std = known(g.vertical_std_m, p.gnss_vertical_std, p.gnss_position_floor);
  const auto z = [&](int i) {
    const ErrorStateEkf::Past past = at_fix(valid_s, p);
    return ekf::late(ekf::position(filter_, past, i, p_n(i)), past.v_n(i));
  };
  const double variance = h_std * h_std;
  filter_.noise.gnss_std = h_std;
  for (int i = 0; i < 2; ++i) {
    const ekf::Scalar fix = z(i);
    health_.position_innovation(i) = fix.innovation / filter_.expected_std(fix, variance);
  }
  const Vector3d& off = health_.position_innovation;
  Aid& level = health_.horizontal;
  // While the velocity is accepted.
  const bool asked = airborne_ && !stuck(level) && health_.velocity.refused_from_s == never &&
                     time_s_ - health_.velocity.believed_s > 60;
  if (asked)
    health_.wander.fix(p_n.head<2>(), eigen(g.velocity_mps).head<2>(), h_std, valid_s);
  else
    health_.wander.missed();
  level.contradicts = asked && health_.wander.wanders();
  if (stuck(level) || (asked && health_.wander.doubted())) {
    // Whatever the time: an aircraft does not stand in the air, and moves with its velocity.
  } else if (within({off.x(), off.y()}, p.gnss_gate, level)) {
    for (int i = 0; i < 2; ++i) filter_.fuse(z(i), variance, 1e3);
  } else if (time_s_ - std::max(level.accepted_s, aligned_s_) > patience_s(level, p) &&
             !level.innovations.noisy()) {
    const ekf::Nominal before = filter_.state();
    Vector3d moved = before.p_n;
    moved.head<2>() += Vector2d(z(0).innovation, z(1).innovation);
    filter_.place(moved, before.v_n);
    forget_level();
    count_reset(before);
    level.accepted_s = level.believed_s = time_s_;
  }
  if (!stuck(health_.height)) gnss_height(z(2), v_std, p);
}

/// Receiver and barometer can both be wrong, so their difference is resolved over seconds without a step of
/// the height, even after a long rejection. Only a difference that no flight resolves by degrees is set.
inline void Navigator::gnss_height(const ekf::Scalar& z, double std, const Params& p) {
  const double dt = std::clamp(time_s_ - height_seen_s_, 0.0, 10.0),
               refused_s = time_s_ - std::max(health_.height.accepted_s, aligned_s_);
  height_seen_s_ = time_s_;
  height_off_m_ += (z.innovation - height_off_m_) * (1 - std::exp(-dt / height_off_s));
  health_.position_innovation.z() = z.innovation / filter_.expected_std(z, std * std);
  const double variance = height_variance(z, std, p);  // by when one was accepted before this one
  const bool agrees = within({health_.position_innovation.z()}, p.gnss_gate, health_.height);
  // A single fix of a scattering receiver is not accepted, however long it is rejected.
  if (!agrees && (refused_s <= p.gnss_reset_after || health_.height.innovations.noisy())) return;
  if (agrees || std::abs(z.innovation) < height_set_m) {
    filter_.fuse(z, variance, 1e9);  // not counted as accepted by its gate, so that the next one is used too
    return;
  }
  const ekf::Nominal before = filter_.state();
  filter_.place(before.p_n + Vector3d(0, 0, z.innovation), before.v_n);
  filter_.forget(ekf::pos + 2, 1, std);
  count_reset(before);
  seen_.baro_zero = false;
  height_off_m_ = 0;
  health_.height.accepted_s = time_s_;
}

/// Its error is slow, so a fix has little weight; the weight grows steeply with the duration and size of a
/// contradiction. The possible motion bounds the variance from below.
inline double Navigator::height_variance(const ekf::Scalar& z, double std, const Params& p) const {
  const double doubt = std::pow(height_off_m_ / std::max(p.gnss_height_doubt.value, std), 8);
  const double known = filter_.expected_std(z, 0);
  return std::max(samples_in(p.gnss_height_time, health_.height.accepted_s) * std * std / (1 + doubt),
                  known * known * (std::abs(z.innovation) / height_step_m - 1));
}

}  // namespace fulmar::navigation
