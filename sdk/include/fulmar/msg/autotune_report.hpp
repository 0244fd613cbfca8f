// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "fulmar/message.hpp"

namespace fulmar {

enum class AutotuneStage : std::uint8_t { idle, exciting, searching, verifying, finished, aborted };
enum class AutotuneAxis : std::uint8_t { none, roll, pitch, yaw };
enum class AutotuneVerdict : std::uint8_t { open, kept, reverted, left_out };
/// Reason of a reverted or excluded axis; `ended`: the autotune ended during the test of this axis.
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

/// State and results of an autotune in flight. Arrays: roll, pitch, yaw damper. Margins are those of the loop
/// broken at the surface, measured in flight; 0: not measured.
struct AutotuneReport {
  AutotuneStage stage = AutotuneStage::idle;     ///< stage of the autotune
  AutotuneAxis axis = AutotuneAxis::none;        ///< axis under test
  AutotuneVerdict roll = AutotuneVerdict::open;  ///< verdict on each axis
  AutotuneVerdict pitch = AutotuneVerdict::open;
  AutotuneVerdict yaw = AutotuneVerdict::open;
  bool done = false;                                 ///< flag of the end: finished or aborted
  double time_s = 0;                                 ///< time since the request, constant after the end
  std::array<double, 3> before_kp_ratio{};           ///< gains before the autotune
  std::array<double, 3> before_ki_ratio{};           ///< gains before the autotune
  std::array<double, 3> before_kd_ratio{};           ///< gains before the autotune
  std::array<double, 3> kp_ratio{};                  ///< gains in use
  std::array<double, 3> ki_ratio{};                  ///< gains in use
  std::array<double, 3> kd_ratio{};                  ///< gains in use
  std::array<double, 3> before_gain_margin_ratio{};  ///< gain margin before the autotune, the smaller of
                                                     ///< upward and downward
  std::array<double, 3> before_phase_margin_rad{};   ///< phase margin before the autotune
  std::array<double, 3> gain_margin_ratio{};         ///< gain margin of the gains tried last
  std::array<double, 3> phase_margin_rad{};          ///< phase margin of the gains tried last
  std::array<double, 3> crossover_radps{};           ///< crossover frequency of the gains tried last
  std::array<double, 3> noise_ratio{};               ///< relative standard error of 1 + L near the
                                                     ///< crossover
  AutotuneReason roll_reason = AutotuneReason::none;
  AutotuneReason pitch_reason = AutotuneReason::none;
  AutotuneReason yaw_reason = AutotuneReason::none;
};

}  // namespace fulmar
