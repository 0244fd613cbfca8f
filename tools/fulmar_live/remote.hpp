// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of a running flight, and the completion of the whole command line.
#pragma once
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fulmar::core {

class RemoteCommands {
 public:
  /// Adds list, watch, echo, plot, view, param, call, phase, swap, reset, pause, resume, step, speed, restart
  /// and completion. `programs`: further commands, in separate programs, for shells.
  RemoteCommands(CLI::App& app, std::vector<std::string> programs);
  ~RemoteCommands();
  RemoteCommands(const RemoteCommands&) = delete;
  RemoteCommands& operator=(const RemoteCommands&) = delete;
  /// Runs the parsed command and returns its exit code.
  int run() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
