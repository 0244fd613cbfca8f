// SPDX-License-Identifier: BSD-3-Clause
// Writes the values that parameters have in a flight back into the files that they came from, and leaves
// comments and layout as they are.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "tools/fulmar_save/file_edit.hpp"

namespace fulmar::core {

/// A parameter as a flight has it.
struct SavedParam {
  std::string component, use;  // "slc", "control_slc/Outer"
  ParamInfo info;
  ParamValue value;  // base
};

struct SavePlan {
  std::vector<FileEdit> files;       // those that change
  std::vector<std::string> changed;  // "slc.roll_kp"
  std::vector<std::string> refused;  // sentences: what has to be written by hand, and why
  std::vector<std::string> also;     // sentences: what else the same text says
};

/// Where a value stands decides where it is written: `params:` of the mission, that of a file it extends,
/// the airframe's; the mission when it stands nowhere, or in a file of the installation (`fulmar:`). Values
/// keep the unit and the quotes that they are written in. A change that would alter anything else, through an
/// anchor say, is refused, but when that is the same parameter of the airframe for a plugin that does not
/// fly: it is told. `flown`: the plugins that do, "control_slc/Outer". Records and blobs are left out. Throws
/// Error when a file cannot be read.
SavePlan plan_save(const std::filesystem::path& mission, const std::vector<SavedParam>& params,
                   const std::vector<std::string>& flown);

/// Throws Error when the file is another mission than the one that flies.
void check_mission_name(const std::string& file, const std::string& flies);

}  // namespace fulmar::core
