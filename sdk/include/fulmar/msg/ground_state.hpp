// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Contact : std::uint8_t { unknown, ground, air };

/// Whether the aircraft stands, rolls or flies, estimated from sensors that every vehicle has. Missions,
/// safety, landing and take-off read this and not the contact switch that only a simulator has.
struct GroundState {
  Contact contact = Contact::unknown;
  bool landed = false;  ///< on the ground after a flight, and too slow to fly; until the next take-off begins
  bool throttle_locked = false;  ///< since `landed`: a hand-over by the pilot or a take-off request ends it
  std::uint32_t lift_offs = 0, touch_downs = 0;  ///< since the start
  double since_s = 0;                            ///< since `contact` changed
  double touch_evidence_ratio = 0;               ///< 1: enough for a touch-down
  double touch_sink_mps = 0;                     ///< estimate at the last touch-down
};

}  // namespace fulmar
