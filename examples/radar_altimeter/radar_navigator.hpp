// SPDX-License-Identifier: BSD-3-Clause
// A navigator with a radar altimeter, on the SDK's error-state filter. It takes over in the air. It finds no
// attitude by itself and bridges no gaps: there it fails, and its fallback flies. Sources: Sola, Quaternion
// kinematics for the error-state Kalman filter (2017), section 7; Groves, Principles of GNSS, Inertial and
// Multisensor Integrated Navigation Systems (2013), chapters 6 (radar altimeter) and 17 (gates).
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/eigen.hpp>
#include <fulmar/flight/ekf_models.hpp>
#include <fulmar/flight/geodesy.hpp>
#include <fulmar/flight/magnetic_model.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>
#include <stdexcept>

#include "radar_altimeter.hpp"

using Eigen::Vector3d;

struct RadarNavigator {  // fills the role `nav`
  static constexpr const char* doc =
      "Error-state Kalman filter with a radar altimeter; takes over in the air.";
  struct Inputs {
    In<Imu> imu;
    Optional<Gnss> gnss;
    Optional<Mag> mag;
    Optional<Baro> baro;
    Optional<Pitot> pitot;
    Queue<RadarRange> range;
  };
  struct Outputs {
    Out<VehicleState> state;
    Probe radar_ratio;          // innovation of the last range, in deviations
    Probe radar_refused_ratio;  // ranges refused so far
    Probe baro_bias_m;          // what the barometer reads too high
  };
  struct Params {
    Flag use_radar{true, "false: flies on GNSS and barometer alone"};
    Param gate{5, "ratio", 2, 20, "innovations beyond this many deviations are refused"};
    Param max_gap{0.1, "s", 0.02, 1, "without an inertial sample: then it fails"};
    Param max_age{0.3, "s", 0.02, 0.5, "older ranges are left out"};
    Count stuck_after{10, 2, 1000, "equal ranges in a row: the radar is stuck"};
    Param reopen_after{5, "s", 0.5, 60, "ranges refused so long: height and barometer are doubted"};
    Param doubt{3, "m", 0.1, 100, "how far height and barometer are doubted then"};
    Param gnss_timeout{5, "s", 1, 60, "without an accepted fix the position is not valid"};
    Param contradiction{10, "s", 1, 60, "fixes refused so long: it fails"};
    Param gnss_height_time{60, "s", 0, 1000, "correlation time of the receiver's height error"};
    Param gnss_climb_time{2, "s", 0, 100, "the same of its climb error"};
    Param baro_std{0.6, "m", 0.05, 10, "of one sample, noise and the wing's pressure field"};
    Param pitot_std{0.2, "m/s", 0.05, 5, "of one sample"};
    Param mag_std{0.06, "rad", 0.005, 1, "of one heading at 10 Hz"};
  };

  /// Range r = h / c along r_z, the body's z axis in NED, with c = r_z.down = cos phi cos theta. Height and
  /// its row are those of the time at which it was measured (ekf::position); so is the tilt, turned back with
  /// the rate of now. A rotation theta of the estimate changes r by r/c (e_down x r_z) . theta.
  static ekf::Scalar slant_range(const ErrorStateEkf& f, double time_s, double measured_m) {
    const ErrorStateEkf::Past past = f.at(time_s);
    const Vector3d r_z = f.R_nb() * (exp_map(-past.age_s * f.rate_b()) * Vector3d::UnitZ());
    const double c = r_z.z(), r = -past.p_n.z() / c;
    ekf::Scalar z = ekf::position(f, past, 2, 0);
    z.innovation = measured_m - r;
    z.H *= -1 / c;
    const Eigen::RowVector3d by_tilt = r / c * Vector3d::UnitZ().cross(r_z);
    z.H.segment<3>(ekf::theta) += by_tilt;
    z.H.segment<3>(ekf::gyro_bias) += past.age_s * by_tilt * f.R_nb();
    return z;
  }

  void configure(const Params&) {  // noises as those of the shipped filter
    ekf::Noise& n = filter_.noise;
    n.gyro_scale = 2e-3;
    n.accel_scale = 1e-2;
    n.accel_bias_walk = 5e-4;
    n.baro_walk = 0.1;
    n.heading_std = 0.05;
  }

