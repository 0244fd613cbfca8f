// SPDX-License-Identifier: BSD-3-Clause
// For the handler of a signal that ends the host: the component of a thread, and the last frame for its
// device.
#pragma once
#include <atomic>

#include "core/run/component/running_code.hpp"
#include "fulmar/abi.h"

namespace fulmar::core {

/// The vehicle's last frame, encoded in advance; nullptr without one.
inline std::atomic<const fulmar_last_frame*> last_frame{nullptr};

}  // namespace fulmar::core
