// SPDX-License-Identifier: BSD-3-Clause
#include "core/replay/playback.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>

#include "core/run/flight_impl.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

std::string log_topic(std::string name) {
  std::replace(name.begin(), name.end(), '.', '/');
  return "/" + name;
}

bool has_topic(const McapFile& file, const std::string& topic) {
  return std::any_of(file.channels.begin(), file.channels.end(), [&](const auto& c) { return c.second.topic == topic; });
}

/// The channel of a topic whose messages are of this type. Throws Error.
std::uint16_t channel_of(const McapFile& file, const std::string& topic, const Type& type) {
  const std::uint16_t channel = file.channel(topic);
  const auto schema = file.schemas.find(file.channels.at(channel).schema);
  if (schema == file.schemas.end() || schema->second.text != ros_definition(type))
    throw Error("the log's " + topic + " has other fields than " + type.name + " has here: it was written by another version");
  return channel;
}

/// Under which of its two names the log has an output: a role's topic, or, where that has another filler's fields, its own.
std::string topic_in(const McapFile& file, const Graph& graph, const Component& component, std::size_t output) {
  const Port& port = component.info().outputs[output];
  const std::string role = log_topic(topic_name(graph, component, output)), own = log_topic(component.name + "." + port.name);
  if (role == own || !has_topic(file, own) || !has_topic(file, role)) return role;
  const auto schema = file.schemas.find(file.channels.at(file.channel(role)).schema);
  return schema != file.schemas.end() && schema->second.text == ros_definition(*port.type) ? role : own;
}

std::int64_t flight_ns(std::uint64_t log_ns, std::int64_t epoch_ns) { return static_cast<std::int64_t>(log_ns) - epoch_ns; }

}  // namespace

