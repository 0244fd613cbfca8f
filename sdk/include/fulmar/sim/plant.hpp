// SPDX-License-Identifier: BSD-3-Clause
// The simulated aircraft: servos, motor, aerodynamics, turbulence and ground around a rigid body. Beard &
// McLain, chapters 3 and 4.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/flight/model/propulsion.hpp"
#include "fulmar/flight/model/rigid_body.hpp"
#include "fulmar/flight/model/round_earth.hpp"
#include "fulmar/flight/model/trim.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/sim/battery.hpp"
#include "fulmar/sim/departure.hpp"
#include "fulmar/sim/disturbances.hpp"
#include "fulmar/sim/ground.hpp"
#include "fulmar/sim/motors.hpp"
#include "fulmar/sim/slope.hpp"
#include "fulmar/sim/surfaces.hpp"
#include "fulmar/sim/weather.hpp"

namespace fulmar::sim {

/// Earth model: flat ground and constant gravity, flat ground and gravity by latitude and height, or the
/// rotating ellipsoid.
enum class EarthModel : std::uint8_t { flat, gravity, wgs84 };
/// Ground below the aircraft; not for the rotating ellipsoid.
struct Terrain {
  double slope_rad = 0, rises_towards_rad = 0;  ///< slope of the plane through the origin
  double friction_ratio = 1;                    ///< factor on the friction of the airframe
  bool ground_effect = false;                   ///< reduced induced drag near the ground
};
struct Earth {  ///< the Earth below the aircraft
  EarthModel model = EarthModel::flat;
  double lat_rad = 0, lon_rad = 0;  ///< position of the origin
  Terrain terrain{};
};

/// The last touch-down, or the contact that broke the aircraft: the part, and the state at that time.
/// Velocity and attitude are relative to the ground, the position is in the frame of the origin.
struct Touch {
  std::uint32_t count = 0;  ///< 0: none yet
  const char* part = "";
  RigidBody at;
};

class Plant {  ///< the simulated aircraft; SI units, NED from the origin, body axes
 public:
  Plant(const Airframe& a, const Weather& weather, double origin_altitude_m, std::uint64_t seed,
        const Earth& earth = {})
      : airframe_(a),
        mass_(a.mass_kg, inertia(a)),
        aero_(a),
        propeller_(a.propulsion),
        propellers_(a),
        battery_(a.propulsion),
        slope_(earth.terrain.slope_rad, earth.terrain.rises_towards_rad),
        ground_(a, earth.terrain.friction_ratio),
        disturbances_(weather, seed),
        surfaces_(a),
        flap_(a.flap),
        has_flaps_(has_flaps(a.aero)),
        weather_(weather),
        origin_altitude_m_(origin_altitude_m),
        earth_(earth),
        turning_({earth.lat_rad, earth.lon_rad, origin_altitude_m}),
        level_(turning_, Eigen::Vector3d::Zero()) {
    stand(0, 0, 0);
  }

  /// Sets the aircraft at rest on the ground.
  void stand(double north_m, double east_m, double heading_rad) {
    x_ = RigidBody{};
    clear_events();
    const Standing& at = ground_.standing();
    x_.p_n = {north_m, east_m, -at.height_m};
    x_.q_nb = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ());
    if (slope_.some()) x_ = slope_.standing(north_m, east_m, heading_rad, at.height_m);
    if (!airframe_.gear.contacts.empty()) x_.q_nb = x_.q_nb * at.tilt;
    ground_.stand();
    put_in_frame();
    refresh();
  }

