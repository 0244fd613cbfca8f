// SPDX-License-Identifier: BSD-3-Clause
// Limits of the pilot's attitude and throttle: bank and pitch of the airframe, a margin above the stall, and
// the largest airspeed. The README gives the curves.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/flight/control/outer_commands.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::manual {

struct EnvelopeParams {
  Flag protection{true, "switch for the limits of bank, pitch, stall and overspeed; false for a landing"};
  Param stall_airspeed{0, "m/s", 0, 300,
                       "stall airspeed with wings level; 0: minimum airspeed of the airframe over 1.2"};
};

struct Envelope {
  double roll_max = std::numbers::pi;  ///< rad, either way
  double pitch_min = -std::numbers::pi / 2, pitch_max = std::numbers::pi / 2;
  double throttle_min = 0, throttle_max = 1;
};

/// 0 below `from`, 1 above `to`, linear between.
inline double ramp(double x, double from, double to) {
  return std::clamp((x - from) / (to - from), 0.0, 1.0);
}

inline Envelope envelope(const VehicleState& state, const FlightLimits& limits, const EnvelopeParams& p) {
  if (!p.protection) return {};
  Envelope e{limits.roll_max_rad, limits.pitch_min_rad, limits.pitch_max_rad, 0, 1};
  // Without airspeed a stall cannot be detected; on the ground it does not matter.
  if (!state.airspeed_valid || !flying(state, limits)) return e;
  const double Vs = p.stall_airspeed > 0 ? p.stall_airspeed.value : limits.airspeed_min_mps / 1.2;
  const double over = state.airspeed_mps / Vs, fast = state.airspeed_mps / limits.airspeed_max_mps;
  // A turn stalls at Vs sqrt(n), n = 1/cos(roll): the bank is limited to a speed reserve of a tenth, plus 10
  // degrees.
  const double cosine = std::min(1.0, 1.1 * 1.1 / (over * over));
  e.roll_max = std::min(e.roll_max, std::max(std::acos(cosine), 0.175));
  const double dive = std::max(limits.pitch_min_rad, -0.175), flare = limits.pitch_max_rad / 2;
  e.pitch_max = dive + (e.pitch_max - dive) * ramp(over, 1.05, 1.35);
  e.pitch_min += (flare - e.pitch_min) * ramp(fast, 0.95, 1.1);
  e.pitch_min = std::min(e.pitch_min, e.pitch_max);
  e.throttle_min = 1 - ramp(over, 1.05, 1.2);
  e.throttle_max = std::max(e.throttle_min, 1 - ramp(fast, 0.95, 1.05));
  return e;
}

}  // namespace fulmar::manual
