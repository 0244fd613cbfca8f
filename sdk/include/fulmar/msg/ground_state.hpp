// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Contact : std::uint8_t { unknown, ground, air };

/// Contact with the ground, estimated from sensors of every vehicle. Missions, safety, landing and take-off
/// read this, not the contact switch of the simulator.
struct GroundState {
  Contact contact = Contact::unknown;            ///< estimated contact
  bool landed = false;                           ///< flag after a flight: on the ground and too slow to fly,
                                                 ///< until the next take-off starts
  bool throttle_locked = false;                  ///< lock of the throttle since `landed`; a return of
                                                 ///< control by the pilot or a take-off request ends it
  std::uint32_t lift_offs = 0, touch_downs = 0;  ///< number of lift-offs and touch-downs since the start
  double since_s = 0;                            ///< time since the last change of `contact`
  double touch_evidence_ratio = 0;               ///< evidence for a touch-down; 1: sufficient
  double touch_sink_mps = 0;                     ///< estimated sink rate at the last touch-down
};

}  // namespace fulmar
