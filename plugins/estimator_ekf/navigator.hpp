// SPDX-License-Identifier: BSD-3-Clause
// From sensors to the filter: alignment, which sample is used when and with what noise, recovery. Knows no ports; time is in seconds.
// The filter and its equations: fulmar/flight/ekf.hpp and ekf_models.hpp.
#pragma once
#include <fulmar/flight/ekf_models.hpp>
#include <fulmar/flight/geodesy.hpp>
#include <fulmar/flight/magnetic_model.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/msg/vehicle_status.hpp>

#include "alignment.hpp"
#include "params.hpp"

namespace fulmar::estimator {

inline constexpr double never = -1e9;

/// What the last update of each kind said: innovation in deviations, and how long ago one was accepted.
struct Health {
  double horizontal_ratio = 0, height_ratio = 0, velocity_ratio = 0, baro_ratio = 0, pitot_ratio = 0, sideslip_ratio = 0, heading_ratio = 0;
  double position_s = never, velocity_s = never, height_s = never, baro_s = never, pitot_s = never, heading_s = never;
  std::uint32_t refused = 0;
};

class Navigator {
 public:
  /// Set-up and live changes: noises only.
  void tune(const Params& p) {
    ekf::Noise& n = filter_.noise;
    n.gyro = p.gyro_noise;
    n.gyro_scale = p.gyro_scale_error;
    n.accel = p.accel_noise;
    n.accel_scale = p.accel_scale_error;
    n.gyro_bias_walk = p.gyro_bias_walk;
    n.accel_bias_walk = p.accel_bias_walk;
    n.wind_walk = p.wind_walk;
    n.wind_shear = p.wind_shear;
    n.gust_std = p.gust_std;
    n.gust_time = p.gust_time;
    n.baro_walk = p.baro_walk;
    n.heading_std = p.mag_deviation;
    n.heading_time = p.mag_deviation_time;
    filter_.gravity_mps2 = p.gravity;
  }

