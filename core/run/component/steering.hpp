// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace fulmar::core {

/// The inputs of the vehicle in a tick: commands of active components, failsafe values, or none.
enum class Steering : std::uint8_t { commands, failsafe, nothing };

}  // namespace fulmar::core
