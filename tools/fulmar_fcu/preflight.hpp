// SPDX-License-Identifier: BSD-3-Clause
// The list before a flight: each line OK, WARN or FAIL, why, and what to do. What the parameters mean:
// rosflight_firmware 2.0.
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

/// What the inertial unit measured while it was listened to.
struct Rest {
  double gravity_mps2 = 0, turn_rps = 0;        ///< lengths of the means
  double accel_rms_mps2 = 0, gyro_rms_rps = 0;  ///< around them: sensor noise, or somebody moves it
};

/// All that is judged.
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
  std::int64_t baud = 0;  ///< 0: no serial line
  std::optional<Airframe> airframe;
};

/// Listens for so long.
Facts gather(Client& client, std::int64_t baud, std::int64_t listen_ns = 2 * second);
std::vector<Item> judge(const Facts& facts);
std::string items_text(const std::vector<Item>& items);

/// Throws Error with every fault of the file.
Airframe read_airframe(const std::string& path);

}  // namespace fulmar::fcu
