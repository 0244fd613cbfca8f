// SPDX-License-Identifier: BSD-3-Clause
// A mission file as written: every key checked, every value in its type, no plugin opened yet.
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
  bool cut = false;  // null: removes the wire that a role brings
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
  std::optional<Io> only;  // not set: it exists with both
  std::vector<WireText> in;
  Node params;
  double rate_hz = 0;                      // 0: every tick
  std::optional<std::int64_t> max_age_ns;  // of wires without their own
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

/// The mission's `hardware:` section: whether it may fly an aircraft behind a flight controller.
struct HardwareText {
  bool fit = true;   // also for a mission without the key
  std::string with;  // a role or component that the command line must choose; "": none
  std::string because;
  Where where;  // line 0: not set
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
  std::vector<FilePtr> files;      // the mission and the files that it extends
  std::vector<MissionText> below;  // each lower layer with those that it extends, the lowest first

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
/// With io: fcu: reports and throws for a mission that is not for hardware.
void check_hardware(const MissionText& text, const Overrides& overrides, Report& report);

// recording.cpp: `record:`, and `--record`, whose rules come before the mission's and take precedence
void read_recording(const Keys& mission, MissionText& text, Report& report);
void add_record_options(MissionText& mission, const std::vector<std::string>& options, Report& report);
/// "64 MB" -> 64e6. Reports a fault and returns 0.
std::uint64_t parse_bytes(const std::string& text, const Where& where, const std::string& path,
                          Report& report);

/// "nav.state"; nothing and a fault for any other form.
std::optional<PortName> parse_port_name(const std::string& text, const Where& where, const std::string& path,
                                        Report& report);

/// "2026-01-01T00:00Z" as ns since 1970. Throws Error.
std::int64_t parse_utc_ns(const std::string& text);

}  // namespace fulmar::core
