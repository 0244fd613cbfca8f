// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// The sideslip that the rudder is to fly, past the outer loops, which know none. Whoever asks for it feeds
/// the bank forward that keeps the course meanwhile. It counts as long as it is said anew.
struct SideslipCommand {
  double sideslip_rad = 0;  ///< asin(v / Va): positive is air from the right, the nose left of it
};

template <>
inline constexpr std::array<FieldRange, 1> field_ranges<SideslipCommand>{
    {{"sideslip_rad", -std::numbers::pi / 2, std::numbers::pi / 2}}};

}  // namespace fulmar
