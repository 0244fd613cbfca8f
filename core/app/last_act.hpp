// SPDX-License-Identifier: BSD-3-Clause
// Last actions of the program when a plugin's code ends it by a crash or an exit: it sends the vehicle's
// device the last frame and reports the component. Every program that loads plugins uses this: a file that
// passed its probe may still crash here.
#pragma once
#include <array>
#include <atomic>
#include <initializer_list>
#include <string>

#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

/// Marks the program as at work for its lifetime. When code ends the process meanwhile, the program reports
/// it and exits with a code other than 0. A crash is reported at any time.
class AtWork {
 public:
  AtWork();
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
};

/// Installs the handlers of crash signals; may be called again.
void handle_crashes();

/// Prepares the report of an end: the place of the log, or that the flight is over. `log`: name of the
/// complete log; "": no log.
void prepare_end(const std::string& log, bool flight_over = false);
/// A flight is under way.
extern std::atomic<bool> in_flight;

/// Notes the address range of a plugin's code, for a crash in a thread that no component owns. `function`:
/// any function of the file.
void note_code(const std::string& file, const void* function);
void forget_code();

/// Whether this process is the host itself, not a copy that a component has forked.
bool is_the_host();
/// Ends this process by a signal as if the host had never handled it.
void end_by_default(int signal);

/// Sends the last frame to the vehicle's device. This function and those below are async-signal-safe.
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
