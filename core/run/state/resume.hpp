// SPDX-License-Identifier: BSD-3-Clause
// A flight that resumes at the end of a log: for a host that was restarted in the air.
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
  std::vector<std::string> missing;  // state that is missing in the log, in sentences
  bool armed = false;                // state of the aircraft at the end of the log
  bool if_armed = false;  // resume only when the vehicle reports in its first second that it is armed and not
                          // on the ground
  std::string text() const;  // "phase cruise, manage.first_item = 3"
};

/// State from a log of this mission, at its end. Throws Error when it is of another mission or holds no
/// phase.
Resume read_resume(const Graph& graph, const std::filesystem::path& log);

/// Stores the place of a flight's log in the mission's default folder: `newest_log` reads it.
void note_newest_log(const Graph& graph, const std::filesystem::path& log);

/// The newest log of the mission, in its default folder or at the stored place of the last flight, truncated
/// or complete. Empty when none is young enough; 0: any age.
std::filesystem::path newest_log(const Graph& graph, double max_age_s);

}  // namespace fulmar::core
