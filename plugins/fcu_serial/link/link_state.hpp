// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace fulmar::fcu {

struct LinkState {
  bool open = false;          ///< the device is open
  std::int64_t heard_ns = 0;  ///< host time of the last valid frame; 0: never
  std::uint64_t frames = 0, bad = 0, missing = 0, lost_in_queue = 0;
  std::uint64_t modern = 0;   ///< starts of frames of MAVLink 2
  std::uint64_t undated = 0;  ///< impossible stamps, replaced by the time of arrival
  // all bytes; printable ones and line ends among them, which indicate a device of another kind
  std::uint64_t bytes = 0, text_bytes = 0;
  std::uint32_t connections = 0, reboots = 0;
  bool synchronised = false;
  std::int64_t round_trip_ns = 0;  ///< smallest of the last seconds
  std::int64_t offset_ns = 0;      ///< host time = controller's time + offset
  double drift_ppm = 0;
};

}  // namespace fulmar::fcu
