// SPDX-License-Identifier: BSD-3-Clause
// When commands, auxiliary outputs and attitudes go out.
#pragma once
#include <array>
#include <cstdint>
#include <utility>

#include "state.hpp"

namespace fulmar::fcu {

/// Of commands: each new one, as often as is allowed, and the last one again before the controller would
/// forget it.
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

/// Of auxiliary outputs: repeated now and then: a frame may have been lost, or the controller rebooted.
class AuxPace {
 public:
  bool due(bool fresh, std::int64_t now_ns) {
    if (!fresh && now_ns - sent_ns_ < period_ns) return false;
    sent_ns_ = now_ns;
    return true;
  }
  std::array<bool, 14> motors{};  ///< those that were commanded so far

 private:
  static constexpr std::int64_t period_ns = 1'000'000'000;
  std::int64_t sent_ns_ = never_ns;
};

/// Of attitudes for the controller's own estimate: 50 Hz.
class AttitudePace {
 public:
  bool due(std::int64_t now_ns) const { return !(now_ns - sent_ns_ < period_ns); }
  void sent(std::int64_t now_ns) { sent_ns_ = now_ns; }
  /// There is no state to send.
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
