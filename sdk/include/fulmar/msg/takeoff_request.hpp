// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Opens the throttle that a landing has closed, for another take-off.
struct TakeoffRequest {
  bool confirmed = true;
};

}  // namespace fulmar
