// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace fulmar::core {

/// What the vehicle is told in a tick: the commands of those who fly, the failsafe's values, or nothing.
enum class Steering : std::uint8_t { commands, failsafe, nothing };

}  // namespace fulmar::core
