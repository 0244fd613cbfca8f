// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/state/resume.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "core/graph/condition.hpp"
#include "core/log/events.hpp"
#include "core/log/reader.hpp"
#include "core/run/messages.hpp"
#include "core/run/state/published.hpp"
#include "core/types/named.hpp"
#include "core/types/text.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {
namespace fs = std::filesystem;

std::string topic_of(const Graph& graph, const Source& source) {
  if (source.kind == Source::Kind::component)
    return "/" + slashed(topic_name(graph, nth(graph.components, source.index),
                                    static_cast<std::size_t>(source.output)));
  const Role& role = nth(graph.roles, source.index);
  return "/" + slashed(role.name + "." + nth(role.outputs, source.output).name);
}

/// Content of a log for a resumed flight, from one reading.
struct EndOfLog {
  McapFile log;                                          // the log without its messages
  std::map<std::uint16_t, std::vector<std::byte>> last;  // last message of each channel of the wanted topics
  std::string phase;
};

EndOfLog read_end(const fs::path& log, const std::set<std::string>& topics) {
  McapStream stream(log);
  EndOfLog end;
  std::optional<HostTopic<Event>> events;
  while (const McapFile::Message* const m = stream.next()) {
    const std::string& topic = stream.log().channels.at(m->channel).topic;
    if (!events && topic == Event::topic) events.emplace(stream.log());
    if (events && events->holds(*m)) {
      const Event event = events->read(m->data);
      if (event.code == Code::phase_entered) end.phase = event.name.data();
    } else if (topics.contains(topic)) {
      end.last[m->channel].assign(m->data.begin(), m->data.end());
    }
  }
  end.log = stream.take_log();
  return end;
}

/// Reason for missing content of a log: " The log ends early: ...", or "" for a log that was read to its end.
std::string early_end(const EndOfLog& end) {
  return end.log.fault.empty() ? "" : run_messages::log_ends_early(end.log.fault).text;
}

std::uint16_t channel_in(const EndOfLog& end, const std::string& topic) try {
  return end.log.channel(topic);
} catch (const Error& unknown) {
  if (end.log.fault.empty()) throw;
  throw Error(run_messages::log_incomplete(unknown.diagnostic, early_end(end)));
}

/// The last message of a topic, decoded. Throws Error when there is none or it has other fields.
std::vector<std::byte> last_message(const EndOfLog& end, const std::string& topic, const Type& type) {
  const McapFile& log = end.log;
  const std::uint16_t channel = channel_in(end, topic);
  if (log.schemas.at(log.channels.at(channel).schema).text != ros_definition(type))
    throw Error(run_messages::resumed_fields_differ(topic, type.name));
  const auto last = end.last.find(channel);
  if (last == end.last.end()) throw Error(run_messages::sample_missing(topic, early_end(end)));
  std::vector<std::byte> message(type.size);
  cdr_decode(type, last->second.data(), last->second.size(), message.data());
  return message;
}

/// All topics that a resume needs.
std::set<std::string> topics_of_interest(const Graph& graph) {
  std::set<std::string> topics;
  if (graph.flags.armed.from.kind != Source::Kind::none)
    topics.insert(topic_of(graph, graph.flags.armed.from));
  for (const ResumeRule& rule : graph.resume)
    if (rule.field.type) topics.insert(topic_of(graph, rule.field.from));
  return topics;
}

bool armed_at_end(const Graph& graph, const EndOfLog& end) {
  const VehicleFlag& armed = graph.flags.armed;
  if (armed.from.kind == Source::Kind::none) return false;
  const Component& vehicle = nth(graph.components, armed.from.index);
  const Type& type = *nth(vehicle.info().outputs, armed.from.output).type;
  try {
    return last_message(end, topic_of(graph, armed.from), type)[armed.offset] != std::byte{0};
  } catch (const Error&) {
    return false;
  }
}

Resume::Param read_rule(const Graph& graph, const EndOfLog& end, const ResumeRule& rule) {
  const auto dot = rule.param.find('.');
  Resume::Param p{rule.param.substr(0, dot), rule.param.substr(dot + 1), {}};
  const Component* const component = find_named(graph.components, p.component);
  if (!component) throw Error(run_messages::component_missing(p.component));
  if (!rule.field.type) throw Error(run_messages::resumed_field_invalid(rule.field.text));
  const std::vector<std::byte> message =
      last_message(end, topic_of(graph, rule.field.from), *rule.field.type);
  const double x = number_at(*rule.field.field.field, message.data() + rule.field.field.offset);
  const ParamInfo& info = nth(component->info().params, component->info().param(p.param));
  if (!(x >= info.min && x <= info.max))
    throw Error(run_messages::resumed_value_invalid(rule.field.text, x, rule.param, info.min, info.max));
  p.value.number[0] = x;
  p.value.integer = std::llround(x);
  return p;
}

}  // namespace

