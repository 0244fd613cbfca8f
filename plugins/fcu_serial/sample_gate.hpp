// SPDX-License-Identifier: BSD-3-Clause
// Selection of samples: no duplicates, no late samples from before a reboot, no implausible values.
#pragma once
#include <cstdint>

#include "state.hpp"

namespace fulmar::fcu {

class SampleGate {
 public:
  bool newer_imu(std::int64_t valid_ns) const { return valid_ns > imu_ns_; }
  void imu(std::int64_t valid_ns) { imu_ns_ = valid_ns; }
  /// True for a repeated frame of the same fix. `stamp_us`: the controller's.
  bool same_fix(std::uint64_t stamp_us) {
    if (stamp_us != 0 && stamp_us == fix_us_) return true;
    fix_us_ = stamp_us;
    return false;
  }
  /// The controller has rebooted at `now_ns`: its attitude estimate starts again.
  void rebooted(std::int64_t now_ns) {
    imu_ns_ = never_ns;
    attitude_from_ns_ = now_ns + attitude_boots_ns;
  }
  bool attitude(std::int64_t now_ns) const { return !(now_ns < attitude_from_ns_); }

 private:
  static constexpr std::int64_t attitude_boots_ns = 3'000'000'000;  ///< FILT_INIT_T

  std::int64_t imu_ns_{never_ns}, attitude_from_ns_{never_ns};
  std::uint64_t fix_us_ = 0;
};

/// Reports the first fault of each kind.
class ReportedKinds {
 public:
  bool first(std::uint32_t kind) {
    const bool is_first = (kinds_ & kind) == 0;
    kinds_ |= kind;
    return is_first;
  }

 private:
  std::uint32_t kinds_ = 0;
};

}  // namespace fulmar::fcu
