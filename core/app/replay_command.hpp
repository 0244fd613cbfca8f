// SPDX-License-Identifier: BSD-3-Clause
// `fulmar replay`.
#pragma once
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

struct ReplayWords {
  std::string log;
  Overrides changes;  // --with and --set: an experiment; --record
  std::string out;    // where the replay's own log goes; "": nowhere
  bool json = false;
};

/// Flies a log again and tells what differs. Returns the exit code: 0 equal, 1 different; 0 for an experiment
/// that could be flown.
int replay_command(const ReplayWords& words);

}  // namespace fulmar::core
