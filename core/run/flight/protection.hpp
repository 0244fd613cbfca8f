// SPDX-License-Identifier: BSD-3-Clause
// What the vehicle says of its aircraft, by the flags of its contract, and what follows for the host.
#pragma once
#include <cstdint>
#include <string>

#include "core/run/flight/wiring.hpp"
#include "core/run/state/state.hpp"

namespace fulmar::core {

class Protection {
 public:
  explicit Protection(const FlightState& state) : state_(state) {}
  /// [setup] Where the flags stand; anew when units were exchanged.
  void connect(const Wiring& wiring) noexcept;

  /// What counts of a vehicle that has no such flag, or has not published it yet: disarmed, on the ground, in
  /// control. Nothing that the host does reaches a vehicle that is silent, and at its desk a host must end by
  /// one signal.
  bool armed() const noexcept { return armed_.says(false); }
  bool on_ground() const noexcept { return on_ground_.says(true); }
  /// In the air for certain: it says so.
  bool flies() const noexcept { return armed() && !on_ground_.says(false); }
  bool has_flown() const noexcept { return has_flown_; }
  bool has_spoken() const noexcept { return armed_.spoken(); }
  /// An aircraft that the host does not leave.
  bool armed_hardware() const noexcept { return state_.on_hardware() && armed(); }
  /// Why nothing can be swapped now, or "".
  std::string in_use() const;

  /// [tick] After the vehicle was read. True when control has just returned.
  bool watch() noexcept;
  /// [tick] The vehicle does not obey: nothing may wind up meanwhile.
  bool out_of_control() const noexcept { return out_of_control_; }

 private:
  struct Flag {
    const Slot* slot = nullptr;
    std::uint32_t offset = 0;
    bool spoken() const noexcept { return slot && slot->sequence > 0; }
    bool says(bool unknown) const noexcept {
      return spoken() ? slot->published[offset] != std::byte{0} : unknown;
    }
  };
  const FlightState& state_;
  Flag armed_, on_ground_, in_control_;
  bool was_armed_ = false, out_of_control_ = false, has_flown_ = false;
};

}  // namespace fulmar::core
