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

/// One solution of a satellite navigation receiver. Its time of validity is the sample's stamp; it may be
/// older than its arrival.
struct Gnss {
  double latitude_deg = 0;   ///< WGS-84
  double longitude_deg = 0;  ///< WGS-84
  double altitude_m = 0;     ///< above mean sea level
  Vec3<Ned> velocity_mps;    ///< relative to the ground
  double horizontal_std_m = unknown_std;
  double vertical_std_m = unknown_std;
  double speed_std_mps = unknown_std;
  std::int64_t utc_ns = 0;  ///< nanoseconds since 1970-01-01, as the receiver knows them; 0 when it does not
  FixType fix = FixType::none;
  std::uint8_t satellites = 0;
};

}  // namespace fulmar
