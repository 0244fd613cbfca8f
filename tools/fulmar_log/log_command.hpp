// SPDX-License-Identifier: BSD-3-Clause
// fulmar log info | recover | export | diff | compare
#pragma once
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace fulmar::core {

class LogCommand {
 public:
  /// Adds the command `log` to the program.
  explicit LogCommand(CLI::App& app);
  ~LogCommand();
  bool parsed() const;
  /// Returns the exit code. Throws Error.
  int run() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
