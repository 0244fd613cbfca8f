// SPDX-License-Identifier: BSD-3-Clause
// Send times of commands, auxiliary outputs and attitudes.
#pragma once
#include <array>
#include <cstdint>
#include <utility>

#include "state.hpp"

namespace fulmar::fcu {

/// Rate of commands: a new one is sent as often as allowed, the last one again before the controller's
/// time-out.
class Pace {
 public:
  explicit Pace(double rate_hz = 400) : period_ns_(static_cast<std::int64_t>(1e9 / rate_hz)) {}

  /// `fresh`: the command is new. Returns true when it is sent now.
  bool due(bool fresh, std::int64_t now_ns) {
    waiting_ = waiting_ || fresh;
    const std::int64_t since = now_ns - sent_ns_;
    // Ticks follow inertial samples, with some jitter.
    return (waiting_ || since >= repeat_ns) && now_ns >= next_ns_ - slack_ns;
  }
  void sent(std::int64_t now_ns) {
    sent_ns_ = now_ns;
    next_ns_ = (now_ns - next_ns_ > period_ns_ ? now_ns : next_ns_) +
               period_ns_;  // a late tick does not delay the next one
    waiting_ = false;
  }

 private:
  static constexpr std::int64_t repeat_ns =
      25'000'000;  ///< a quarter of the controller's time-out: three frames may be lost
  static constexpr std::int64_t slack_ns = 500'000;
  std::int64_t period_ns_, sent_ns_ = never_ns, next_ns_ = never_ns;
  bool waiting_ = false;
};

/// Rate of auxiliary outputs: they are repeated because a frame may be lost or the controller may reboot.
class AuxPace {
 public:
  bool due(bool fresh, std::int64_t now_ns) {
    if (!fresh && now_ns - sent_ns_ < period_ns) return false;
    sent_ns_ = now_ns;
    return true;
  }
  std::array<bool, 14> motors{};  ///< those commanded so far

 private:
  static constexpr std::int64_t period_ns = 1'000'000'000;
  std::int64_t sent_ns_ = never_ns;
};

/// Rate of attitudes for the controller's estimate: 50 Hz.
class AttitudePace {
 public:
  bool due(std::int64_t now_ns) const { return !(now_ns - sent_ns_ < period_ns); }
  void sent(std::int64_t now_ns) { sent_ns_ = now_ns; }
  /// Reports that there is no state to send.
  void report_unwired(Notices& out) {
    if (std::exchange(reported_unwired_, true)) return;
    out.add(fulmar::Severity::warning, fcu_serial_messages::state_unwired);
  }

 private:
  static constexpr std::int64_t period_ns = 19'500'000;
  std::int64_t sent_ns_ = never_ns;
  bool reported_unwired_ = false;
};

}  // namespace fulmar::fcu
