// SPDX-License-Identifier: BSD-3-Clause
// Messages of this vehicle that no simulated aircraft publishes.
#pragma once
#include "fulmar/message.hpp"
#include "fulmar/msg/controller_attitude.hpp"

namespace fulmar::fcu {

/// A range finder of the flight controller.
struct Range {
  double distance_m = 0;        ///< measured distance
  double min_m = 0, max_m = 0;  ///< limits of the range, as reported by the controller; firmware 2.0 always
                                ///< reports 0.25 and 8
  bool valid = false;           ///< true within the limits
};

/// Outputs of the controller: after mixer, override and failsafe.
struct ControllerOutputs {
  std::array<double, 14> values_ratio{};  ///< servo and motor outputs, 0 to 1
};

/// A parameter of the controller, published at its first report and at each change: a record of set-up and
/// calibration.
struct ControllerParameter {
  Text<17> name;                       ///< name of the parameter
  Text<24> value;                      ///< value in the fewest digits that give the same 32 bits; its unit
                                       ///< is that of the firmware
  bool whole = false;                  ///< type of the value: true for an integer, false for a float
  std::uint16_t index = 0, count = 0;  ///< index of the parameter, and number of parameters
};

/// State of the link between host and controller.
struct LinkStatus {
  bool open = false;                           ///< true if the device is open
  bool synchronised = false;                   ///< true if the offset to the clock of the controller is
                                               ///< known
  double heard_age_s = 1e9;                    ///< time since the last valid frame; 1e9: never
  std::uint64_t frames = 0;                    ///< number of valid frames
  std::uint64_t bad = 0;                       ///< number of frames with a wrong checksum
  std::uint64_t missing = 0;                   ///< number of lost frames, by their sequence numbers
  std::uint64_t dropped = 0;                   ///< number of frames without room on the host
  std::uint64_t unusable = 0;                  ///< number of sensor values that are not finite or not
                                               ///< plausible
  std::uint64_t commands = 0;                  ///< number of commands sent
  std::uint64_t unsent = 0;                    ///< number of commands that are not finite, or not accepted
                                               ///< by the device
  std::uint32_t connections = 0, reboots = 0;  ///< number of connections, and of reboots of the controller
  std::uint32_t imu_gaps = 0;                  ///< number of gaps above 6 ms between two inertial samples
  double worst_gap_s = 0;                      ///< longest gap between two inertial samples
  double imu_rate_hz = 0;                      ///< rate of the inertial samples in the last second
  double round_trip_s = 0;                     ///< smallest round-trip time of the last seconds
  bool pitot_zeroed = false;                   ///< true after a reboot in flight has zeroed the pitot: it is
                                               ///< not used any more
  std::int64_t offset_ns = 0;                  ///< clock of the host minus clock of the controller
  double drift_ratio = 0;                      ///< relative rate error of the host's clock; positive is
                                               ///< faster
  double turnaround_s = 0;                     ///< longest time from the arrival of an inertial sample to
                                               ///< its command, since the last report
};

}  // namespace fulmar::fcu
