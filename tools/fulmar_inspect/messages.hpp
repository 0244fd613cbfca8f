// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::inspect_messages {

inline constexpr MessageText driver_thread{"inspect.driver_thread", "in a thread of its own"};
inline constexpr MessageText event_output_kind{"inspect.event_output_kind", "value, not in every step"};
inline constexpr MessageText format_unknown{
    "inspect.format_unknown", {"format", "choices"}, "unknown format '{format}'.{choices}"};
inline constexpr MessageText rate_in_child{"inspect.rate_in_child", {"rate"}, "{rate}, in a child process"};

}  // namespace fulmar::inspect_messages
