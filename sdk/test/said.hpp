// SPDX-License-Identifier: BSD-3-Clause
// What a command in a shell says, for tests.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace fulmar::test {

/// Whether `part` stands in a text.
inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Said {
  int code = -1;    ///< of the exit; 128 and the signal, as shells have it
  std::string out;  ///< whatever goes to the standard output; with 2>&1 in the command the errors, too
};

/// `each` gets the lines as they come.
template <class Each>
Said shell(const std::string& command, Each&& each) {
  Said said;
  FILE* const pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  char line[4096];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    each(std::string(line));
    said.out += line;
  }
  const int status = pclose(pipe);
  said.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return said;
}
inline Said shell(const std::string& command) {
  return shell(command, [](const std::string&) {});
}

/// A word of fulmar, as somebody types it at a terminal: with all that it says.
inline Said typed(const std::string& words) { return shell(FULMAR_BIN_DIR "/fulmar " + words + " 2>&1"); }

}  // namespace fulmar::test
