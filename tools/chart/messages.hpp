// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::chart_messages {

inline constexpr MessageText figure_too_small{
    "chart.figure_too_small",
    {"count", "noun", "width", "height"},
    "is too small for its axes and {count}{noun}; give at least {width}x{height}mm"};

}  // namespace fulmar::chart_messages
