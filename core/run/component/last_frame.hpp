// SPDX-License-Identifier: BSD-3-Clause
// For the handler of a signal that ends the host: whose code a thread was in, and what its device still gets.
#pragma once
#include <atomic>

#include "core/run/component/running_code.hpp"
#include "fulmar/abi.h"

namespace fulmar::core {

/// The vehicle's last word, encoded beforehand; nullptr when it has none.
inline std::atomic<const fulmar_last_frame*> last_frame{nullptr};

}  // namespace fulmar::core
