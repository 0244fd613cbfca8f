// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/playback.hpp"

#include <algorithm>
#include <limits>

#include "core/run/component/recorded_samples.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_replay/logged.hpp"
#include "tools/fulmar_replay/messages.hpp"
#include "tools/fulmar_replay/recorded_vehicle.hpp"

namespace fulmar::core {
namespace {

// a flight reads less than one such amount ahead, for 40 ticks
constexpr std::size_t max_ahead_bytes = 64u << 20;

/// The message with the log in front, unless it names the log already.
Diagnostic in_log(const std::filesystem::path& log, const Error& fault) {
  const bool named = std::string_view(fault.what()).find(log.string()) != std::string_view::npos;
  return named ? fault.diagnostic : located(log.string(), fault.diagnostic);
}

}  // namespace

Playback::Playback(const std::filesystem::path& log, const Survey& survey, const Graph& graph,
                   std::vector<std::string> changed) try
    : survey_(survey),
      changed_(std::move(changed)),
      epoch_ns_(graph.epoch_ns),
      reading_{McapStream(log), std::numeric_limits<std::int64_t>::min(), 0, {},
  0
}  // namespace fulmar::core
, now_ns_(reading_.now_ns) {
  if (!survey.ticks.fault.empty()) throw Error(survey.ticks.fault);
  check_order(survey, survey.log.channel(Event::topic));
  if (!survey.event_fault.empty()) throw Error(survey.event_fault);
  const HostTopic<Ticks> ticks(survey.log);
  route(ticks.channel(), [this, ticks](const McapFile::Message& m) {
    each_tick(ticks.read(m.data), [this](std::uint32_t, std::int64_t ns) { ticks_.push_back(ns); });
    reading_.ahead_bytes = 0;
  });
  prepare_vehicle(graph);
  prepare_entries(graph);
  prepare_resume(graph);
}
catch (const Error& fault) {
  throw Error(in_log(log, fault));
}

Playback::~Playback() = default;

std::int64_t Playback::flight_ns(std::uint64_t log_ns) const { return core::flight_ns(log_ns, epoch_ns_); }
std::uint64_t Playback::log_ns(std::int64_t flight_ns) const {
  return static_cast<std::uint64_t>(flight_ns + epoch_ns_);
}

std::optional<double> Playback::duration_s() const {
  if (!survey_.ended_ns) return std::nullopt;
  return 1e-9 * static_cast<double>(flight_ns(*survey_.ended_ns));
}

// ---- reading of the log during the flight

void Playback::route(std::uint16_t channel, Take take) {
  check_order(survey_, channel);
  if (reading_.takes.size() <= channel) reading_.takes.resize(channel + std::size_t{1});
  reading_.takes[channel].push_back(std::move(take));
}

/// Reads one message; false at the end.
bool Playback::read() {
  const McapFile::Message* const m = reading_.stream.next();
  if (!m) return false;
  reading_.now_ns = flight_ns(m->log_ns);
  if (m->channel < reading_.takes.size() && !reading_.takes[m->channel].empty()) {
    reading_.ahead_bytes += m->data.size() + sizeof *m;
    for (const Take& take : reading_.takes[m->channel]) take(*m);
    if (reading_.ahead_bytes > max_ahead_bytes)
      throw Error(replay_messages::tick_gap_too_large(max_ahead_bytes >> 20));
  }
  ++reading_.place;
  return true;
}

void Playback::begin_tick() {
  while (ticks_.empty())
    if (!read()) throw Error(replay_messages::log_changed());
  now_ns_ = ticks_.front();
  ticks_.pop_front();
  while (reading_.now_ns <= now_ns_ && read()) {
  }
  vehicle_->begin_tick(now_ns_);
}

/// A command between two ticks has the time of the first of them.
std::optional<Command> Playback::entry() {
  if (entries_.empty()) return std::nullopt;
  Entry& next = entries_.front();
  if (!next.at_begin && next.log_ns >= now_ns_ && !(over_ && next.log_ns == now_ns_)) return std::nullopt;
  Command command = std::move(next.command);
  entries_.pop_front();
  return command;
}

// ---- interface of the host

namespace {

template <class Times>
bool holds_time(const Times& times, std::uint64_t log_ns) {
  return std::binary_search(times.begin(), times.end(), log_ns);
}

}  // namespace

bool Playback::signalled() const { return holds_time(survey_.signals, log_ns(now_ns_)); }

bool Playback::ran_over(const std::string& component, std::int64_t now_ns) const {
  const auto reported = survey_.reported.find(component);
  return reported != survey_.reported.end() && holds_time(reported->second.over_budget, log_ns(now_ns));
}

// ---- replacement of vehicle and drivers

void Playback::prepare_vehicle(const Graph& graph) {
  vehicle_ = std::make_shared<VehicleTrack>(survey_, graph);
  for (const auto& [channel, output] : vehicle_->outputs()) {
    if (std::string gap = gap_in(survey_, channel); !gap.empty()) gaps_.push_back(std::move(gap));
    route(channel, [this, to = output](const McapFile::Message& m) { vehicle_->take(to, m); });
  }
  vehicle_failed_ =
      survey_.vehicle_failed_ns && flight_ns(*survey_.vehicle_failed_ns) == survey_.ticks.last_ns;
  if (vehicle_failed_) vehicle_->set_last_words(survey_.last_words);
}

bool Playback::changed(const std::string& component) const {
  return std::find(changed_.begin(), changed_.end(), component) != changed_.end();
}

void Playback::stand_in(const Graph& graph, const Component& component, UnitOptions& options) {
  constexpr std::int64_t patience_ns = 10'000'000'000;
  // components that timed out in the log are stopped by the log below
  options.hang_ns = std::max(options.hang_ns, patience_ns);
  options.wait_for_async = true;
  if (component.info().vehicle) options.runner = std::make_unique<RecordedVehicle>(vehicle_);
  static const Reported nothing;
  const auto at = survey_.reported.find(component.name);
  const Reported& reported = at == survey_.reported.end() ? nothing : at->second;
  if (!changed(component.name))
    for (const Reported::Death& d : reported.deaths)
      options.deaths.push_back({flight_ns(d.log_ns), d.call, d.cause, d.hung});
  if (component.run == RunMode::async) {
    for (const auto& [due_ns, at_ns] : reported.late) options.late.emplace_back(due_ns, flight_ns(at_ns));
    std::sort(options.late.begin(), options.late.end());
  }
  if (component.run != RunMode::driver) return;
  std::vector<std::pair<std::int64_t, std::string>> faults;
  for (const auto& [at_ns, cause] : reported.guards) faults.emplace_back(flight_ns(at_ns), cause);
  options.samples = std::make_unique<RecordedSamples>(driver(graph, component), std::move(faults));
}

/// One track for each port, independent of the driver: a driver that replaces another continues it.
std::shared_ptr<SampleTrack> Playback::driver(const Graph& graph, const Component& component) {
  std::shared_ptr<SampleTrack>& track = drivers_[component.name];
  if (track) return track;
  std::vector<std::string> topics;
  bool probes = false;
  for (std::size_t i = 0; i < component.info().outputs.size(); ++i) {
    const std::string topic =
        component.info().outputs[i].type ? topic_in(survey_.log, graph, component, i) : "";
    probes = probes || topic.empty();
    // an output without a sample in the whole flight has no topic
    const bool there = has_topic(survey_.log, topic);
    topics.push_back(there ? topic : "");
  }
  track = std::make_shared<SampleTrack>(survey_.log, component.name, component.info(), topics,
                                        probes ? "/" + component.name + "/probes" : "", epoch_ns_);
  for (const auto& [channel, output] : track->outputs()) {
    route(channel, [to = track](const McapFile::Message& m) { to->take(m); });
  }
  return track;
}

// ---- inputs of the flight

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

/// The value of a parameter that this mission does not have stays unread: applying the command reports it.
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

void Playback::store(const McapFile::Message& m, Command command) {
  const std::int64_t now_ns = flight_ns(m.log_ns);
  if (now_ns > survey_.ticks.last_ns) return;
  entries_.push_back({reading_.place < survey_.begun_at, now_ns, std::move(command)});
}

void Playback::prepare_entries(const Graph& graph) {
  const auto add = [this](std::uint16_t channel, Take take) {
    if (std::string gap = gap_in(survey_, channel); !gap.empty()) gaps_.push_back(std::move(gap));
    route(channel, std::move(take));
  };
  for (const auto& [channel, port] : input_channels(survey_.log, graph))
    add(channel, [this, port = port](const McapFile::Message& m) {
      Command command = command_of(port.kind, port.component, port.port);
      command.message.resize(port.type->size);
      cdr_decode(*port.type, m.data.data(), m.data.size(), command.message.data());
      store(m, std::move(command));
    });
  const HostTopic<CommandNote> parameters(survey_.log, CommandNote::parameter_topic), commands(survey_.log);
  for (const auto& topic : {parameters, commands}) {
    topic.check();
    if (!topic.there()) continue;
    add(topic.channel(), [this, topic, &graph](const McapFile::Message& m) {
      if (survey_.resumed && survey_.resumed->places.contains(reading_.place)) return;  // see prepare_resume
      store(m, logged_command(topic.read(m.data), graph));
    });
  }
}

/// Reads the point at which a resumed flight began, and its parameters.
void Playback::prepare_resume(const Graph& graph) {
  if (!survey_.resumed) return;
  resume_.emplace();
  resume_->phase = survey_.resumed->phase;
  resume_->if_armed = survey_.resumed->begun;
  for (const CommandNote& note : survey_.resumed->params) {
    Command set = logged_command(note, graph);
    resume_->params.push_back({set.component, set.name, std::move(set.value)});
  }
}

}  // namespace fulmar::core
