// SPDX-License-Identifier: BSD-3-Clause
// Gains of control_slc and control_tecs from bandwidths, which the margins may reduce.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/loops.hpp"

namespace fulmar::aero {

/// rad/s; 0: the largest that lags and margins allow.
struct Bandwidths {
  double roll = 0, pitch = 0, course = 0, height = 0, airspeed = 0;
};

/// Margins that every loop must keep (least), and that the design aims at (wanted). MIL-DTL-9490E requires 6
/// dB and 45 deg.
struct MarginRule {
  double gain_db, phase_rad;
  bool kept(const LoopFigures& f) const {
    return f.min_gain_db() >= gain_db && f.min_phase_rad() >= phase_rad;
  }
};
inline constexpr double margin_degree = std::numbers::pi / 180;
inline constexpr MarginRule min_margins{6, 45 * margin_degree}, wanted_margins{8, 55 * margin_degree};

struct Tuning {
  Laws laws;
  Bandwidths chosen;  ///< the bandwidths of the gains
  bool yaw_damper = false;
  std::vector<std::string> beyond;  ///< gains outside of their ranges, a sentence each
};

/// Largest bandwidth of a loop with a lag, rad/s: beyond it the lag alone uses up the phase margin.
double max_bandwidth(double lag_s);

/// `start`: parameters that are not computed stay. Loops with a `given` bandwidth keep it.
Tuning tune(const Plant& plant, const Laws& start, const Bandwidths& given);

}  // namespace fulmar::aero
