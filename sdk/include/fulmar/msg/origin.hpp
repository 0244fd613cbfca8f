// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Origin of the local frame. A parameter `Record<Origin> origin` is filled from the mission's `origin:`.
struct Origin {
  double lat_deg = 0;    ///< latitude, WGS-84
  double lon_deg = 0;    ///< longitude, WGS-84
  double alt_msl_m = 0;  ///< altitude above mean sea level
  bool given = false;    ///< true if the mission defines it; false: mean of the first good fixes
};

/// Range of the ground and of the atmosphere models; not at a pole, where north changes within a flight.
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Origin>{
    {{"lat_deg", -89.5, 89.5}, {"lon_deg", -180, 180}, {"alt_msl_m", -1000, 20000}}};

template <>
inline constexpr std::array<std::string_view, 3> required_fields<Origin>{"lat_deg", "lon_deg", "alt_msl_m"};

}  // namespace fulmar
