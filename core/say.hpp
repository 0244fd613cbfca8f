// SPDX-License-Identifier: BSD-3-Clause
// What the host says to people, on standard error, in the colours of spdlog.
#pragma once
#include <string>

namespace fulmar::core {

enum class Tone : unsigned char { info, warning, error };

/// A line for people, without what a terminal obeys. From any thread.
void say_aloud(const std::string& text, Tone tone = Tone::info);
inline void warn(const std::string& text) { say_aloud(text, Tone::warning); }

/// [set-up] Lines go to standard error as they are, without time and level.
void speak_on_standard_error();

}  // namespace fulmar::core