std::string Resume::text() const {
  std::string all = "phase " + phase;
  for (const Param& p : params) {
    char number[32];
    std::snprintf(number, sizeof number, "%g", p.value.number[0]);
    all += ", " + p.component + "." + p.param + " = " + number;
  }
  return all;
}

Resume read_resume(const Graph& graph, const fs::path& log) try {
  const EndOfLog end = read_end(log, topics_of_interest(graph));
  for (const McapFile::Metadata& metadata : end.log.metadata)
    for (const auto& [key, value] : metadata.pairs)
      if (metadata.name == "fulmar" && key == "mission" && value != graph.mission)
        throw Error(run_messages::mission_differs(value, graph.mission));
  Resume resume;
  HostTopic<Event>(end.log).check();
  if (end.phase.empty()) throw Error(run_messages::log_phase_missing(early_end(end)));
  resume.phase = end.phase;
  if (!find_named(graph.phases, resume.phase))
    throw Error(run_messages::log_phase_unknown(resume.phase, graph.mission, join(names_of(graph.phases))));
  resume.armed = armed_at_end(graph, end);
  for (const ResumeRule& rule : graph.resume) try {
      resume.params.push_back(read_rule(graph, end, rule));
    } catch (const Error& fault) {
      resume.missing.push_back("resume." + rule.param + ": " + fault.what());
    }
  return resume;
} catch (const Error& fault) {
  const bool named = std::string_view(fault.what()).find(log.string()) != std::string_view::npos;
  throw Error(named ? fault.diagnostic : located(log.string(), fault.diagnostic));
}

namespace {

/// False for the log of a host that died at its start.
bool holds_message(const fs::path& log) {
  try {
    return McapStream(log).next() != nullptr;
  } catch (const Error&) {
    return false;
  }
}

struct UsualPlace {
  fs::path folder;
  std::string stem;
};
UsualPlace usual_place(const Graph& graph) {
  const fs::path usual = graph.record_file.empty() ? "logs/" + graph.mission + "-" : graph.record_file;
  return {usual.has_parent_path() ? usual.parent_path() : ".",
          graph.record_file.empty() ? usual.filename().string() : usual.stem().string()};
}
/// Noted logs of the last flights: one that died at its start has no state to resume from.
std::vector<std::string> noted_logs(const fs::path& note) {
  constexpr std::size_t most = 4;
  std::vector<std::string> logs;
  std::ifstream in(note);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) logs.push_back(line);
  if (logs.size() > most) logs.erase(logs.begin(), logs.end() - most);
  return logs;
}
fs::path note_of(const UsualPlace& place) { return place.folder / ("." + place.stem + "newest"); }

/// The newest so far.
struct Newest {
  fs::path log;
  fs::file_time_type time = fs::file_time_type::min();

  /// `whole`: the stem is that of one flight, whose names end with a number at most.
  void look(const UsualPlace& place, bool whole = false) {
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(place.folder, code)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(place.stem) || !(name.ends_with(".mcap") || name.ends_with(".mcap.part")))
        continue;
      const char next = name[place.stem.size()];
      if (whole && next != '.' && next != '-') continue;
      const fs::file_time_type written = entry.last_write_time(code);
      if (code || written <= time || !holds_message(entry.path())) continue;
      log = entry.path();
      time = written;
    }
  }
};

}  // namespace

void note_newest_log(const Graph& graph, const fs::path& log) {
  const UsualPlace place = usual_place(graph);
  std::error_code code;
  fs::create_directories(place.folder, code);
  std::vector<std::string> logs = noted_logs(note_of(place));
  logs.push_back(fs::absolute(log, code).string());
  std::ofstream out(note_of(place));
  for (const std::string& one : logs) out << one << '\n';
}

fs::path newest_log(const Graph& graph, double max_age_s) {
  Newest newest;
  if (max_age_s > 0)
    newest.time = fs::file_time_type::clock::now() - std::chrono::duration_cast<fs::file_time_type::duration>(
                                                         std::chrono::duration<double>(max_age_s));
  const UsualPlace usual = usual_place(graph);
  newest.look(usual);
  for (const fs::path noted : noted_logs(note_of(usual)))
    newest.look({noted.parent_path(), noted.stem().string()}, true);
  return newest.log;
}

}  // namespace fulmar::core
