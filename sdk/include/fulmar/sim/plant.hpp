// SPDX-License-Identifier: BSD-3-Clause
// The aircraft in its air: servos, motor, aerodynamics, turbulence and ground around a rigid body. Beard &
// McLain, chapters 3 and 4.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "fulmar/flight/aerodynamics.hpp"
#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/dryden.hpp"
#include "fulmar/flight/earth.hpp"
#include "fulmar/flight/propulsion.hpp"
#include "fulmar/flight/rigid_body.hpp"
#include "fulmar/flight/trim.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/sim/drive.hpp"
#include "fulmar/sim/ground.hpp"
#include "fulmar/sim/weather.hpp"

namespace fulmar::sim {

/// What lies below: flat ground and constant gravity, flat ground and gravity by latitude and height, or the
/// turning ellipsoid.
enum class EarthModel : std::uint8_t { flat, gravity, wgs84 };
struct Earth {
  EarthModel model = EarthModel::flat;
  double lat_rad = 0, lon_rad = 0;  ///< of the origin
};

class Plant {
 public:
  Plant(const Airframe& a, const Weather& weather, double origin_altitude_m, std::uint64_t seed,
        const Earth& earth = {})
      : airframe_(a),
        mass_(a.mass_kg, inertia(a)),
        aero_(a),
        propeller_(a.propulsion),
        ground_(a),
        dryden_(dryden_scales(weather.turbulence), seed),
        aileron_(a.aileron),
        elevator_(a.elevator),
        rudder_(a.rudder),
        weather_(weather),
        origin_altitude_m_(origin_altitude_m),
        earth_(earth),
        turning_({earth.lat_rad, earth.lon_rad, origin_altitude_m}),
        level_(turning_, Eigen::Vector3d::Zero()) {
    stand(0, 0, 0);
  }

  /// At rest on the ground.
  void stand(double north_m, double east_m, double heading_rad) {
    x_ = RigidBody{};
    x_.p_n = {north_m, east_m, -airframe_.gear.height_m};
    x_.q_nb = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ());
    ground_.stand();
    put_in_frame();
    refresh();
  }

  /// In steady level flight through the steady wind. False when the aircraft cannot fly at this speed.
  /// `p_n.z()` is minus the height.
  bool fly(const Eigen::Vector3d& p_n, double heading_rad, double Va) {
    const double altitude_m = origin_altitude_m_ - p_n.z();
    const Trim trim =
        trimmed_flight(airframe_, Va, air_at(altitude_m).density_kgm3, 0, gravity_at(altitude_m));
    if (!trim.found) return false;
    ground_ = Ground(airframe_);
    x_ = RigidBody{};
    x_.p_n = p_n;
    x_.q_nb = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(trim.pitch_rad, Eigen::Vector3d::UnitY());
    const Eigen::Vector3d v_r(Va * std::cos(trim.alpha_rad) * std::cos(trim.beta_rad),
                              Va * std::sin(trim.beta_rad),
                              Va * std::sin(trim.alpha_rad) * std::cos(trim.beta_rad));
    x_.v_n = x_.q_nb * v_r + steady_wind(x_);
    aileron_.set(trim.deflections.aileron);
    elevator_.set(trim.deflections.elevator);
    rudder_.set(trim.deflections.rudder);
    Omega_ = trim.propeller_radps;
    put_in_frame();
    refresh();
    return true;
  }

