// SPDX-License-Identifier: BSD-3-Clause
// State of the aircraft from the flags of the vehicle's contract, and its consequences for the host.
#pragma once
#include <cstdint>
#include <string>

#include "core/run/flight/wiring.hpp"
#include "core/run/state/state.hpp"

namespace fulmar::core {

class Protection {
 public:
  explicit Protection(const FlightState& state) : state_(state) {}
  /// [setup] Finds the flags; call it again after an exchange of units.
  void connect(const Wiring& wiring) noexcept;

  /// Defaults for a vehicle without such a flag, or before its first sample: disarmed, on the ground, in
  /// control. The host cannot reach a vehicle that sends nothing, and on the bench one signal must end the
  /// host.
  bool armed() const noexcept { return armed_.says(false); }
  bool on_ground() const noexcept { return on_ground_.says(true); }
  /// In the air for certain: the vehicle reports it.
  bool flies() const noexcept { return armed() && !on_ground_.says(false); }
  bool has_flown() const noexcept { return has_flown_; }
  bool has_spoken() const noexcept { return armed_.spoken(); }
  /// An aircraft whose flight the host must not end.
  bool armed_hardware() const noexcept { return state_.on_hardware() && armed(); }
  /// Reason why a swap is not possible now, or "".
  std::string in_use() const;

  /// [tick] After the vehicle was read. True when control has just returned.
  bool watch() noexcept;
  /// [tick] The vehicle does not follow commands: controllers must not wind up meanwhile.
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
