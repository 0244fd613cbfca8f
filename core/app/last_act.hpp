// SPDX-License-Identifier: BSD-3-Clause
// What the program does last when code of a plugin ends it, by a crash or an exit: the vehicle's device gets
// its last frame, and somebody is told who it was. So in every program that loads plugins: a file that
// behaves where it is tried may do otherwise here.
#pragma once
#include <array>
#include <atomic>
#include <initializer_list>
#include <string>

#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

/// While it lives the program is at work: whoever ends the process meanwhile is told of, and its exit code is
/// not 0. A crash is told for ever.
class AtWork {
 public:
  AtWork();
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
};

/// Takes the signals of a crash, once or again.
void handle_crashes();

/// Prepares the report of an end: the place of the log, of which `log` is the name when it is whole ("": no
/// log), or that the flight is over.
void prepare_end(const std::string& log, bool flight_over = false);
/// A flight is under way.
extern std::atomic<bool> in_flight;

/// Where a plugin's code lies, for a crash in a thread that is nobody's. `function`: one of the file's.
void note_code(const std::string& file, const void* function);
void forget_code();

/// Whether this process is the one whose ends are handled, and no copy of it that a component has forked.
bool is_the_host();
/// Ends this process by a signal as if the host had never handled it.
void end_by_default(int signal);

/// What the vehicle's device is to hear when the host goes. This and what follows is async-signal-safe.
void send_last_frame();
void report(std::initializer_list<const char*> words);
template <std::size_t N, class... Values>
void report(const MessageText<N>& message, const Values*... values) {
  std::array<char, 4400> text{};  // holds the name of a log
  message.write(text.data(), text.size(), values...);
  report({text.data()});
}
void report_end();
[[noreturn]] void leave(int code);

}  // namespace fulmar::core
