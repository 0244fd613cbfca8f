// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace fulmar::fcu {

struct LinkState {
  bool open = false;          ///< the device is there
  std::int64_t heard_ns = 0;  ///< host time of the last good frame; 0: never
  std::uint64_t frames = 0, bad = 0, missing = 0, lost_in_queue = 0;
  std::uint64_t modern = 0;                 ///< starts of frames of MAVLink 2
  std::uint64_t undated = 0;                ///< stamps that are impossible: the arrival stands in for them
  std::uint64_t bytes = 0, text_bytes = 0;  ///< all that came, and what of it is printable or ends a line: a
                                            ///< device of another kind
  std::uint32_t connections = 0, reboots = 0;
  bool synchronised = false;
  std::int64_t round_trip_ns = 0;  ///< least of the last seconds
  std::int64_t offset_ns = 0;      ///< host time = controller's time + offset
  double drift_ppm = 0;
};

}  // namespace fulmar::fcu
