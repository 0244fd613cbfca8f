// SPDX-License-Identifier: BSD-3-Clause
// What an autotune says to people.
#pragma once
#include <algorithm>
#include <array>
#include <cstdio>
#include <fulmar/msg/notice.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>
#include <string_view>

#include "axis_result.hpp"
#include "gain_search.hpp"

namespace fulmar::slc {

/// Notices of one step, until they are published.
class Findings {
 public:
  static constexpr std::array<const char*, 3> names{"roll", "pitch", "yaw"};

  void left_out(std::size_t axis, AutotuneReason why) {
    say(Severity::info, "%s: not tuned: %s", names[axis], words(why));
  }
  void reverted(std::size_t axis, std::string_view why) {
    say(Severity::warning, "%s: old gains: %.*s", names[axis], static_cast<int>(why.size()), why.data());
  }
  /// As they stand in a file.
  void kept(std::size_t axis, const AxisGains& g, const Margins& m) {
    constexpr double degree = std::numbers::pi / 180;
    const double phase_deg = std::min(m.phase_rad / degree, 180.0);
    const char* const name = names[axis];
    if (g.damper())
      say(Severity::info, "%s_kd: %.3g  # kept: %.1f dB, %.0f deg measured", name, g.kd, m.min_gain_db(),
          phase_deg);
    else
      say(Severity::info, "%s_kp: %.3g, %s_ki: %.3g, %s_kd: %.3g  # kept: %.1f dB, %.0f deg measured", name,
          g.kp, name, g.ki, name, g.kd, m.min_gain_db(), phase_deg);
  }
  template <class Notices>
  void publish(const Tick& tick, Notices& notices) {
    for (std::size_t i = 0; i < said_; ++i) notices.push(notices_[i], tick.now_ns);
    said_ = 0;
  }

 private:
  template <class... Values>
  void say(Severity severity, const char* format, Values... values) {
    if (said_ >= notices_.size()) return;
    Notice& n = notices_[said_++];
    n.severity = severity;
    std::snprintf(n.text.bytes.data(), n.text.bytes.size(), format, values...);
  }

  std::array<Notice, 4> notices_{};
  std::size_t said_ = 0;
};

}  // namespace fulmar::slc
