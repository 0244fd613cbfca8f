// SPDX-License-Identifier: BSD-3-Clause
// Gains of control_slc and control_tecs from bandwidths, and less bandwidth where margins ask for it.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/loops.hpp"

namespace fulmar::aero {

/// rad/s; 0: as much as lags and margins allow.
struct Bandwidths {
  double roll = 0, pitch = 0, course = 0, height = 0, airspeed = 0;
};

/// Margins that every loop has to keep (least), and that gains are chosen for (wanted). MIL-DTL-9490E asks
/// for 6 dB and 45 deg.
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
  Bandwidths chosen;  ///< what the gains were computed from
  bool yaw_damper = false;
  std::vector<std::string> beyond;  ///< gains that their ranges do not allow, a sentence each
};

/// The most bandwidth of a loop that acts through a lag, rad/s: beyond it the lag alone takes the phase that
/// the margin needs.
double max_bandwidth(double lag_s);

/// `start`: what is not computed stays as it is there. Loops whose bandwidth is `given` keep it.
Tuning tune(const Plant& plant, const Laws& start, const Bandwidths& given);

}  // namespace fulmar::aero
