// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "fulmar/message.hpp"

namespace fulmar {

enum class AutotuneStage : std::uint8_t { idle, exciting, searching, verifying, finished, aborted };
enum class AutotuneAxis : std::uint8_t { none, roll, pitch, yaw };
enum class AutotuneVerdict : std::uint8_t { open, kept, reverted, left_out };
/// Why an axis went back or was left out; `ended`: all of it ended while this axis was under test.
enum class AutotuneReason : std::uint8_t {
  none,
  margins_do_not_hold,
  no_gains_found,
  surface_at_limit,
  turbulence,
  no_answer,
  ended,
  no_surface,
  gain_is_zero,
  no_time
};

/// What an autotune in flight does and has found. Arrays: roll, pitch, yaw damper. Margins are those of the
/// loop broken at the surface, measured in flight; 0: not measured.
struct AutotuneReport {
  AutotuneStage stage = AutotuneStage::idle;
  AutotuneAxis axis = AutotuneAxis::none;
  AutotuneVerdict roll = AutotuneVerdict::open;
  AutotuneVerdict pitch = AutotuneVerdict::open;
  AutotuneVerdict yaw = AutotuneVerdict::open;
  bool done = false;                        ///< finished or aborted
  double time_s = 0;                        ///< since it was asked for; stands when it is done
  std::array<double, 3> before_kp_ratio{};  ///< gains that it began with
  std::array<double, 3> before_ki_ratio{};
  std::array<double, 3> before_kd_ratio{};
  std::array<double, 3> kp_ratio{};  ///< gains in use
  std::array<double, 3> ki_ratio{};
  std::array<double, 3> kd_ratio{};
  std::array<double, 3> before_gain_margin_ratio{};  ///< by which the gain may grow, or shrink: the less
  std::array<double, 3> before_phase_margin_rad{};
  std::array<double, 3> gain_margin_ratio{};  ///< of the gains that were tried last
  std::array<double, 3> phase_margin_rad{};
  std::array<double, 3> crossover_radps{};
  std::array<double, 3> noise_ratio{};  ///< relative standard error of 1 + L where it matters
  AutotuneReason roll_reason = AutotuneReason::none;
  AutotuneReason pitch_reason = AutotuneReason::none;
  AutotuneReason yaw_reason = AutotuneReason::none;
};

}  // namespace fulmar
