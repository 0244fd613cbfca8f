// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// A strip to land on, from the point where it begins, in the local frame.
struct Runway {
  double north_m = 0, east_m = 0, up_m = 0;  ///< of the origin: the threshold, the middle of its near end
  double heading_rad = 0;                    ///< in which it is landed on
  double length_m = 0;                       ///< from the threshold on
};

template <>
inline constexpr std::array<FieldRange, 2> field_ranges<Runway>{
    {{"heading_rad", -std::numbers::pi, 2 * std::numbers::pi}, {"length_m", 1, 10000}}};

template <>
inline constexpr std::array<std::string_view, 5> required_fields<Runway>{"north_m", "east_m", "up_m",
                                                                         "heading_rad", "length_m"};

}  // namespace fulmar
