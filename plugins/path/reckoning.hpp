// SPDX-License-Identifier: BSD-3-Clause
// How long a position is good enough for the plan when no satellites tell it any more: the estimator reckons
// on from air data and the wind that it has learnt, and says how far it may be off.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::path {

class Reckoning {
 public:
  /// Whether the plan can be flown by this position: a valid one, or one that has been and is reckoned on.
  /// Once it was too far off it stays so until the next valid one, whatever deviation is said later: who
  /// circles does not go on for a second.
  bool located(const VehicleState& s, std::int64_t now_ns, double max_std_m, double max_s) {
    if (s.position_valid) {
      lost_ns_.reset();
      known_ = true;
      too_far_ = false;
      return true;
    }
    if (!lost_ns_) lost_ns_ = now_ns;
    const double std_m = std::max(s.position_std_m.north, s.position_std_m.east);
    too_far_ = too_far_ || std_m > max_std_m;
    return known_ && s.attitude_valid && s.velocity_valid && !too_far_ &&
           1e-9 * static_cast<double>(now_ns - *lost_ns_) <= max_s;
  }

 private:
  bool known_ = false, too_far_ = false;
  std::optional<std::int64_t> lost_ns_;
};

}  // namespace fulmar::path
