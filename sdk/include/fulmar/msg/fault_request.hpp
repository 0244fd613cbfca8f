// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Part of a simulated aircraft with the fault.
enum class FaultTarget : std::uint8_t {
  gyro,
  accel,
  gnss_position,
  gnss_velocity,
  mag,
  baro,
  pitot,
  aileron,
  elevator,
  rudder,
  engine,
  battery,
  radio,
  icing
};

/// Kind of the fault. Each target accepts some of them; a rejected request lists them.
enum class FaultKind : std::uint8_t {
  none,               ///< end of the fault
  off,                ///< no message, or zero in a shared message; the motor stops; no radio link
  stuck,              ///< repetition of the last value; a surface stays in place
  wrong,              ///< offset
  slow,               ///< lag
  noisy,              ///< additional noise
  jumping,            ///< offset that changes at random times
  hardover_positive,  ///< deflection to the limit, signs as in `Actuators`
  hardover_negative,
  free,     ///< surface without a servo: it trails with the flow
  lost,     ///< surface broken off: without effect
  weak,     ///< share of the voltage at the motor
  empty,    ///< falling voltage of the battery
  growing,  ///< growth of ice
  melting
};

/// Request for a fault of a simulated aircraft. An accepted fault holds until its time ends, another request
/// for the same target is accepted, or a request of the kind `none` ends it.
struct FaultRequest {
  FaultTarget what = FaultTarget::gyro;  ///< part with the fault
  FaultKind kind = FaultKind::none;      ///< kind of the fault
  double size_ratio = 0;                 ///< size of the fault, in the unit of its quantity; 0: size in the
                                         ///< parameters
  double ramp_s = 0;                     ///< rise time to the size
  double for_s = 0;                      ///< duration of the fault; 0: until its end is requested
};

}  // namespace fulmar
