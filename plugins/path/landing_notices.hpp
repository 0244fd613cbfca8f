// SPDX-License-Identifier: BSD-3-Clause
// One notice for each go-around, refusal and unusual end of a landing: the reason with its figure, and what
// the aircraft does.
#pragma once
#include <cmath>
#include <cstdio>

#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/plugin.hpp"

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
      say("still rolling %.0f s after the touch-down: brake by hand", times.rolled_s, out);
  }

 private:
  void say(const char* format, double value, Out& out, Severity severity = Severity::warning) const {
    Notice notice;
    char text[96];
    std::snprintf(text, sizeof text, format, value);
    notice.text = text;
    notice.severity = severity;
    out.push(notice, now_ns_);
  }

  void go_around(const LandingProgress& now, double flare_s, Out& out) const {
    switch (now.reason) {
      case LandingReason::cross_track:
        return say("go-around: %.0f m off the centre line", std::abs(now.cross_m), out);
      case LandingReason::height: return say("go-around: off the glide slope at %.0f m", now.height_m, out);
      case LandingReason::position:
        return say("go-around: no valid position or height at %.0f m", now.height_m, out);
      case LandingReason::flare_long:
        return say("go-around: no touch-down in %.0f s of flare, the height is wrong", flare_s, out);
      default: return say("go-around at %.0f m, as commanded", now.height_m, out, Severity::info);
    }
  }

  /// A refusal is repeated for as long as it holds.
  void wind(const LandingProgress& before, const LandingProgress& now, Out& out) {
    constexpr std::int64_t repeat_ns = 30'000'000'000;
    const bool crosswind = now.reason == LandingReason::crosswind;
    if (!crosswind && now.reason != LandingReason::runway_short) return;
    const bool warned = now.stage == LandingStage::approach && before.stage == LandingStage::join;
    const bool refused = now.stage == LandingStage::join && now_ns_ - said_ns_ > repeat_ns;
    if (!warned && !refused) return;
    said_ns_ = now_ns_;
    const double value = crosswind ? std::abs(now.cross_wind_mps) : now.needed_m;
    if (warned)
      say(crosswind ? "crosswind of %.1f m/s is beyond the limit: landing all the same"
                    : "the landing takes %.0f m, more than the runway: landing all the same",
          value, out);
    else
      say(crosswind ? "crosswind of %.1f m/s is beyond the limit: circling, take over"
                    : "the landing takes %.0f m, more than the runway: circling, take over",
          value, out);
  }

  std::int64_t now_ns_ = 0, said_ns_ = -1'000'000'000'000;
};

}  // namespace fulmar::path
