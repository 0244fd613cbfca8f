// SPDX-License-Identifier: BSD-3-Clause
// Common parts of joystick and keyboard: frames of a transmitter at 50 Hz, and reports of its loss.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"

namespace fulmar::hand {

/// Counts flight time: a paused flight gets no frames, a fast one gets 50 a second of flight time.
class Transmitter {
 public:
  static constexpr std::int64_t period_ns = 20'000'000;

  /// True when a frame is due. `now_ns` is the time of the last tick, 0 before the first one, which may be
  /// negative. A time that jumps back restarts the count.
  bool due(std::int64_t now_ns) {
    if (now_ns < due_ns_ && now_ns > due_ns_ - 2 * period_ns) return false;
    const bool steady = now_ns >= due_ns_ && now_ns - due_ns_ < period_ns;
    due_ns_ = (steady ? due_ns_ : now_ns) + period_ns;
    return true;
  }

  /// Reports a link or its loss once, with the reason.
  template <class Notices>
  void report(bool link, const std::string& device, const char* why, Notices& notices) {
    if (reported_ && link == was_) return;
    const bool lost = reported_ && !link, back = reported_ && link;
    reported_ = true;
    was_ = link;
    char words[192];
    if (link)
      (back ? joystick_messages::pilot_back : joystick_messages::pilot_present)
          .write(words, sizeof words, device);
    else
      (lost ? joystick_messages::pilot_lost : joystick_messages::pilot_absent)
          .write(words, sizeof words, device, why);
    notices.push({Text<96>(words), link ? Severity::info : Severity::warning}, on_arrival);
  }

 private:
  std::int64_t due_ns_ = INT64_MIN / 2;
  bool reported_ = false, was_ = false;
};

}  // namespace fulmar::hand
