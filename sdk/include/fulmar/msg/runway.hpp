// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// A strip to land on, from the point where it begins: the threshold, the middle of its near end. Either in
/// the local frame or geodetic; what is not given is `unknown_std`.
struct Runway {
  double north_m = unknown_std, east_m = unknown_std, up_m = unknown_std;  ///< of the origin
  double heading_rad = 0;  ///< in which it is landed on, from north, clockwise
  double length_m = 0;     ///< from the threshold on; 0: there is no runway
  double lat_deg = unknown_std, lon_deg = unknown_std, alt_msl_m = unknown_std;  ///< WGS-84
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
