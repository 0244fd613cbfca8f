// SPDX-License-Identifier: BSD-3-Clause
// Electric motor and propeller. Source: Beard & McLain, supplement to Small Unmanned Aircraft, "Propeller
// thrust and torque" (2nd edition 4.3): polynomials of thrust and torque over the advance ratio; motor speed
// from the balance of torques. If the airframe selects it, the disc of the first edition (2012), section 4.3;
// its throttle is propeller speed over maximum propeller speed.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// True if there is thrust at any speed.
inline bool has_thrust(const Propulsion& p) {
  return p.disc.area_m2 > 0 || p.ct0_ratio != 0 || p.ct1_ratio != 0 || p.ct2_ratio != 0;
}

/// One motor with its propeller. Speed in rad/s, airspeed in m/s, density in kg/m3.
class Propeller {
 public:
  explicit Propeller(const Propulsion& p)
      : p_(p),
        sag_ohm_(p.pack.resistance_ohm * std::max<double>(1, static_cast<double>(p.propellers.size()))),
        is_disc_(p.disc.area_m2 > 0) {}

  /// Thrust, N, along the body's x axis at propeller speed `Omega`, rad/s. Multiplied out with J = 2 pi Va /
  /// (Omega D), without a division.
  double thrust(double Omega, double Va, double rho) const { return thrust_of<double>(Omega, Va, rho); }
  template <class S>
  S thrust_of(const S& Omega, const S& Va, const S& rho) const {
    if (is_disc_) return disc_thrust<S>(Omega, Va, rho);
    const double D = p_.propeller_diameter_m;
    const S n = Omega / (2 * std::numbers::pi);
    return rho * D * D * (p_.ct0_ratio * D * D * n * n + p_.ct1_ratio * D * n * Va + p_.ct2_ratio * Va * Va);
  }

  /// Aerodynamic torque on the propeller, N m; the airframe has the opposite torque about x.
  double torque(double Omega, double Va, double rho) const { return torque_of<double>(Omega, Va, rho); }
  template <class S>
  S torque_of(const S& Omega, const S& Va, const S& rho) const {
    if (is_disc_) return p_.disc.torque_ratio * Omega * Omega;
    const double D = p_.propeller_diameter_m;
    const S n = Omega / (2 * std::numbers::pi);
    return rho * D * D * D *
           (p_.cq0_ratio * D * D * n * n + p_.cq1_ratio * D * n * Va + p_.cq2_ratio * Va * Va);
  }

  /// Speed, rad/s, at which the torques of motor and propeller balance. At high advance ratios the polynomial
  /// is out of its valid range, and the discriminant may become negative: then the double root is used. A
  /// propeller does not turn backwards.
  double steady_speed(double throttle_frac, double Va, double rho) const {
    return steady_speed_of<double>(throttle_frac, Va, rho);
  }
  template <class S>
  S steady_speed_of(const S& throttle_frac, const S& Va, const S& rho) const {
    using std::sqrt, std::max;
    if (is_disc_) return p_.disc.speed_radps * max(S(0.0), throttle_frac);
    const double D = p_.propeller_diameter_m, K = p_.torque_constant_ratio;
    const S R = resistance(throttle_frac);
    const double D3 = D * D * D, two_pi = 2 * std::numbers::pi;
    const S a = p_.cq0_ratio * rho * D3 * D * D / (two_pi * two_pi);
    const S b = p_.cq1_ratio * rho * D3 * D * Va / two_pi + K * K / R;
    const S c =
        p_.cq2_ratio * rho * D3 * Va * Va - K / R * throttle_frac * p_.battery_volt + K * p_.no_load_amp;
    return max(S(0.0), (-b + sqrt(max(S(0.0), b * b - 4 * a * c))) / (2 * a));
  }

  /// Throttle of a speed in steady flight: the balance of torques, solved for the voltage.
  double throttle_for(double Omega, double Va, double rho) const {
    return throttle_for_of<double>(Omega, Va, rho);
  }
  template <class S>
  S throttle_for_of(const S& Omega, const S& Va, const S& rho) const {
    if (is_disc_) return Omega / p_.disc.speed_radps;
    const S amp = torque_of(Omega, Va, rho) / p_.torque_constant_ratio + p_.no_load_amp;
    const S volt = amp * p_.resistance_ohm + p_.torque_constant_ratio * Omega;
    if (sag_ohm_ <= 0) return volt / p_.battery_volt;
    const S left = p_.battery_volt * p_.battery_volt - 4 * sag_ohm_ * amp * volt;
    if (left < 0) return S(2.0);  // more than the battery voltage at any throttle
    using std::sqrt;
    return 2 * volt / (p_.battery_volt + sqrt(left));
  }

  /// Current of the motor, A. The disc has no electric model: its shaft power over the voltage of the motor.
  double current(double throttle_frac, double Omega) const {
    if (is_disc_) {
      const double volt = throttle_frac * p_.battery_volt;
      return volt > 0 ? p_.disc.torque_ratio * Omega * Omega * Omega / volt : 0;
    }
    return (throttle_frac * p_.battery_volt - p_.torque_constant_ratio * Omega) / resistance(throttle_frac);
  }

  double time_constant_s() const { return p_.time_constant_s; }
  double inertia_kgm2() const { return p_.propeller_inertia_kgm2; }
  /// Voltage of the battery without load.
  void set_voltage(double volt) { p_.battery_volt = volt; }

 private:
  /// Resistance of motor and battery, as the motor has it: the controller draws throttle times the motor's
  /// current, and passes on throttle times the remaining voltage. `sag_ohm_` is for all motors.
  template <class S>
  S resistance(const S& throttle_frac) const {
    return p_.resistance_ohm + sag_ohm_ * throttle_frac * throttle_frac;
  }

  /// rho/2 S C Vd (Vd - Va) with Vd = Va + dt (k_motor - Va), the air behind the disc. A separate function,
  /// so that the polynomials have no additional cost.
  template <class S>
  [[gnu::noinline]] S disc_thrust(const S& Omega, const S& Va, const S& rho) const {
    const DiscMotor& disc = p_.disc;
    const S faster = Omega / disc.speed_radps * (disc.exit_speed_mps - Va);
    return 0.5 * rho * disc.area_m2 * disc.efficiency_ratio * (Va + faster) * faster;
  }

  Propulsion p_;
  double sag_ohm_;
  bool is_disc_;
};

}  // namespace fulmar
