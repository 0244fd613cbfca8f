// SPDX-License-Identifier: BSD-3-Clause
// The list before a flight: each line is OK, WARN or FAIL, with the reason and the remedy. Meaning of the
// parameters: rosflight_firmware 2.0.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fulmar/msg/airframe.hpp"
#include "tools/fulmar_fcu/params.hpp"
#include "tools/fulmar_fcu/status.hpp"

namespace fulmar::fcu {

enum class Verdict : std::uint8_t { ok, note, warn, fail };

struct Item {
  Verdict verdict = Verdict::ok;
  std::string name, text;
};

/// Measurements of the inertial unit at rest.
struct Rest {
  double gravity_mps2 = 0, turn_rps = 0;        ///< lengths of the means
  double accel_rms_mps2 = 0, gyro_rms_rps = 0;  ///< standard deviation: sensor noise, or motion
};

/// All facts that are checked.
struct Facts {
  std::string version;
  std::vector<Param> params;  ///< all
  RosflightStatus status;
  std::optional<RcChannels> rc;
  std::optional<RosflightGnss> gnss;
  std::optional<RosflightBatteryStatus> battery;
  std::optional<DiffPressure> pitot;
  std::optional<AttitudeQuaternion> attitude;
  std::optional<Rest> rest;
  double imu_hz = 0, mag_hz = 0, baro_hz = 0, pitot_hz = 0, rc_hz = 0, status_hz = 0;
  double bytes_per_s = 0, loss_ratio = 0;
  double uptime_s = 0;
  std::optional<double> round_trip_s;
  std::int64_t baud = 0;  ///< 0: not a serial line
  std::optional<Airframe> airframe;
};

/// Collects facts for that time.
Facts gather(Client& client, std::int64_t baud, std::int64_t listen_ns = 2 * second);
std::vector<Item> judge(const Facts& facts);
std::string items_text(const std::vector<Item>& items);

/// Throws Error with all faults of the file.
Airframe read_airframe(const std::string& path);

}  // namespace fulmar::fcu
