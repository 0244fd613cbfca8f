// SPDX-License-Identifier: BSD-3-Clause
// The mission of a new plugin: the given one, with the new component in its roles or without a role. It is
// short because it extends the same file as the given one.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_new/new_contract.hpp"

namespace fulmar::core {

/// Entry of the new component in the mission.
struct NewComponent {
  std::string name;  // of component and plugin
  std::vector<std::string>
      references;  // outputs that come from a second instance of the shipped component; usually none
};

/// Name of the second instance of the component that fills `role`: one that the mission does not use.
std::string reference_name(const MissionView& mission, const Contract& contract, const std::string& name,
                           std::size_t role);

/// Text of mission.yaml. File names of the installation begin with fulmar:, others are absolute, except that
/// of the new plugin.
std::string write_mission(const MissionView& mission, const Contract& contract,
                          const NewComponent& component);

}  // namespace fulmar::core
