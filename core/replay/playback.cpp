// SPDX-License-Identifier: BSD-3-Clause
#include "core/replay/playback.hpp"

#include <algorithm>
#include <map>

#include "core/replay/logged.hpp"
#include "core/replay/recorded_vehicle.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {

TickList read_ticks(const McapFile& file) {
  const HostTopic<Ticks> topic(file);
  if (!topic.there())
    throw Error("the log has no /fulmar/ticks: it is not a flight's, or older than replays");
  topic.check();
  TickList list;
  for (const McapFile::Message& m : file.messages) {
    if (!topic.holds(m)) continue;
    const Ticks ticks = topic.read(m.data);
    if (ticks.first != list.hash.size() || ticks.periods != ticks.hashes)
      throw Error(list.hash.empty()
                      ? "the log begins with tick " + std::to_string(ticks.first) +
                            " of its flight; a replay begins with the first: give the file before it"
                      : "the log has lost its ticks " + std::to_string(list.hash.size()) + " to " +
                            std::to_string(ticks.first) + ": it can be replayed no further than that");
    std::int64_t now = ticks.time_ns;
    for (std::uint32_t i = 0; i < ticks.hashes; ++i) {
      if (i > 0) now += ticks.period_ns[i];
      list.time_ns.push_back(now);
      list.hash.push_back(ticks.hash[i]);
    }
  }
  if (list.hash.empty()) throw Error("the log holds no tick");
  if (!std::is_sorted(list.time_ns.begin(), list.time_ns.end(), std::less_equal<>()))
    throw Error("the log's ticks are not in order");
  return list;
}

Playback::Playback(const McapFile& file, const Graph& graph, std::vector<std::string> changed)
    : file_(file),
      changed_(std::move(changed)),
      epoch_ns_(graph.epoch_ns),
      ticks_(read_ticks(file)),
      events_(file) {
  index_host();
  vehicle_ = std::make_unique<RecordedVehicle>(file_, graph, ticks_.time_ns);
  gaps_ = vehicle_->gaps();
  if (vehicle_failed_) vehicle_->set_last_words(last_words_);
  index_entries(graph);
}

Playback::~Playback() = default;

// ---- the host

void Playback::index_host() {
  file_.channel(Event::topic);  // throws when there is none
  events_.check();
  for (const McapFile::Message& m : file_.messages)
    if (events_.holds(m)) take_event(events_.read(m.data), flight_ns(m.log_ns, epoch_ns_));
}

/// What only the host's events tell: the wall clock, signals, devices that failed, and an end that the
/// flight's owner had set.
void Playback::take_event(const Event& e, std::int64_t now_ns) {
  switch (e.code) {
    case Code::vehicle_failed:
      vehicle_failed_ = now_ns == ticks_.time_ns.back();
      last_words_ = e.cause.data();
      break;
    case Code::duration_reached: duration_s_ = 1e-9 * static_cast<double>(now_ns); break;
    case Code::guard:
    case Code::hung:
    case Code::died:
    case Code::over_budget:
    case Code::late_result:
    case Code::signal_refused:
    case Code::gave_up:
      told_.push_back({now_ns, e.value_ns, e.code, e.component.data(), e.name.data(), e.cause.data()});
      break;
    default: break;
  }
}

bool Playback::told(Code code, const std::string& component, std::int64_t now_ns) const {
  return std::any_of(told_.begin(), told_.end(), [&](const Told& t) {
    return t.code == code && t.at_ns == now_ns && t.component == component;
  });
}

bool Playback::signalled(std::int64_t now_ns) const {
  return told(Code::signal_refused, "", now_ns) || told(Code::gave_up, "", now_ns);
}

bool Playback::ran_over(const std::string& component, std::int64_t now_ns) const {
  return told(Code::over_budget, component, now_ns);
}

// ---- in place of vehicle and drivers

void Playback::stand_in(const Graph& graph, const Component& component, UnitOptions& options) {
  std::vector<std::pair<std::int64_t, std::string>> faults;
  constexpr std::int64_t patience_ns = 10'000'000'000;
  options.hang_ns =
      std::max(options.hang_ns, patience_ns);  // what died by the clock dies as it is told below
  options.wait_for_async = true;
  for (const Told& t : told_) {
    if (t.component != component.name) continue;
    if (t.code == Code::guard) faults.emplace_back(t.at_ns, t.cause);
    const bool other = std::find(changed_.begin(), changed_.end(), component.name) != changed_.end();
    if ((t.code == Code::hung || t.code == Code::died) && !other)
      options.deaths.push_back({t.at_ns, t.name, t.cause, t.code == Code::hung});
    if (t.code == Code::late_result && component.run == RunMode::async) options.late[t.value_ns] = t.at_ns;
  }
  if (component.info().vehicle) options.runner = std::move(vehicle_);
  if (component.run != RunMode::driver) return;
  std::vector<std::string> topics;
  bool probes = false;
  for (std::size_t i = 0; i < component.info().outputs.size(); ++i) {
    const std::string topic = component.info().outputs[i].type ? topic_in(file_, graph, component, i) : "";
    probes = probes || topic.empty();
    topics.push_back(has_topic(file_, topic) ? topic
                                             : "");  // one that was silent in the whole flight has none
  }
  options.samples = std::make_unique<RecordedSamples>(file_, component.info(), topics,
                                                      probes ? "/" + component.name + "/probes" : "",
                                                      epoch_ns_, std::move(faults));
}