  /// Goes on from the state that was applied last, as sure as that was. How far the barometer reads too high
  /// is not in it: the first sample tells.
  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    const VehicleState& s = last->state.value;
    if (!last.has(last->state) || !s.attitude_valid || !s.velocity_valid || !s.position_valid ||
        !s.height_valid || !s.origin_valid || s.airspeed_mps < 5)
      throw std::runtime_error("takes over in the air alone, from a state that is valid as a whole");
    if (in.imu.sequence() == 0 || seconds(tick.now_ns - in.imu.valid_at_ns()) > p.max_gap)
      throw std::runtime_error("there is no inertial sample to begin with");
    origin_ = s;
    frame_ = LocalFrame(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
    const double year = in.gnss ? std::clamp(decimal_year(in.gnss->utc_ns), 2025.0, 2030.0) : 2026.0;
    const Vector3d field_n =
        magnetic_field_ned(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m, year);
    declination_rad_ = std::atan2(field_n.y(), field_n.x());
    ekf::Nominal x;
    x.q_nb = eigen(s.attitude);
    x.v_n = eigen(s.velocity_mps);
    x.p_n = eigen(s.position_m);
    x.gyro_bias = eigen(s.gyro_bias_radps);
    x.accel_bias = eigen(s.accel_bias_mps2);
    x.wind = eigen(s.wind_mps).head<2>();
    ekf::Vector std;
    std << eigen(s.attitude_std_rad), eigen(s.velocity_std_mps), eigen(s.position_std_m),
        Vector3d::Constant(2e-3), Vector3d::Constant(0.05), eigen(s.wind_std_mps).head<2>(),
        filter_.noise.gust_std, 300, 0, filter_.noise.heading_std, Vector3d::Zero();
    imu_ns_ = in.imu.valid_at_ns();
    filter_.reset(x, std.cwiseMin(300), in.imu.valid_at_s());
    position_s_ = height_s_ = climb_s_ = pitot_s_ = filter_.time_s();
    contradicted_ = radar_refused_ = {};
    repeated_ = 0;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const std::int64_t sample_ns = in.imu.valid_at_ns();
    const Vector3d omega_b = eigen(in.imu->rate_radps), f_b = eigen(in.imu->specific_force_mps2);
    const bool usable = omega_b.allFinite() && f_b.allFinite();
    if (!in.imu.fresh() || !usable || sample_ns <= imu_ns_ || sample_ns > tick.now_ns)
      return seconds(tick.now_ns - imu_ns_) > p.max_gap ? Status::failed : Status::ok;
    const double dt = seconds(sample_ns - imu_ns_);
    if (dt > p.max_gap) return Status::failed;
    imu_ns_ = sample_ns;
    filter_.predict(omega_b, f_b, dt);
    air(in, p);
    if (in.gnss && in.gnss.fresh()) gnss(*in.gnss, in.gnss.valid_at_s(), p);
    for (const auto& sample : in.range) radar(sample.value, sample.valid_at_s(), p);
    const double now = filter_.time_s();
    if (contradicted_.lasted_s > p.contradiction) return Status::failed;
    out.state.publish(state(now - position_s_ < p.gnss_timeout, now - pitot_s_ < 1), sample_ns);
    out.radar_ratio = radar_ratio_;
    out.radar_refused_ratio = refused_;
    out.baro_bias_m = filter_.state().baro_m;
    return now - position_s_ < p.gnss_timeout ? Status::ok : Status::degraded;
  }

 private:
  static constexpr double never = -1e9;
  /// How long something has been so without a break.
  struct Streak {
    double since_s = never, lasted_s = 0;
    void update(bool so, double now_s) {
      since_s = !so ? never : since_s == never ? now_s : since_s;
      lasted_s = so ? now_s - since_s : 0;
    }
  };

  static double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

  /// A scalar within the gate; `n` samples whose error is the same count as one.
  bool fuse(const ekf::Scalar& z, double std, const Params& p, double n = 1) {
    if (!(std::abs(z.innovation) < p.gate * filter_.expected_std(z, std * std))) return false;
    filter_.fuse(z, n * std * std, 1e9);
    return true;
  }

