// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Request to arm or disarm a simulated vehicle. On hardware the pilot arms.
struct ArmRequest {
  bool armed = true;  ///< state on request: true arms
};

}  // namespace fulmar