  /// Sets steady level flight in the steady wind. Returns false if the aircraft cannot fly at this speed.
  /// `p_n.z()` is minus the height.
  bool fly(const Eigen::Vector3d& p_n, double heading_rad, double Va) {
    const double altitude_m = origin_altitude_m_ - p_n.z();
    const Trim trim =
        trimmed_flight(airframe_, Va, air_at(altitude_m).density_kgm3, 0, gravity_at(altitude_m));
    if (!trim.found) return false;
    trim_ = trim;
    clear_events();
    x_ = RigidBody{};
    x_.p_n = p_n;
    x_.q_nb = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(trim.pitch_rad, Eigen::Vector3d::UnitY());
    if (trim.roll_rad != 0) x_.q_nb = x_.q_nb * Eigen::AngleAxisd(trim.roll_rad, Eigen::Vector3d::UnitX());
    const Eigen::Vector3d v_r(Va * std::cos(trim.alpha_rad) * std::cos(trim.beta_rad),
                              Va * std::sin(trim.beta_rad),
                              Va * std::sin(trim.alpha_rad) * std::cos(trim.beta_rad));
    x_.v_n = x_.q_nb * v_r + steady_wind(x_);
    surfaces_.set(trim.deflections);
    Omega_ = trim.propeller_radps;
    if (propellers_.differential())
      motors_.set(propellers_, propeller_, trim, Va, air_at(altitude_m).density_kgm3);
    put_in_frame();
    refresh();
    return true;
  }

  /// Trim of the last `fly`.
  const Trim& trim() const { return trim_; }

  /// One step. `power` is the available fraction of the full battery voltage; 0 stops the motor at any
  /// throttle.
  [[gnu::flatten]] void advance(const Actuators& command, double power, double dt) {
    throttle_ = power * std::clamp(command.throttle_frac, 0.0, 1.0);
    if (ground_.crashed()) {
      throttle_ = Omega_ = 0;
      motors_.stop();
      return;
    }
    if (battery_.empty()) power = throttle_ = 0;
    if (surfaces_.free()) surfaces_.trail_at(trailing(relative(x_), x_.omega_b, airframe_.wing.span_m));
    const Deflections commanded = surfaces_.commanded(command);
    const double Omega_steady = propeller_.steady_speed(throttle_, Va_, air_.density_kgm3);
    const double Omega_before = Omega_;
    for (Stage& stage : stage_) {
      surfaces_.advance(commanded, 0.5 * dt);
      Omega_ = Omega_steady + (Omega_ - Omega_steady) * motor_decay(0.5 * dt);
      if (has_flaps_) flap_.advance(flap_command_, 0.5 * dt);
      stage = {deflections(), Omega_};
    }
    if (propellers_.differential()) turn_motors(command, power, dt);
    if (propeller_.inertia_kgm2() > 0) spin_up(Omega_before, Omega_steady, dt);
    const auto load_at = [&](const RigidBody& x, double part) {
      const std::size_t i = part > 0.75 ? 1 : 0;
      return load(x, stage_[i], i);
    };
    x_ = turns() ? runge_kutta(x_, load_, dt, mass_, turning_, load_at)
                 : runge_kutta(x_, load_, dt, mass_, g_n_, load_at);
    if (slope_.some()) [[unlikely]]
      ground_.advance(slope_.seen(x_), dt);
    else
      ground_.advance(turns() ? level_.seen(x_) : x_, dt);
    note_touch();
    if (ground_.crashed()) rest();  // stays at the place of the crash
    disturb(dt);
    if (battery_.drains()) drain(dt);
    refresh();
    if (departure_ == Departure::none) departure_ = judged();
  }

  /// Moves without forces. Before arming, an aircraft in the air keeps its steady flight, and one on the
  /// ground stands.
  void carry(double dt) {
    x_.p_n += dt * x_.v_n;
    disturb(dt);
    refresh();
    load_.force_b = -mass_.mass * (x_.q_nb.conjugate() * g_n_);
    load_.moment_b.setZero();
  }
  /// The same with an acceleration along the nose, m/s2: hand launch or catapult.
  void push(double mps2, double dt) {
    const Eigen::Vector3d a_n = mps2 * (x_.q_nb * Eigen::Vector3d::UnitX());
    x_.p_n += 0.5 * dt * dt * a_n;
    carry(dt);
    x_.v_n += dt * a_n;
    load_.force_b.x() += mass_.mass * mps2;
  }

