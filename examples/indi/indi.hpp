// SPDX-License-Identifier: BSD-3-Clause
// Inner loop by incremental nonlinear dynamic inversion of the body rates: u = u_f + G^-1 (nu - omega_dot_f).
// The same filter acts on u_f and omega_dot_f. Proportional attitude loops command the rates. Sources:
// Sieberling, Chu & Mulder, J. Guidance, Control, and Dynamics 33 (2010), (18)-(22); Smeur, Chu & de Croon,
// ibid. 39 (2016), section III for the filter on both. G is that of the airframe: Beard & McLain, Small
// Unmanned Aircraft (2012), (5.3).
#pragma once
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fulmar/eigen.hpp>
#include <fulmar/flight/control/outer_commands.hpp>
#include <fulmar/flight/control/turn_trim.hpp>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/math/filters.hpp>
#include <fulmar/flight/model/aircraft_model.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>
#include <stdexcept>

using namespace fulmar;

struct Indi {  // fills the role `inner`
  static constexpr const char* doc = "Attitude hold by incremental nonlinear dynamic inversion of the rates.";
  struct Inputs {
    In<VehicleState> state;
    In<AttitudeCommand> attitude;
  };
  struct Outputs {
    Actuators actuators;
    Probe roll_acceleration_error_ratio;  // rad/s2: nu - omega_dot_f
    Probe pitch_acceleration_error_ratio;
    Probe yaw_acceleration_error_ratio;
  };
  struct Params {
    Param roll{6, "1/s", 0, 30, "roll rate command per roll error"};
    Param pitch{8, "1/s", 0, 30, "pitch rate command per pitch error"};
    Param roll_rate{18, "1/s", 0, 60, "roll acceleration command per roll rate error"};
    Param pitch_rate{15, "1/s", 0, 60, "pitch acceleration command per pitch rate error"};
    Param yaw_rate{5, "1/s", 0, 60, "yaw acceleration command per yaw rate error"};
    Param filter{40, "rad/s", 5, 300, "natural frequency of the filter on rates and surfaces"};
    Param effectiveness{1, "ratio", 0.2, 5, "factor on the surface effectiveness of the airframe"};
    Param roll_kff{0.7, "ratio", 0, 2, "share of the commanded roll rate that is fed forward"};
    Param command_filter{0.04, "s", 0.005, 1, "time constant of the differentiated roll command"};
    Param fade{0.3, "s", 0.01, 5, "time constant of the bumpless transfer"};
    Record<Airframe> airframe{"airframe with inertia, surface effectiveness, servo lag, throws and limits"};
  };

  /// Angular acceleration per surface (aileron, elevator, rudder) and unit of dynamic pressure, rad/s2 / rad
  /// / Pa.
  static Eigen::Matrix3d effect(const Airframe& a) {
    const auto &l = a.aero.roll, &m = a.aero.pitch, &n = a.aero.yaw;
    const double b = a.wing.span_m, c = a.wing.chord_m;
    Eigen::Matrix3d moment;
    moment << b * l.aileron_ratio, b * l.elevator_ratio, b * l.rudder_ratio,  //
        c * m.aileron_ratio, c * m.elevator_ratio, c * m.rudder_ratio,        //
        b * n.aileron_ratio, b * n.elevator_ratio, b * n.rudder_ratio;
    return inertia_matrix(a.inertia).inverse() * (a.wing.area_m2 * moment);
  }

  static constexpr const char* airframe_missing = "the inversion requires an airframe";
  static constexpr const char* surfaces_insufficient =
      "the surfaces of this airframe do not turn it about three axes";

  void configure(const Params& params) {
    if (!params.airframe.given()) throw std::runtime_error(airframe_missing);
    const Eigen::FullPivLU<Eigen::Matrix3d> lu(effect(*params.airframe));
    if (!lu.isInvertible()) throw std::runtime_error(surfaces_insufficient);
    inverse_ = lu.inverse();
  }