// ---- what was asked of the flight

namespace {

struct InputPort {
  CommandKind kind = CommandKind::request;
  std::string component, port;
  TypePtr type;
};

/// Topics of requests and imports.
std::map<std::uint16_t, InputPort> input_channels(const McapFile& file, const Graph& graph) {
  std::map<std::uint16_t, InputPort> inputs;
  for (const Component& component : graph.components)
    for (std::size_t i = 0; i < component.info().inputs.size(); ++i) {
      const Port& port = component.info().inputs[i];
      const bool request = port.kind == FULMAR_IN_REQUEST;
      const bool import = component.wires[i].import >= 0;
      const std::string topic = "/" + component.name + "/" + port.name;
      if ((!request && !import) || !has_topic(file, topic)) continue;
      inputs[channel_of(file, topic, *port.type)] = {request ? CommandKind::request : CommandKind::import,
                                                     component.name, port.name, port.type};
    }
  return inputs;
}

/// Of a parameter that this mission does not have the value stays unread: whoever applies the command says
/// so.
Command logged_command(const CommandNote& note, const Graph& graph) {
  Command command = command_of(note.kind, note.component.data(), note.name.data());
  command.note = note;
  if (note.kind != CommandKind::parameter) return command;
  for (const Component& c : graph.components)
    if (const int i = c.name == command.component ? c.info().param(command.name) : -1; i >= 0)
      command.value = value_of(note, nth(c.info().params, i));
  return command;
}

}  // namespace

/// Where the flight went on, and the parameters with which it did: each was set just before its event.
void Playback::take_resume(const Event& e, bool begun) {
  if (e.code != Code::resumed && e.code != Code::not_resumed) return;
  if (e.component[0] == '\0') {
    resume_.emplace();
    resume_->phase = e.name.data(), resume_->if_armed = begun;
    return;
  }
  if (e.code == Code::not_resumed || !resume_ || entries_.empty()) return;  // of a parameter: it was not set
  Command& set = entries_.back().command;
  if (set.kind != CommandKind::parameter || set.component != e.component.data() || set.name != e.name.data())
    return;
  resume_->params.push_back({set.component, set.name, std::move(set.value)});
  entries_.pop_back();
}

void Playback::check_gap(std::uint16_t channel) {
  if (std::string gap = gap_in(file_, channel); !gap.empty()) gaps_.push_back(std::move(gap));
}

void Playback::index_entries(const Graph& graph) {
  const HostTopic<CommandNote> parameters(file_, CommandNote::parameter_topic), commands(file_);
  const std::map<std::uint16_t, InputPort> inputs = input_channels(file_, graph);
  for (const auto& [channel, port] : inputs) check_gap(channel);
  for (const auto& topic : {parameters, commands}) {
    topic.check();
    if (topic.there()) check_gap(topic.channel());
  }
  bool begun = false;  // the first thing that a flight says is its phase
  for (const McapFile::Message& m : file_.messages) {
    if (events_.holds(m)) {
      const Event event = events_.read(m.data);
      begun = begun || event.code == Code::phase_entered;
      take_resume(event, begun);
      continue;
    }
    Entry entry;
    if (const auto at = inputs.find(m.channel); at != inputs.end()) {
      const InputPort& port = at->second;
      entry.command = command_of(port.kind, port.component, port.port);
      entry.command.message.resize(port.type->size);
      cdr_decode(*port.type, m.data.data(), m.data.size(), entry.command.message.data());
    } else if (parameters.holds(m) || commands.holds(m)) {
      entry.command = logged_command(commands.read(m.data), graph);
    } else {
      continue;
    }
    const std::int64_t now = flight_ns(m.log_ns, epoch_ns_);
    if (begun)
      entry.before = static_cast<std::size_t>(
          std::upper_bound(ticks_.time_ns.begin(), ticks_.time_ns.end(), now) - ticks_.time_ns.begin());
    if (now <= ticks_.time_ns.back()) entries_.push_back(std::move(entry));
  }
}

}  // namespace fulmar::core
