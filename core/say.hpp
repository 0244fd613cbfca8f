// SPDX-License-Identifier: BSD-3-Clause
// Messages of the host to users, on standard error, in the colours of spdlog.
#pragma once
#include <string>

namespace fulmar::core {

enum class Tone : unsigned char { info, warning, error };

/// Prints a line without control characters. From any thread.
void say_aloud(const std::string& text, Tone tone = Tone::info);
inline void warn(const std::string& text) { say_aloud(text, Tone::warning); }

/// [setup] Prints lines to standard error without time and level.
void speak_on_standard_error();

}  // namespace fulmar::core
