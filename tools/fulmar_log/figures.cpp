// SPDX-License-Identifier: BSD-3-Clause
// See figures.hpp.
#include "tools/fulmar_log/figures.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/graph/mission.hpp"
#include "core/graph/stored_files.hpp"
#include "core/log/events.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/log_reading/log_file.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::core {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t most_bytes = 1 << 20;  // limit for a message, as a damaged log may state any size

/// The mission of the flight; no value when the log has no readable one.
std::optional<MissionText> mission_of(const McapFile& log) try {
  std::vector<std::pair<std::string, std::string>> files;
  for (const McapFile::Attachment& a : log.attachments)
    if (a.media_type == "application/yaml") files.emplace_back(a.name, a.content);
  if (files.empty()) return std::nullopt;
  const std::string name = files.front().first;
  Overrides overrides;
  if (const McapFile::Metadata* const said = find_named(log.metadata, "overrides"))
    for (const auto& [key, value] : said->pairs) {
      if (key == "io") overrides.io = value;
      if (key.starts_with("role ")) overrides.roles.emplace_back(key.substr(5), value);
    }
  overrides.files = std::make_shared<const StoredFiles>(std::move(files));
  Report faults;  // of a mission of another version: the readable part is enough
  MissionText mission = parse_mission(name, overrides, faults);
  for (const auto& given : overrides.roles)
    for (PhaseText& phase : mission.phases) {
      std::erase_if(phase.roles, [&](const AssignmentText& a) { return a.role == given.first; });
      phase.roles.push_back({given.first, {given.second, {}}, {}, {}, {}});
    }
  return mission;
} catch (const Error&) {
  return std::nullopt;
}

void take_assignments(const MissionText& mission, LogFigures& out) {
  for (const ComponentText& c : mission.components) {
    out.components.push_back(c.name);
    if (c.only && *c.only != mission.io) continue;
    for (const Word& role : c.fills) out.first.try_emplace(role.text, c.name);
  }
  for (const PhaseText& phase : mission.phases)
    for (const AssignmentText& a : phase.roles) out.assigned[phase.name][a.role] = a.use.text;
}

/// One pass over the log: active components over time, and the last message of each topic.
struct FlightReading {
  McapStream stream;
  std::map<std::uint16_t, Bytes> last;
  std::vector<std::pair<std::uint64_t, Bytes>> events;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max(), last_ns = 0;

  explicit FlightReading(const std::filesystem::path& file) : stream(file) {
    while (const McapFile::Message* m = stream.next()) {
      first_ns = std::min(first_ns, m->log_ns);
      last_ns = std::max(last_ns, m->log_ns);
      if (stream.log().channels.at(m->channel).topic == Event::topic)
        events.emplace_back(m->log_ns, Bytes(m->data.begin(), m->data.end()));
      else
        last[m->channel].assign(m->data.begin(), m->data.end());
    }
  }

  void take_changes(LogFigures& out) const try {
    const McapFile& log = stream.log();
    const HostTopic<Event> topic(log);
    if (!topic.same()) return;
    const std::uint64_t epoch = log_epoch_ns(log, first_ns);
    for (const auto& [at, bytes] : events) {
      const Event e = topic.read(bytes);
      const auto time_ns = static_cast<std::int64_t>(at - epoch);
      if (e.code == Code::phase_entered) out.changes.push_back({time_ns, true, e.name.data(), ""});
      if (e.code == Code::took_over)
        out.changes.push_back({time_ns, false, e.component.data(), e.name.data()});
      if (e.code == Code::guard_reset) out.changes.push_back({time_ns, false, e.component.data(), ""});
    }
  } catch (const Error&) {  // damaged: the active component is then estimated from the mission
  }

  /// As in `fulmar run --json`; null when it was not recorded.
  nlohmann::json shown(const std::string& port) const try {
    std::string topic = "/" + port;
    std::replace(topic.begin(), topic.end(), '.', '/');
    for (const auto& [id, bytes] : last) {
      const McapFile::Channel& channel = stream.log().channels.at(id);
      const auto schema = stream.log().schemas.find(channel.schema);
      if (channel.topic != topic || schema == stream.log().schemas.end()) continue;
      const TypePtr type = parse_ros_definition(schema->second.name, schema->second.text);
      if (type->size > most_bytes) return nullptr;
      Bytes message(type->size);
      cdr_decode(*type, bytes.data(), bytes.size(), message.data());
      return figures_json(*type, message.data());
    }
    return nullptr;
  } catch (const Error&) {
    return nullptr;
  }
};

}  // namespace

std::string LogFigures::owner(const std::string& topic, std::int64_t at_ns) const {
  if (!topic.starts_with('/')) return "";
  const std::string name = topic.substr(1, topic.find('/', 1) - 1);
  if (std::find(components.begin(), components.end(), name) != components.end()) return name;
  const auto by_default = first.find(name);
  if (by_default == first.end()) return "";
  std::string phase;
  std::map<std::string, std::string> instead;
  for (const Change& c : changes) {
    if (c.at_ns > at_ns) break;
    if (c.phase) phase = c.name;
    if (!c.phase) instead[c.name] = c.after;
  }
  std::string active = by_default->second;
  if (const auto p = assigned.find(phase); p != assigned.end())
    if (const auto use = p->second.find(name); use != p->second.end()) active = use->second;
  for (std::size_t i = 0; i < instead.size() && instead.contains(active) && !instead[active].empty(); ++i)
    active = instead[active];
  return active;
}

LogFigures log_figures(const std::filesystem::path& file) {
  const FlightReading reading(file);
  LogFigures out;
  const std::optional<MissionText> mission = mission_of(reading.stream.log());
  if (!mission) return out;
  take_assignments(*mission, out);
  reading.take_changes(out);
  if (reading.last_ns >= reading.first_ns)
    out.figures["flight_time_s"] = 1e-9 * static_cast<double>(reading.last_ns - reading.first_ns);
  for (const auto& [key, port] : mission->judge.summary) out.figures[key] = reading.shown(port.text);
  return out;
}

nlohmann::json result_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if ((in >> std::ws).peek() != '{') return nullptr;
  nlohmann::json result = nlohmann::json::parse(in, nullptr, false);
  if (result.is_discarded()) throw Error(located(file.string(), log_tool_messages::result_expected()));
  return result;
}

}  // namespace fulmar::core
