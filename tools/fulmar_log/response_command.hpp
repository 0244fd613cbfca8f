// SPDX-License-Identifier: BSD-3-Clause
// `fulmar response`: how one field of a log answers another one.
#pragma once
#include <memory>

namespace CLI {
class App;
}

namespace fulmar::response {

class ResponseCommand {
 public:
  /// Adds the command `response` to the program's.
  explicit ResponseCommand(CLI::App& app);
  ~ResponseCommand();
  bool parsed() const;
  /// 0: at least one of what was asked for could be told; else it throws core::Error.
  int run() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::response
