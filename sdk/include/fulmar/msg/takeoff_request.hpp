// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Request to unlock the throttle after a landing, for the next take-off.
struct TakeoffRequest {
  bool confirmed = true;  ///< confirmation of the request
};

}  // namespace fulmar
