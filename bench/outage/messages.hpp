// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::outage_messages {

inline constexpr MessageText fixes_missing{"outage.fixes_missing", {"log"}, "{log} has no fixes"};
inline constexpr MessageText fixes_outside{
    "outage.fixes_outside",
    {"from", "to", "log", "first", "last"},
    "no fixes to withhold from {from} to {to}; those of {log} arrive from {first} to {last}"};

}  // namespace fulmar::outage_messages
