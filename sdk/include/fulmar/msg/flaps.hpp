// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// Where the flaps are to go. Whoever lands or takes off says it; silence is retracted.
struct Flaps {
  double flap_rad = 0;  ///< positive is trailing edge down, both sides
};
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<Flaps>{
    {{"flap_rad", -std::numbers::pi / 2, std::numbers::pi / 2}}};

}  // namespace fulmar
