// SPDX-License-Identifier: BSD-3-Clause
// The terminal that standard output is.
#pragma once
#include <csignal>
#include <string>

#include "tools/fulmar_live/canvas.hpp"

namespace fulmar::core {

/// Rows and columns, 80 x 24 where nobody says; no colours where NO_COLOR is set or nobody sees them.
PlotSize terminal_size();

/// Set by SIGINT, SIGTERM and SIGHUP, once `catch_interrupts` was called.
extern volatile std::sig_atomic_t interrupted;
void catch_interrupts();

/// A screen of its own, without cursor, as long as it lives; then the terminal is as it was before.
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  /// In place of what is there. `text`: lines, no more and no wider than the terminal has; what is wider is
  /// cut by it.
  void show(std::string text);
};

}  // namespace fulmar::core
