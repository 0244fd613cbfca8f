// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// A runway for a landing, from its threshold at the middle of the near end. Either in the local frame or
/// geodetic; a value that is not given is `unknown_std`.
struct Runway {
  double north_m = unknown_std, east_m = unknown_std, up_m = unknown_std;  ///< position of the threshold
                                                                           ///< from the origin
  double heading_rad = 0;  ///< landing heading, from north, clockwise
  double length_m = 0;     ///< length from the threshold; 0: no runway
  double lat_deg = unknown_std, lon_deg = unknown_std, alt_msl_m = unknown_std;  ///< geodetic position of
                                                                                 ///< the threshold, WGS-84
};

template <>
inline constexpr std::array<FieldRange, 8> field_ranges<Runway>{
    {{"north_m", -1e5, 1e5},
     {"east_m", -1e5, 1e5},
     {"up_m", -1e5, 1e5},
     {"heading_rad", -std::numbers::pi, 2 * std::numbers::pi},
     {"length_m", 1, 10000},
     {"lat_deg", -90, 90},
     {"lon_deg", -360, 360},
     {"alt_msl_m", -1e5, 1e5}}};

template <>
inline constexpr std::array<std::string_view, 2> required_fields<Runway>{"heading_rad", "length_m"};

}  // namespace fulmar