TickList read_ticks(const McapFile& file) {
  const HostTopic<Ticks> topic(file);
  if (!topic.there()) throw Error("the log has no /fulmar/ticks: it is not a flight's, or older than replays");
  topic.check();
  TickList list;
  for (const McapFile::Message& m : file.messages) {
    if (!topic.holds(m)) continue;
    const Ticks ticks = topic.read(m.data);
    if (ticks.first != list.hash.size() || ticks.periods != ticks.hashes)
      throw Error(list.hash.empty() ? "the log begins with tick " + std::to_string(ticks.first) +
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
  if (!std::is_sorted(list.time_ns.begin(), list.time_ns.end(), std::less_equal<>())) throw Error("the log's ticks are not in order");
  return list;
}

Playback::Playback(const McapFile& file, const Graph& graph)
    : file_(file), epoch_ns_(graph.epoch_ns), ticks_(read_ticks(file)), events_(file) {
  samples_.resize(ticks_.time_ns.size());
  index_host();
  index_vehicle(graph);
  index_entries(graph);
}

// ---- the host ---------------------------------------------------------------------------------------------------------------

void Playback::index_host() {
  file_.channel(Event::topic);  // throws when there is none
  events_.check();
  for (const McapFile::Message& m : file_.messages)
    if (events_.holds(m)) take_event(events_.read(m.data), flight_ns(m.log_ns, epoch_ns_));
}

/// What only the host's events tell: the wall clock, signals, devices that failed, and an end that the flight's owner had set.
void Playback::take_event(const Event& e, std::int64_t now_ns) {
  switch (e.code) {
    case Code::vehicle_failed:
      vehicle_failed_ = now_ns == ticks_.time_ns.back();
      if (vehicle_failed_) last_words_ = e.cause.data();
      break;
    case Code::duration_reached:
      duration_s_ = 1e-9 * static_cast<double>(now_ns);
      break;
    case Code::guard:
    case Code::hung:
    case Code::over_budget:
    case Code::late_result:
    case Code::signal_refused:
    case Code::gave_up:
      told_.push_back({now_ns, e.value_ns, e.code, e.component.data(), e.cause.data()});
      break;
    default:
      break;
  }
}

bool Playback::told(Code code, const std::string& component, std::int64_t now_ns) const {
  return std::any_of(told_.begin(), told_.end(),
                     [&](const Told& t) { return t.code == code && t.at_ns == now_ns && t.component == component; });
}

bool Playback::signalled(std::int64_t now_ns) const {
  return told(Code::signal_refused, "", now_ns) || told(Code::gave_up, "", now_ns);
}

bool Playback::ran_over(const std::string& component, std::int64_t now_ns) const { return told(Code::over_budget, component, now_ns); }

// ---- the vehicle ------------------------------------------------------------------------------------------------------------

void Playback::index_vehicle(const Graph& graph) {
  const Component& vehicle = graph.components[static_cast<std::size_t>(graph.vehicle)];
  vehicle_ = &vehicle.info();
  constexpr std::uint32_t all_probes = ~0u;
  std::map<std::uint16_t, std::uint32_t> outputs;  // channel -> output
  for (std::uint32_t i = 0; i < vehicle_->outputs.size(); ++i) {
    const Port& port = vehicle_->outputs[i];
    if (!port.type) {
      probes_.push_back(i);
      continue;
    }
    const std::string topic = topic_in(file_, graph, vehicle, i);
    const bool silent = port.kind != FULMAR_OUT_VALUE && !has_topic(file_, topic);  // in the whole flight
    if (!silent) outputs[channel_of(file_, topic, *port.type)] = i;
  }
  if (!probes_.empty()) outputs[file_.channel("/" + vehicle.name + "/probes")] = all_probes;
  for (const auto& [channel, output] : outputs) check_gaps(channel);
  std::size_t tick = 0;
  for (const McapFile::Message& m : file_.messages) {
    const auto at = outputs.find(m.channel);
    if (at == outputs.end()) continue;
    const std::int64_t now = flight_ns(m.log_ns, epoch_ns_);
    while (tick < samples_.size() && ticks_.time_ns[tick] < now) ++tick;
    if (tick == samples_.size()) break;  // the log was cut off before it told of this tick
    if (ticks_.time_ns[tick] != now) throw Error("the log has samples of " + file_.channels.at(m.channel).topic + " between two ticks");
    if (at->second != all_probes) samples_[tick].push_back({at->second, &m});
    if (at->second == all_probes && m.data.size() != 4 + 8 * probes_.size()) throw Error("the log has other probes of " + vehicle.name);
    for (std::size_t k = 0; at->second == all_probes && k < probes_.size(); ++k) samples_[tick].push_back({probes_[k], &m});
  }
}

void Playback::check_gaps(std::uint16_t channel) {
  std::uint64_t expected = 0, lost = 0;
  for (const McapFile::Message& m : file_.messages) {
    if (m.channel != channel) continue;
    lost += static_cast<std::uint32_t>(m.sequence - static_cast<std::uint32_t>(expected));
    expected = std::uint64_t{m.sequence} + 1;
  }
  if (lost > 0) gaps_.push_back("the log has lost " + std::to_string(lost) + " samples of " + file_.channels.at(channel).topic);
}

void Playback::read(fulmar_tick& tick, fulmar_output* outputs) {
  if (at_ == samples_.size()) throw Error(last_words_);
  tick.now_ns = ticks_.time_ns[at_];
  for (const Sample& sample : samples_[at_]) {
    const Port& port = vehicle_->outputs[sample.output];
    fulmar_output& out = outputs[sample.output];
    const McapFile::Message& m = *sample.message;
    auto* to = static_cast<std::byte*>(out.data);
    if (!port.type) {  // all probes in one message of doubles
      const auto k = static_cast<std::size_t>(std::find(probes_.begin(), probes_.end(), sample.output) - probes_.begin());
      std::memcpy(to, m.data.data() + 4 + 8 * k, 8);
      out.count = 1;
      continue;
    }
    const std::int64_t valid_at_ns = flight_ns(m.publish_ns, epoch_ns_);
    if (port.kind != FULMAR_OUT_QUEUE) {
      cdr_decode(*port.type, m.data.data(), m.data.size(), to);
      out.valid_at_ns = valid_at_ns;
      out.count = 1;
      continue;
    }
    if (out.count == port.capacity) throw Error("the log has more samples of " + port.name + " in a tick than there is room for");
    cdr_decode(*port.type, m.data.data(), m.data.size(), to + std::size_t{out.count} * port.type->size);
    out.stamps_ns[out.count++] = valid_at_ns;
  }
  ++at_;
}

struct Playback::Functions {
  static std::uint32_t read(void* self, fulmar_tick* tick, fulmar_output* outputs, fulmar_error* error) noexcept {
    try {
      static_cast<Playback*>(self)->read(*tick, outputs);
      return FULMAR_OK;
    } catch (const std::exception& fault) {
      std::snprintf(error->text, sizeof error->text, "%s", fault.what());
      return FULMAR_FAILED;
    }
  }
  static std::uint32_t write(void*, const fulmar_tick*, const fulmar_input*, fulmar_error*) noexcept { return FULMAR_OK; }
  static std::uint32_t configure(void*, const fulmar_value*, fulmar_error*) noexcept { return FULMAR_OK; }
  static void destroy(void*) noexcept {}
};

const fulmar_component& Playback::functions() {
  static const fulmar_component table = [] {
    fulmar_component t{};
    t.name = t.doc = "";
    t.read = &Functions::read;
    t.write = &Functions::write;
    t.configure = &Functions::configure;
    t.destroy = &Functions::destroy;
    return t;
  }();
  return table;
}

void Playback::stand_in(const Graph& graph, const Component& component, UnitOptions& options) {
  std::vector<std::pair<std::int64_t, std::string>> faults;
  options.paced = false;
  options.wait_for_async = true;
  for (const Told& t : told_) {
    if (t.component != component.name) continue;
    if (t.code == Code::guard) faults.emplace_back(t.at_ns, t.cause);
    // A child that hung will hang again: only then the wall clock ends it.
    if (t.code == Code::hung) options.paced = true;
    if (t.code == Code::late_result && component.run == RunMode::async) options.late[t.value_ns] = t.at_ns;
  }
  if (component.info().vehicle) options.playback = this;
  if (component.run != RunMode::driver) return;
  std::vector<std::string> topics;
  bool probes = false;
  for (std::size_t i = 0; i < component.info().outputs.size(); ++i) {
    const std::string topic = component.info().outputs[i].type ? topic_in(file_, graph, component, i) : "";
    probes = probes || topic.empty();
    topics.push_back(has_topic(file_, topic) ? topic : "");  // one that was silent in the whole flight has none
  }
  options.samples = std::make_unique<RecordedSamples>(file_, component.info(), topics, probes ? "/" + component.name + "/probes" : "",
                                                      epoch_ns_, std::move(faults));
}

// ---- what was asked of the flight -------------------------------------------------------------------------------------------

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
      inputs[channel_of(file, topic, *port.type)] = {request ? CommandKind::request : CommandKind::import, component.name, port.name,
                                                     port.type};
    }
  return inputs;
}

