// SPDX-License-Identifier: BSD-3-Clause
// End of the program when a flight does not end by itself: by a signal, a crash, or a component that ends the
// process. In each case the vehicle's device gets its last frame, and a report names the cause and the place
// of the log.
#pragma once
#include <atomic>
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// A signal that the flight has not rejected; 0: none.
extern std::atomic<int> signal_seen;

/// Installs the signal handlers; may be called again. With hardware, a flight continues when its terminal
/// closes. A second signal, or one that is not answered within `patience_s`, ends the program.
void handle_signals(bool hardware, unsigned patience_s);

/// Only the exit handlers of plugins are left to run. The program ends by force when they do not return.
void expect_exit(int code);

/// Marks a flight as under way for its lifetime. When code ends the process meanwhile, the program reports it
/// and exits with a code of at least 1.
class UnderWay {
 public:
  /// `log`: name of the complete log; "": no log.
  UnderWay(const Graph& graph, const std::string& log);
  ~UnderWay();
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;
};

}  // namespace fulmar::core
