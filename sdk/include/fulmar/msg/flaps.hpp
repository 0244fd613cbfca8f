// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// Command of the flaps, from a landing or take-off component; without a message they are retracted.
struct Flaps {
  double flap_rad = 0;  ///< flap deflection; positive is trailing edge down, both sides
};
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<Flaps>{
    {{"flap_rad", -std::numbers::pi / 2, std::numbers::pi / 2}}};

}  // namespace fulmar