  /// One step. `power` is the share of the battery's full voltage that the throttle deals out: 0 stops the
  /// motor whatever it says.
  [[gnu::flatten]] void advance(const Actuators& command, double power, double dt) {
    throttle_ = power * std::clamp(command.throttle_frac, 0.0, 1.0);
    if (ground_.crashed()) {
      throttle_ = Omega_ = 0;
      return;
    }
    if (aileron_.free() || elevator_.free() || rudder_.free()) let_trail();
    const double Omega_steady = propeller_.steady_speed(throttle_, Va_, air_.density_kgm3);
    for (Stage& stage : stage_) {
      aileron_.advance(command.aileron_rad, 0.5 * dt);
      elevator_.advance(command.elevator_rad, 0.5 * dt);
      rudder_.advance(command.rudder_rad, 0.5 * dt);
      Omega_ = Omega_steady + (Omega_ - Omega_steady) * motor_decay(0.5 * dt);
      stage = {{aileron_.angle(), elevator_.angle(), rudder_.angle()}, Omega_};
    }
    const auto load_at = [&](const RigidBody& x, double part) {
      return load(x, stage_[part > 0.75 ? 1 : 0]);
    };
    x_ = turns() ? runge_kutta(x_, load_, dt, mass_, turning_, load_at)
                 : runge_kutta(x_, load_, dt, mass_, g_n_, load_at);
    ground_.advance(turns() ? level_.seen(x_) : x_, dt);
    if (ground_.crashed()) rest();  // it stays where it hit
    gust_b_ = dryden_.advance(dt, Va_);
    refresh();
  }

  /// Carried along without forces: before arming, an aircraft that starts in the air keeps its steady flight,
  /// one on the ground is held.
  void carry(double dt) {
    x_.p_n += dt * x_.v_n;
    gust_b_ = dryden_.advance(dt, Va_);
    refresh();
    load_.force_b = -mass_.mass * (x_.q_nb.conjugate() * g_n_);
    load_.moment_b.setZero();
  }

  /// Back (or on) along the present velocity.
  void shift(double seconds) { x_.p_n += seconds * x_.v_n; }
  void set_state(const RigidBody& x) {
    x_ = x;
    refresh();
  }
  /// Where servos and propeller are, before `set_state`.
  void set_drives(const Deflections& d, double propeller_radps) {
    aileron_.set(d.aileron);
    elevator_.set(d.elevator);
    rudder_.set(d.rudder);
    Omega_ = propeller_radps;
  }
  void set_wind(const Eigen::Vector3d& wind_n) { weather_.wind_n = wind_n; }
  void suffer(const Fault& aileron, const Fault& elevator, const Fault& rudder) {
    aileron_.suffer(aileron);
    elevator_.suffer(elevator);
    rudder_.suffer(rudder);
  }
  /// With ice on it; mass and trim stay.
  void set_aerodynamics(const Airframe& a) { aero_ = Aerodynamic(a); }

  /// In the frame of the origin; the body rate is that of a gyro, relative to inertial space where the Earth
  /// turns.
  const RigidBody& state() const { return x_; }
  /// As the ground below sees it: velocity and attitude by north, east and down at the aircraft's own place,
  /// the body rate relative to the Earth, `p_n.z()` minus the height. On flat ground the same as `state`.
  const RigidBody& seen() const { return turns() ? seen_ : x_; }
  const Air& air() const { return air_; }
  /// What an accelerometer at the centre of gravity measures.
  Eigen::Vector3d specific_force() const {
    if (ground_.crashed()) return -(x_.q_nb.conjugate() * g_n_);
    return load_.force_b / mass_.mass;
  }
  Eigen::Vector3d air_velocity_b() const { return relative(seen()); }
  /// By north, east and down at the aircraft's own place.
  Eigen::Vector3d wind_n() const { return steady_wind(seen()) + seen().q_nb * gust_b_; }
  Deflections deflections() const { return {aileron_.angle(), elevator_.angle(), rudder_.angle()}; }
  double propeller_radps() const { return Omega_; }
  double battery_amp() const { return std::max(0.0, throttle_ * propeller_.current(throttle_, Omega_)); }
  bool on_ground() const { return ground_.touching(); }
  bool crashed() const { return ground_.crashed(); }

 private:
  struct Stage {
    Deflections deflections;
    double Omega = 0;
  };

