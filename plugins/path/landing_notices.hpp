// SPDX-License-Identifier: BSD-3-Clause
// One notice for each go-around, rejected approach and unusual end of a landing: the reason with its figure,
// and the action of the aircraft.
#pragma once
#include <cmath>

#include "fulmar/fitted.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"

namespace fulmar::path {

class LandingNotices {
 public:
  using Out = OutQueue<Notice, 4>;
  struct Times {
    double flare_s, rolled_s, roll_limit_s;
  };
  void report(const LandingProgress& before, const LandingProgress& now, const Times& times,
              std::int64_t now_ns, Out& out) {
    now_ns_ = now_ns;
    if (now.go_arounds != before.go_arounds) go_around(now, times.flare_s, out);
    wind(before, now, out);
    if (now.stage == LandingStage::stopped && before.stage == LandingStage::roll_out &&
        times.rolled_s > times.roll_limit_s)
      say(path_messages::roll_long, Fixed{times.rolled_s, 0}, out);
  }

 private:
  void say(const MessageText<1>& text, Fixed value, Out& out, Severity severity = Severity::warning) const {
    Notice notice;
    notice.text = fitted<96>(text, value);
    notice.severity = severity;
    out.push(notice, now_ns_);
  }

  void go_around(const LandingProgress& now, double flare_s, Out& out) const {
    switch (now.reason) {
      case LandingReason::cross_track:
        return say(path_messages::go_around_cross_track, Fixed{std::abs(now.cross_m), 0}, out);
      case LandingReason::height: return say(path_messages::go_around_slope, Fixed{now.height_m, 0}, out);
      case LandingReason::position:
        return say(path_messages::go_around_position, Fixed{now.height_m, 0}, out);
      case LandingReason::flare_long: return say(path_messages::go_around_flare, Fixed{flare_s, 0}, out);
      default: return say(path_messages::go_around_commanded, Fixed{now.height_m, 0}, out, Severity::info);
    }
  }

  /// A rejection is repeated while it holds.
  void wind(const LandingProgress& before, const LandingProgress& now, Out& out) {
    constexpr std::int64_t repeat_ns = 30'000'000'000;
    const bool crosswind = now.reason == LandingReason::crosswind;
    if (!crosswind && now.reason != LandingReason::runway_short) return;
    const bool warned = now.stage == LandingStage::approach && before.stage == LandingStage::join;
    const bool refused = now.stage == LandingStage::join && now_ns_ - said_ns_ > repeat_ns;
    if (!warned && !refused) return;
    said_ns_ = now_ns_;
    const Fixed value = crosswind ? Fixed{std::abs(now.cross_wind_mps), 1} : Fixed{now.needed_m, 0};
    if (warned)
      say(crosswind ? path_messages::crosswind_landing : path_messages::runway_short_landing, value, out);
    else
      say(crosswind ? path_messages::crosswind_waiting : path_messages::runway_short_waiting, value, out);
  }

  std::int64_t now_ns_ = 0, said_ns_ = -1'000'000'000'000;
};

}  // namespace fulmar::path