  void start(const Params& p) {
    *this = Navigator{};
    tune(p);
    if (p.origin.given()) set_origin(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
  }

  /// Takes over from an estimate that flies already.
  void resume(const VehicleState& s, const Params& p, double time_s) {
    start(p);
    if (s.origin_valid && !origin_known_) set_origin(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
    ekf::Nominal x;
    x.q_nb = eigen(s.attitude);
    x.v_n = eigen(s.velocity_mps);
    x.p_n = eigen(s.position_m);
    x.gyro_bias = eigen(s.gyro_bias_radps);
    x.accel_bias = eigen(s.accel_bias_mps2);
    x.wind = eigen(s.wind_mps).head<2>();
    begin(x, p, time_s, 0.05, 0.05);
    has_imu_ = true;
    const auto at_least = [&](int i, double std, double low, double high) { filter_.forget(i, 1, std::clamp(std, low, high)); };
    for (int i = 0; i < 3; ++i) {
      filter_.forget(ekf::vel + i, 1, 1);
      filter_.forget(ekf::gyro_bias + i, 1, 0.02);
    }
    at_least(ekf::wind, s.wind_std_mps.north, 0.5, p.wind_std);
    at_least(ekf::wind + 1, s.wind_std_mps.east, 0.5, p.wind_std);
    position_known_ = s.position_valid;
    filter_.forget(ekf::pos, 3, s.position_valid ? 5 : 1e3);
    yaw_known_ = true;
  }

  bool aligned() const { return aligned_; }
  bool yaw_known() const { return yaw_known_; }
  bool origin_known() const { return origin_known_; }
  bool position_known() const { return position_known_; }
  bool height_known() const { return height_known_; }
  bool airborne() const { return airborne_; }
  bool resting() const { return resting_; }
  const ErrorStateEkf& filter() const { return filter_; }
  const Health& health() const { return health_; }
  LocalFrame::Geodetic origin() const { return frame_.origin(); }
  double pitot_mps() const { return pitot_mps_; }  ///< smoothed true airspeed of the tube alone
  double time_s() const { return time_s_; }

  void status(const VehicleStatus& s) {
    has_status_ = true;
    armed_ = s.armed;
    on_ground_ = s.on_ground;
  }

  /// One inertial sample, valid at `time_s`. False: it is not newer than the last one and was ignored.
  bool imu(const Vector3d& omega_b, const Vector3d& f_b, double time_s, const Params& p) {
    const double dt = time_s - time_s_;
    if (has_imu_ && !(dt > 0)) return false;
    time_s_ = time_s;
    if (!has_imu_) {
      has_imu_ = true;
      return true;
    }
    still_.update(omega_b, f_b, dt);
    resting_ = still_.still() && at_rest_by_others(p);
    if (!aligned_) {
      flight_.imu(omega_b, f_b, dt);
      if (resting_) align_at_rest(p);
      return true;
    }
    if (dt > p.max_imu_gap)
      filter_.skip(dt, 0.5, 5);
    else
      filter_.predict(omega_b, f_b, dt);
    if (resting_ && time_s_ - rest_fused_s_ > 0.05) rest(p);
    update_airborne(p);
    if (airborne_ && yaw_known_ && time_s_ - sideslip_s_ > 0.1 - 1e-4) sideslip(p);
    return true;
  }

  void gnss(const Gnss& g, double valid_s, const Params& p);
  void mag(const Vector3d& field_b, const Params& p);
  void baro(double pressure_pa, const Params& p);
  void pitot(double pressure_pa, const Params& p);

 private:
  static bool good(const Gnss& g) {
    const bool solved = g.fix == FixType::fix_3d || g.fix == FixType::combined || g.fix == FixType::rtk_float || g.fix == FixType::rtk_fixed;
    return solved && std::abs(g.latitude_deg) <= 90 && std::abs(g.longitude_deg) <= 360 && std::isfinite(g.altitude_m) &&
           eigen(g.velocity_mps).allFinite();
  }
  static double known(double reported, double otherwise, double floor) {
    const double std = reported > 0 && reported < 1e6 ? reported : otherwise;
    return std::max(std, floor);
  }

  void set_origin(double lat_deg, double lon_deg, double alt_m) {
    frame_ = LocalFrame(lat_deg, lon_deg, alt_m);
    origin_known_ = true;
    altitude_m_ = alt_m;
    magnetic_model(lat_deg, lon_deg, alt_m);
  }
  void magnetic_model(double lat_deg, double lon_deg, double alt_m) {
    field_n_ = magnetic_field_ned(lat_deg, lon_deg, alt_m, year_);
    field_known_ = true;
  }
  double declination() const { return std::atan2(field_n_.y(), field_n_.x()); }

  /// Nothing but the inertial unit can be fooled by a smooth flight: another witness has to agree that the aircraft stands.
  bool at_rest_by_others(const Params& p) const {
    const bool gnss_slow = time_s_ - gnss_s_ < 2 && gnss_speed_ < 1.5, gnss_fast = time_s_ - gnss_s_ < 2 && gnss_speed_ >= 1.5;
    const bool pitot_slow = time_s_ - pitot_s_ < 1 && pitot_mps_ < p.min_airspeed;
    if (gnss_fast || (has_status_ && armed_)) return false;
    return has_status_ || gnss_slow || pitot_slow;
  }

  void begin(const ekf::Nominal& x, const Params& p, double time_s, double tilt_std, double yaw_std) {
    ekf::Vector std;
    std.segment<2>(ekf::theta).setConstant(tilt_std);
    std(ekf::theta + 2) = yaw_std;
    std.segment<3>(ekf::vel).setConstant(1);
    std.segment<3>(ekf::pos).setConstant(1e3);
    std.segment<3>(ekf::gyro_bias).setConstant(p.gyro_bias_std);
    std.segment<3>(ekf::accel_bias).setConstant(p.accel_bias_std);
    std.segment<2>(ekf::wind).setConstant(p.wind_std);
    std(ekf::gust) = p.gust_std;
    std(ekf::baro) = 100;
    std(ekf::heading) = p.mag_deviation;
    time_s_ = time_s;
    filter_.reset(x, std, time_s);
    aligned_ = true;
    aligned_s_ = time_s;
    yaw_known_ = yaw_std < 0.5;
  }

  void align_at_rest(const Params& p) {
    if (rest_since_s_ < 0) rest_since_s_ = time_s_;
    const bool has_mag = time_s_ - mag_s_ < 0.5;
    if (!has_mag && time_s_ - rest_since_s_ < 2) return;  // a magnetometer may still wake up
    ekf::Nominal x;
    const Vector3d f_b = still_.f();
    x.q_nb = has_mag ? attitude_at_rest(f_b, mag_b_, declination()) : attitude_at_rest(f_b);
    x.gyro_bias = still_.omega();
    // At rest nothing but the accelerometers tells the tilt, and tilt the yaw by the dip of the field: no prior of their own, the updates at
    // rest tie them to the prior of the accelerometer bias.
    begin(x, p, time_s_, 0.5, has_mag ? 1 : 1.8);
    yaw_known_ = has_mag;
    filter_.forget(ekf::gyro_bias, 3, 0.01);
    rest(p);
    if (has_mag) mag(mag_b_, p);
  }

  void align_in_flight(const Gnss& g, double time_s, const Params& p) {
    const Vector3d v_n = eigen(g.velocity_mps);
    const bool has_mag = field_known_ && time_s_ - mag_s_ < 0.5;
    const auto q_nb = flight_.fix(v_n, p.gravity, has_mag ? &field_n_ : nullptr);
    if (!q_nb || v_n.head<2>().norm() < p.min_airspeed) return;
    ekf::Nominal x;
    x.q_nb = *q_nb;
    x.v_n = v_n;
    begin(x, p, time_s_, 0.2, has_mag ? 0.3 : 0.4);
    yaw_known_ = true;
    place(g, time_s, p);
  }

  void rest(const Params&) {
    rest_fused_s_ = time_s_;
    const ErrorStateEkf::Past now = filter_.at(time_s_);
    for (int i = 0; i < 3; ++i) filter_.fuse(ekf::velocity(filter_, now, i, 0), 0.05 * 0.05, 1e3);
    for (int i = 0; i < 3; ++i) filter_.fuse(ekf::zero_rate(filter_.state(), i, still_.omega()(i)), 2e-3 * 2e-3, 1e3);
  }

  void update_airborne(const Params& p) {
    const double limit = airborne_ ? 0.7 * p.min_airspeed : p.min_airspeed;
    const double Va = ekf::air_velocity(filter_.state()).norm();
    const bool fast = Va > limit || (time_s_ - pitot_s_ < 1 && pitot_mps_ > limit && filter_.state().v_n.norm() > 0.5 * limit);
    airborne_ = fast && !resting_ && !(has_status_ && !armed_ && on_ground_);
  }

  void sideslip(const Params& p) {
    sideslip_s_ = time_s_;
    const double side = p.sideslip_ratio * ekf::air_velocity(filter_.state()).norm();
    const double variance = p.sideslip_speed_std * p.sideslip_speed_std + side * side;
    health_.sideslip_ratio = filter_.fuse_considering_attitude(ekf::zero_sideslip(filter_.state()), variance, p.air_gate).ratio;
  }

  void place(const Gnss& g, double time_s, const Params& p);
  void collect_origin(const Gnss& g, const Params& p);
  void gnss_velocity(const Gnss& g, const ErrorStateEkf::Past& past, double time_s, const Params& p);
  void gnss_position(const Gnss& g, double time_s, const Params& p);
  void yaw_from_course(const Vector3d& v_n);
  void yaw_from_field(const Vector3d& field_b);

  ErrorStateEkf filter_;
  LocalFrame frame_;
  Stillness still_;
  FlightAlignment flight_;
  Health health_;
  Vector3d field_n_{2e-5, 0, 4e-5}, mag_b_ = Vector3d::Zero();
  Vector3d origin_sum_ = Vector3d::Zero();
  Air air_;
  double year_ = 2026.0, altitude_m_ = 0;  ///< of the origin; without one: by pressure
  double time_s_ = 0, aligned_s_ = 0, rest_since_s_ = never, rest_fused_s_ = never, sideslip_s_ = never;
  double gnss_s_ = never, gnss_speed_ = 0, mag_s_ = never, mag_fused_s_ = never, pitot_s_ = never, pitot_mps_ = 0, baro_s_ = never, pitot_refused_s_ = never;
  std::int64_t origin_count_ = 0;
  bool has_imu_ = false, aligned_ = false, yaw_known_ = false, origin_known_ = false, position_known_ = false, height_known_ = false;
  bool field_known_ = false, year_known_ = false, baro_zeroed_ = false, altitude_known_ = false;
  bool has_status_ = false, armed_ = false, on_ground_ = false, resting_ = false, airborne_ = false;
};

/// Origin by averaging on the ground, by the first fix in the air.
inline void Navigator::collect_origin(const Gnss& g, const Params& p) {
  if (gnss_speed_ < 2 && !airborne_) {
    const Vector3d fix(g.latitude_deg, g.longitude_deg, g.altitude_m);
    if (origin_count_ == 0) origin_sum_.setZero();
    origin_sum_ += fix;
    ++origin_count_;
    if (origin_count_ < p.origin_fixes) return;
    origin_sum_ /= static_cast<double>(origin_count_);
    set_origin(origin_sum_.x(), origin_sum_.y(), origin_sum_.z());
  } else {
    set_origin(g.latitude_deg, g.longitude_deg, g.altitude_m);
  }
  baro_zeroed_ = false;
}

inline void Navigator::gnss(const Gnss& g, double valid_s, const Params& p) {
  if (!good(g)) return;
  gnss_s_ = time_s_;
  gnss_speed_ = eigen(g.velocity_mps).norm();
  if (g.utc_ns > 0 && !year_known_) {
    year_ = decimal_year(g.utc_ns);
    year_known_ = true;
    field_known_ = false;
  }
  if (!field_known_) magnetic_model(g.latitude_deg, g.longitude_deg, g.altitude_m);
  if (!origin_known_) collect_origin(g, p);
  if (!aligned_) {
    if (!resting_) align_in_flight(g, valid_s - p.gnss_delay, p);
    return;
  }
  const double time_s = std::min(valid_s - p.gnss_delay, time_s_);
  const ErrorStateEkf::Past past = filter_.at(time_s);
  if (!past.known) return;
  if (!yaw_known_) yaw_from_course(eigen(g.velocity_mps));
  gnss_velocity(g, past, time_s, p);
  if (origin_known_) gnss_position(g, time_s, p);
}

/// Without a magnetometer the take-off run shows the yaw.
inline void Navigator::yaw_from_course(const Vector3d& v_n) {
  if (v_n.head<2>().norm() < 5) return;
  Euler e = euler_from(filter_.R_nb());
  e.yaw_rad = std::atan2(v_n.y(), v_n.x());
  filter_.set_attitude(quaternion_from(e));
  filter_.forget(ekf::theta + 2, 1, 0.35);
  filter_.place(filter_.state().p_n, v_n);
  filter_.forget(ekf::vel, 3, 1);
  yaw_known_ = true;
}

inline void Navigator::gnss_velocity(const Gnss& g, const ErrorStateEkf::Past& past, double time_s, const Params& p) {
  const Vector3d v_n = eigen(g.velocity_mps);
  const double std = known(g.speed_std_mps, p.gnss_speed_std, p.gnss_speed_floor), variance = std * std;
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    const ekf::Scalar z = ekf::velocity(filter_, past, i, v_n(i));
    worst = std::max(worst, std::abs(z.innovation) / filter_.expected_std(z, variance));
  }
  health_.velocity_ratio = worst;
  if (worst > p.gnss_gate) {
    ++health_.refused;
    if (time_s_ - std::max(health_.velocity_s, aligned_s_) < p.gnss_reset_after) return;
    filter_.place(filter_.state().p_n, filter_.state().v_n + v_n - past.v_n);
    filter_.forget(ekf::vel, 3, 3 * std);
    filter_.inflate(ekf::theta, 3, 0.1);
  } else {
    for (int i = 0; i < 3; ++i) filter_.fuse(ekf::velocity(filter_, filter_.at(time_s), i, v_n(i)), variance, 1e3);
  }
  health_.velocity_s = time_s_;
}

/// The first fix, and the one that is believed after all.
inline void Navigator::place(const Gnss& g, double time_s, const Params& p) {
  if (!origin_known_) return;
  const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
  filter_.place(p_n + std::max(time_s_ - time_s, 0.0) * filter_.state().v_n, filter_.state().v_n);
  filter_.forget(ekf::pos, 2, known(g.horizontal_std_m, p.gnss_horizontal_std, 1));
  filter_.forget(ekf::pos + 2, 1, known(g.vertical_std_m, p.gnss_vertical_std, 1));
  position_known_ = height_known_ = true;
  baro_zeroed_ = false;
}

inline void Navigator::gnss_position(const Gnss& g, double time_s, const Params& p) {
  const Vector3d p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
  if (!position_known_) {
    place(g, time_s, p);
    health_.position_s = health_.height_s = time_s_;
    return;
  }
  const double h_std = known(g.horizontal_std_m, p.gnss_horizontal_std, p.gnss_position_floor);
  const double v_std = known(g.vertical_std_m, p.gnss_vertical_std, p.gnss_position_floor);
  const auto z = [&](int i) { return ekf::position(filter_, filter_.at(time_s), i, p_n(i)); };
  const double variance = h_std * h_std;
  health_.horizontal_ratio =
      std::max(std::abs(z(0).innovation) / filter_.expected_std(z(0), variance), std::abs(z(1).innovation) / filter_.expected_std(z(1), variance));
  if (health_.horizontal_ratio <= p.gnss_gate) {
    for (int i = 0; i < 2; ++i) filter_.fuse(z(i), variance, 1e3);
    health_.position_s = time_s_;
  } else if (++health_.refused; time_s_ - std::max(health_.position_s, aligned_s_) > p.gnss_reset_after) {
    Vector3d moved = filter_.state().p_n;
    moved.head<2>() += Eigen::Vector2d(z(0).innovation, z(1).innovation);
    filter_.place(moved, filter_.state().v_n);
    filter_.forget(ekf::pos, 2, h_std);
    health_.position_s = time_s_;
  }
  const ekf::Fused height = filter_.fuse(z(2), v_std * v_std, p.gnss_gate);
  health_.height_ratio = height.ratio;
  if (height.accepted) {
    health_.height_s = time_s_;
  } else if (++health_.refused; time_s_ - std::max(health_.height_s, aligned_s_) > p.gnss_reset_after) {
    filter_.place(filter_.state().p_n + Vector3d(0, 0, z(2).innovation), filter_.state().v_n);
    filter_.forget(ekf::pos + 2, 1, v_std);
    baro_zeroed_ = false;
    health_.height_s = time_s_;
  }
}

inline void Navigator::mag(const Vector3d& field_b, const Params& p) {
  const double strength = field_b.norm();
  if (!(strength > 1e-6) || !field_b.allFinite()) return;
  mag_s_ = time_s_;
  mag_b_ = field_b;
  if (!aligned_) {
    flight_.mag(field_b);
    return;
  }
  const double horizontal = field_n_.head<2>().norm() / field_n_.norm();
  if (!field_known_ || horizontal < 0.15) return;  // near the magnetic poles the needle does not know
  if (time_s_ - mag_fused_s_ < 0.1 - 1e-4) return;  // its errors are correlated: more samples would not be more information
  mag_fused_s_ = time_s_;
  if (!yaw_known_) yaw_from_field(field_b);
  const double std = p.mag_noise / horizontal;
  const ekf::Fused fused = filter_.fuse(ekf::magnetic_heading(filter_.state(), field_b, declination()), std * std, p.mag_gate);
  health_.heading_ratio = fused.ratio;
  if (fused.accepted)
    health_.heading_s = time_s_;
  else
    ++health_.refused;
}

/// A magnetometer that wakes up after the alignment.
inline void Navigator::yaw_from_field(const Vector3d& field_b) {
  const double turn = ekf::magnetic_heading(filter_.state(), field_b, declination()).innovation;
  filter_.set_attitude(exp_map({0, 0, turn}) * filter_.state().q_nb);
  filter_.forget(ekf::theta + 2, 1, 1);
  yaw_known_ = true;
}

inline void Navigator::baro(double pressure_pa, const Params& p) {
  if (!(pressure_pa > 1e4 && pressure_pa < 1.2e5)) return;
  baro_s_ = time_s_;
  if (!origin_known_ && !altitude_known_) {
    altitude_m_ = pressure_altitude(pressure_pa);
    altitude_known_ = true;
  }
  if (!aligned_) return;
  air_ = standard_air(altitude_m_ - filter_.state().p_n.z());
  if (!baro_zeroed_) {
    ekf::Vector dx = ekf::Vector::Zero();
    dx(ekf::baro) = ekf::baro_height(filter_.state(), pressure_pa, altitude_m_).innovation;
    filter_.correct(dx);
    const double height_std = height_known_ ? filter_.std(ekf::pos + 2) : 0.5;
    if (!height_known_) filter_.forget(ekf::pos + 2, 1, 0.5);
    filter_.forget(ekf::baro, 1, std::max(height_std, 1.0));
    height_known_ = baro_zeroed_ = true;
  }
  const double dynamic_pa = airborne_ ? 0.5 * air_.density_kgm3 * ekf::air_velocity(filter_.state()).squaredNorm() : 0;
  const double std = std::hypot(p.baro_noise, p.baro_position_error * dynamic_pa) * ekf::metres_per_pascal(air_);
  const ekf::Fused fused = filter_.fuse(ekf::baro_height(filter_.state(), pressure_pa, altitude_m_), std * std, p.air_gate);
  health_.baro_ratio = fused.ratio;
  if (fused.accepted) {
    health_.baro_s = time_s_;
  } else if (++health_.refused; time_s_ - std::max(health_.baro_s, aligned_s_) > p.gnss_reset_after) {
    baro_zeroed_ = false;
    health_.baro_s = time_s_;
  }
}

inline void Navigator::pitot(double pressure_pa, const Params& p) {
  if (!std::isfinite(pressure_pa)) return;
  if (time_s_ - baro_s_ > 1) air_ = standard_air(altitude_m_ - (aligned_ ? filter_.state().p_n.z() : 0));
  const double Va = p.pitot_scale * std::sqrt(2 * std::max(pressure_pa, 0.0) / air_.density_kgm3);
  const double dt = std::clamp(time_s_ - pitot_s_, 0.0, 1.0);
  pitot_mps_ = pitot_s_ == never ? Va : pitot_mps_ + (Va - pitot_mps_) * (1 - std::exp(-dt / 0.2));
  pitot_s_ = time_s_;
  if (!aligned_ || !airborne_ || Va < 0.5 * p.min_airspeed) return;
  const double noise = p.pitot_noise / (air_.density_kgm3 * Va);
  const ekf::Fused fused =
      filter_.fuse(ekf::true_airspeed(filter_.state(), Va), noise * noise + p.pitot_speed_std * p.pitot_speed_std, p.air_gate);
  health_.pitot_ratio = fused.ratio;
  if (fused.accepted)
    health_.pitot_s = time_s_;
  else
    ++health_.refused;
}

}  // namespace fulmar::estimator
