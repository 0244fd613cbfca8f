// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// Sideslip command to the rudder, past the outer loops. Its sender adds the feed-forward bank that keeps the
/// course. It is valid only while it is repeated.
struct SideslipCommand {
  double sideslip_rad = 0;  ///< sideslip asin(v / Va): positive is air from the right, nose left of it
};

template <>
inline constexpr std::array<FieldRange, 1> field_ranges<SideslipCommand>{
    {{"sideslip_rad", -std::numbers::pi / 2, std::numbers::pi / 2}}};

}  // namespace fulmar
