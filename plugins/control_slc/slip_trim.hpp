// SPDX-License-Identifier: BSD-3-Clause
// Rudder and aileron that hold the requested sideslip of a landing in cross wind.
#pragma once
#include <fulmar/msg/airframe.hpp>
#include <fulmar/msg/sideslip_command.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::slc {

/// Requested sideslip, rad. A request ends when it is not repeated, so a stopped guide has no effect.
inline double slip_asked(const Tick& tick, const Optional<SideslipCommand>& sideslip) {
  constexpr std::int64_t patience_ns = 200'000'000;
  const bool fresh = sideslip && tick.now_ns - sideslip.valid_at_ns() <= patience_ns;
  return fresh ? sideslip->sideslip_rad : 0;
}

/// Rudder and aileron that hold a steady sideslip: the moments of yaw and roll vanish, B&M (4.19), (4.20).
/// The roll moment of the rudder and the yaw moment of the aileron are small; the loops take them up.
inline double rudder_for(double slip_rad, const Aerodynamics& a) {
  return a.yaw.rudder_ratio != 0 ? -a.yaw.beta_ratio / a.yaw.rudder_ratio * slip_rad : 0;
}
inline double aileron_for(double slip_rad, const Aerodynamics& a) {
  return a.roll.aileron_ratio != 0 ? -a.roll.beta_ratio / a.roll.aileron_ratio * slip_rad : 0;
}

}  // namespace fulmar::slc
