// SPDX-License-Identifier: BSD-3-Clause
// `fulmar response`: response of one field of a log to another one.
#pragma once
#include <memory>

namespace CLI {
class App;
}

namespace fulmar::response {

class ResponseCommand {
 public:
  /// Adds the command `response` to the program.
  explicit ResponseCommand(CLI::App& app);
  ~ResponseCommand();
  bool parsed() const;
  /// Returns 0 when at least one requested result exists; else throws core::Error.
  int run() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::response
