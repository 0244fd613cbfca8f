// SPDX-License-Identifier: BSD-3-Clause
// An aircraft for closed-loop tests of control laws: the nonlinear six degrees of freedom of flight/, servos
// and motor with a lag, ideal state. The parameters are those of the Anaconda (4.5 kg, 2.08 m).
#pragma once
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/earth/dryden.hpp>
#include <fulmar/flight/math/attitude.hpp>
#include <fulmar/flight/model/aerodynamics.hpp>
#include <fulmar/flight/model/propulsion.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/vehicle_state.hpp>

namespace fulmar::test {

inline Airframe anaconda() {
  Airframe a;
  a.name = "anaconda";
  a.mass_kg = 4.5;
  a.inertia = {0.24855, 0.3784, 0.618, 0.06};
  a.wing = {.area_m2 = 0.52,
            .span_m = 2.08,
            .chord_m = 0.235,
            .oswald_ratio = 0.9,
            .stall_alpha_rad = 0.2618,
            .stall_sharpness_ratio = 50};
  a.aero.parasite_drag_ratio = 0.043;
  a.aero.lift = {.zero_ratio = 0.506, .alpha_ratio = 5.61, .q_ratio = 7.95, .elevator_ratio = 0.13};
  a.aero.side = {.beta_ratio = -0.98, .aileron_ratio = 0.075, .rudder_ratio = 0.19};
  a.aero.roll = {
      .beta_ratio = -0.13, .p_ratio = -0.51, .r_ratio = 0.25, .aileron_ratio = 0.17, .rudder_ratio = 0.0024};
  a.aero.pitch = {.zero_ratio = 0.135, .alpha_ratio = -2.74, .q_ratio = -38.21, .elevator_ratio = -0.99};
  a.aero.yaw = {.beta_ratio = 0.1301,
                .p_ratio = -0.0364,
                .r_ratio = -0.1541,
                .aileron_ratio = -0.011,
                .rudder_ratio = -0.069};
  a.propulsion = {.propeller_diameter_m = 0.381,
                  .ct0_ratio = 0.06288743,
                  .ct1_ratio = -0.02704452,
                  .ct2_ratio = -0.31320732,
                  .cq0_ratio = 0.00614891,
                  .cq1_ratio = -0.0106795,
                  .cq2_ratio = -0.011779,
                  .torque_constant_ratio = 0.01705,
                  .resistance_ohm = 0.042,
                  .no_load_amp = 1.5,
                  .battery_volt = 24,
                  .time_constant_s = 0.1,
                  .propellers = {},
                  .pack = {},
                  .disc = {}};
  for (Surface* s : {&a.aileron, &a.elevator, &a.rudder}) {
    s->limit_rad = 0.698;
    s->time_constant_s = 0.02;
  }
  a.elevator.trim_rad = 0.12;
  a.limits = {.airspeed_min_mps = 12,
              .airspeed_cruise_mps = 17,
              .airspeed_max_mps = 25,
              .roll_max_rad = 0.785,
              .pitch_max_rad = 0.35,
              .pitch_min_rad = -0.35,
              .climb_rate_max_mps = 4,
              .sink_rate_max_mps = 3,
              .throttle_cruise_frac = 0.57};
  return a;
}

struct FlightModel {
  static constexpr double field_m = 1387;  ///< altitude of the origin above mean sea level
  Airframe airframe;
  Aerodynamic aero;
  Propeller propeller;
  MassProperties mass;
  RigidBody x;
  Eigen::Vector3d wind_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_b{0, 0, -isa::g0};
  Deflections surfaces;
  double propeller_speed = 0;
  Dryden gusts;

