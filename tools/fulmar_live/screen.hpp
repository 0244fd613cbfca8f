// SPDX-License-Identifier: BSD-3-Clause
// The terminal of the standard output.
#pragma once
#include <csignal>
#include <string>

#include "tools/fulmar_live/canvas.hpp"

namespace fulmar::core {

/// Rows and columns, 80 x 24 when unknown; no colours with NO_COLOR or without a terminal.
PlotSize terminal_size();

/// Set by SIGINT, SIGTERM and SIGHUP, once `catch_interrupts` was called.
extern volatile std::sig_atomic_t interrupted;
void catch_interrupts();

/// The alternate screen without a cursor; the destructor restores the terminal.
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  /// Replaces the content. `text`: lines within the size of the terminal; longer lines are cut.
  void show(std::string text);
};

}  // namespace fulmar::core
