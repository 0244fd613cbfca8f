// SPDX-License-Identifier: BSD-3-Clause
// A resolved mission: its components, their wires and order, and the fillers of the roles in each phase. All
// faults of a mission are rejected before a Graph exists. The loop only reads it.
#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/graph/said_places.hpp"
#include "core/loader/library.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// The value of one parameter, owned. The valid members depend on the kind, as in fulmar_value. A record or
/// blob from the mission has `integer` 1 and in `text` the name of its file.
struct ParamValue {
  double number[3] = {0, 0, 0};
  std::int64_t integer = 0;
  std::string text;
  std::vector<std::byte> data;
  SaidPlacesPtr places{};  // place in the mission; null: none
};

/// Start of a wire: an output of one component, or of the component that fills a role.
struct Source {
  enum class Kind : std::uint8_t { none, component, role };
  Kind kind = Kind::none;
  int index = -1;   // into Graph::components or Graph::roles
  int output = -1;  // into ComponentInfo::outputs or Role::outputs
  friend bool operator==(const Source&, const Source&) = default;
};

struct Wire {
  Source from;                  // none: an optional input without a source
  std::int64_t max_age_ns = 0;  // 0: any age
  bool guarded = false;         // an older sample, or a writer that was stopped, stops the reader
  bool by_steps = false;        // the age of an output that need not publish in every step counts from its
                                // writer's last step
  bool delayed = false;         // carries the value of the previous tick: breaks a cycle
  Where where;
  int import = -1;  // into DdsOptions::imports: fed from outside; `from` is none

  static constexpr std::int64_t unsaid = -1;  // of max_age_ns, until the graph is built: not set
};

/// Source of the aircraft: a simulation, or a flight controller.
enum class Io : std::uint8_t { sim, fcu };
inline const std::vector<std::string> io_words = {"sim", "fcu"};
inline const std::string& io_word(Io io) { return io_words[static_cast<std::size_t>(io)]; }

/// A flag of the vehicle's contract: a bool in one of its outputs.
struct VehicleFlag {
  Source from;               // an output of the vehicle's component; none: it has no such flag
  std::uint32_t offset = 0;  // of the bool in that output's message
};

/// Flags that the host needs for the protection of an aircraft.
struct VehicleFlags {
  VehicleFlag armed, on_ground, in_control;
};

/// How a component runs: tick in the loop's thread, process in a child, async with a latency, driver in a
/// separate thread.
enum class RunMode : std::uint8_t { tick, process, async, driver };

/// Settings of a component that do not depend on others.
struct ComponentSettings {
  std::string name;                         // "slc"
  std::int64_t budget_ns = 0;               // 0: none
  std::int64_t latency_ns = 0;              // async: from the step's inputs to its visible outputs
  std::int64_t hang_ns = 0;                 // process: longest wait for one call; 0: not set
  std::uint64_t memory_bytes = 64'000'000;  // allowed growth of the heap in flight
  Where where;
};

struct Component : ComponentSettings {
  std::string use;                           // "control_slc/Outer", as resolved
  std::shared_ptr<const PluginInfo> plugin;  // the host's own copy: outlives the library
  std::shared_ptr<Library> library;          // empty when a test describes the component by hand
  std::size_t index_in_plugin = 0;
  std::vector<int> roles;      // roles that it fills, all at once, in some phase; none: it steps in every
                               // phase
  std::int64_t period_ns = 0;  // 0: every tick
  RunMode run = RunMode::tick;
  std::vector<Wire> wires;         // one per input
  std::vector<ParamValue> params;  // one per parameter, the base values

  const ComponentInfo& info() const { return plugin->components[index_in_plugin]; }
  bool fills(int role) const { return std::find(roles.begin(), roles.end(), role) != roles.end(); }
};

struct RolePort {
  std::string name;
  TypePtr type;
  bool optional = false;
};

struct Role {
  std::string name;
  std::vector<RolePort> outputs;
  std::vector<int> fillers;                // into Graph::components, in file order
  std::vector<std::vector<int>> provides;  // [filler][output] -> the filler's own output index, or -1
  Where where;
};

struct Overlay {
  int param = -1;  // into the component's parameters
  ParamValue value;
};

struct Assignment {
  int component = -1;        // component that fills the role
  int fallback = -1;         // -1: none
  std::vector<Overlay> set;  // on the component's live parameters while the phase lasts
};

/// A compiled boolean expression over fields of ports. See condition.hpp.
class Condition;

struct Transition {
  int to = -1;  // into Graph::phases
  std::shared_ptr<const Condition> when;
  std::int64_t for_ns = 0;
  Where where;
};

struct Phase {
  std::string name;
  std::vector<Assignment> roles;  // one per Graph::roles
  std::vector<Transition> next;   // the transitions of `any` are in Graph::any
  Where where;
};

/// A number to show: a field of a port.
struct Shown {
  std::string text;  // "nav.state.height_m"
  Source from;
  FieldRef field;
  TypePtr type;  // of the message; empty for a probe, whose sample is one double
};

/// A parameter that gets the last value of a field from the log, for a restart in the air.
struct ResumeRule {
  std::string param;  // "manage.first_item"
  Shown field;
};

struct RecordRule {
  std::vector<std::string> ports;            // patterns "nav.*", "*"
  std::int64_t period_ns = 0;                // 0: every sample
  static constexpr std::int64_t usual = -2;  // as in a mission without this key
};

