// SPDX-License-Identifier: BSD-3-Clause
// The simulated aircraft as one function, rate = f(state, inputs), with the simulator's aerodynamics,
// propeller, air and rigid body. Twelve states as in Beard & McLain, Small Unmanned Aircraft (2012), table
// 3.1; still air; propeller and servos at their commands.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/flight/model/propellers.hpp"
#include "fulmar/flight/model/propulsion.hpp"
#include "fulmar/flight/model/rigid_body.hpp"

namespace fulmar {

/// Indices of states and inputs in their vectors.
namespace model {
/// North, east and down, m; velocity in body axes, m/s; Euler angles, rad; body rates, rad/s.
enum State : int { north, east, down, u, v, w, roll, pitch, yaw, p, q, r };
/// Deflections in rad, signs as in `Actuators`; throttle 0 to 1.
enum Input : int { aileron, elevator, rudder, throttle };
inline constexpr int states = 12, inputs = 4;
template <class S>
using StateVector = Eigen::Matrix<S, states, 1>;
template <class S>
using InputVector = Eigen::Matrix<S, inputs, 1>;
}  // namespace model

/// The element xz is the negative of the product of inertia, as in Beard & McLain, section 3.3.
inline Eigen::Matrix3d inertia_matrix(const Inertia& i) {
  Eigen::Matrix3d J;
  J << i.xx_kgm2, 0, -i.xz_kgm2, 0, i.yy_kgm2, 0, -i.xz_kgm2, 0, i.zz_kgm2;
  return J;
}

/// Velocity in body axes. Beard & McLain (2.7).
template <class S>
Eigen::Vector3<S> air_velocity(double Va, const S& alpha, const S& beta) {
  using std::cos, std::sin;
  return {Va * cos(alpha) * cos(beta), Va * sin(beta), Va * sin(alpha) * cos(beta)};
}

/// The model of one airframe in still standard air. `S` is double, or Dual for derivatives.
class AircraftModel {
 public:
  /// `altitude_m`: altitude above mean sea level of the state `down` = 0; geopotential, if the difference
  /// matters.
  explicit AircraftModel(const Airframe& a, double altitude_m, const AirOffset& offset = {},
                         double gravity_mps2 = isa::g0)
      : airframe_(a),
        aero_(a),
        propeller_(a.propulsion),
        propellers_(a),
        mass_(a.mass_kg, inertia_matrix(a.inertia)),
        altitude_m_(altitude_m),
        offset_(offset),
        gravity_mps2_(gravity_mps2) {
    aero_.set_speed_of_sound(standard_air(altitude_m, offset).speed_of_sound_mps());
  }

  const Airframe& airframe() const { return airframe_; }
  const Aerodynamic& aerodynamic() const { return aero_; }
  const Propeller& propeller() const { return propeller_; }
  const Propellers& propellers() const { return propellers_; }
  /// Flaps are no input: they keep this deflection.
  void set_flap(double rad) { flap_rad_ = rad; }
  double flap_rad() const { return flap_rad_; }
  double altitude_m() const { return altitude_m_; }

  /// Force without gravity, and moment, at propeller speed `Omega`.
  template <class S>
  LoadOf<S> load(const Eigen::Vector3<S>& v_b, const Eigen::Vector3<S>& omega_b, const DeflectionsOf<S>& d,
                 const S& Omega, const S& rho) const {
    LoadOf<S> load = aero_.load_of<S>(v_b, omega_b, d, rho);
    const S Va = v_b.norm();
    if (aero_.washed()) aero_.add_wash<S>(v_b, d, propeller_.thrust_of<S>(Omega, Va, rho), rho, load);
    const LoadOf<S> push = propellers_.steady_load<S>(propeller_, Omega, d.rudder, Va, rho);
    load.force_b += push.force_b;
    load.moment_b += push.moment_b;
    if (const double I = propeller_.inertia_kgm2(); I > 0) {
      const Eigen::Vector3<S> spin = propellers_.steady_spin<S>(propeller_, Omega, d.rudder, Va, rho);
      load.moment_b -= omega_b.cross(Eigen::Vector3<S>(S(I) * spin.x(), S(I) * spin.y(), S(I) * spin.z()));
    }
    return load;
  }

  /// dx/dt at propeller speed `Omega`. Beard & McLain (3.14)-(3.17), velocity in body axes.
  template <class S>
  model::StateVector<S> rate_at(const model::StateVector<S>& x, const DeflectionsOf<S>& d,
                                const S& Omega) const {
    using std::cos, std::sin;
    const S &phi = x(model::roll), &theta = x(model::pitch);
    const Eigen::Vector3<S> v_b = x.template segment<3>(model::u), w = x.template segment<3>(model::p);
    RigidBodyOf<S> body;
    body.p_n = x.template segment<3>(model::north);
    body.q_nb = Eigen::AngleAxis<S>(x(model::yaw), Eigen::Vector3<S>::UnitZ()) *
                Eigen::AngleAxis<S>(theta, Eigen::Vector3<S>::UnitY()) *
                Eigen::AngleAxis<S>(phi, Eigen::Vector3<S>::UnitX());
    body.v_n = body.q_nb * v_b;
    body.omega_b = w;
    const RigidBodyRateOf<S> d_n = rate_of(body, load(v_b, w, d, Omega, density(x)), mass_, gravity());
    const S along = w.y() * sin(phi) + w.z() * cos(phi);
    model::StateVector<S> rate;
    rate.template segment<3>(model::north) = d_n.p_n;
    rate.template segment<3>(model::u) = body.q_nb.conjugate() * d_n.v_n - w.cross(v_b);
    rate(model::roll) = w.x() + along * sin(theta) / cos(theta);  // (3.16)
    rate(model::pitch) = w.y() * cos(phi) - w.z() * sin(phi);
    rate(model::yaw) = along / cos(theta);
    rate.template segment<3>(model::p) = d_n.omega_b;
    return rate;
  }

  /// dx/dt with motor and propeller in balance.
  template <class S>
  model::StateVector<S> rate(const model::StateVector<S>& x, const model::InputVector<S>& input) const {
    const S Va = x.template segment<3>(model::u).norm();
    const S Omega = propeller_.steady_speed_of<S>(input(model::throttle), Va, density(x));
    return rate_at<S>(x, {input(model::aileron), input(model::elevator), input(model::rudder), S(flap_rad_)},
                      Omega);
  }

  template <class S>
  S density(const model::StateVector<S>& x) const {
    return standard_air_of<S>(altitude_m_ - x(model::down), offset_).density_kgm3;
  }
  Eigen::Vector3d gravity() const { return {0, 0, gravity_mps2_}; }

 private:
  Airframe airframe_;
  Aerodynamic aero_;
  Propeller propeller_;
  Propellers propellers_;
  MassProperties mass_;
  double altitude_m_;
  AirOffset offset_;
  double gravity_mps2_, flap_rad_ = 0;
};

}  // namespace fulmar