  Status activate(const Tick&, const Inputs& in, const Params& params, const Applied<Outputs>& last) {
    const Actuators& u = last->actuators;
    begin(*params.airframe, *in.state, *in.attitude, last.has(u) ? &u : nullptr);
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    const AttitudeCommand& command = *in.attitude;
    const Airframe& a = *p.airframe;
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const double Va = airspeed_.step(scheduling_airspeed(s, a.limits), 0.5, dt);
    if (!begun_ || !flying(s, a.limits)) begin(a, s, command, nullptr);

    const Eigen::Vector3d omega = eigen(s.rate_radps);
    Eigen::Vector3d omega_dot, u_f;  // both with the same delay of the filter
    for (int i = 0; i < 3; ++i) {
      rate_[i].step(omega(i), p.filter, 0.7, dt);
      surface_[i].step(servo(i, a, dt), p.filter, 0.7, dt);
      omega_dot(i) = rate_[i].rate();
      u_f(i) = surface_[i].value();
    }
    const Eigen::Vector3d gain(p.roll_rate, p.pitch_rate, p.yaw_rate);
    Eigen::Vector3d nu = gain.cwiseProduct(wanted_rates(s, command, p, Va, dt) - omega);
    if (fresh_) {
      left_ = nu - omega_dot;
      throttle_left_ = throttle_ - command.throttle_frac;
    }
    fresh_ = false;
    nu -= left_;  // the initial difference fades out, so that no surface steps
    left_ *= std::exp(-dt / p.fade);
    const double pressure = 0.5 * standard_air(s.origin_altitude_m + s.height_m).density_kgm3 * Va * Va;
    u_ = u_f + inverse_ * (nu - omega_dot) / (pressure * p.effectiveness);
    for (int i = 0; i < 3; ++i) u_(i) = std::clamp(u_(i), -surface(a, i).limit_rad, surface(a, i).limit_rad);

    out.actuators = {std::clamp(command.throttle_frac + throttle_left_, 0.0, 1.0), u_(0), u_(1), u_(2)};
    throttle_left_ *= std::exp(-dt / p.fade);
    out.roll_acceleration_error_ratio = nu(0) - omega_dot(0);
    out.pitch_acceleration_error_ratio = nu(1) - omega_dot(1);
    out.yaw_acceleration_error_ratio = nu(2) - omega_dot(2);
    return s.attitude_valid ? Status::ok : Status::degraded;
  }

 private:
  static const Surface& surface(const Airframe& a, int i) {
    return i == 0 ? a.aileron : i == 1 ? a.elevator : a.rudder;
  }

  /// Starts from the last surface commands, or from trim without them.
  void begin(const Airframe& a, const VehicleState& s, const AttitudeCommand& command,
             const Actuators* last) {
    u_ = last ? Eigen::Vector3d(last->aileron_rad, last->elevator_rad, last->rudder_rad)
              : Eigen::Vector3d(a.aileron.trim_rad, a.elevator.trim_rad, a.rudder.trim_rad);
    servo_ = u_;
    for (int i = 0; i < 3; ++i) {
      surface_[i].reset_to(u_(i));
      rate_[i].reset_to(eigen(s.rate_radps)(i));
    }
    roll_command_rate_.reset_to(command.roll_rad);
    airspeed_.reset_to(scheduling_airspeed(s, a.limits));
    left_.setZero();
    throttle_left_ = 0;
    throttle_ = last ? last->throttle_frac : 0;
    begun_ = true;
    fresh_ = last != nullptr;
  }

  /// Modelled position of surface `i`, with lag and rate limit of its servo.
  double servo(int i, const Airframe& a, double dt) {
    const Surface& of = surface(a, i);
    const double lag = of.time_constant_s > 0 ? 1 - std::exp(-dt / of.time_constant_s) : 1;
    const double most = of.rate_limit_radps * dt;
    return servo_(i) += std::clamp(lag * (u_(i) - servo_(i)), -most, most);
  }

  /// Body rates that turn the attitude to its command, plus the rates of a coordinated turn; B&M (3.3)
  /// inverted. Zero without a valid attitude.
  Eigen::Vector3d wanted_rates(const VehicleState& s, const AttitudeCommand& command, const Params& p,
                               double Va, double dt) {
    const double ahead =
        std::clamp(roll_command_rate_.step(command.roll_rad, p.command_filter, dt), -3.0, 3.0);
    if (!s.attitude_valid) return Eigen::Vector3d::Zero();
    const TurnRates turn = turn_rates(s.roll_rad, s.pitch_rad, Va);
    const double phi_dot = p.roll * (command.roll_rad - s.roll_rad) + p.roll_kff * ahead;
    const double theta_dot = p.pitch * (command.pitch_rad - s.pitch_rad);
    return {phi_dot + turn.p_radps, theta_dot * std::cos(s.roll_rad) + turn.q_radps,
            -theta_dot * std::sin(s.roll_rad) + turn.r_radps};
  }

  Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d u_ = Eigen::Vector3d::Zero(), servo_ = Eigen::Vector3d::Zero();
  SecondOrder rate_[3], surface_[3];
  Differentiator roll_command_rate_;
  LowPass airspeed_;
  Eigen::Vector3d left_ = Eigen::Vector3d::Zero();  ///< initial difference at a switch, rad/s2; fades out
  double throttle_ = 0, throttle_left_ = 0;
  bool begun_ = false, fresh_ = false;
};
