// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace fulmar::core {

volatile std::sig_atomic_t interrupted = 0;

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { interrupted = 1; });
}

PlotSize terminal_size() {
  PlotSize size;
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0) {
    size.columns = window.ws_col;
    size.rows = window.ws_row;
  }
  const char* no_colour = std::getenv("NO_COLOR");
  size.colours = isatty(STDOUT_FILENO) != 0 && (!no_colour || !*no_colour);
  return size;
}

Screen::Screen() { std::fputs("\x1b[?1049h\x1b[?25l\x1b[?7l", stdout); }  // disables the wrap of long lines

Screen::~Screen() {
  std::fputs("\x1b[?7h\x1b[?25h\x1b[?1049l", stdout);
  std::fflush(stdout);
}

void Screen::show(std::string text) {
  if (text.ends_with('\n')) text.pop_back();  // a final newline would scroll the screen
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 4)
    text.insert(at, "\x1b[K");
  std::printf("\x1b[H%s\x1b[K\x1b[J", text.c_str());
  std::fflush(stdout);
}

}  // namespace fulmar::core
