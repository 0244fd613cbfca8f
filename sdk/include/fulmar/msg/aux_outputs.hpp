// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class AuxKind : std::uint8_t { off, servo, motor };

/// Outputs that fly nothing: a camera, a hook, a light. Which of them exist is the vehicle's affair.
struct AuxOutputs {
  std::array<AuxKind, 14> kinds{};
  std::array<double, 14> values_ratio{};  ///< servo: -1 to 1; motor: 0 to 1, only while armed
};

}  // namespace fulmar
