// SPDX-License-Identifier: BSD-3-Clause
// `fulmar replay`.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

struct ReplayArguments {
  std::string log;
  Overrides changes;  // --with and --set: an experiment; --record
  std::string out;    // file for the replay's log; "": none
  bool json = false;
};

class ReplayCommand {
 public:
  explicit ReplayCommand(CLI::App& app);

  /// Call after the parsing: replays the log and reports differences. Exit code: 0 equal, 1 different; 0 for
  /// a completed experiment. Throws Error, and CLI::ValidationError (wrong usage).
  int run();

 private:
  ReplayArguments words_;
  std::vector<std::string> set_, with_;
};

}  // namespace fulmar::core
