// SPDX-License-Identifier: BSD-3-Clause
// What this vehicle alone has to say: messages that no simulated aircraft publishes.
#pragma once
#include "fulmar/message.hpp"
#include "fulmar/msg/controller_attitude.hpp"

namespace fulmar::fcu {

/// A range finder of the flight controller.
struct Range {
  double distance_m = 0;
  double min_m = 0, max_m = 0;  ///< as the controller says; firmware 2.0 always says 0.25 and 8
  bool valid = false;           ///< within them
};

/// What the controller's outputs get: after mixer, override and failsafe.
struct ControllerOutputs {
  std::array<double, 14> values_ratio{};  ///< servos and motors 0 to 1
};

/// A parameter of the controller, when it is heard for the first time and whenever it changes: with which
/// set-up and calibration it was flown.
struct ControllerParameter {
  Text<17> name;
  Text<24> value;  ///< in the fewest digits that read back as the same 32 bits; its unit is the firmware's
  bool whole = false;                  ///< a whole number, else a float
  std::uint16_t index = 0, count = 0;  ///< which of how many
};

/// How well the two hear each other.
struct LinkStatus {
  bool open = false;           ///< the device is there
  bool synchronised = false;   ///< the controller's clock is known
  double heard_age_s = 1e9;    ///< since the last good frame; 1e9: never
  std::uint64_t frames = 0;    ///< good ones
  std::uint64_t bad = 0;       ///< with a wrong checksum
  std::uint64_t missing = 0;   ///< that never came, by their sequence numbers
  std::uint64_t dropped = 0;   ///< found no room on this side
  std::uint64_t unusable = 0;  ///< sensor values that were not finite or out of this world
  std::uint64_t commands = 0;  ///< sent
  std::uint64_t unsent = 0;    ///< commands that were not finite, or that the device did not take
  std::uint32_t connections = 0, reboots = 0;
  std::uint32_t imu_gaps = 0;  ///< longer than 6 ms between two inertial samples
  double worst_gap_s = 0;
  double imu_rate_hz = 0;      ///< of the last second
  double round_trip_s = 0;     ///< least of the last seconds
  bool pitot_zeroed = false;   ///< by a reboot in flight: the pitot tube is not used any more
  std::int64_t offset_ns = 0;  ///< host's clock minus the controller's
  double drift_ratio = 0;      ///< how much faster the host's clock runs
  double turnaround_s =
      0;  ///< from the arrival of an inertial sample to its command, longest since the last report
};

}  // namespace fulmar::fcu
