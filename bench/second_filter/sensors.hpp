// SPDX-License-Identifier: BSD-3-Clause
// Measurements of the navigator (navigator.hpp): GNSS, magnetometer, barometer, pitot, zero sideslip.
#pragma once
#include "bench/second_filter/alignment.hpp"

namespace fulmar::second_filter {

// ---- air data

inline void Navigator::baro(double pressure_pa, const Params& p) {
  if (!(pressure_pa > 1e4 && pressure_pa < 1.2e5)) return;
  baro_s_ = time_s_;
  baro_pa_ = pressure_pa;
  if (!seen_.origin && !seen_.altitude) {
    altitude_m_ = pressure_altitude(pressure_pa);
    seen_.altitude = true;
  }
  if (!aligned() || health_.baro.stuck(airborne_)) return;
  air_ = standard_air(altitude_m_ - filter_(pos + 2));
  const auto z = [&] { return baro_height(filter_, pressure_pa, altitude_m_, airborne_); };
  const double dynamic_pa =
      airborne_ ? 0.5 * air_.density_kgm3 * filter_.state().through_air_n().squaredNorm() : 0;
  const double load = filter_.specific_force_b().norm() / p.gravity - 1;
  const double std =
      std::hypot(p.baro_noise, p.baro_load_error * load * dynamic_pa) * metres_per_pascal(air_);
  if (!seen_.baro_zero) {  // its offset follows from the height, or without one the height is 0
    if (!seen_.height) filter_.forget(pos + 2, 1, 0.5);
    filter_.forget(baro_bias, 1, 100);
    filter_.fuse(z(), std * std, 1e9, all_);
    seen_.height = seen_.baro_zero = true;
    return;
  }
  fuse(z(), std * std, p, health_.baro);
}

inline void Navigator::pitot(double pressure_pa, const Params& p) {
  if (!std::isfinite(pressure_pa)) return;
  if (time_s_ - baro_s_ > 1) air_ = standard_air(altitude_m_ - (aligned() ? filter_(pos + 2) : 0));
  const double Va = p.pitot_scale * std::sqrt(2 * std::max(pressure_pa, 0.0) / air_.density_kgm3);
  const double dt = std::clamp(time_s_ - pitot_s_, 0.0, 1.0);
  pitot_mps_ = pitot_s_ == never ? Va : pitot_mps_ + (Va - pitot_mps_) * (1 - std::exp(-dt / 0.2));
  pitot_s_ = time_s_;
  if (!aligned() || !airborne_ || health_.pitot.stuck(airborne_)) return;
  const double per_speed = air_.density_kgm3 * filter_.state().through_air_n().norm(),  // Pa per m/s
      by_speed = p.pitot_speed_std * per_speed, late = late_mps_ * per_speed;
  // A late sample is that of another airspeed: in a launch by several m/s.
  const double variance =
      (p.pitot_noise * p.pitot_noise + by_speed * by_speed) * health_.pitot.level.white() + late * late;
  const Scalar z = tube_pressure(filter_, pressure_pa, air_.density_kgm3, 1 / p.pitot_scale);
  const Fused fused = filter_.fuse(z, variance, p.gate, all_, health_.pitot.insists(time_s_));
  health_.pitot.record(fused, time_s_, true);
  health_.refused += !fused.accepted;
}

inline void Navigator::sideslip(const Params& p) {
  sideslip_s_ = time_s_;
  const double variance = p.sideslip_noise * p.sideslip_noise * health_.sideslip.level.white();
  health_.sideslip.record(filter_.fuse(coordinated(filter_), variance, p.gate, by_air_), time_s_, true);
}

// ---- magnetometer

inline void Navigator::mag(const Vector3d& field_b, const Params& p) {
  const double strength = field_b.norm();
  if (!(strength > 1e-6) || !field_b.allFinite()) return;
  mag_s_ = time_s_;
  mag_b_ = field_b;
  if (!aligned()) {
    flight_.mag(field_b);
    return;
  }
  if (!seen_.field || field_n_.head<2>().norm() < 0.15 * field_n_.norm()) return;  // near the poles
  if (time_s_ - mag_fused_s_ < 0.1 - 1e-4) return;  // its errors are correlated
  mag_fused_s_ = time_s_;
  if (health_.heading.stuck(airborne_)) return;
  if (strength_ == 0) strength_ = strength;
  if (!seen_.yaw) yaw_from_field(field_b);
  constexpr double tilted = 0.05;  // rad, standard deviation: a wrong tilt turns the yaw that a field shows
  if (std::max(filter_.std(theta), filter_.std(theta + 1)) > tilted) return;
  const Vector3d m_n = field_n_.normalized();
  const double variance = p.mag_noise * p.mag_noise * health_.heading.level.white();
  Vector3d ratio;
  for (int i = 0; i < 3; ++i) {
    const Scalar z = field(filter_, m_n, i, field_b(i) / strength_);
    ratio(i) = z.innovation / filter_.expected_std(z, variance);
  }
  within({ratio.x(), ratio.y(), ratio.z()}, p, health_.heading);
  for (int i = 0; i < 3; ++i)
    filter_.fuse(field(filter_, m_n, i, field_b(i) / strength_), variance, p.gate, by_field_,
                 health_.heading.insists(time_s_));
}

/// A magnetometer that wakes up after the alignment.
inline void Navigator::yaw_from_field(const Vector3d& field_b) {
  const Nominal before = filter_.state();
  const Vector3d m = before.q_nb * field_b;
  const double turn = wrap_pi(declination() - std::atan2(m.y(), m.x()));
  filter_.set_attitude(exp_map({0, 0, turn}) * before.q_nb);
  filter_.forget(theta + 2, 1, 1);
  seen_.yaw = true;
  count_reset(before);
}

// ---- GNSS

inline bool Navigator::within(std::initializer_list<double> ratios, const Params& p, Aid& aid) {
  Fused fused{true, 0};
  double squares = 0;
  for (const double ratio : ratios) {
    squares += ratio * ratio;
    if (!(std::abs(ratio) <= p.gate)) fused.accepted = false;  // no number as well
  }
  fused.ratio = std::sqrt(squares / static_cast<double>(ratios.size()));
  aid.record(fused, time_s_, ratios, airborne_);
  health_.refused += !fused.accepted;
  return fused.accepted;
}

/// Origin by averaging on the ground, by the first fix in the air.
inline void Navigator::collect_origin(const Gnss& g, const Params& p) {
  if (gnss_speed_ < 2 && !airborne_) {
    origin_sum_ += Vector3d(g.latitude_deg, g.longitude_deg, g.altitude_m);
    ++origin_count_;
    if (origin_count_ < p.origin_fixes) return;
    origin_sum_ /= static_cast<double>(origin_count_);
    set_origin(origin_sum_.x(), origin_sum_.y(), origin_sum_.z());
  } else {
    set_origin(g.latitude_deg, g.longitude_deg, g.altitude_m);
  }
  seen_.baro_zero = false;
}

/// The slow errors have the standard deviations that the receiver reports.
inline void Navigator::accuracy(const Gnss& g, const Params& p) {
  const Vector3d now(known(g.horizontal_std_m, p.gnss_horizontal_std, p.gnss_position_least),
                     known(g.vertical_std_m, p.gnss_vertical_std, 1.5 * p.gnss_position_least),
                     known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_least));
  if ((now - fix_std_).cwiseAbs().maxCoeff() < 0.01 * fix_std_.minCoeff()) return;
  fix_std_ = now;
  tune(p);
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
  accuracy(g, p);
  if (!seen_.field) magnetic_model(g.latitude_deg, g.longitude_deg, g.altitude_m);
  if (!seen_.origin) collect_origin(g, p);
  if (!aligned()) {
    if (!resting_) align_in_flight(g, valid_s - p.gnss_delay, p);
    return;
  }
  if (!at_fix(valid_s, p).known) return;
  if (!seen_.yaw) yaw_from_course(eigen(g.velocity_mps));
  if (!health_.velocity.stuck(airborne_)) {
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
  const double most = 4 * p.gnss_delay_std, delay_s = filter_(delay);
  if (std::abs(delay_s) > most) filter_.correct(delay, std::clamp(delay_s, -most, most) - delay_s);
}

/// State at the time of the fix, by the estimated delay. It may be a little ahead of the present for a fix
/// with hardly any delay.
inline Past Navigator::at_fix(double valid_s, const Params& p) const {
  const double time_s = valid_s - p.gnss_delay - filter_(delay);
  Past past = filter_.at(std::min(time_s, time_s_));
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
  const Past after = filter_.at(time_s + span_s), before = filter_.at(time_s - span_s);
  const double span = before.age_s - after.age_s;
  if (!before.known || span < 0.5 * span_s) return Vector3d::Zero();
  return (after.v_n - before.v_n) / span;
}

/// Adds the change since `before` to the published reset. Changes at one time are one reset.
inline void Navigator::count_reset(const Nominal& before) {
  const Nominal& now = filter_.state();
  if (resets_.at_s != time_s_) resets_ = {resets_.count + 1, Vector3d::Zero(), Vector3d::Zero(), 0, time_s_};
  resets_.position_m += now.p_n() - before.p_n();
  resets_.velocity_mps += now.v_n() - before.v_n();
  resets_.yaw_rad = wrap_pi(resets_.yaw_rad +
                            angle_difference(euler_from(now.q_nb).yaw_rad, euler_from(before.q_nb).yaw_rad));
}

/// Without a magnetometer the take-off run shows the yaw.
inline void Navigator::yaw_from_course(const Vector3d& v_n) {
  if (v_n.head<2>().norm() < 5) return;
  const Nominal before = filter_.state();
  Euler e = euler_from(filter_.R_nb());
  e.yaw_rad = std::atan2(v_n.y(), v_n.x());
  filter_.set_attitude(quaternion_from(e));
  filter_.forget(theta + 2, 1, 0.35);
  filter_.place(filter_.state().p_n(), v_n);
  filter_.forget(vel, 3, 1);
  seen_.yaw = true;
  count_reset(before);
}

/// The heading that the accelerations show, where it contradicts the magnetometer: a magnetometer that is
/// mounted wrong is turned; one that is wrong again is not used any more.
inline void Navigator::test_heading(const Vector3d& v_n, double std_mps, double valid_s, const Params& p) {
  constexpr double most_std = 5, sure_rad = 0.15;
  heading_.fix(v_n.head<2>(), std_mps, valid_s - p.gnss_delay - filter_(delay));
  const double error = heading_.error_rad(), std = heading_.std_rad();
  if (resting_ || std > sure_rad || std::abs(error) < most_std * std::hypot(std, filter_.std(theta + 2)))
    return;
  const Nominal before = filter_.state();
  filter_.set_attitude(exp_map({0, 0, error}) * before.q_nb);
  // What the wrong heading has done to tilt and biases.
  filter_.inflate(theta, 2, 0.03);
  filter_.inflate(gyro_bias, 3, 5e-3);
  filter_.inflate(accel_bias, 3, 0.1);
  filter_.forget(theta + 2, 1, 2 * std + 0.05);
  filter_.forget(wind, 2, p.wind_std);
  filter_.forget(gust, 2, filter_.block(gust).std);
  filter_.place(before.p_n(), v_n);
  filter_.forget(vel, 3, std::max(std_mps, 0.5));
  filter_.forget(iron, 3, p.hard_iron_std);
  for (int i = 0; i < 3; ++i) filter_.correct(iron + i, -filter_(iron + i));
  filter_.correct(mount, -error);
  filter_.forget(mount, 1, 2 * std + 0.05);
  health_.heading.faulty_s = time_s_;
  heading_.clear();
  count_reset(before);
}

inline void Navigator::gnss_velocity(const Gnss& g, double valid_s, const Params& p) {
  constexpr double stamp_std_s = 0.004;  // from fix to fix: a receiver solves its epochs in some ms
  const Vector3d v_n = eigen(g.velocity_mps);
  test_heading(v_n, known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_least), valid_s, p);
  const Past past = at_fix(valid_s, p);
  const Vector3d a_n = acceleration_at(time_s_ - past.age_s);
  const auto z = [&](int i) { return fix_velocity(filter_, at_fix(valid_s, p), i, v_n(i), a_n(i)); };
  const double white = p.gnss_white * known(g.speed_std_mps, p.gnss_speed_std, 0.01);
  const auto variance = [&](int i) {
    const double by_stamp = stamp_std_s * a_n(i);
    return by_stamp * by_stamp + health_.velocity.level.white() * white * white;
  };
  Vector3d& off = health_.velocity_innovation;
  const double moved = filter_.take_motion_variance(), dt = time_s_ - fix_s_;
  fix_s_ = time_s_;
  for (int i = 0; i < 3; ++i) {
    const Scalar one = z(i);
    const double std = filter_.expected_std(one, variance(i));
    off(i) = one.innovation / std;
    if (airborne_ && dt < 1)
      motion_level_ = Level::learnt(motion_level_, off(i), 3 * std::min(moved / (std * std), 1.0), dt);
  }
  filter_.unit.motion = std::exp(motion_level_);
  within({off.x(), off.y(), off.z()}, p, health_.velocity);
  for (int i = 0; i < 3; ++i)
    filter_.fuse(z(i), variance(i), p.gate, all_, health_.velocity.insists(time_s_));
}

