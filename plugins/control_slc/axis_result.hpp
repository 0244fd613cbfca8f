// SPDX-License-Identifier: BSD-3-Clause
// Result of an autotune for one axis.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/msg/autotune_report.hpp>
#include <numbers>
#include <optional>

#include "loop_lines.hpp"
#include "messages.hpp"

namespace fulmar::slc {

inline const char* words(AutotuneReason why) {
  using Reason = AutotuneReason;
  switch (why) {
    case Reason::margins_do_not_hold: return control_slc_messages::margins_not_held.c_str();
    case Reason::no_gains_found: return control_slc_messages::gains_missing.c_str();
    case Reason::surface_at_limit: return control_slc_messages::surface_at_limit.c_str();
    case Reason::turbulence: return control_slc_messages::turbulence_high.c_str();
    case Reason::no_answer: return control_slc_messages::surface_without_answer.c_str();
    case Reason::no_surface: return control_slc_messages::surface_missing.c_str();
    case Reason::gain_is_zero: return control_slc_messages::gain_zero.c_str();
    case Reason::no_time: return control_slc_messages::time_missing.c_str();
    default: return "";
  }
}

/// Result of one axis: verdict, measured margins and their error.
struct AxisResult {
  AutotuneVerdict verdict = AutotuneVerdict::open;
  AutotuneReason reason = AutotuneReason::none;
  std::optional<Margins> before, after;  ///< with the initial gains; with the gains tried last
  double noise = 0;                      ///< relative standard error of 1 + L

  void decide(AutotuneVerdict what, AutotuneReason why) {
    verdict = what;
    reason = why;
  }
  /// Drops the result because the gains were replaced.
  void forget() {
    decide(AutotuneVerdict::open, AutotuneReason::none);
    before.reset();
    after.reset();
  }
  void put_into(AutotuneReport& r, std::size_t axis) const {
    report_margins(before, r.before_gain_margin_ratio[axis], r.before_phase_margin_rad[axis]);
    report_margins(after, r.gain_margin_ratio[axis], r.phase_margin_rad[axis]);
    r.crossover_radps[axis] = after ? after->crossover_radps : 0;
    r.noise_ratio[axis] = std::isfinite(noise) ? std::min(noise, 1e9) : 1e9;
  }

 private:
  static void report_margins(const std::optional<Margins>& m, double& gain_ratio, double& phase_rad) {
    gain_ratio = m ? std::min(std::pow(10, m->min_gain_db() / 20), 1e9) : 0;
    phase_rad = m ? std::min(m->phase_rad, std::numbers::pi) : 0;
  }
};

}  // namespace fulmar::slc
