// SPDX-License-Identifier: BSD-3-Clause
// What the program does last when code of a plugin ends it, by a crash or an exit: the vehicle's device gets
// its last frame, and somebody is told who it was. So in every program that loads plugins: a file that
// behaves where it is tried may do otherwise here.
#pragma once
#include <atomic>
#include <initializer_list>
#include <string>

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

/// Prepares how a sentence about an end ends: with where the log lies, or with `text` when there is none.
/// `log`: its name when it will be whole.
void prepare_end(const std::string& log, const char* text);
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
void report_end();
[[noreturn]] void leave(int code);

}  // namespace fulmar::core
