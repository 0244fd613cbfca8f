// SPDX-License-Identifier: BSD-3-Clause
// ports in: imu Imu, gnss Gnss, mag Mag, baro Baro, pitot Pitot
// ports out: state VehicleState
// Fixed-gain observer: the integrated IMU is corrected towards GNSS velocity and position, barometric height
// and magnetic heading. Source: Hua, Attitude estimation for accelerated vehicles using GPS/INS measurements,
// Control Engineering Practice 18 (2010), first observer. After a switch it continues from attitude, biases
// and origin of the previous estimator. Without one it aligns only at rest.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/eigen.hpp>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct MyLaw {  // fills the role `nav`
  static constexpr const char* doc = "Fixed-gain observer of attitude, velocity and position.";
  struct Inputs {
    In<Imu> imu;
    In<Gnss> gnss;
    In<Mag> mag;
    In<Baro> baro;
    In<Pitot> pitot;
  };
  struct Outputs {
    VehicleState state;
  };
  struct Params {
    Param k_velocity{2.0, "1/s", 0, 20, "gain of the velocity towards GNSS"};
    Param k_position{0.5, "1/s", 0, 20, "gain of the position towards GNSS"};
    Param k_tilt{0.4, "ratio", 0, 5, "gain of roll and pitch from the velocity error"};
    Param k_heading{0.3, "1/s", 0, 5, "gain of the heading towards the magnetometer"};
    Param k_bias{0.02, "1/s", 0, 1, "gain of the gyro bias from the same corrections"};
    Param k_wind{0.1, "1/s", 0, 5, "gain of the wind from the airspeed"};
    Param declination{0.19, "rad", -3.2, 3.2, "magnetic declination at a start without a predecessor"};
  };

  Status activate(const Tick&, const Inputs& in, const Params&, const Applied<Outputs>& last) {
    const VehicleState& s = last->state;
    const bool known = last.has(last->state) && s.attitude_valid && s.position_valid && s.origin_valid;
    if (!known) return Status::ok;  // `step` aligns
    q_ = eigen(s.attitude);
    v_ = v_gnss_ = eigen(s.velocity_mps);
    p_ = p_gnss_ = eigen(s.position_m);
    gyro_bias_ = eigen(s.gyro_bias_radps);
    accel_bias_ = eigen(s.accel_bias_mps2);
    wind_ = eigen(s.wind_mps);
    lat0_ = s.origin_latitude_deg;
    lon0_ = s.origin_longitude_deg;
    alt0_ = s.origin_altitude_m;
    heading_offset_ = wrap_pi(s.yaw_rad - compass(in));
    baro_offset_ = s.height_m - pressure_height(in);
    begun_ = true;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (!begun_) begin(in, p);
    if (in.gnss.fresh() && in.gnss->fix >= FixType::fix_3d) update_gnss(*in.gnss);
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.05);
    const Eigen::Vector3d f_n = q_ * (eigen(in.imu->specific_force_mps2) - accel_bias_),
                          gravity(0, 0, 9.80665);
    const Eigen::Vector3d v_error = v_gnss_ - v_;
    // A velocity error normal to the specific force means a tilt error; the compass corrects the heading.
    Eigen::Vector3d correction_n = p.k_tilt / 9.80665 * f_n.cross(v_error) / 9.80665;
    correction_n.z() = p.k_heading * wrap_pi(compass(in) + heading_offset_ - yaw());
    const Eigen::Vector3d correction_b = q_.conjugate() * correction_n;
    gyro_bias_ -= p.k_bias * dt * correction_b;
    const Eigen::Vector3d omega_b = eigen(in.imu->rate_radps) - gyro_bias_,
                          turn = (omega_b + correction_b) * dt;
    q_ = (q_ * Eigen::Quaterniond(1, turn.x() / 2, turn.y() / 2, turn.z() / 2)).normalized();
    v_ += dt * (f_n + gravity + p.k_velocity * v_error);
    p_gnss_ += dt * v_;  // propagated between two fixes
    v_gnss_ += dt * (f_n + gravity);
    const double height_error = pressure_height(in) + baro_offset_ + p_.z();
    p_ += dt * (v_ + p.k_position * (Eigen::Vector3d(p_gnss_.x(), p_gnss_.y(), p_.z() - height_error) - p_));
    update_air(in, p, dt);
    publish(in, omega_b, out.state);
    return Status::ok;
  }

 private:
  static double pressure_height(const Inputs& in) {
    return 44330.77 * (1 - std::pow(in.baro->pressure_pa / 101325.0, 0.190263));
  }  // ISA
  double yaw() const {
    return std::atan2(2 * (q_.w() * q_.z() + q_.x() * q_.y()), 1 - 2 * (q_.y() * q_.y() + q_.z() * q_.z()));
  }
  /// Heading of the magnetic field's horizontal part, levelled with the present attitude.
  double compass(const Inputs& in) const {
    const Eigen::Vector3d level =
        Eigen::AngleAxisd(-yaw(), Eigen::Vector3d::UnitZ()) * (q_ * eigen(in.mag->field_tesla));
    return std::atan2(-level.y(), level.x());
  }

  /// Alignment at rest: the accelerometer gives the vertical, the gyros show their biases, the first fix is
  /// the origin.
  void begin(const Inputs& in, const Params& p) {
    const Eigen::Vector3d up_b = eigen(in.imu->specific_force_mps2);
    const double roll = std::atan2(-up_b.y(), -up_b.z()),
                 pitch = std::asin(std::clamp(up_b.x() / std::max(up_b.norm(), 1e-3), -1.0, 1.0));
    q_ = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
    q_ = Eigen::AngleAxisd(compass(in) + p.declination, Eigen::Vector3d::UnitZ()) * q_;
    heading_offset_ = p.declination;
    gyro_bias_ = eigen(in.imu->rate_radps);
    lat0_ = in.gnss->latitude_deg;
    lon0_ = in.gnss->longitude_deg;
    alt0_ = in.gnss->altitude_m;
    baro_offset_ = -pressure_height(in);
    begun_ = true;
  }

  void update_gnss(const Gnss& gnss) {
    constexpr double a = 6378137, e2 = 6.69437999014e-3,
                     deg = std::numbers::pi / 180;  // WGS-84, flat around the origin
    const double s = std::sin(lat0_ * deg), root = std::sqrt(1 - e2 * s * s);
    p_gnss_ = {(gnss.latitude_deg - lat0_) * deg * (a * (1 - e2) / (root * root * root) + alt0_),
               (gnss.longitude_deg - lon0_) * deg * (a / root + alt0_) * std::cos(lat0_ * deg),
               alt0_ - gnss.altitude_m};
    v_gnss_ = eigen(gnss.velocity_mps);
  }

  /// Airspeed from the pitot; the wind is ground velocity minus air velocity.
  void update_air(const Inputs& in, const Params& p, double dt) {
    const double rho = standard_air(alt0_ - p_.z()).density_kgm3;
    Va_ += std::min(dt / 0.1, 1.0) * (std::sqrt(2 * std::max(in.pitot->pressure_pa, 0.0) / rho) - Va_);
    if (Va_ < 5) return;
    const Eigen::Vector3d seen = v_ - q_ * Eigen::Vector3d(Va_, 0, 0);
    wind_ += p.k_wind * dt * (Eigen::Vector3d(seen.x(), seen.y(), 0) - wind_);
  }

  void publish(const Inputs& in, const Eigen::Vector3d& omega_b, VehicleState& s) const {
    const Eigen::Matrix3d R = q_.toRotationMatrix();
    s = {};
    s.position_m = from_eigen<Ned>(p_);
    s.velocity_mps = from_eigen<Ned>(v_);
    s.attitude = from_eigen(q_);
    s.roll_rad = std::atan2(R(2, 1), R(2, 2));
    s.pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
    s.yaw_rad = yaw();
    s.rate_radps = from_eigen<Body>(omega_b);
    s.specific_force_mps2 = from_eigen<Body>(eigen(in.imu->specific_force_mps2) - accel_bias_);
    s.height_m = -p_.z();
    s.climb_rate_mps = -v_.z();
    s.ground_speed_mps = std::hypot(v_.x(), v_.y());
    s.course_rad = s.ground_speed_mps > 1 ? std::atan2(v_.y(), v_.x()) : s.yaw_rad;
    s.airspeed_mps = Va_;
    const Eigen::Vector3d v_r = q_.conjugate() * (v_ - wind_);
    if (Va_ > 5) {
      s.alpha_rad = std::atan2(v_r.z(), v_r.x());
      s.beta_rad = std::asin(std::clamp(v_r.y() / v_r.norm(), -1.0, 1.0));
    }
    s.wind_mps = from_eigen<Ned>(wind_);
    s.gyro_bias_radps = from_eigen<Body>(gyro_bias_);
    s.accel_bias_mps2 = from_eigen<Body>(accel_bias_);
    s.position_std_m = {3, 3, 3};
    s.velocity_std_mps = {0.3, 0.3, 0.3};
    s.attitude_std_rad = {0.03, 0.03, 0.1};
    s.wind_std_mps = {1, 1, 1};
    s.airspeed_std_mps = 1;
    s.origin_latitude_deg = lat0_;
    s.origin_longitude_deg = lon0_;
    s.origin_altitude_m = alt0_;
    s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
        s.airspeed_valid = s.wind_valid = true;
  }

  Eigen::Quaterniond q_{1, 0, 0, 0};
  Eigen::Vector3d v_{0, 0, 0}, p_{0, 0, 0}, v_gnss_{0, 0, 0}, p_gnss_{0, 0, 0};
  Eigen::Vector3d gyro_bias_{0, 0, 0}, accel_bias_{0, 0, 0}, wind_{0, 0, 0};
  double lat0_ = 0, lon0_ = 0, alt0_ = 0, heading_offset_ = 0, baro_offset_ = 0, Va_ = 0;
  bool begun_ = false;
};
