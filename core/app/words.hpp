// SPDX-License-Identifier: BSD-3-Clause
// Standard error without blocking in a flight: a terminal may be stopped, an ssh session may stall, a journal
// may be slow.
#pragma once

namespace fulmar::core {

/// From now on a write to standard error does not wait for its reader: a thread forwards the text, and text
/// without room in the buffer is lost. At the end of the program the rest is forwarded within at most a
/// second. May be called again.
void print_without_waiting();

/// Waits until all printed text is forwarded, at most a second. Call it before a write to standard output.
void pass_on_words() noexcept;

/// Whether the reader of standard error is a terminal.
bool words_on_terminal() noexcept;

/// Async-signal-safe, for a program that ends now: writes the rest of the buffer, then `text`, directly to
/// the reader.
void write_last_words(const char* text) noexcept;

}  // namespace fulmar::core