  void radar(const RadarRange& seen, double time_s, const Params& p) {
    repeated_ = seen.valid && seen.range_m == range_m_ ? repeated_ + 1 : 0;
    range_m_ = seen.range_m;
    const double now = filter_.time_s(), age_s = now - time_s, c = filter_.R_nb()(2, 2);
    const bool whole = seen.valid && seen.range_m >= 0 && seen.range_m < 1e4 && seen.range_std_m < 100;
    const bool timely = age_s > -0.01 && age_s < p.max_age && filter_.at(time_s).known;
    if (!p.use_radar || !whole || !timely || repeated_ >= p.stuck_after || c < 0.3) return;
    const ekf::Scalar z = slant_range(filter_, time_s, seen.range_m);
    // The tilt of then is known to a few milliradians, which slant makes a length.
    const double std =
        std::hypot(seen.range_std_m, 0.004 * seen.range_m * std::tan(std::acos(std::min(c, 1.0))), 0.02);
    radar_ratio_ = z.innovation / filter_.expected_std(z, std * std);
    const bool refused = !fuse(z, std, p);
    radar_refused_.update(refused, now);
    refused_ += refused;
    if (radar_refused_.lasted_s >= p.reopen_after) doubt(p);
  }

  /// One of the two is wrong. What the radar itself has made sure of is doubted, as far as the other sensors
  /// may be off: a radar that is right comes in again, one that is far off stays out.
  void doubt(const Params& p) {
    for (const int i : {ekf::pos + 2, int{ekf::baro}})
      filter_.inflate(i, 1, std::sqrt(std::max(p.doubt * p.doubt - std::pow(filter_.std(i), 2), 0.0)));
    radar_refused_ = {};
  }

  void gnss(const Gnss& g, double time_s, const Params& p) {
    const bool solved = g.fix == FixType::fix_3d || g.fix >= FixType::rtk_float || g.fix == FixType::combined;
    const double now = filter_.time_s();
    if (!solved || !filter_.at(time_s).known) return;
    const Vector3d v_n = eigen(g.velocity_mps),
                   p_n = frame_.to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
    const double std_v = std::clamp(g.speed_std_mps, 0.02, 5.0),
                 std_h = std::clamp(g.vertical_std_m, 0.1, 50.0);
    const double std_p = std::clamp(g.horizontal_std_m, 0.1, 50.0);
    // Fixes within the correlation time of their error know as much as one.
    const auto fixes_in = [&](double time, double last_s) {
      return 1 + 2 * time / std::clamp(now - last_s, 0.02, 10.0);
    };
    const auto v = [&](int i) { return ekf::velocity(filter_, filter_.at(time_s), i, v_n(i)); };
    const auto x = [&](int i) { return ekf::position(filter_, filter_.at(time_s), i, p_n(i)); };
    const bool speed = fuse(v(0), std_v, p) && fuse(v(1), std_v, p);
    const bool climb = fuse(v(2), std_v, p, fixes_in(p.gnss_climb_time, climb_s_));
    const bool position = fuse(x(0), std_p, p) && fuse(x(1), std_p, p);
    const bool height = fuse(x(2), std_h, p, fixes_in(p.gnss_height_time, height_s_));
    if (climb) climb_s_ = now;
    if (position) position_s_ = now;
    if (height) height_s_ = now;
    contradicted_.update(!speed || !climb || !position || !height, now);
  }

  void air(const Inputs& in, const Params& p) {
    const ekf::Nominal& x = filter_.state();
    const double alt0 = origin_.origin_altitude_m, now = filter_.time_s();
    if (in.baro && in.baro.fresh() && in.baro->pressure_pa > 1e4)
      fuse(ekf::baro_height(x, in.baro->pressure_pa, alt0), p.baro_std, p);
    if (in.pitot && in.pitot.fresh()) {
      const double rho = standard_air(alt0 - x.p_n.z()).density_kgm3;
      const double Va = std::sqrt(2 * std::max(in.pitot->pressure_pa, 0.0) / rho);
      if (Va > 5 && fuse(ekf::true_airspeed(x, Va), p.pitot_std, p)) pitot_s_ = now;
    }
    if (now - slow_s_ < 0.1 - 1e-4) return;  // errors that last: more samples would not tell more
    slow_s_ = now;
    if (in.mag && in.mag.fresh() && eigen(in.mag->field_tesla).norm() > 1e-6)
      fuse(ekf::magnetic_heading(x, eigen(in.mag->field_tesla), declination_rad_), p.mag_std, p);
    const double side_mps = std::hypot(2.0, 0.1 * ekf::air_velocity(x).norm());
    filter_.fuse_considering_attitude(ekf::zero_sideslip(x), side_mps * side_mps, p.gate);
  }

