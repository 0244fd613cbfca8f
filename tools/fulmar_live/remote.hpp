// SPDX-License-Identifier: BSD-3-Clause
// The part of the command line that speaks to a running flight, and the completion of all of it.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fulmar::core {

class RemoteCommands {
 public:
  /// Adds list, echo, plot, param, call, phase, swap, reset and completion.
  /// `programs`: further commands, which are programs of their own; for shells.
  RemoteCommands(CLI::App& app, std::vector<std::string> programs);
  ~RemoteCommands();
  RemoteCommands(const RemoteCommands&) = delete;
  RemoteCommands& operator=(const RemoteCommands&) = delete;
  /// The exit code of the command that was parsed; nothing when it was another one.
  std::optional<int> run() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
