// SPDX-License-Identifier: BSD-3-Clause
// A mission file as written: every key checked, every value in its type, nothing looked up in plugins yet.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/graph/yaml.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

/// "nav.state", split. Conditions and fields have more parts and are split elsewhere.
struct PortName {
  std::string owner, port;
  std::string text() const { return owner + "." + port; }
};

struct WireText {
  std::string name;  // of the input
  PortName from;
  std::optional<std::int64_t> max_age_ns;  // 0: off
  bool delayed = false;
  bool cut = false;  // null: the wire that a role brings is not wanted
  Where where;
};

struct RoleOutText {
  std::string name, type;
  bool optional = false;
  Where where;
};

struct RoleText {
  std::string name;
  std::vector<WireText> in;
  std::vector<RoleOutText> out;
  std::vector<std::pair<std::string, Word>> flags;  // of the role vehicle: armed -> status.armed
  Where where;
};

struct ComponentText : ComponentSettings {
  std::vector<Word> fills;  // roles: all of them at once
  Word use;
  std::optional<Io> only;  // nothing: it exists with both
  std::vector<WireText> in;
  Node params;
  double rate_hz = 0;                      // 0: every tick
  std::optional<std::int64_t> max_age_ns;  // of wires that say nothing
  std::optional<RunMode> run;
  Where where_rate;

  bool fills_role(const std::string& role) const {
    return std::any_of(fills.begin(), fills.end(), [&](const Word& word) { return word.text == role; });
  }
};

struct AssignmentText {
  std::string role;
  Word use, fallback;
  Node set;
  Where where;
};

struct TransitionText {
  Word to, when;
  std::int64_t for_ns = 0;
  Where where;
};

struct PhaseText {
  std::string name;
  std::vector<AssignmentText> roles;
  std::vector<TransitionText> next;
  Where where;
};

/// "plan.edits: /fulmar/plan_edits"
struct ImportText {
  PortName to;
  std::string topic;
  Where where;
};

/// What the mission states of itself: whether an aircraft behind a flight controller may fly it.
struct HardwareText {
  bool fit = true;   // also of a mission that does not say
  std::string with;  // a role or component that the command line has to choose; "": none
  std::string because;
  Where where;  // line 0: not said
};

struct MissionText : Settings {
  FilePtr file;
  double rate_hz = 400;
  Where rate_where;  // empty: no file sets it
  struct {
    Node airframe;  // text, a map, or missing
    Node origin, failsafe;
  } node;
  struct {
    std::optional<Word> done, failed, flown, verdict;
    std::vector<Word> progress;
    std::vector<std::pair<std::string, Word>> summary;
  } judge;
  std::vector<Word> control, report;
  std::vector<std::pair<std::string, Word>> resume;  // parameter -> field
  HardwareText hardware;
  std::vector<RoleText> roles;
  std::vector<ComponentText> components;
  std::vector<PhaseText> phases;  // without `any`
  std::vector<TransitionText> any;
  struct {
    std::vector<Where> record;            // one per rule of `record:`
    std::vector<ImportText> dds_imports;  // into components that may not exist
  } tap;
  std::vector<FilePtr> files;      // the mission and what it extends
  std::vector<MissionText> below;  // each layer under it with those that it extends, the lowest first

  const RoleText* role(const std::string& name) const { return find_named(roles, name); }
  const ComponentText* component(const std::string& name) const { return find_named(components, name); }
};

/// Reads a mission and the file that it extends. Faults go to the report; throws Error when there is no such
/// file.
MissionText parse_mission(const std::string& file, const Overrides& overrides, Report& report);

// tap_sections.cpp: `live:` and `dds:`
void read_live(const Keys& mission, MissionText& text, Report& report);
void read_dds(const Keys& mission, MissionText& text, Report& report);

// hardware.cpp: `hardware:`
void read_hardware(const Keys& mission, MissionText& text, Report& report);
/// With io: fcu: reports a mission that is not for hardware, and throws then.
void check_hardware(const MissionText& text, const Overrides& overrides, Report& report);

// recording.cpp: `record:`, and `--record`, whose rules come before the mission's own, so that they hold
void read_recording(const Keys& mission, MissionText& text, Report& report);
void add_record_options(MissionText& mission, const std::vector<std::string>& options, Report& report);
/// "64 MB" -> 64e6. Reports a fault and returns 0.
std::uint64_t parse_bytes(const std::string& text, const Where& where, const std::string& path,
                          Report& report);

/// "nav.state"; nothing and a fault when it is not that.
std::optional<PortName> parse_port_name(const std::string& text, const Where& where, const std::string& path,
                                        Report& report);

/// "2026-01-01T00:00Z" as ns since 1970. Throws Error.
std::int64_t parse_utc_ns(const std::string& text);

}  // namespace fulmar::core
