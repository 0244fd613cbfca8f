// SPDX-License-Identifier: BSD-3-Clause
// The mission of a new plugin: the given one, with the new component in its roles or beside them. Stays short
// by extending what the given one extends.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_new/new_contract.hpp"

namespace fulmar::core {

/// What a mission is to say of the new component.
struct NewComponent {
  std::string name;  // of component and plugin
  std::vector<std::string>
      references;  // outputs that it passes on from a second instance of the shipped component; usually none
};

/// Name of the second instance of who fills `role`: one that the mission does not use yet.
std::string reference_name(const MissionView& mission, const Contract& contract, const std::string& name,
                           std::size_t role);

/// The text of mission.yaml. File names in it begin with fulmar: where they are of the installation, and are
/// absolute elsewhere, but for that of the new plugin.
std::string write_mission(const MissionView& mission, const Contract& contract,
                          const NewComponent& component);

}  // namespace fulmar::core
