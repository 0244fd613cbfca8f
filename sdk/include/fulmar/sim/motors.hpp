// SPDX-License-Identifier: BSD-3-Clause
// Motors with different speeds, because some have a share of the rudder command. With a battery under load,
// each has the loss that it would have if all had its throttle.
#pragma once
#include <algorithm>
#include <array>

#include "fulmar/flight/model/propellers.hpp"
#include "fulmar/flight/model/trim.hpp"

namespace fulmar::sim {

/// Speeds of all motors, rad/s, over one step of the plant.
class Motors {
 public:
  /// Sets the speeds in balance.
  void set(const Propellers& places, const Propeller& p, const Trim& trim, double Va, double rho) {
    command(places, p, 1, trim.throttle_frac, trim.deflections.rudder, Va, rho);
    for (Speeds& s : speeds_) s = steady_;
  }
  void stop() { speeds_ = {}; }
  void set_all(double radps) {
    for (Speeds& s : speeds_) s.fill(radps);
  }

  /// Commands for the next step. `power` is the fraction of the voltage at the motors.
  void command(const Propellers& places, const Propeller& p, double power, double throttle, double rudder,
               double Va, double rho) {
    before_ = speeds_[1];
    for (std::size_t i = 0; i < places.count(); ++i) {
      throttle_[i] = power * places.throttle(i, throttle, rudder);
      steady_[i] = p.steady_speed(throttle_[i], Va, rho);
    }
  }
  /// Advances to the middle of the step, and from there to its end. `decay` is that of the motors' lag.
  void advance(const Propellers& places, std::size_t stage, double decay) {
    const Speeds& from = speeds_[1 - stage];
    for (std::size_t i = 0; i < places.count(); ++i)
      speeds_[stage][i] = steady_[i] + (from[i] - steady_[i]) * decay;
  }
  [[gnu::noinline]] void add_load(const Propellers& places, const Propeller& p, std::size_t stage, double Va,
                                  double rho, Load& load) const {
    for (std::size_t i = 0; i < places.count(); ++i) {
      const double Omega = speeds_[stage][i];
      places.add_one<double>(i, p.thrust(Omega, Va, rho), p.torque(Omega, Va, rho), load);
    }
  }
  /// Battery current, A.
  double current(const Propellers& places, const Propeller& p) const {
    double sum = 0;
    for (std::size_t i = 0; i < places.count(); ++i)
      sum += std::max(0.0, throttle_[i] * p.current(throttle_[i], speeds_[1][i]));
    return sum;
  }
  double speed(std::size_t i) const { return speeds_[1][i]; }

  /// Sum of the speeds about the axes, rad/s: in the middle of the step, or at its end.
  Eigen::Vector3d spin(const Propellers& places, std::size_t stage) const {
    return sum(places, [&](std::size_t i) { return speeds_[stage][i]; });
  }
  /// Rate of that sum, rad/s2, by the motors' lag `tau`; without a lag constant over the step.
  Eigen::Vector3d gain(const Propellers& places, std::size_t stage, double tau, double dt) const {
    return rate(places, speeds_[stage], tau, dt);
  }
  Eigen::Vector3d gain_at_begin(const Propellers& places, double tau, double dt) const {
    return rate(places, before_, tau, dt);
  }

 private:
  using Speeds = std::array<double, Propellers::most>;

  template <class Of>
  static Eigen::Vector3d sum(const Propellers& places, Of&& of) {
    Eigen::Vector3d s = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < places.count(); ++i) s += of(i) * places.spin(i);
    return s;
  }
  Eigen::Vector3d rate(const Propellers& places, const Speeds& at, double tau, double dt) const {
    return sum(places, [&](std::size_t i) {
      return tau > 0 ? (steady_[i] - at[i]) / tau : (speeds_[1][i] - before_[i]) / dt;
    });
  }

  Speeds throttle_{}, steady_{}, before_{};
  std::array<Speeds, 2> speeds_{};  ///< rad/s: in the middle of the step, and at its end
};

}  // namespace fulmar::sim
