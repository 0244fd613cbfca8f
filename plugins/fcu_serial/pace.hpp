// SPDX-License-Identifier: BSD-3-Clause
// When a command goes out: each new one, as often as is allowed, and the last one again before the controller
// would forget it.
#pragma once
#include <cstdint>

#include "state.hpp"

namespace fulmar::fcu {

class Pace {
 public:
  explicit Pace(double rate_hz = 400) : period_ns_(static_cast<std::int64_t>(1e9 / rate_hz)) {}

  /// `fresh`: nobody has seen this command before. True: it goes out now.
  bool due(bool fresh, std::int64_t now_ns) {
    waiting_ = waiting_ || fresh;
    const std::int64_t since = now_ns - sent_ns_;
    // Ticks come when inertial samples arrive, give or take a little.
    return (waiting_ || since >= repeat_ns) && now_ns >= next_ns_ - slack_ns;
  }
  void sent(std::int64_t now_ns) {
    sent_ns_ = now_ns;
    next_ns_ = (now_ns - next_ns_ > period_ns_ ? now_ns : next_ns_) +
               period_ns_;  // a late tick does not put off the one after it
    waiting_ = false;
  }

 private:
  static constexpr std::int64_t repeat_ns =
      25'000'000;  ///< a quarter of the controller's patience: three may be lost
  static constexpr std::int64_t slack_ns = 500'000;
  std::int64_t period_ns_, sent_ns_ = never_ns, next_ns_ = never_ns;
  bool waiting_ = false;
};

}  // namespace fulmar::fcu
