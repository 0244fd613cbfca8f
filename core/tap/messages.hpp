// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::tap_messages {

inline constexpr MessageText log_ends_early{"tap.log_ends_early", {"reason"}, "the log ends early: {reason}"};
inline constexpr MessageText seed_invalid{
    "tap.seed_invalid", {"found"}, "seed '{found}': give a whole number from 0 to 18446744073709551615"};
inline constexpr MessageText speed_invalid{
    "tap.speed_invalid",
    {"found"},
    "speed '{found}': give real, max, or a multiple of real time from 0.01 to 1e6"};
inline constexpr MessageText step_count_invalid{
    "tap.step_count_invalid",
    {"found", "limit"},
    "step '{found}': give a whole number of ticks from 1 to {limit}"};

}  // namespace fulmar::tap_messages
