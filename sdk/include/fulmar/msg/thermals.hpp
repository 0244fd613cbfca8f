// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// A column of rising air. A negative strength is sinking air.
struct Thermal {
  double north_m = 0, east_m = 0;  ///< position of its axis at flight time 0, from the origin
  double strength_mps = 2;         ///< updraft on the axis at the height of its maximum
  double radius_m = 60;            ///< radius at which the updraft is 1/e of that on the axis
  double top_m = 1000;             ///< depth z_i of the convective layer, above the ground at the origin
  bool drifts = false;             ///< drift of the axis with the steady wind
};

/// The file of the parameter `thermals`.
struct Thermals {
  List<Thermal, 16> thermals;
  bool given = false;  ///< true if the mission defines them; set by the host
};

template <>
inline constexpr std::array<std::string_view, 1> required_fields<Thermals>{"thermals"};
template <>
inline constexpr std::array<std::string_view, 2> required_fields<Thermal>{"north_m", "east_m"};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Thermal>{
    {{"strength_mps", -30, 30}, {"radius_m", 1, 1e4}, {"top_m", 10, 2e4}}};

}  // namespace fulmar
