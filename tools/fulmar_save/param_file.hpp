// SPDX-License-Identifier: BSD-3-Clause
// Writes the values of a flight's parameters back into their files, without a change of comments and layout.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "tools/fulmar_save/file_edit.hpp"

namespace fulmar::core {

/// A parameter of a flight.
struct SavedParam {
  std::string component, use;  // "slc", "control_slc/Outer"
  ParamInfo info;
  ParamValue value;  // base
};

struct SavePlan {
  std::vector<FileEdit> files;       // those that change
  std::vector<std::string> changed;  // "slc.roll_kp"
  std::vector<std::string> refused;  // sentences: parameters that must be edited by hand, with the reason
  std::vector<std::string> also;     // sentences: other parameters that the same text sets
};

/// Plans the edits. The place of a value decides the file: `params:` of the mission, of a file that it
/// extends, or of the airframe. A value without a place, or in a file of the installation (`fulmar:`), goes
/// to the mission. Values keep their unit and quotes.
/// A change with another effect, for example through an anchor, is rejected. An exception is the same
/// parameter of the airframe for an inactive plugin, which is reported.
/// `flown`: the active plugins, "control_slc/Outer". Records and blobs are left out. Throws Error when a file
/// cannot be read.
SavePlan plan_save(const std::filesystem::path& mission, const std::vector<SavedParam>& params,
                   const std::vector<std::string>& flown);

/// Throws Error when the file is not the active mission.
void check_mission_name(const std::string& file, const std::string& flies);

}  // namespace fulmar::core