  static Eigen::Matrix3d inertia(const Airframe& a) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    J.diagonal() << a.inertia.xx_kgm2, a.inertia.yy_kgm2, a.inertia.zz_kgm2;
    J(0, 2) = J(2, 0) = -a.inertia.xz_kgm2;
    return J;
  }

  void let_trail() {
    const Deflections d = trailing(relative(x_), x_.omega_b, airframe_.wing.span_m);
    aileron_.trail_at(d.aileron);
    elevator_.trail_at(d.elevator);
    rudder_.trail_at(d.rudder);
  }

  double motor_decay(double dt) {
    if (dt != motor_dt_) {
      motor_dt_ = dt;
      const double tau = propeller_.time_constant_s();
      motor_decay_ = tau > 0 ? std::exp(-dt / tau) : 0;
    }
    return motor_decay_;
  }

  bool turns() const { return earth_.model == EarthModel::wgs84; }

  /// The state, so far as seen from the ground at its place, becomes one in the frame of the origin.
  void put_in_frame() {
    if (!turns()) return;
    level_ = LocalLevel(turning_, x_.p_n);
    x_ = level_.in_frame(x_);
  }

  void rest() {
    x_.v_n.setZero();
    x_.omega_b.setZero();
    if (turns()) x_.omega_b = x_.q_nb.conjugate() * turning_.rotation();
  }

  Air air_at(double altitude_m) const {
    return standard_air(earth_.model == EarthModel::flat ? altitude_m : geopotential_altitude(altitude_m),
                        weather_.offset);
  }

  double gravity_at(double altitude_m) const {
    return earth_.model == EarthModel::flat ? isa::g0 : normal_gravity(earth_.lat_rad, altitude_m);
  }

  /// Here `x` is as seen from the ground, and in `relative`.
  Eigen::Vector3d steady_wind(const RigidBody& x) const {
    if (weather_.shear.profile == WindProfile::constant) return weather_.wind_n;
    return weather_.shear.at(-x.p_n.z()) * weather_.wind_n;
  }

  Eigen::Vector3d relative(const RigidBody& x) const {
    const Eigen::Vector3d wind_n = steady_wind(x);
    const Eigen::Vector3d v_r = plain::rotated_back<double>(
        x.q_nb, {x.v_n.x() - wind_n.x(), x.v_n.y() - wind_n.y(), x.v_n.z() - wind_n.z()});
    return {v_r.x() - gust_b_.x(), v_r.y() - gust_b_.y(), v_r.z() - gust_b_.z()};
  }

  Load load(const RigidBody& x, const Stage& s) const {
    return turns() ? load_seen(level_.seen(x), s) : load_seen(x, s);
  }

  Load load_seen(const RigidBody& x, const Stage& s) const {
    const Eigen::Vector3d v_r = relative(x);
    const double rho = air_.density_kgm3;
    Load load = aero_.load(v_r, x.omega_b, s.deflections, rho);
    const double Va = plain::norm<double>(v_r);
    load.force_b.x() += propeller_.thrust(s.Omega, Va, rho);
    load.moment_b.x() -= propeller_.torque(s.Omega, Va, rho);
    ground_.add_load(x, load);
    return load;
  }

  /// The load at the present state: the first stage of the next step, and what the accelerometer feels now.
  /// Air and gravity are those of the present place for the whole next step.
  void refresh() {
    if (turns()) {
      level_ = LocalLevel(turning_, x_.p_n);
      seen_ = level_.seen(x_);
    }
    const double altitude_m = origin_altitude_m_ - seen().p_n.z();
    g_n_ =
        turns() ? turning_.free_acceleration(x_.p_n, x_.v_n) : Eigen::Vector3d(0, 0, gravity_at(altitude_m));
    air_ = air_at(altitude_m);
    Va_ = plain::norm<double>(relative(seen()));
    load_ = load_seen(seen(), {deflections(), Omega_});
  }

  Airframe airframe_;
  MassProperties mass_;
  Aerodynamic aero_;
  Propeller propeller_;
  Ground ground_;
  Dryden dryden_;
  Drive aileron_, elevator_, rudder_;
  Weather weather_;
  double origin_altitude_m_;
  Earth earth_;
  RotatingEarth turning_;
  LocalLevel level_;  ///< at the place at which the present step began

  RigidBody x_, seen_;
  Eigen::Vector3d g_n_ = Eigen::Vector3d::Zero();  ///< of what is free
  Air air_;
  Load load_;
  std::array<Stage, 2> stage_;
  Eigen::Vector3d gust_b_ = Eigen::Vector3d::Zero();
  double Omega_ = 0, Va_ = 0, throttle_ = 0;
  double motor_dt_ = -1, motor_decay_ = 0;
};

}  // namespace fulmar::sim