  explicit FlightModel(const Airframe& a = anaconda(), Turbulence turbulence = Turbulence::none,
                       std::uint64_t seed = 1)
      : airframe(a),
        aero(a),
        propeller(a.propulsion),
        mass(a.mass_kg, inertia(a)),
        gusts(dryden_scales(turbulence), seed) {
    x.p_n = {0, 0, -70};
    x.v_n = {a.limits.airspeed_cruise_mps, 0, 0};
    propeller_speed = propeller.steady_speed(a.limits.throttle_cruise_frac, x.v_n.x(), density());
    surfaces.elevator = a.elevator.trim_rad;
  }

  static Eigen::Matrix3d inertia(const Airframe& a) {
    Eigen::Matrix3d J = Eigen::Vector3d(a.inertia.xx_kgm2, a.inertia.yy_kgm2, a.inertia.zz_kgm2).asDiagonal();
    J(0, 2) = J(2, 0) = -a.inertia.xz_kgm2;
    return J;
  }
  double density() const { return standard_air(field_m - x.p_n.z()).density_kgm3; }

  Eigen::Vector3d air_velocity(const RigidBody& b) const {
    return b.q_nb.conjugate() * (b.v_n - wind_n) - gusts.gust();
  }

  void step(const Actuators& u, double dt) {
    const auto servo = [&](double& position, double command, const Surface& s) {
      const double move = (std::clamp(command, -s.limit_rad, s.limit_rad) - position) *
                          (1 - std::exp(-dt / s.time_constant_s));
      position += std::clamp(move, -s.rate_limit_radps * dt, s.rate_limit_radps * dt);
    };
    servo(surfaces.aileron, u.aileron_rad, airframe.aileron);
    servo(surfaces.elevator, u.elevator_rad, airframe.elevator);
    servo(surfaces.rudder, u.rudder_rad, airframe.rudder);
    const double rho = density(), Va = air_velocity(x).norm();
    gusts.advance(dt, Va);
    propeller_speed += (propeller.steady_speed(u.throttle_frac, Va, rho) - propeller_speed) *
                       (1 - std::exp(-dt / airframe.propulsion.time_constant_s));
    const auto load_at = [&](const RigidBody& b, double) {
      const Eigen::Vector3d v_r = air_velocity(b);
      Load load = aero.load(v_r, b.omega_b, surfaces, rho);
      load.force_b.x() += propeller.thrust(propeller_speed, v_r.norm(), rho);
      load.moment_b.x() -= propeller.torque(propeller_speed, v_r.norm(), rho);
      return load;
    };
    const Load first = load_at(x, 0);
    specific_force_b = first.force_b / airframe.mass_kg;
    x = runge_kutta(x, first, dt, mass, Eigen::Vector3d(0, 0, isa::g0), load_at);
  }

  /// State of an ideal estimator.
  VehicleState state() const {
    const Euler e = euler_from(x.q_nb);
    const AirData air(air_velocity(x));
    VehicleState s;
    s.position_m = from_eigen<Ned>(x.p_n);
    s.velocity_mps = from_eigen<Ned>(x.v_n);
    s.attitude = from_eigen(x.q_nb);
    s.roll_rad = e.roll_rad;
    s.pitch_rad = e.pitch_rad;
    s.yaw_rad = e.yaw_rad;
    s.rate_radps = from_eigen<Body>(x.omega_b);
    s.specific_force_mps2 = from_eigen<Body>(specific_force_b);
    s.height_m = -x.p_n.z();
    s.climb_rate_mps = -x.v_n.z();
    s.ground_speed_mps = x.v_n.head<2>().norm();
    s.course_rad = s.ground_speed_mps > 0.5 ? std::atan2(x.v_n.y(), x.v_n.x()) : s.yaw_rad;
    s.airspeed_mps = air.Va;
    s.alpha_rad = air.alpha;
    s.beta_rad = air.beta;
    s.wind_mps = from_eigen<Ned>(wind_n);
    s.origin_altitude_m = field_m;
    s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
        s.airspeed_valid = s.wind_valid = true;
    return s;
  }
};

}  // namespace fulmar::test