/// Of a parameter that this mission does not have the value stays unread: whoever applies the command says so.
Command logged_command(const CommandNote& note, const Graph& graph) {
  Command command = command_of(note.kind, note.component.data(), note.name.data());
  command.note = note;
  if (note.kind != CommandKind::parameter) return command;
  for (const Component& c : graph.components)
    if (const int i = c.name == command.component ? c.info().param(command.name) : -1; i >= 0)
      command.value = value_of(note, c.info().params[static_cast<std::size_t>(i)]);
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
  if (!resume_ || entries_.empty()) return;
  Command& set = entries_.back().command;
  if (set.kind != CommandKind::parameter || set.component != e.component.data() || set.name != e.name.data()) return;
  resume_->params.push_back({set.component, set.name, std::move(set.value)});
  entries_.pop_back();
}

void Playback::index_entries(const Graph& graph) {
  const HostTopic<CommandNote> parameters(file_, CommandNote::parameter_topic), commands(file_);
  const std::map<std::uint16_t, InputPort> inputs = input_channels(file_, graph);
  for (const auto& [channel, port] : inputs) check_gaps(channel);
  for (const auto& topic : {parameters, commands}) {
    topic.check();
    if (topic.there()) check_gaps(topic.channel());
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
      entry.before = static_cast<std::size_t>(std::upper_bound(ticks_.time_ns.begin(), ticks_.time_ns.end(), now) - ticks_.time_ns.begin());
    if (now <= ticks_.time_ns.back()) entries_.push_back(std::move(entry));
  }
}

}  // namespace fulmar::core
