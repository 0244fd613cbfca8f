// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight/protection.hpp"

#include <utility>

#include "core/run/messages.hpp"

namespace fulmar::core {

void Protection::connect(const Wiring& wiring) noexcept {
  const VehicleFlags& flags = state_.graph.flags;
  armed_ = {wiring.slot_of(flags.armed.from), flags.armed.offset};
  on_ground_ = {wiring.slot_of(flags.on_ground.from), flags.on_ground.offset};
  in_control_ = {wiring.slot_of(flags.in_control.from), flags.in_control.offset};
}

std::string Protection::in_use() const {
  if (armed()) return run_messages::aircraft_armed().line();
  return on_ground() ? "" : run_messages::aircraft_in_air().line();
}

/// A simulated aircraft is armed at a known time: until then its controllers are not held.
bool Protection::watch() noexcept {
  was_armed_ = was_armed_ || state_.on_hardware() || armed_.says(true) || in_control_.says(false);
  has_flown_ = has_flown_ || !on_ground_.says(true);
  const bool was = std::exchange(out_of_control_, was_armed_ && !in_control_.says(true));
  return was && !out_of_control_;
}

}  // namespace fulmar::core
