// SPDX-License-Identifier: BSD-3-Clause
// Armed state of the motor.
#pragma once
#include <cstdint>

namespace fulmar::sim {

/// Armed state: requests and the pilot's switch ask for it; it is granted from flight time 0 on.
class Arming {
 public:
  void ask(bool armed) {
    wanted_ = armed;
    if (!wanted_) armed_ = false;
  }
  void advance(bool may_arm, std::int64_t now_ns) {
    if (!(wanted_ && !armed_ && may_arm && now_ns >= 0)) return;
    if (!released_) at_ns_ = now_ns;
    armed_ = released_ = true;
  }
  bool armed() const { return armed_; }
  /// True after the first arming: from then on the aircraft is free to move.
  bool released() const { return released_; }
  /// Time since the first arming.
  double age_s(std::int64_t now_ns) const { return 1e-9 * static_cast<double>(now_ns - at_ns_); }

 private:
  bool wanted_ = false, armed_ = false, released_ = false;
  std::int64_t at_ns_ = 0;  ///< time of the first arming
};

}  // namespace fulmar::sim
