// SPDX-License-Identifier: BSD-3-Clause
// Energy per mass and its rate: throttle changes the sum, pitch its distribution between speed and height.
#pragma once
#include <cmath>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar {

/// Acceleration along the air velocity from accelerometer and attitude, m/s2. It has less delay and less
/// noise than a differentiated airspeed. The change of the wind is not included.
inline double airspeed_rate(const VehicleState& state) {
  const double ca = std::cos(state.alpha_rad), sa = std::sin(state.alpha_rad), cb = std::cos(state.beta_rad),
               sb = std::sin(state.beta_rad);
  const double cp = std::cos(state.pitch_rad);
  const Vec3<Body> gravity_b{-std::sin(state.pitch_rad), cp * std::sin(state.roll_rad),
                             cp * std::cos(state.roll_rad)};
  const Vec3<Body> a_b = state.specific_force_mps2 + isa::g0 * gravity_b;
  return ca * cb * a_b.x + sb * a_b.y + sa * cb * a_b.z;
}

/// Airspeed without gusts, m/s: integrates the acceleration of the body and converges to the measured
/// airspeed. A change by the aircraft has no lag; a change by the air is averaged. Complementary filter, as
/// in Lambregts (1983).
class SteadyAirspeed {
 public:
  double step(double airspeed_mps, double airspeed_rate_mps2, double time_constant_s, double dt_s) {
    if (!started_) return reset_to(airspeed_mps);
    const double pole = time_constant_s > 0 ? decay_.of(dt_s / time_constant_s) : 0;
    return y_ = airspeed_mps + pole * (y_ + airspeed_rate_mps2 * dt_s - airspeed_mps);
  }
  double reset_to(double airspeed_mps) {
    started_ = true;
    return y_ = airspeed_mps;
  }
  void reset() { started_ = false; }

 private:
  double y_ = 0;
  bool started_ = false;
  Decay decay_;
};

/// Rates of the specific energies, m2/s3.
struct EnergyRates {
  double potential = 0;  ///< g hdot
  double kinetic = 0;    ///< V Vdot
  double total() const { return potential + kinetic; }
  /// Rate of height minus rate of speed, each with its weight in [0, 1].
  double balance(double height_weight, double speed_weight) const {
    return height_weight * potential - speed_weight * kinetic;
  }
};

}  // namespace fulmar
