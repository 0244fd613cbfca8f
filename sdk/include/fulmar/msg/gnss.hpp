// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class FixType : std::uint8_t {
  none,
  dead_reckoning,
  fix_2d,
  fix_3d,
  combined,
  time_only,
  rtk_float,
  rtk_fixed
};

/// One solution of a satellite navigation receiver. Its time of validity is the stamp of the sample, which
/// may be earlier than its arrival.
struct Gnss {
  double latitude_deg = 0;                ///< latitude, WGS-84
  double longitude_deg = 0;               ///< longitude, WGS-84
  double altitude_m = 0;                  ///< altitude above mean sea level
  Vec3<Ned> velocity_mps;                 ///< velocity relative to the ground
  double horizontal_std_m = unknown_std;  ///< standard deviation of the horizontal position
  double vertical_std_m = unknown_std;    ///< standard deviation of the altitude
  double speed_std_mps = unknown_std;     ///< standard deviation of the velocity
  std::int64_t utc_ns = 0;                ///< UTC of the receiver, nanoseconds since 1970-01-01; 0: unknown
  FixType fix = FixType::none;            ///< type of the fix
  std::uint8_t satellites = 0;            ///< number of satellites in the solution
};

}  // namespace fulmar
