// SPDX-License-Identifier: BSD-3-Clause
// The notices of an autotune.
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
#include "messages.hpp"

namespace fulmar::slc {

/// Notices of one step, until they are published.
class Findings {
 public:
  static constexpr std::array<const char*, 3> names{"roll", "pitch", "yaw"};

  void left_out(std::size_t axis, AutotuneReason why) {
    report(Severity::info, control_slc_messages::axis_not_tuned, names[axis], words(why));
  }
  void reverted(std::size_t axis, std::string_view why) {
    report(Severity::warning, control_slc_messages::axis_reverted, names[axis], why);
  }
  /// Reports the gains in the form of a parameter file.
  void kept(std::size_t axis, const AxisGains& g, const Margins& m) {
    constexpr double degree = std::numbers::pi / 180;
    const double phase_deg = std::min(m.phase_rad / degree, 180.0);
    const char* const name = names[axis];
    std::array<char, 96> gains{};
    if (g.damper())
      std::snprintf(gains.data(), gains.size(), "%s_kd: %.3g", name, g.kd);
    else
      std::snprintf(gains.data(), gains.size(), "%s_kp: %.3g, %s_ki: %.3g, %s_kd: %.3g", name, g.kp, name,
                    g.ki, name, g.kd);
    report(Severity::info, control_slc_messages::axis_kept, gains.data(), Fixed{m.min_gain_db(), 1},
           Fixed{phase_deg, 0});
  }
  template <class Notices>
  void publish(const Tick& tick, Notices& notices) {
    for (std::size_t i = 0; i < reported_; ++i) notices.push(notices_[i], tick.now_ns);
    reported_ = 0;
  }

 private:
  template <class Message, class... Values>
  void report(Severity severity, const Message& message, const Values&... values) {
    if (reported_ >= notices_.size()) return;
    Notice& n = notices_[reported_++];
    n.severity = severity;
    message.write(n.text.bytes.data(), n.text.bytes.size(), values...);
  }

  std::array<Notice, 4> notices_{};
  std::size_t reported_ = 0;
};

}  // namespace fulmar::slc
