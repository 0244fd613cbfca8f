// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Asks a simulated vehicle to arm or disarm. On hardware the pilot arms.
struct ArmRequest {
  bool armed = true;
};

}  // namespace fulmar
