// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// What of a simulated aircraft can fail.
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

/// How. Not everything fails in every way: who is asked says what is valid.
enum class FaultKind : std::uint8_t {
  none,     ///< the request is taken back
  off,      ///< says nothing, or zero where others share its message; the motor stops; no radio link
  stuck,    ///< says its last value again and again; a surface stays where it is
  wrong,    ///< an offset
  slow,     ///< lags behind
  noisy,    ///< more noise
  jumping,  ///< an offset that changes at random times
  hardover_positive,  ///< to its limit, signs as in `Actuators`
  hardover_negative,
  free,     ///< no servo holds it: it trails with the flow
  lost,     ///< broken off: without effect
  weak,     ///< the motor gets a share of the voltage
  empty,    ///< the battery's voltage fades
  growing,  ///< ice
  melting
};

/// Asks a simulated aircraft to fail. Accepted, it holds until its time is over, another one for the same
/// target comes, or one of the kind `none` takes it back.
struct FaultRequest {
  FaultTarget what = FaultTarget::gyro;
  FaultKind kind = FaultKind::none;
  double size_ratio = 0;  ///< in the unit of what it is the size of; 0: what the parameters say
  double ramp_s = 0;      ///< grows to its size within this time
  double for_s = 0;       ///< holds for so long; 0: until it is taken back
};

}  // namespace fulmar
