// SPDX-License-Identifier: BSD-3-Clause
// How the program ends when a flight does not end by itself: by a signal, a crash, or a component that ends
// the process. Whatever it is, the vehicle's device gets its last frame, and somebody is told who, and where
// the log lies.
#pragma once
#include <atomic>
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// A signal that the flight has not refused; 0: none.
extern std::atomic<int> signal_seen;

/// Takes the signals, once or again. With hardware the terminal may go without an end of the flight. A second
/// signal, or none answered within `patience_s`, ends the program.
void handle_signals(bool hardware, unsigned patience_s);

/// All is done but what plugins do at their exit. Where that does not come to an end, the program does.
void expect_exit(int code);

/// While it lives a flight is under way: whoever ends the process is told of, and its exit code is 1 at
/// least.
class UnderWay {
 public:
  /// `log`: its name when it will be whole; "": none.
  UnderWay(const Graph& graph, const std::string& log);
  ~UnderWay();
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;
};

}  // namespace fulmar::core
