// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/playback.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/run/flight_impl.hpp"
#include "core/tap/ros_parse.hpp"
#include "core/tap/wire.hpp"

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

template <class T>
T decode(const Type& type, const McapFile::Message& message) {
  T value;
  cdr_decode(type, message.data.data(), message.data.size(), reinterpret_cast<std::byte*>(&value));
  return value;
}

std::int64_t flight_ns(std::uint64_t log_ns, std::int64_t epoch_ns) { return static_cast<std::int64_t>(log_ns) - epoch_ns; }

}  // namespace

TickList read_ticks(const McapFile& file) {
  if (!has_topic(file, "/fulmar/ticks")) throw Error("the log has no /fulmar/ticks: it is not a flight's, or older than replays");
  const std::uint16_t channel = channel_of(file, "/fulmar/ticks", *ticks_type());
  TickList list;
  for (const McapFile::Message& m : file.messages) {
    if (m.channel != channel) continue;
    const auto ticks = decode<Ticks>(*ticks_type(), m);
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

Playback::Playback(const McapFile& file, const Graph& graph) : file_(file), epoch_ns_(graph.epoch_ns), ticks_(read_ticks(file)) {
  samples_.resize(ticks_.time_ns.size());
  const auto failures = told_of(graph.components[static_cast<std::size_t>(graph.vehicle)].name, true);
  vehicle_failed_ = !failures.empty() && failures.back().first == ticks_.time_ns.back();
  last_words_ = vehicle_failed_ ? failures.back().second : "the log ends here";
  index_vehicle(graph);
  index_entries(graph);
  index_host();
}

// ---- the host ---------------------------------------------------------------------------------------------------------------

/// What only the host's events tell: signals, and an end that its owner had set.
void Playback::index_host() {
  const std::uint16_t events = channel_of(file_, "/fulmar/event", *event_type());
  const auto ends = [](const std::string& text) { return text.ends_with("; flies on until disarmed"); };
  for (const McapFile::Message& m : file_.messages) {
    if (m.channel != events) continue;
    const auto event = decode<Event>(*event_type(), m);
    const std::string text = event.text.data();
    const std::int64_t now = flight_ns(m.log_ns, epoch_ns_);
    const bool refused = event.kind == EventKind::end && text.starts_with("the aircraft is armed: Ctrl-C");
    const bool given_up = event.kind == EventKind::failsafe && text == "failsafe: control given up by a signal";
    if (refused || given_up) signals_.push_back(now);
    if (event.kind == EventKind::guard && text == over_budget_words) overruns_.emplace_back(now, event.component.data());
    if (event.kind == EventKind::end && ends(text) && (text.starts_with("duration reached") || text.starts_with("failsafe: ")))
      duration_s_ = 1e-9 * static_cast<double>(now);
  }
}

bool Playback::signalled(std::int64_t now_ns) const { return std::find(signals_.begin(), signals_.end(), now_ns) != signals_.end(); }

bool Playback::ran_over(const std::string& component, std::int64_t now_ns) const {
  return std::any_of(overruns_.begin(), overruns_.end(), [&](const auto& o) { return o.first == now_ns && o.second == component; });
}

// ---- the vehicle ------------------------------------------------------------------------------------------------------------

void Playback::index_vehicle(const Graph& graph) {
  const Component& vehicle = graph.components[static_cast<std::size_t>(graph.vehicle)];
  vehicle_ = &vehicle.info();
  constexpr std::uint32_t all_probes = ~0u;
  std::map<std::uint16_t, std::uint32_t> outputs;  // channel -> output
  for (std::uint32_t i = 0; i < vehicle_->outputs.size(); ++i) {
    const Port& port = vehicle_->outputs[i];
    if (port.type)
      outputs[channel_of(file_, topic_in(file_, graph, vehicle, i), *port.type)] = i;
    else
      probes_.push_back(i);
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

Playback::Told Playback::told_of(const std::string& component, bool guards) const {
  Told list;
  const std::uint16_t events = channel_of(file_, "/fulmar/event", *event_type());
  for (const McapFile::Message& m : file_.messages) {
    if (m.channel != events) continue;
    const auto event = decode<Event>(*event_type(), m);
    if (event.kind == (guards ? EventKind::guard : EventKind::notice) && event.component.data() == component)
      list.emplace_back(flight_ns(m.log_ns, epoch_ns_), event.text.data());
  }
  return list;
}

void Playback::stand_in(const Graph& graph, const Component& component, UnitOptions& options) {
  const Told guards = told_of(component.name, true);
  // a child that hung will hang again: only then the wall clock ends it
  options.paced = std::any_of(guards.begin(), guards.end(), [](const auto& g) { return g.second.starts_with("hung: "); });
  options.wait_for_async = true;
  if (component.info().vehicle) options.playback = this;
  if (component.run == RunMode::async)
    for (const auto& [at_ns, text] : told_of(component.name, false))
      if (text.starts_with(late_words)) options.late[std::strtoll(text.c_str() + std::strlen(late_words), nullptr, 10)] = at_ns;
  if (component.run != RunMode::driver) return;
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < component.info().outputs.size(); ++i)
    topics.push_back(component.info().outputs[i].type ? topic_in(file_, graph, component, i) : "");
  const bool probes = std::any_of(topics.begin(), topics.end(), [](const std::string& topic) { return topic.empty(); });
  options.samples = std::make_unique<RecordedSamples>(file_, component.info(), topics, probes ? "/" + component.name + "/probes" : "",
                                                      epoch_ns_, told_of(component.name, true));
}

// ---- what was asked of the flight -------------------------------------------------------------------------------------------

namespace {

struct InputPort {
  std::string component, port;
  TypePtr type;
  Entry::Kind kind = Entry::Kind::request;
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
      inputs[channel_of(file, topic, *port.type)] = {component.name, port.name, port.type,
                                                     request ? Entry::Kind::request : Entry::Kind::import};
    }
  return inputs;
}

/// Reads the host's own messages by the log's own schema.
class HostTopic {
 public:
  HostTopic(const McapFile& file, const std::string& topic) {
    if (!has_topic(file, topic)) return;
    channel_ = file.channel(topic);
    const McapFile::Schema& schema = file.schemas.at(file.channels.at(*channel_).schema);
    type_ = parse_ros_definition(schema.name, schema.text);
    message_.resize(type_->size);
  }
  bool holds(const McapFile::Message& m) const { return channel_ == m.channel; }
  nlohmann::json read(const McapFile::Message& m) {
    cdr_decode(*type_, m.data.data(), m.data.size(), message_.data());
    return to_json(*type_, message_.data(), false);
  }

 private:
  std::optional<std::uint16_t> channel_;
  TypePtr type_;
  std::vector<std::byte> message_;
};

Entry::Kind command_kind(const std::string& word) {
  if (word == "phase") return Entry::Kind::phase;
  if (word == "swap") return Entry::Kind::swap;
  if (word == "reset") return Entry::Kind::reset;
  throw Error("the log has a command '" + word + "' that this version does not know");
}

}  // namespace

namespace {

/// "resumed: phase cruise, manage.first_item = 3"; the values follow as parameters. "not resumed: ...": nothing came of it.
Resume resume_of(const std::string& text, bool if_armed) {
  constexpr std::string_view words = "resumed: phase ";
  Resume resume;
  resume.if_armed = if_armed;
  if (text.starts_with(words)) resume.phase = text.substr(words.size(), text.find(',') - words.size());
  if (text.starts_with(words)) resume.params.resize(static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')));
  return resume;
}

Resume::Param resumed_parameter(const Entry& entry) {
  Resume::Param p{entry.component, entry.name, {}};
  p.value.number[0] = std::strtod(entry.text.c_str(), nullptr);
  p.value.integer = std::llround(p.value.number[0]);
  return p;
}

}  // namespace

void Playback::index_entries(const Graph& graph) {
  HostTopic parameters(file_, "/fulmar/parameter"), commands(file_, "/fulmar/command");
  const std::map<std::uint16_t, InputPort> inputs = input_channels(file_, graph);
  for (const auto& [channel, port] : inputs) check_gaps(channel);
  for (const char* topic : {"/fulmar/parameter", "/fulmar/command"})
    if (has_topic(file_, topic)) check_gaps(file_.channel(topic));
  const std::uint16_t events = channel_of(file_, "/fulmar/event", *event_type());
  std::size_t resumed = 0;
  bool begun = false;  // the first thing that a flight says is its phase
  for (const McapFile::Message& m : file_.messages) {
    if (m.channel == events) {
      const auto event = decode<Event>(*event_type(), m);
      begun = begun || event.kind == EventKind::phase;
      if (event.kind == EventKind::resume) resume_ = resume_of(event.text.data(), begun);
    }
    const std::int64_t now = flight_ns(m.log_ns, epoch_ns_);
    Entry entry;
    if (const auto at = inputs.find(m.channel); at != inputs.end()) {
      entry.kind = at->second.kind, entry.component = at->second.component, entry.name = at->second.port;
      entry.message.resize(at->second.type->size);
      cdr_decode(*at->second.type, m.data.data(), m.data.size(), entry.message.data());
    } else if (parameters.holds(m)) {
      const nlohmann::json j = parameters.read(m);
      entry.kind = Entry::Kind::parameter, entry.component = j.at("component"), entry.name = j.at("name"), entry.text = j.at("text");
    } else if (commands.holds(m)) {
      const nlohmann::json j = commands.read(m);
      entry.kind = command_kind(j.at("kind")), entry.component = j.at("component"), entry.text = j.at("text");
    } else {
      continue;
    }
    if (resume_ && resumed < resume_->params.size() && entry.kind == Entry::Kind::parameter) {
      resume_->params[resumed++] = resumed_parameter(entry);
      continue;
    }
    if (begun)
      entry.before = static_cast<std::size_t>(std::upper_bound(ticks_.time_ns.begin(), ticks_.time_ns.end(), now) - ticks_.time_ns.begin());
    if (now <= ticks_.time_ns.back()) entries_.push_back(std::move(entry));
  }
}

}  // namespace fulmar::core
