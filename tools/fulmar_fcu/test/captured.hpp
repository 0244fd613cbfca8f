// SPDX-License-Identifier: BSD-3-Clause
// Runs a command and keeps its output, its exit code, and its error.
#pragma once
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <string>

namespace fulmar::fcu::test {

struct Captured {
  int code = 1;
  std::string out, complaint;

  explicit Captured(const std::function<int()>& command) {
    std::FILE* room = std::tmpfile();
    std::fflush(stdout);
    const int terminal = ::dup(STDOUT_FILENO);
    ::dup2(::fileno(room), STDOUT_FILENO);
    try {
      code = command();
    } catch (const std::exception& e) {
      complaint = e.what();
    }
    std::fflush(stdout);
    ::dup2(terminal, STDOUT_FILENO);
    ::close(terminal);
    std::rewind(room);
    for (int c = 0; (c = std::fgetc(room)) != EOF;) out += static_cast<char>(c);
    std::fclose(room);
  }
  bool says(const std::string& part) const { return (out + complaint).find(part) != std::string::npos; }
};

}  // namespace fulmar::fcu::test
