// SPDX-License-Identifier: BSD-3-Clause
// Standard error in a flight that must not wait: a terminal may be stopped, an ssh session stall, a journal
// be slow.
#pragma once

namespace fulmar::core {

/// From now on nobody who prints on standard error waits for its reader: a thread passes the words on, and
/// those that find no room are lost. At the end of the program what is left is passed on, for at most a
/// second. May be called again.
void print_without_waiting();

/// Waits until all that was printed has been passed on, at most a second: before something is printed on
/// standard output.
void pass_on_words() noexcept;

/// Whether the reader is a terminal.
bool words_on_terminal() noexcept;

/// Async-signal-safe, for a program that ends now: what is left, then `text`, straight to the reader.
void write_last_words(const char* text) noexcept;

}  // namespace fulmar::core
