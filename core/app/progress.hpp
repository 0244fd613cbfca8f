// SPDX-License-Identifier: BSD-3-Clause
// The progress of a flight on standard error.
#pragma once
#include <cstdio>
#include <string>

#include "core/app/report.hpp"
#include "core/app/words.hpp"
#include "core/say.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {

/// One line that is rewritten on a terminal; every tenth line as a whole when piped.
class Progress {
 public:
  explicit Progress(const Graph& graph) : graph_(graph), terminal_(words_on_terminal()) {}
  void show(const Flight& flight) {
    if (!terminal_ && ++calls_ % 10 != 1) return;
    std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n",
                 for_terminal(progress_line(graph_, flight)).c_str());
    drawn_ = terminal_;
  }
  void say(const std::string& text, bool warning) {
    clear();
    say_aloud(text, warning ? Tone::warning : Tone::info);
  }
  void clear() {
    if (drawn_) std::fprintf(stderr, "\r\033[K");
    drawn_ = false;
  }

 private:
  const Graph& graph_;
  bool terminal_, drawn_ = false;
  int calls_ = 0;
};

}  // namespace fulmar::core
