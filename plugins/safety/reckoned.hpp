// SPDX-License-Identifier: BSD-3-Clause
// Position without satellites: dead reckoning by the estimator from air data; beyond its accuracy, by the
// last wind.
#pragma once
#include <algorithm>

#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::safety {

/// True when the position is good enough for guidance: valid, or dead-reckoned from a valid one.
inline bool located(const VehicleState& s, double max_std_m) {
  return s.velocity_valid && s.attitude_valid &&
         (s.position_valid || std::max(s.position_std_m.north, s.position_std_m.east) < max_std_m);
}

class Reckoned {
 public:
  bool known() const { return known_; }
  double north_m() const { return at_.north; }
  double east_m() const { return at_.east; }
  double std_m() const { return std_m_; }
  /// The position is no longer used: the circle drifts with the wind.
  bool drifts() const { return drifts_; }

  void step(const VehicleState& s, const Vec3<Ned>& wind_mps, double max_std_m, double dt) {
    known_ = known_ || s.position_valid;
    if (!known_) return;
    drifts_ = !s.position_valid && (drifts_ || !located(s, max_std_m));
    if (drifts_) {
      constexpr double wind_std_mps = 1;
      at_ = at_ + dt * wind_mps;
      std_m_ += wind_std_mps * dt;
      return;
    }
    at_ = s.position_m;
    std_m_ = std::min(std::max(s.position_std_m.north, s.position_std_m.east), max_std_m);
  }

 private:
  Vec3<Ned> at_;
  double std_m_ = 0;
  bool known_ = false, drifts_ = false;
};

}  // namespace fulmar::safety