  /// Moves along the present velocity by this time, forwards or backwards.
  void shift(double seconds) { x_.p_n += seconds * x_.v_n; }
  /// Sets the state; clears a crash and a departure.
  void set_state(const RigidBody& x) {
    x_ = x;
    if (ground_.crashed() || departure_ != Departure::none) clear_events();
    refresh();
  }
  /// Sets servos and propeller; call it before `set_state`.
  void set_drives(const Deflections& d, double propeller_radps) {
    surfaces_.set(d);
    flap_.set(d.flap);
    motors_.set_all(propeller_radps);
    Omega_ = propeller_radps;
  }
  void set_wind(const Eigen::Vector3d& wind_n) { weather_.wind_n = wind_n; }
  /// Sets faults of the servos. With a mixer, the argument is the servo in that place (mixer.hpp).
  void suffer(const Fault& aileron, const Fault& elevator, const Fault& rudder) {
    surfaces_.suffer(aileron, elevator, rudder);
  }
  /// Sets aerodynamics with ice, or changed by the user; mass and trim stay.
  void set_aerodynamics(const Airframe& a) {
    aero_ = Aerodynamic(a);
    has_flaps_ = has_flaps(a.aero);
    aero_.set_speed_of_sound(air_.speed_of_sound_mps());
    feel_ground();
  }
  /// Flap command, rad; the servo follows it.
  void set_flap(double rad) { flap_command_ = rad; }
  /// Starts a discrete gust.
  void fire(const GustSpec& gust) { disturbances_.fire(gust); }

  /// State in the frame of the origin. The body rate is that of a gyro: relative to inertial space on the
  /// rotating Earth.
  const RigidBody& state() const { return x_; }
  /// State relative to the ground below: velocity and attitude by north, east and down at the aircraft, body
  /// rate relative to the Earth, `p_n.z()` minus the height. On flat ground equal to `state`.
  const RigidBody& seen() const { return turns() ? seen_ : x_; }
  const Air& air() const { return air_; }
  /// Specific force at the centre of gravity, as an accelerometer measures it.
  Eigen::Vector3d specific_force() const {
    if (ground_.crashed()) return -(x_.q_nb.conjugate() * g_n_);
    return load_.force_b / mass_.mass;
  }
  /// Angular acceleration relative to inertial space, rad/s2, with the present loads: Euler's equation.
  Eigen::Vector3d angular_acceleration() const {
    if (ground_.crashed()) return Eigen::Vector3d::Zero();
    return mass_.J_inverse * (load_.moment_b - x_.omega_b.cross(mass_.J * x_.omega_b));
  }
  Eigen::Vector3d air_velocity_b() const { return relative(seen()); }
  /// Velocity of the air by north, east and down at the place of the aircraft.
  Eigen::Vector3d wind_n() const { return steady_wind(seen()) + seen().q_nb * gust_b_; }
  Deflections deflections() const {
    Deflections d = surfaces_.deflections();
    d.flap = flap_.angle();
    return d;
  }
  /// Servo angles, in the fields of mixer.hpp.
  Deflections servos() const { return surfaces_.servos(); }
  /// Speed of the propellers without a share of the rudder.
  double propeller_radps() const { return Omega_; }
  double propeller_radps(std::size_t i) const {
    return propellers_.differential() ? motors_.speed(i) : Omega_;
  }
  /// Battery current for all motors, A.
  double battery_amp() const {
    if (propellers_.differential()) return motors_.current(propellers_, propeller_);
    return static_cast<double>(propellers_.count()) *
           std::max(0.0, throttle_ * propeller_.current(throttle_, Omega_));
  }
  /// Voltage at the terminals, without a fault of the battery.
  double battery_volt() const {
    return battery_.open_volt() - airframe_.propulsion.pack.resistance_ohm * battery_amp();
  }
  double battery_used_ah() const { return battery_.used_ah(); }
  bool on_ground() const { return ground_.touching(); }
  bool crashed() const { return ground_.crashed(); }
  const Touch& touch() const { return touch_; }
  Departure departure() const { return departure_; }
  const Aerodynamic& aerodynamic() const { return aero_; }
  double height_above_ground() const { return slope_.height(seen().p_n); }

