// SPDX-License-Identifier: BSD-3-Clause
// The child's last act when it crashes: it tells the host which signal ends it, and wakes it.
#pragma once
#include "core/isolate/shared.hpp"

namespace fulmar::core {

/// Handles the signals of a crash on a stack of their own, for the calling thread.
void tell_crashes(ControlBlock& control);

}  // namespace fulmar::core