/// `live:` of the mission.
struct LiveOptions {
  bool on = false;
  std::string host = "127.0.0.1";
  std::uint16_t port = 8765;  // 0: any free port
  std::string token;          // token of a client; needed for hosts other than loopback
  std::string tiles;  // "https://tile.example.org/{z}/{x}/{y}.png", background of the page's map; "": none
  std::optional<bool> save;  // whether clients may write files; not set: only those of this computer
  std::string attribution;   // attribution of the tiles, as their provider requires
  Where where;
};

/// `dds:` of the mission.
struct DdsOptions {
  struct Export {
    std::string port;            // "nav.state"
    std::string topic;           // "nav/state", behind the namespace; "/tf" is absolute
    std::int64_t period_ns = 0;  // 0: every sample
    bool best_effort = false;
    Where where;
  };
  struct Import {
    int component = -1, input = -1;
    std::string topic;
    Where where;
  };
  bool on = false;
  int domain = 0;
  std::string name_space;               // "uav1": before every topic and service
  std::vector<std::string> interfaces;  // own addresses; default loopback alone
  Where interfaces_where;
  std::vector<std::string> peers;  // addresses of other participants; default the interfaces
  std::vector<Export> exports;
  std::vector<Import> imports;
  bool services = true, parameters = true;  // requests and parameters as ROS 2 services
  bool humble = false;  // form of the node's description in ROS 2 Humble, which differs from all later
                        // releases
  Where where;          // of the section
};

class StoredFiles;

/// Changes from the command line.
struct Overrides {
  std::optional<std::string> io;
  std::optional<std::uint64_t> seed;
  std::vector<std::pair<std::string, std::string>> roles;  // role=component
  std::vector<std::pair<std::string, std::string>> set;    // component.param=value (YAML text)
  std::vector<std::pair<std::string, std::string>>
      with;           // component=plugin file, in place of the file in its `use`; or role=plugin file
  std::string swaps;  // component of `with` that is exchanged in flight: the new file must have all ports of
                      // the old one
  std::shared_ptr<const StoredFiles> files;  // in place of the disk: for a mission that has flown
  std::vector<std::string> flown;            // SHA-256 of the plugins that flew
  std::optional<std::string> arm;            // auto, off
  std::vector<std::string> record;           // "all", "nav.*@100Hz"
};

/// A port with the verdict of the flight: a word and a sentence.
struct VerdictPort {
  Source from;
  std::size_t word = 0, text = 0;  // offsets of the texts
  std::size_t word_size = 0, text_size = 0;
};

/// Settings of a mission that do not depend on components.
struct Settings {
  std::string mission;
  Io io = Io::sim;
  std::int64_t epoch_ns = 0;  // UTC of flight time 0
  std::uint64_t seed = 1;
  bool arm = false;                                                   // with Io::sim alone
  std::int64_t timeout_ns = 0;                                        // of flight time; 0: none
  std::int64_t done_for_ns = 0, failed_for_ns = 0, flown_for_ns = 0;  // time for which the conditions must
                                                                      // hold
  std::int64_t failsafe_ns = 0;
  std::string record_file;  // "" : logs/<mission>-<UTC>.mcap
  bool record = true;
  std::vector<RecordRule> record_rules;
  LiveOptions live;
  DdsOptions dds;
};

struct Graph : Settings {
  std::string airframe;  // file name, "" when there is none
  std::int64_t tick_ns = 2'500'000;
  std::vector<Component> components;  // only those that exist in this run
  std::vector<Role> roles;
  std::vector<Phase> phases;  // the flight begins in the first
  std::vector<Transition> any;
  std::vector<int> order;  // order of steps, without the vehicle
  int vehicle = -1;
  VehicleFlags flags;  // of the vehicle; complete with Io::fcu
  struct {
    std::shared_ptr<const Condition> done, failed, flown;  // may be empty
    std::optional<VerdictPort> verdict;                    // a component's verdict of the flight
    std::vector<std::pair<std::string, Source>> summary;   // key of the result -> port; none: left out
    /// Result keys of components that this flight does not have -> port.
    std::vector<std::pair<std::string, std::string>> left_out;
    std::vector<Shown> progress;
  } judge;                     // when the flight ends, and its figures
  std::vector<int> control;    // roles that begin again as long as the vehicle reports that it does not obey
  std::vector<Source> report;  // ports whose texts are for people
  std::vector<ResumeRule> resume;
  std::vector<std::vector<std::byte>> failsafe;  // one per vehicle input: the struct to send; empty: not sent
  struct {
    std::string file;
    std::vector<std::filesystem::path> files;  // mission, the files that it extends, airframe, plans
    /// Their contents as read: name without folders -> text.
    std::vector<std::pair<std::string, std::string>> attachments;
    Overrides overrides;
    std::vector<std::string> warnings;  // faults that do not prevent the flight
  } source;                             // sources of the mission, to read it again
};

/// Loads a mission file and all files that it names. fulmar:missions/orbit.yaml is a file of the
/// installation. Throws Error with all faults, one per line.
Graph load_mission(const std::string& file, const Overrides& overrides = {});

/// The same with components from another source than plugin files.
struct Catalogue;
Graph load_mission(const std::string& file, const Overrides& overrides, Catalogue& catalogue);

/// Replaces roles in `with` by components: "nav" becomes "ekf". Throws Error for a role that is not filled by
/// exactly one component.
Overrides with_components(const std::string& mission, const Overrides& overrides);

/// Parses "127.0.0.1:8765" or "off" of the command line. Throws Error.
LiveOptions parse_live(const std::string& listen);

/// Whether a port's name, "nav.state", matches a pattern of `record.ports`, "nav.*".
bool port_matches(const std::string& text, const std::string& pattern, std::size_t t = 0, std::size_t p = 0);

}  // namespace fulmar::core