 private:
  struct Stage {
    Deflections deflections;
    double Omega = 0;
    Eigen::Vector3d spin_up_nm =
        Eigen::Vector3d::Zero();  ///< reaction of the airframe to the propellers' acceleration
  };

  static Eigen::Matrix3d inertia(const Airframe& a) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    J.diagonal() << a.inertia.xx_kgm2, a.inertia.yy_kgm2, a.inertia.zz_kgm2;
    J(0, 2) = J(2, 0) = -a.inertia.xz_kgm2;
    return J;
  }

  /// Clears contacts, damage and departure.
  void clear_events() {
    ground_ = Ground(airframe_, earth_.terrain.friction_ratio);
    touch_ = {};
    departure_ = Departure::none;
  }

  double motor_decay(double dt) {
    if (dt != motor_dt_) {
      motor_dt_ = dt;
      const double tau = propeller_.time_constant_s();
      motor_decay_ = tau > 0 ? std::exp(-dt / tau) : 0;
    }
    return motor_decay_;
  }

  /// On the ground any flow direction is valid.
  Departure judged() const {
    if (diverged(x_)) return Departure::diverged;
    return ground_.touching() || ground_.crashed() ? Departure::none : beyond_tables(aero_, relative(seen()));
  }

  /// Propeller acceleration by the lag at the start, the middle and the end of the step. Without a lag the
  /// speed changes evenly over the step.
  [[gnu::noinline]] void spin_up(double Omega_before, double Omega_steady, double dt) {
    const double I = propeller_.inertia_kgm2(), tau = propeller_.time_constant_s();
    if (propellers_.differential()) {
      for (const std::size_t i : {0u, 1u}) stage_[i].spin_up_nm = I * motors_.gain(propellers_, i, tau, dt);
      load_.moment_b -= I * motors_.gain_at_begin(propellers_, tau, dt);
      return;
    }
    const auto moment = [&](double Omega) -> Eigen::Vector3d {
      return (tau > 0 ? I * (Omega_steady - Omega) / tau : I * (Omega_ - Omega_before) / dt) *
             propellers_.spin();
    };
    for (Stage& s : stage_) s.spin_up_nm = moment(s.Omega);
    load_.moment_b -= moment(Omega_before);
  }

  /// Moment -omega x h - h', with the angular momentum h = I sum(Omega_i a_i) of the propellers. Euler's
  /// equation of the aircraft with its propellers.
  [[gnu::noinline]] void add_spin(const Stage& s, std::size_t i, const Eigen::Vector3d& omega_b,
                                  Load& load) const {
    const Eigen::Vector3d spin = propellers_.differential() ? motors_.spin(propellers_, i)
                                                            : Eigen::Vector3d(s.Omega * propellers_.spin());
    load.moment_b -= s.spin_up_nm + omega_b.cross(propeller_.inertia_kgm2() * spin);
  }

  bool turns() const { return earth_.model == EarthModel::wgs84; }

  void disturb(double dt) {
    move_air(dt);
    if (disturbances_.rotates()) gust_rate_b_ = disturbances_.rotation(dt, Va_);
  }

  void move_air(double dt) {
    if (!disturbances_.of_place()) {
      gust_b_ = disturbances_.advance(dt, Va_);
      return;
    }
    const RigidBody x = turns() ? level_.seen(x_) : x_;
    gust_b_ = disturbances_.advance_at(dt, Va_, x, slope_.height(x.p_n), steady_wind(x));
  }

  void feel_ground() {
    if (earth_.terrain.ground_effect)
      aero_.near_ground(induced_drag_near_ground(height_above_ground(), airframe_.wing.span_m));
  }

  /// Converts the state from relative to the ground below into the frame of the origin.
  void put_in_frame() {
    if (!turns()) return;
    level_ = LocalLevel(turning_, x_.p_n);
    x_ = level_.in_frame(x_);
  }

  void note_touch() {
    if (ground_.touches() == touch_.count) return;
    touch_ = {ground_.touches(), ground_.touched_part(), turns() ? level_.seen(x_) : x_};
    touch_.at.p_n = x_.p_n;
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

  /// `x` is relative to the ground below; also in `relative`.
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

  [[gnu::noinline]] void turn_motors(const Actuators& command, double power, double dt) {
    motors_.command(propellers_, propeller_, power, std::clamp(command.throttle_frac, 0.0, 1.0),
                    command.rudder_rad, Va_, air_.density_kgm3);
    for (const std::size_t i : {0u, 1u}) motors_.advance(propellers_, i, motor_decay(0.5 * dt));
  }

  [[gnu::noinline]] void drain(double dt) {
    battery_.drain(battery_amp(), dt);
    propeller_.set_voltage(battery_.open_volt());
  }

  /// Load at the first or second stage.
  Load load(const RigidBody& x, const Stage& s, std::size_t i) const {
    return turns() ? load_seen(level_.seen(x), s, i) : load_seen(x, s, i);
  }

  Load load_seen(const RigidBody& x, const Stage& s, std::size_t i) const {
    const Eigen::Vector3d v_r = relative(x);
    const double rho = air_.density_kgm3;
    Load load = aero_.load(v_r, x.omega_b - gust_rate_b_, s.deflections, rho);
    const double Va = plain::norm<double>(v_r);
    if (aero_.washed())
      aero_.add_wash<double>(v_r, s.deflections, propeller_.thrust(s.Omega, Va, rho), rho, load);
    if (propellers_.differential())
      motors_.add_load(propellers_, propeller_, i, Va, rho, load);
    else
      propellers_.add<double>(propeller_.thrust(s.Omega, Va, rho), propeller_.torque(s.Omega, Va, rho), load);
    if (propeller_.inertia_kgm2() > 0) add_spin(s, i, x.omega_b, load);
    if (slope_.some()) [[unlikely]]
      add_load_on_slope(x, load);
    else
      ground_.add_load(x, load);
    return load;
  }

  [[gnu::noinline]] void add_load_on_slope(const RigidBody& x, Load& load) const {
    ground_.add_load(slope_.seen(x), load);
  }

  /// Load at the present state: the first stage of the next step, and the present specific force. Air and
  /// gravity stay constant over the next step.
  void refresh() {
    if (turns()) {
      level_ = LocalLevel(turning_, x_.p_n);
      seen_ = level_.seen(x_);
    }
    const double altitude_m = origin_altitude_m_ - seen().p_n.z();
    g_n_ =
        turns() ? turning_.free_acceleration(x_.p_n, x_.v_n) : Eigen::Vector3d(0, 0, gravity_at(altitude_m));
    air_ = air_at(altitude_m);
    if (aero_.over_mach()) aero_.set_speed_of_sound(air_.speed_of_sound_mps());
    Va_ = plain::norm<double>(relative(seen()));
    feel_ground();
    load_ = load_seen(seen(), {deflections(), Omega_}, 1);
  }

  Airframe airframe_;
  MassProperties mass_;
  Aerodynamic aero_;
  Propeller propeller_;
  Propellers propellers_;
  Motors motors_;
  BatteryState battery_;
  Slope slope_;
  Ground ground_;
  Touch touch_;
  Disturbances disturbances_;
  Surfaces surfaces_;
  Drive flap_;
  bool has_flaps_;
  double flap_command_ = 0;
  Weather weather_;
  double origin_altitude_m_;
  Earth earth_;
  RotatingEarth turning_;
  LocalLevel level_;  ///< at the place of the aircraft at the start of the step

  Trim trim_;
  RigidBody x_, seen_;
  Eigen::Vector3d g_n_ = Eigen::Vector3d::Zero();  ///< gravity of free motion
  Air air_;
  Load load_;
  std::array<Stage, 2> stage_;
  Eigen::Vector3d gust_b_ = Eigen::Vector3d::Zero(), gust_rate_b_ = Eigen::Vector3d::Zero();
  double Omega_ = 0, Va_ = 0, throttle_ = 0;
  double motor_dt_ = -1, motor_decay_ = 0;
  Departure departure_ = Departure::none;
};

}  // namespace fulmar::sim
