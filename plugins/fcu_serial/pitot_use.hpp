// SPDX-License-Identifier: BSD-3-Clause
// Decision on the use of the pitot.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "readiness.hpp"
#include "words.hpp"

namespace fulmar::fcu {

/// Decides whether the pitot is used: not after its zero was taken in wind, in the air, or by a reboot in
/// flight.
class PitotUse {
 public:
  explicit PitotUse(double limit_pa = 0) : limit_pa_(limit_pa) {}

  bool used() const { return !zeroed_ && !off_; }
  /// True after a reboot in flight.
  bool zeroed() const { return zeroed_; }
  PitotZero zero(std::uint64_t controller_us) const {
    if (!used()) return PitotZero::wrong;
    return controller_us < zeroing_us ? PitotZero::pending : PitotZero::good;
  }

  /// After a boot of the controller in the air, in this run or before it.
  void zeroed_in_the_air(Notices& out) {
    if (std::exchange(zeroed_, true)) return;
    out.add(fulmar::Severity::critical, fcu_serial_messages::pitot_zeroed_in_flight);
  }
  /// In still air the zero is the offset of the sensor. Beyond the limit it is the pressure of an airspeed,
  /// at which the pitot would then read 0. `bits`: of a float.
  void take_zero(std::int32_t bits, bool armed, Notices& out) {
    const double pascal = static_cast<double>(std::bit_cast<float>(bits));
    const bool off = !(std::fabs(pascal) <= limit_pa_);
    if (off == std::exchange(off_, off)) return;
    if (!off) return out.add(fulmar::Severity::info, fcu_serial_messages::pitot_used_again);
    const fulmar::Severity severity = armed ? fulmar::Severity::critical : fulmar::Severity::warning;
    if (std::isfinite(pascal) && std::fabs(pascal) < 1e6)
      out.add(severity, fcu_serial_messages::pitot_zero_off, std::llround(pascal));
    else
      out.add(severity, fcu_serial_messages::pitot_zero_wrong);
  }

 private:
  double limit_pa_ = 0;
  bool zeroed_ = false;  ///< by a reboot in flight
  bool off_ = false;     ///< its zero is beyond the limit
};

}  // namespace fulmar::fcu
