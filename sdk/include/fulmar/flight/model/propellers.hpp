// SPDX-License-Identifier: BSD-3-Clause
// Propellers at their places: thrust and torque on the airframe. Each follows propulsion.hpp, at the airspeed
// of the centre of gravity. Rigid-body statics: M = r x T a - s Q a with the unit vector a of its axis, s = 1
// for right rotation.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/model/propulsion.hpp"
#include "fulmar/flight/model/rigid_body.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Axis of the propeller, in the direction of its thrust.
inline Eigen::Vector3d axis_of(const PropellerPlace& p) {
  return {std::cos(p.tilt_rad) * std::cos(p.toe_rad), std::cos(p.tilt_rad) * std::sin(p.toe_rad),
          -std::sin(p.tilt_rad)};
}

/// All propellers of an airframe: force, N, and moment, N m, in body axes, about the centre of gravity.
class Propellers {
 public:
  static constexpr std::size_t most = 8;

  explicit Propellers(const Airframe& a) : alone_(a.propulsion.propellers.empty()) {
    for (const PropellerPlace& p : a.propulsion.propellers) {
      const Eigen::Vector3d axis = axis_of(p);
      Place& place = places_[count_++];
      place.axis = axis;
      place.arm = eigen(p.at_m).cross(axis);
      place.spin = p.turns == Turns::right ? axis : Eigen::Vector3d(-axis);
      // nose left, positive rudder: more thrust on the right
      place.per_rudder = std::copysign(p.differential_frac, p.at_m.y) / std::max(a.rudder.limit_rad, 1e-9);
      differential_ = differential_ || p.differential_frac > 0;
      all_.axis += place.axis;
      all_.arm += place.arm;
      all_.spin += place.spin;
    }
    if (!alone_) return;
    count_ = 1;
    all_.axis = all_.spin = places_[0].axis = places_[0].spin = Eigen::Vector3d::UnitX();
  }

  std::size_t count() const { return count_; }
  /// True for one propeller on the x axis through the centre of gravity.
  bool alone() const { return alone_; }
  /// True if propellers have different speeds.
  bool differential() const { return differential_; }
  /// Forward thrust of all propellers, per thrust of one.
  double along() const { return all_.axis.x(); }
  /// Angular momentum of all propellers at one speed, per angular momentum of one.
  const Eigen::Vector3d& spin() const { return all_.spin; }
  const Eigen::Vector3d& spin(std::size_t i) const { return places_[i].spin; }

  /// Throttle of one propeller.
  template <class S>
  S throttle(std::size_t i, const S& of_all, const S& rudder) const {
    using std::max, std::min;
    return max(S(0.0), min(S(1.0), S(of_all + places_[i].per_rudder * rudder)));
  }

  /// Adds the load of all propellers at one speed.
  template <class S>
  void add(const S& thrust, const S& torque, LoadOf<S>& load) const {
    if (alone_) {
      load.force_b.x() += thrust;
      load.moment_b.x() -= torque;
    } else {
      add(all_, thrust, torque, load);
    }
  }
  /// Adds the load of one propeller.
  template <class S>
  void add_one(std::size_t i, const S& thrust, const S& torque, LoadOf<S>& load) const {
    add(places_[i], thrust, torque, load);
  }

  /// Adds the load in balance with the motors: at speed `Omega`. Propellers with a share of the rudder have
  /// the speeds of their own throttle.
  template <class S>
  LoadOf<S> steady_load(const Propeller& p, const S& Omega, const S& rudder, const S& Va,
                        const S& rho) const {
    LoadOf<S> load;
    if (!differential_) {
      add<S>(p.thrust_of<S>(Omega, Va, rho), p.torque_of<S>(Omega, Va, rho), load);
      return load;
    }
    const S all = p.throttle_for_of<S>(Omega, Va, rho);
    for (std::size_t i = 0; i < count_; ++i) {
      const S own =
          places_[i].per_rudder == 0 ? Omega : p.steady_speed_of<S>(throttle<S>(i, all, rudder), Va, rho);
      add_one<S>(i, p.thrust_of<S>(own, Va, rho), p.torque_of<S>(own, Va, rho), load);
    }
    return load;
  }

  /// Sum of the speeds about the axes in that balance, rad/s.
  template <class S>
  Eigen::Vector3<S> steady_spin(const Propeller& p, const S& Omega, const S& rudder, const S& Va,
                                const S& rho) const {
    Eigen::Vector3<S> sum(S(0.0), S(0.0), S(0.0));
    const auto turn = [&](const S& speed, const Eigen::Vector3d& axis) {
      for (int k = 0; k < 3; ++k) sum(k) += speed * axis(k);
    };
    if (!differential_) {
      turn(Omega, all_.spin);
      return sum;
    }
    const S all = p.throttle_for_of<S>(Omega, Va, rho);
    for (std::size_t i = 0; i < count_; ++i)
      turn(places_[i].per_rudder == 0 ? Omega : p.steady_speed_of<S>(throttle<S>(i, all, rudder), Va, rho),
           places_[i].spin);
    return sum;
  }

 private:
  struct Place {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< axis of the thrust
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();   ///< r x axis
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< axis of right-handed rotation
    double per_rudder = 0;                           ///< change of throttle per rad of rudder
  };

  template <class S>
  [[gnu::noinline]] static void add(const Place& p, const S& thrust, const S& torque, LoadOf<S>& load) {
    for (int k = 0; k < 3; ++k) {
      load.force_b(k) += thrust * p.axis(k);
      load.moment_b(k) += thrust * p.arm(k) - torque * p.spin(k);
    }
  }

  bool alone_ = true, differential_ = false;
  std::size_t count_ = 0;
  std::array<Place, most> places_;
  Place all_;
};

}  // namespace fulmar
