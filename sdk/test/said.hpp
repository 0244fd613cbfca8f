// SPDX-License-Identifier: BSD-3-Clause
// Output and exit code of shell commands, for tests.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace fulmar::test {

/// True if `text` contains `part`.
inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Said {
  int code = -1;    ///< exit code; 128 plus the signal, as in a shell
  std::string out;  ///< standard output; with 2>&1 in the command also the errors
};

/// Calls `each` with every line at its arrival.
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

/// Runs `fulmar` with these arguments, with standard output and errors.
inline Said typed(const std::string& words) { return shell(FULMAR_BIN_DIR "/fulmar " + words + " 2>&1"); }

}  // namespace fulmar::test
