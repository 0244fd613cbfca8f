// SPDX-License-Identifier: BSD-3-Clause
// Contract of a component: inputs and outputs. For roles they are read from the mission and from the
// components that fill the roles there; without a role they come from the author.
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
  TypePtr type;  // empty: an optional output without a writer
  std::string type_name;
  fulmar_port_kind kind = FULMAR_OUT_VALUE;
  std::uint32_t capacity = 1;
  bool optional = false;
  std::size_t role = 0;  // index into Contract::roles
};

struct ContractRole {
  std::string name;
  // component that fills the role now; part of MissionView::text
  const ComponentText* shipped_text = nullptr;
  std::string shipped_use;  // "control_slc/Outer", or a file
  ComponentInfo shipped;
  Node shipped_set;  // settings of that phase
};

/// An output that the mission passes on: "edits" -> "plan.edits".
struct ContractFeed {
  std::string output;
  PortName to;
};

struct Contract {
  std::string mission;
  std::vector<ContractRole> roles;  // empty: a component without a role
  std::vector<ContractInput> inputs;
  std::vector<ContractOutput> outputs;
  std::vector<ContractFeed> feeds;
  std::string phase;   // phase in which the new component is active; "" for a vehicle, which is active in all
  double rate_hz = 0;  // 0: every tick
  bool vehicle() const { return roles.size() == 1 && roles[0].name == "vehicle"; }
  /// "outer", "outer and inner"
  std::string role_words() const;
  /// Components that filled the roles before: "slc", "slc and attitude"
  std::string shipped_words() const;
};

/// Three views of a mission: its own keys, the keys merged with the file that it extends, and the graph.
struct MissionView {
  std::filesystem::path file;  // absolute
  Node root;
  MissionText text;
  Graph graph;
};

/// Throws Error with all faults of the mission.
MissionView view_mission(const std::filesystem::path& file);

/// Throws Error naming the valid roles.
Contract read_contract(const MissionView& mission, const std::vector<std::string>& roles);

/// Message of a port as its writer defines it, and how it is written. `type` is empty when it is unknown.
struct Sent {
  TypePtr type;
  fulmar_port_kind kind = FULMAR_OUT_VALUE;
  bool known = false;  // the port exists
};
Sent sent_by(const Graph& graph, const PortName& from);

}  // namespace fulmar::core
