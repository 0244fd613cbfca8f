// SPDX-License-Identifier: BSD-3-Clause
// The sideslip that turns the nose to the runway in flare and roll.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::path {

/// Limited to `most_rad`. After a second the remaining error is corrected once, so that the power of the
/// rudder need not be known exactly.
class Decrab {
 public:
  void step(const LandingProgress& progress, const VehicleState& s, const Airframe& a, double most_rad,
            double dt) {
    const bool rolls = progress.stage == LandingStage::roll_out;
    const bool low = progress.stage == LandingStage::flare || rolls;
    const bool steered = a.rudder.limit_rad > 0 && a.aero.yaw.rudder_ratio != 0;
    if (!low || !steered || most_rad <= 0 || !s.attitude_valid) {
      slip_rad_ = 0;
      return;
    }
    const double off = angle_difference(s.yaw_rad, progress.runway_rad);
    if (rolls)
      steer(off, progress.cross_m);
    else
      turn(off, progress.cross_m, most_rad, dt);
  }
  /// Requested sideslip.
  double slip_rad() const { return slip_rad_; }
  /// Bank that balances the side force of that sideslip, rudder included: m g sin(phi) = q S CY, B&M (4.18)
  /// and (4.5).
  double bank_rad(const VehicleState& s, const Airframe& a) const {
    const Derivatives &Y = a.aero.side, &N = a.aero.yaw;
    const double rudder = N.rudder_ratio != 0 ? -N.beta_ratio / N.rudder_ratio : 0;
    const double q =
        0.5 * standard_air(s.origin_altitude_m + s.height_m).density_kgm3 * s.airspeed_mps * s.airspeed_mps;
    const double side = q * a.wing.area_m2 * (Y.beta_ratio + Y.rudder_ratio * rudder) * slip_rad_;
    return std::asin(std::clamp(-side / (a.mass_kg * isa::g0), -0.17, 0.17));
  }

 private:
  /// Steers back to the centre line with the remaining rudder.
  void steer(double off, double cross_m) {
    constexpr double steer_m = 15, steer_rad = 0.2, gain = 4, most_rad = 0.35;
    const double towards = std::clamp(cross_m / steer_m, -steer_rad, steer_rad);
    slip_rad_ = std::clamp(gain * (off + towards), -most_rad, most_rad);
  }
  /// The bank may be too small for slip and gust: an aircraft that drifts off the line gets less slip.
  void turn(double off, double cross_m, double most_rad, double dt) {
    constexpr double within_s = 1, blown_m = 2;
    const double leeward_m = std::max(slip_rad_ > 0 ? -cross_m : cross_m, 0.0);
    const double most = most_rad * std::max(1 - leeward_m / blown_m, 0.0);
    slip_rad_ = std::clamp(slip_rad_ + off * dt / within_s, -most, most);
  }

  double slip_rad_ = 0;
};

}  // namespace fulmar::path
