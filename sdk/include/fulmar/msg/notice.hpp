// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Severity : std::uint8_t { info, warning, error, critical };

/// One line for the person at the terminal and for the log. A port of notices is told when the mission lists
/// it under `tell:`.
struct Notice {
  Text<96> text;
  Severity severity = Severity::info;
};

}  // namespace fulmar
