// SPDX-License-Identifier: BSD-3-Clause
// What a component must be to fill a role of a mission: wires in, messages out. Read from the mission and
// from who fills the role there.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/graph/mission.hpp"

namespace fulmar::core {

struct ContractInput {
  std::string name;
  PortName from;
  TypePtr type;
  fulmar_port_kind kind = FULMAR_IN_VALUE;
  bool optional = false;
};

struct ContractOutput {
  std::string name;
  TypePtr type;  // empty: an optional output that nobody has
  std::string type_name;
  fulmar_port_kind kind = FULMAR_OUT_VALUE;
  std::uint32_t capacity = 1;
  bool optional = false;
};

struct Contract {
  std::string role, mission;  // names
  std::vector<ContractInput> inputs;
  std::vector<ContractOutput> outputs;
  std::string phase;  // where the new component flies; "" for a vehicle, which flies in all of them
  const ComponentText* shipped_text;  // who fills the role there today; part of MissionView::text
  std::string shipped_use;            // "control_slc/Outer", or a file
  ComponentInfo shipped;
  Node shipped_set;  // what that phase sets
  bool vehicle() const { return role == "vehicle"; }
};

/// A mission three ways: its own keys, what they mean with the file that it extends, and the graph that
/// follows.
struct MissionView {
  std::filesystem::path file;  // absolute
  Node root;
  MissionText text;
  Graph graph;
};

/// Throws Error with every fault of the mission.
MissionView view_mission(const std::filesystem::path& file);

/// Throws Error naming the valid roles.
Contract read_contract(const MissionView& mission, const std::string& role);

}  // namespace fulmar::core
