// SPDX-License-Identifier: BSD-3-Clause
// Validity of a position without satellites: the estimator continues by dead reckoning from air data and the
// estimated wind, and reports its standard deviation.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::path {

class Reckoning {
 public:
  /// True when the position is good enough for the plan: a valid one, or dead reckoning from a valid one.
  /// After it was too inaccurate it stays unusable until the next valid one, for any later standard
  /// deviation: otherwise an aircraft on a circle would continue for a second.
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
