// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class AuxKind : std::uint8_t { off, servo, motor };

/// Outputs without effect on the flight: a camera, a hook, a light. The vehicle defines which of them exist.
struct AuxOutputs {
  std::array<AuxKind, 14> kinds{};        ///< kind of each output
  std::array<double, 14> values_ratio{};  ///< value of each output; servo: -1 to 1; motor: 0 to 1, only
                                          ///< while armed
};

}  // namespace fulmar
