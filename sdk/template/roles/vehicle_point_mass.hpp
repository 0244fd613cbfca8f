// SPDX-License-Identifier: BSD-3-Clause
// ports in: actuators Actuators, arm ArmRequest
// ports out: imu Imu, gnss Gnss, mag Mag, baro Baro, pitot Pitot, rc Rc, status VehicleStatus
// A point mass that turns by its bank: first-order roll and pitch rates from the surfaces, coordinated turn,
// ideal sensors, no wind. Source: Beard & McLain, Small Unmanned Aircraft (2012), chapter 9, (9.14) with chi
// = psi; sensors of chapter 7 without noise.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/eigen.hpp>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/earth/magnetic_model.hpp>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/airframe.hpp>
#include <fulmar/msg/arm_request.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/origin.hpp>
#include <fulmar/msg/pitot.hpp>
#include <fulmar/msg/rc.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/msg/vehicle_status.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct MyLaw {  // fills the role `vehicle`
  static constexpr const char* doc = "A point mass that turns as it banks, with perfect sensors.";
  struct Inputs {
    Optional<Actuators> actuators;
    Request<ArmRequest> arm;
  };
  struct Outputs {
    Imu imu;
    Out<Gnss> gnss;
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Out<Rc> rc;
    Out<VehicleStatus> status;
    Out<VehicleState> truth;
  };
  struct Params {
    Record<Airframe> airframe{"airframe with airspeeds and trims", required};
    Record<Origin> origin{"origin of the local frame"};
    Param rate{400, "Hz", 50, 1000, "rate of the loop; the rate of the mission", setup};
    Param epoch{1767225600, "s", 0, 4102444800, "UTC of flight time 0, since 1970; the epoch of the mission",
                setup};
    Param start_heading{0, "rad", -6.3, 6.3, "heading at the start, from north, clockwise", setup};
    Param roll_rate{6, "radps/rad", 0.1, 50, "steady roll rate per aileron"};
    Param pitch_rate{3, "radps/rad", 0.1, 50, "steady pitch rate per elevator"};
    Param lag{0.08, "s", 0.01, 1, "time constant of roll and pitch rate"};
    Param path_lag{0.5, "s", 0.05, 5, "time constant of the climb angle behind the pitch angle"};
    Param acceleration_max{6, "m/s2", 1, 50, "acceleration at full throttle and zero speed"};
  };

  void configure(const Params& p) {
    *this = {};
    period_ns_ = std::llround(1e9 / p.rate);
    now_ns_ = -static_cast<std::int64_t>(5 * p.rate) *
              period_ns_;  // stands still for 5 s, in which the estimator aligns
    origin_ = p.origin.given() ? *p.origin : Origin{40.2463724, -111.6474138, 1387, true};
    psi_ = p.start_heading;
    const double year = 1970 + p.epoch / (365.25 * 86400);
    field_n_ = magnetic_field_ned(origin_.lat_deg, origin_.lon_deg, origin_.alt_msl_m, year);
    tick_ = 0;
  }

  Status read(Tick& tick, const Params& p, Outputs& out) {
    tick.now_ns = now_ns_ += period_ns_;
    if (wanted_ && now_ns_ >= 0) armed_ = true;
    const Eigen::Vector3d v_before = v_n_;
    const double dt = 1e-9 * static_cast<double>(period_ns_);
    if (armed_) advance(p, dt);
    sense(p, (v_n_ - v_before) / dt, out);
    return Status::ok;
  }

  Status write(const Tick& tick, const Inputs& in, const Params&) {
    for (auto request : in.arm) {
      wanted_ = request.value().armed;
      armed_ = armed_ && wanted_;
      request.accept();
    }
    const bool recent = in.actuators && tick.now_ns - in.actuators.valid_at_ns() < 100'000'000;
    command_ = recent ? *in.actuators : Actuators{};
    return Status::ok;
  }

 private:
  static constexpr double g = 9.80665;

  void advance(const Params& p, double dt) {
    const double cruise = p.airframe->limits.airspeed_cruise_mps,
                 grip = std::min(Va_ * Va_ / (cruise * cruise), 1.5);
    const bool rolling = p_n_.z() >= 0 && Va_ < 0.9 * cruise;
    const double lag = std::min(dt / p.lag, 1.0);
    p_rate_ += lag * (grip * p.roll_rate * (command_.aileron_rad - p.airframe->aileron.trim_rad) - p_rate_);
    q_rate_ +=
        lag * (-grip * p.pitch_rate * (command_.elevator_rad - p.airframe->elevator.trim_rad) - q_rate_);
    phi_ = rolling ? 0 : std::clamp(phi_ + p_rate_ * dt, -1.2, 1.2);
    theta_ = rolling ? 0 : std::clamp(theta_ + q_rate_ * dt, -0.6, 0.6);
    gamma_ += dt / p.path_lag * (theta_ - gamma_);
    if (p_n_.z() >= 0) gamma_ = std::max(gamma_, 0.0);
    const double throttle = std::clamp(command_.throttle_frac, 0.0, 1.0),
                 cruise_throttle = std::max(p.airframe->limits.throttle_cruise_frac, 0.1);
    Va_ = std::max(
        Va_ + dt * (p.acceleration_max * (throttle - cruise_throttle * Va_ * Va_ / (cruise * cruise)) -
                    g * std::sin(gamma_)),
        0.0);
    psi_dot_ = rolling ? 0 : g / std::max(Va_, 5.0) * std::tan(phi_);  // (9.14), no wind
    psi_ = wrap_pi(psi_ + psi_dot_ * dt);
    v_n_ = {Va_ * std::cos(gamma_) * std::cos(psi_), Va_ * std::cos(gamma_) * std::sin(psi_),
            -Va_ * std::sin(gamma_)};
    p_n_ += dt * v_n_;
    p_n_.z() = std::min(p_n_.z(), 0.0);
  }

  /// All samples are valid at this tick. Rates: IMU each tick, others each 4th, GNSS each 40th.
  void sense(const Params& p, const Eigen::Vector3d& a_n, Outputs& out) {
    const Eigen::Quaterniond q = Eigen::AngleAxisd(psi_, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(theta_, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(phi_, Eigen::Vector3d::UnitX());
    const double height = -p_n_.z();
    const Eigen::Vector3d rate_b = (q_before_.conjugate() * q).vec() * 2 *
                                   p.rate.value;  // rotation between two ticks, as a gyro measures it
    q_before_ = q;
    out.imu.rate_radps = from_eigen<Body>(tick_ > 0 ? rate_b : Eigen::Vector3d(0, 0, 0));
    out.imu.specific_force_mps2 = from_eigen<Body>(q.conjugate() * (a_n - Eigen::Vector3d(0, 0, g)));
    if (tick_ % 4 == 0) {
      const auto air = standard_air(origin_.alt_msl_m + height);
      out.mag.publish({from_eigen<Body>(q.conjugate() * field_n_)});
      out.baro.publish({air.pressure_pa, air.temperature_kelvin});
      const double pressure = 0.5 * air.density_kgm3 * Va_ * Va_;
      out.pitot.publish({pressure, std::sqrt(2 * pressure / 1.225), air.temperature_kelvin});
      out.truth.publish(truth(q, rate_b));
    }
    if (tick_ % 40 == 0) publish_gnss(p, out);
    if (tick_ % 8 == 0) {
      Rc rc;
      rc.link = true;
      out.rc.publish(rc);
      VehicleStatus status;
      status.armed = armed_;
      status.on_ground = p_n_.z() >= 0;
      status.battery_volt = p.airframe->propulsion.battery_volt;
      out.status.publish(status);
    }
    ++tick_;
  }

  /// A flat Earth around the origin: radii of curvature of WGS-84.
  void publish_gnss(const Params& p, Outputs& out) const {
    constexpr double a = 6378137, e2 = 6.69437999014e-3, deg = std::numbers::pi / 180;
    const double s = std::sin(origin_.lat_deg * deg), root = std::sqrt(1 - e2 * s * s);
    const double meridian = a * (1 - e2) / (root * root * root) + origin_.alt_msl_m,
                 normal = a / root + origin_.alt_msl_m;
    Gnss gnss;
    gnss.latitude_deg = origin_.lat_deg + p_n_.x() / meridian / deg;
    gnss.longitude_deg = origin_.lon_deg + p_n_.y() / (normal * std::cos(origin_.lat_deg * deg)) / deg;
    gnss.altitude_m = origin_.alt_msl_m - p_n_.z();
    gnss.velocity_mps = from_eigen<Ned>(v_n_);
    gnss.horizontal_std_m = gnss.vertical_std_m = 0.5;
    gnss.speed_std_mps = 0.1;
    gnss.utc_ns = std::llround(p.epoch) * 1'000'000'000 + now_ns_;
    gnss.fix = FixType::fix_3d;
    gnss.satellites = 12;
    out.gnss.publish(gnss);
  }

  VehicleState truth(const Eigen::Quaterniond& q, const Eigen::Vector3d& rate_b) const {
    VehicleState s;
    s.position_m = from_eigen<Ned>(p_n_);
    s.velocity_mps = from_eigen<Ned>(v_n_);
    s.attitude = from_eigen(q);
    s.roll_rad = phi_;
    s.pitch_rad = theta_;
    s.yaw_rad = psi_;
    s.rate_radps = from_eigen<Body>(rate_b);
    s.height_m = -p_n_.z();
    s.climb_rate_mps = -v_n_.z();
    s.ground_speed_mps = std::hypot(v_n_.x(), v_n_.y());
    s.course_rad = psi_;
    s.airspeed_mps = Va_;
    s.alpha_rad = theta_ - gamma_;
    s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {};
    s.airspeed_std_mps = 0;
    s.origin_latitude_deg = origin_.lat_deg;
    s.origin_longitude_deg = origin_.lon_deg;
    s.origin_altitude_m = origin_.alt_msl_m;
    s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
        s.airspeed_valid = s.wind_valid = true;
    return s;
  }

  Origin origin_;
  Eigen::Vector3d field_n_{0, 0, 0}, p_n_{0, 0, 0}, v_n_{0, 0, 0};
  Eigen::Quaterniond q_before_{1, 0, 0, 0};
  Actuators command_;
  double Va_ = 0, phi_ = 0, theta_ = 0, psi_ = 0, gamma_ = 0, psi_dot_ = 0, p_rate_ = 0, q_rate_ = 0;
  std::int64_t now_ns_ = 0, period_ns_ = 2'500'000;
  std::uint64_t tick_ = 0;
  bool wanted_ = false, armed_ = false;
};
