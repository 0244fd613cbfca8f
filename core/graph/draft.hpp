// SPDX-License-Identifier: BSD-3-Clause
// A mission on its way from text to graph: what the steps of the resolution share. Internal to core/graph.
#pragma once
#include <string>
#include <vector>

#include "core/graph/catalogue.hpp"
#include "core/graph/condition.hpp"
#include "core/graph/graph.hpp"
#include "core/graph/mission.hpp"
#include "core/graph/params.hpp"

namespace fulmar::core {

/// A component of the file that can exist in this run. Sources in its wires count candidates, and `roles` are
/// what it can fill, until the graph is built.
struct Candidate : Component {
  const ComponentText* text = nullptr;
  bool loaded = false;    // false: its plugin was refused; what depends on it is not reported again
  bool assigned = false;  // fills its role, or is a fallback, in some phase
  bool used = false;      // is created
  int component = -1;     // into Graph::components
};

struct RoleDraft {
  const RoleText* text;
  std::string name;
  std::vector<int> fillers;    // candidates, in file order
  std::vector<TypePtr> types;  // one per output; empty when nobody provides it
  bool unclear = false;        // a filler was refused: do not report what it may provide
};

/// What a port name means. `type` empty: a probe, or unknown because its component was refused.
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
  std::vector<std::vector<Assignment>> assignments;  // [phase][role], components count candidates
  Graph graph;

  int candidate(const std::string& name) const { return index_named(candidates, name); }
  int role(const std::string& name) const { return index_named(roles, name); }
  bool is_out(const ComponentText& c) const { return c.only && *c.only != text.io; }
  const Component& vehicle() const { return nth(graph.components, graph.vehicle); }
};

// resolve.cpp
/// Why a component of the file is not there: "fcu exists only with io: fcu", or that there is none of that
/// name.
Diagnostic not_there(const Draft& draft, const std::string& name);

/// Whether an output of a role is there: somebody who fills it in this run has it. Of the built graph.
bool provided(const Graph& graph, const Source& source);

/// A role or component that is not there: taken away by a layer, perhaps.
struct NoOwner : Error {
  NoOwner(const std::string& name, Diagnostic message) : Error(std::move(message)), owner(name) {}
  std::string owner;
};
/// Whether a layer has taken that role or component away: it is told there, with all that still names it.
bool taken_away(Draft& draft, const std::string& name, const Where& where, const std::string& path);
/// A fault of its own, or one of those.
void report(Draft& draft, const Where& where, const std::string& path, const Error& fault);

// role_contracts.cpp
void resolve_roles(Draft& draft);
/// Components that fill several roles: who fills which must stay clear.
void check_groups(Draft& draft);
/// Exactly one vehicle: the only one that fills the role, or the only vehicle of a mission without that role.
/// After it is known who is used.
void choose_vehicle(Draft& draft);

// wires.cpp
Target find_target(const Draft& draft, const PortName& name);  // throws Error, NoOwner
void resolve_wires(Draft& draft);
/// After it is known who is used: inputs that nobody feeds.
void check_fed(Draft& draft);
void order_steps(Draft& draft);

// ages.cpp: of the built graph
void guard_wires(Draft& draft);
/// Per component: whether what it publishes can move the aircraft.
std::vector<bool> chain_to_vehicle(const Graph& graph);

// hardware.cpp: of the built graph
/// Steering components and conditions that read what only a simulator has: refused with io: fcu.
void report_simulator_ports(Draft& draft, Catalogue& catalogue);

// fences.cpp: of the built graph
void report_two_fences(Draft& draft);

// overlaid.cpp: after the roles are assigned
void report_overlaid(Draft& draft);

// tap_sections.cpp
void mark_imports(Draft& draft);
/// `ports`: the names under which outputs leave the flight.
void resolve_dds(Draft& draft, const std::vector<std::string>& ports);

// phases.cpp
std::string phase_path(const PhaseText& phase);
/// Those of the mission, or the only one of a mission that has none.
const std::vector<PhaseText>& phases_of(const MissionText& text);
void assign_roles(Draft& draft);

// named_ports.cpp
/// Conditions, figures and transitions. Before the graph is built: checks them and marks the components that
/// they name. Afterwards: compiles them for the graph.
void name_ports(Draft& draft);
void compile_phases(Draft& draft);

// with.cpp
/// What is to fly with another file, by component: a role stands for the one that fills it.
Overrides with_components(const MissionText& text, Overrides overrides, Report& report);

// values.cpp
void read_values(Draft& draft);
void read_failsafe(Draft& draft);

// vehicle_flags.cpp: what protects the aircraft, after the graph is built
void read_vehicle_flags(Draft& draft);

}  // namespace fulmar::core
