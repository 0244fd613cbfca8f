// SPDX-License-Identifier: BSD-3-Clause
// A flight that goes on where a log ended: for a host that was restarted in the air.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

struct Resume {
  struct Param {
    std::string component, param;
    ParamValue value;
  };
  std::string phase;
  std::vector<Param> params;         // by the mission's `resume:`
  std::vector<std::string> missing;  // what the log does not tell, in sentences
  bool armed = false;                // the aircraft was, when the log ended
  bool if_armed =
      false;  // only when the vehicle says that it is armed, and not that it stands, in its first second
  std::string text() const;  // "phase cruise, manage.first_item = 3"
};

/// What a log of this mission says, up to wherever it ends. Throws Error when it is of another mission or
/// holds no phase.
Resume read_resume(const Graph& graph, const std::filesystem::path& log);

/// Remembers, in the mission's usual place, where the log of a flight is: `newest_log` looks there, too.
void note_newest_log(const Graph& graph, const std::filesystem::path& log);

/// The newest log of the mission, in its usual place or where the last flight was noted to write it, cut off
/// or whole; empty when there is none that young. 0: of any age.
std::filesystem::path newest_log(const Graph& graph, double max_age_s);

}  // namespace fulmar::core