  VehicleState state(bool position, bool pitot) const {
    const ekf::Nominal& x = filter_.state();
    const auto std = [&](int i) { return Vec3<Ned>{filter_.std(i), filter_.std(i + 1), filter_.std(i + 2)}; };
    VehicleState s;
    s.origin_latitude_deg = origin_.origin_latitude_deg;
    s.origin_longitude_deg = origin_.origin_longitude_deg;
    s.origin_altitude_m = origin_.origin_altitude_m;
    s.position_m = from_eigen<Ned>(x.p_n);
    s.velocity_mps = from_eigen<Ned>(x.v_n);
    s.attitude = from_eigen(x.q_nb);
    const Euler e = euler_from(filter_.R_nb());
    s.roll_rad = e.roll_rad, s.pitch_rad = e.pitch_rad, s.yaw_rad = e.yaw_rad;
    s.rate_radps = from_eigen<Body>(filter_.rate_b());
    s.specific_force_mps2 = from_eigen<Body>(filter_.specific_force_b());
    s.gyro_bias_radps = from_eigen<Body>(x.gyro_bias);
    s.accel_bias_mps2 = from_eigen<Body>(x.accel_bias);
    s.height_m = -x.p_n.z();
    s.climb_rate_mps = -x.v_n.z();
    s.ground_speed_mps = x.v_n.head<2>().norm();
    s.course_rad = s.ground_speed_mps > 1 ? std::atan2(x.v_n.y(), x.v_n.x()) : e.yaw_rad;
    s.wind_mps = {x.wind.x(), x.wind.y(), 0};
    const Vector3d u_b = filter_.R_nb().transpose() * ekf::air_velocity(x);
    s.airspeed_mps = std::max(u_b.norm() + x.gust_mps, 0.0);
    s.alpha_rad = std::atan2(u_b.z(), u_b.x());
    s.beta_rad = std::asin(std::clamp(u_b.y() / std::max(u_b.norm(), 1e-3), -1.0, 1.0));
    s.attitude_std_rad = std(ekf::theta);
    s.velocity_std_mps = std(ekf::vel);
    s.position_std_m = std(ekf::pos);
    s.wind_std_mps = {filter_.std(ekf::wind), filter_.std(ekf::wind + 1), unknown_std};
    s.airspeed_std_mps = filter_.expected_std(ekf::true_airspeed(x, 0), 0);
    const Vec3<Ned>&a = s.attitude_std_rad, &v = s.velocity_std_mps;
    s.attitude_valid = std::max(a.north, a.east) < 0.25 && a.down < 0.5;
    s.velocity_valid = std::max({v.north, v.east, v.down}) < 3;
    s.position_valid = position;
    s.height_valid = s.position_std_m.down < 20;
    s.wind_valid = std::max(s.wind_std_mps.north, s.wind_std_mps.east) < 3;
    s.airspeed_valid = pitot || s.airspeed_std_mps < 3;
    s.origin_valid = true;
    return s;
  }

  ErrorStateEkf filter_;
  LocalFrame frame_;
  VehicleState origin_;  // whose origin holds
  double declination_rad_ = 0;
  double position_s_ = 0, height_s_ = 0, climb_s_ = 0, pitot_s_ = 0, slow_s_ = never;  // accepted last
  std::int64_t imu_ns_ = 0;
  Streak contradicted_, radar_refused_;
  double range_m_ = 0, radar_ratio_ = 0, refused_ = 0;
  std::int64_t repeated_ = 0;  // equal ranges in a row
};