inline void Navigator::gnss_position(const Gnss& g, double valid_s, const Params& p) {
  const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
  if (!seen_.position) {
    const Nominal before = filter_.state();
    place(g, time_s_ - at_fix(valid_s, p).age_s, p);
    if (std::exchange(located_, true)) count_reset(before);
    health_.horizontal.accepted_s = health_.height.accepted_s = time_s_;
    return;
  }
  const auto z = [&](int i) { return fix_position(filter_, at_fix(valid_s, p), i, p_n(i)); };
  const auto variance = [&](int i) {
    const double white = p.gnss_white * (i < 2 ? fix_std_.x() : fix_std_.y());
    return white * white * (i < 2 ? health_.horizontal : health_.height).level.white();
  };
  Vector3d& off = health_.position_innovation;
  for (int i = 0; i < 3; ++i) {
    const Scalar one = z(i);
    off(i) = one.innovation / filter_.expected_std(one, variance(i));
  }
  if (!health_.horizontal.stuck(airborne_)) {
    within({off.x(), off.y()}, p, health_.horizontal);
    for (int i = 0; i < 2; ++i)
      filter_.fuse(z(i), variance(i), p.gate, all_, health_.horizontal.insists(time_s_));
  }
  if (!health_.height.stuck(airborne_)) {
    within({off.z()}, p, health_.height);
    filter_.fuse(z(2), variance(2), p.gate, all_, health_.height.insists(time_s_));
  }
}

}  // namespace fulmar::second_filter
