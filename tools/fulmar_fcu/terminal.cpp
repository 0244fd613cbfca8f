// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>

#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/messages.hpp"

namespace fulmar::fcu {

namespace {
volatile std::sig_atomic_t stop_wanted = 0;
}

void catch_interrupt() {
  struct sigaction action {};
  // no SA_RESTART, so that a question on the terminal ends, too
  action.sa_handler = [](int) { stop_wanted = 1; };
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return stop_wanted != 0; }

bool on_terminal() { return ::isatty(STDOUT_FILENO) == 1; }

bool confirmed(const std::string& question, bool yes, const std::string& flag) {
  if (yes) return true;
  if (::isatty(STDIN_FILENO) != 1 || !on_terminal()) throw Error(fcu_messages::confirmation_required(flag));
  std::printf("%s [y/N] ", question.c_str());
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer == "y" || answer == "Y" || answer == "yes") return true;
  std::printf("Nothing was changed.\n");
  return false;
}

void show_progress(const std::string& text) {
  if (!on_terminal()) return;
  std::printf("\r\033[K%s", text.c_str());
  std::fflush(stdout);
}

}  // namespace fulmar::fcu
