// SPDX-License-Identifier: BSD-3-Clause
// A mission between text and graph: shared by the steps of the resolution. Internal to core/graph.
#pragma once
#include <string>
#include <vector>

#include "core/graph/catalogue.hpp"
#include "core/graph/condition.hpp"
#include "core/graph/graph.hpp"
#include "core/graph/mission.hpp"
#include "core/graph/params.hpp"

namespace fulmar::core {

/// A component of the file that can exist in this run. Until the graph is built, sources in its wires are
/// indexes of candidates, and `roles` are all roles that it can fill.
struct Candidate : Component {
  const ComponentText* text = nullptr;
  bool loaded = false;    // false: its plugin was rejected; dependent faults are not reported again
  bool assigned = false;  // fills its role, or is a fallback, in some phase
  bool used = false;      // is created
  int component = -1;     // into Graph::components
};

struct RoleDraft {
  const RoleText* text;
  std::string name;
  std::vector<int> fillers;    // candidates, in file order
  std::vector<TypePtr> types;  // one per output; empty when no component provides it
  bool unclear = false;        // a filler was rejected: do not report its missing outputs
};

/// Meaning of a port name. `type` empty: a probe, or unknown because its component was rejected.
struct Target {
  Source source;
  TypePtr type;
  fulmar_port_kind kind = FULMAR_OUT_VALUE;
  bool unclear = false;
};

struct Draft {
  const MissionText& text;
  const Overrides& overrides;
  Report& report;
  FileStore& files;
  std::vector<Candidate> candidates;
  std::vector<RoleDraft> roles;
  std::vector<std::vector<Assignment>> assignments;  // [phase][role]; components are indexes of candidates
  Graph graph;

  int candidate(const std::string& name) const { return index_named(candidates, name); }
  int role(const std::string& name) const { return index_named(roles, name); }
  bool is_out(const ComponentText& c) const { return c.only && *c.only != text.io; }
  const Component& vehicle() const { return nth(graph.components, graph.vehicle); }
};

// resolve.cpp
/// Why a component of the file does not exist: "fcu exists only with io: fcu", or that the file has no such
/// name.
Diagnostic not_there(const Draft& draft, const std::string& name);

/// Whether a component that fills the role in this run has the output. For the built graph.
bool provided(const Graph& graph, const Source& source);

/// A role or component that does not exist; a layer may have removed it.
struct NoOwner : Error {
  NoOwner(const std::string& name, Diagnostic message) : Error(std::move(message)), owner(name) {}
  std::string owner;
};
/// Whether a layer has removed that role or component. Then one fault at that layer lists all places that
/// still name it.
bool taken_away(Draft& draft, const std::string& name, const Where& where, const std::string& path);
/// Reports a NoOwner as above, and any other fault by itself.
void report(Draft& draft, const Where& where, const std::string& path, const Error& fault);

// role_contracts.cpp
void resolve_roles(Draft& draft);
/// Components that fill several roles: the fillers must be unambiguous.
void check_groups(Draft& draft);
/// Exactly one vehicle: the only one that fills the role, or the only vehicle of a mission without that role.
/// Call it after the used components are known.
void choose_vehicle(Draft& draft);

// wires.cpp
Target find_target(const Draft& draft, const PortName& name);  // throws Error, NoOwner
void resolve_wires(Draft& draft);
/// Reports inputs without a source. Call it after the used components are known.
void check_fed(Draft& draft);
void order_steps(Draft& draft);

// ages.cpp: of the built graph
void guard_wires(Draft& draft);
/// Per component: whether its outputs can move the aircraft.
std::vector<bool> chain_to_vehicle(const Graph& graph);

// hardware.cpp: of the built graph
/// Steering components and conditions that read ports of the simulator alone: rejected with io: fcu.
void report_simulator_ports(Draft& draft, Catalogue& catalogue);

// fences.cpp: of the built graph
void report_two_fences(Draft& draft);

// overlaid.cpp: after the roles are assigned
void report_overlaid(Draft& draft);

// tap_sections.cpp
void mark_imports(Draft& draft);
/// `ports`: the names under which outputs are published.
void resolve_dds(Draft& draft, const std::vector<std::string>& ports);

// phases.cpp
std::string phase_path(const PhaseText& phase);
/// The phases of the mission, or a default one for a mission that has none.
const std::vector<PhaseText>& phases_of(const MissionText& text);
void assign_roles(Draft& draft);

// named_ports.cpp
/// Conditions, figures and transitions. Before the graph is built, it checks them and marks the components
/// that they name. Afterwards it compiles them for the graph.
void name_ports(Draft& draft);
void compile_phases(Draft& draft);

// with.cpp
/// Components that fly with another file: a role is replaced by the component that fills it.
Overrides with_components(const MissionText& text, Overrides overrides, Report& report);

// values.cpp
void read_values(Draft& draft);
void read_failsafe(Draft& draft);

// vehicle_flags.cpp: what protects the aircraft, after the graph is built
void read_vehicle_flags(Draft& draft);

}  // namespace fulmar::core
