// SPDX-License-Identifier: BSD-3-Clause
// Channels of the tap, their periods in the log, and the attachments of the log.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/run/record/recorder.hpp"
#include "core/run/state/published.hpp"
#include "core/types/named.hpp"
#include "core/types/text.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t events_for_latecomers = 100;
constexpr std::int64_t default_period_ns = 100'000'000;  // 10 Hz for outputs that a replay computes again

}  // namespace

/// The channels of a tap, each topic once.
class Recorder::ChannelList {
 public:
  std::size_t add(const std::string& port, const TypePtr& type) {
    list.push_back({"/" + slashed(port), type});
    return list.size() - 1;
  }
  /// A component of a role publishes under the role's name: one topic for all of them. It uses its own name
  /// when its message has other fields.
  std::size_t add_shared(const std::string& name, const std::string& own, const TypePtr& type) {
    const auto there = std::find_if(list.begin(), list.end(),
                                    [&](const TapChannel& c) { return c.topic == "/" + slashed(name); });
    if (there == list.end()) return add(name, type);
    return there->type->hash == type->hash ? static_cast<std::size_t>(there - list.begin()) : add(own, type);
  }
  std::vector<TapChannel> list;
};

void Recorder::open(const Units& units, bool with_log) {
  tap_ = std::make_unique<Tap>(channels(units));
  if (with_log) open_log(units);
}

std::vector<TapChannel> Recorder::channels(const Units& units) {
  ChannelList list;
  channels_.event = list.add("fulmar.event", host_type<Event>());
  list.list[channels_.event].past = events_for_latecomers;
  channels_.ticks = list.add("fulmar.ticks", host_type<Ticks>());
  channels_.parameter = list.add("fulmar.parameter", host_type<CommandNote>());
  channels_.command = list.add("fulmar.command", host_type<CommandNote>());
  for (const auto& unit : units) add_channels(list, *unit);
  for (const auto& unit : units) add_further_requests(list, *unit);
  channels_.lines = list.add("rosout", host_type<LogLine>());
  return std::move(list.list);
}

void Recorder::add_channels(ChannelList& list, Unit& unit) {
  const Component& c = *unit.component;
  const bool stored_whole = c.info().vehicle || c.run == RunMode::driver;
  for (std::size_t i = 0; i < unit.out.slots.size(); ++i) {
    Slot& slot = unit.out.slots[i];
    if (!slot.port->type) continue;
    const std::string name = topic_name(state_.graph, c, i);
    slot.log.channel = list.add_shared(name, c.name + "." + slot.port->name, slot.port->type);
    if (slot.port->kind == FULMAR_OUT_EVENT) list.list[slot.log.channel].may_stay_silent = true;
    slot.log.period_ns = record_period(name, slot);
    if (!stored_whole) slot.hash = std::make_unique<MessageHash>(*slot.port->type);
  }
  bool asked = false;
  for (Reader& reader : unit.in.readers) {
    const bool request = reader.port->kind == FULMAR_IN_REQUEST;
    if (!(request && asked) && (request || reader.wire->import >= 0))
      reader.channel = static_cast<int>(list.add(c.name + "." + reader.port->name, reader.port->type));
    asked = asked || request;
  }
  Probes& probes = unit.out.probes;
  if (probes.outputs.empty()) return;
  probes.log.period_ns = record_period(c.name + ".probes", unit.out.slots[probes.outputs.front()]);
  probes.log.channel = list.add(c.name + ".probes", probes_type(*c.plugin, c.info()));
}

/// After all other channels of components: the hashes of the ticks use the numbers of the channels. So a new
/// request of a component does not change the channels, or the replays, of existing logs.
void Recorder::add_further_requests(ChannelList& list, Unit& unit) {
  for (Reader& reader : unit.in.readers)
    if (reader.port->kind == FULMAR_IN_REQUEST && reader.channel < 0)
      reader.channel =
          static_cast<int>(list.add(unit.component->name + "." + reader.port->name, reader.port->type));
}

std::int64_t Recorder::record_period(const std::string& port, const Slot& slot) const {
  const Component& component = *slot.owner->component;
  if (component.info().vehicle || component.run == RunMode::driver) return 0;  // a replay needs all of it
  const std::int64_t usual = slot.port->kind == FULMAR_OUT_QUEUE ? 0 : default_period_ns;
  for (const RecordRule& rule : state_.graph.record_rules)
    for (const std::string& pattern : rule.ports)
      if (port_matches(port, pattern)) return rule.period_ns == RecordRule::usual ? usual : rule.period_ns;
  return state_.graph.record_rules.empty() ? usual : -1;
}

void Recorder::open_log(const Units& units) {
  const Graph& graph = state_.graph;
  Log::Options o;
  o.file = state_.options.log_file;
  o.held = state_.options.log_held;
  o.epoch_ns = graph.epoch_ns;
  o.wait = state_.unpaced();
  // Events of the host and input from outside are always stored. A role's topic is stored when any of its
  // components is recorded.
  o.channels.assign(tap_->channels().size(), true);
  const auto each = [&](auto&& set) {
    for (const auto& unit : units) {
      for (const Slot& slot : unit->out.slots)
        if (slot.port->type) set(slot.log);
      if (!unit->out.probes.outputs.empty()) set(unit->out.probes.log);
    }
  };
  each([&](const LogPlace& place) { o.channels[place.channel] = false; });
  each([&](const LogPlace& place) {
    o.channels[place.channel] = o.channels[place.channel] || place.period_ns >= 0;
  });
  log_ = std::make_unique<Log>(o, *tap_);
  attach_texts(units);
}

namespace {

nlohmann::json parameter_json(const ParamInfo& p, const ParamValue& v) {
  switch (p.kind) {
    case FULMAR_NUMBER: return v.number[0];
    case FULMAR_FLAG: return v.integer != 0;
    case FULMAR_COUNT: return v.integer;
    case FULMAR_CHOICE: return p.choices.at(static_cast<std::size_t>(v.integer));
    case FULMAR_VECTOR: return {v.number[0], v.number[1], v.number[2]};
    case FULMAR_RECORD: return to_json(*p.type, v.data.data(), false);
    default: return v.text;
  }
}

std::string parameters_text(const Units& units) {
  nlohmann::json all = nlohmann::json::object();
  for (const auto& unit : units) {
    nlohmann::json& mine = all[unit->component->name] = nlohmann::json::object();
    for (std::size_t i = 0; i < unit->base.size(); ++i)
      mine[unit->info->params[i].name] = parameter_json(unit->info->params[i], unit->base[i]);
  }
  return all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Changes of the command line, for a replay.
Pairs overrides_text(const Overrides& o) {
  Pairs pairs;
  if (o.io) pairs.emplace_back("io", *o.io);
  if (o.arm) pairs.emplace_back("arm", *o.arm);
  if (o.seed) pairs.emplace_back("seed", std::to_string(*o.seed));
  for (const auto& [role, component] : o.roles) pairs.emplace_back("role " + role, component);
  for (const auto& [param, value] : o.set) pairs.emplace_back("set " + param, value);
  for (std::size_t i = 0; i < o.record.size(); ++i)
    pairs.emplace_back("record " + std::to_string(i + 1), o.record[i]);
  return pairs;
}

/// Metadata of a plugin file in a log; `fulmar-replay` reads them back.
Pairs flown_pairs(const PluginInfo& p) {
  Pairs pairs = {{"file", p.file}, {"version", p.version}, {"sha256", p.sha256}};
  if (!p.build_id.empty()) pairs.emplace_back("build_id", p.build_id);
  return pairs;
}

}  // namespace

void Recorder::attach_texts(const Units& units) {
  const Graph& graph = state_.graph;
  for (const auto& [name, text] : graph.source.attachments) log_->attach(name, "application/yaml", text);
  log_->attach("parameters.json", "application/json", parameters_text(units));
  std::string order;
  for (const int i : graph.order) order += nth(graph.components, i).name + "\n";
  log_->attach("order.txt", "text/plain", order);
  Pairs plugins;
  for (const Component& c : graph.components) {
    const PluginInfo& p = *c.plugin;
    for (const auto& [key, value] : flown_pairs(p)) plugins.emplace_back(c.name + "." + key, value);
  }
  log_->metadata("plugins", plugins);
  log_->metadata("overrides", overrides_text(graph.source.overrides));
  log_->metadata("fulmar",
                 {{"version", FULMAR_VERSION},
                  {"abi", std::to_string(FULMAR_ABI_MAJOR) + "." + std::to_string(FULMAR_ABI_MINOR)},
                  {"toolchain", __VERSION__},
                  {"mission", graph.mission},
                  {"io", io_word(graph.io)},
                  {"epoch_ns", std::to_string(graph.epoch_ns)},
                  {"seed", std::to_string(graph.seed)}});
}

void Recorder::note_swap(const std::string& component, const PluginInfo& plugin) {
  if (!log_) return;
  auto pairs = flown_pairs(plugin);
  pairs.emplace(pairs.begin(), "component", component);
  log_->metadata("swap", pairs);
}

// ---- texts for users

void Recorder::listen(const Units& units) {
  reported_.clear();
  const auto unit = [&](int index) -> const Unit& { return *nth(units, index); };
  for (const Source& source : state_.graph.report) {
    if (source.kind == Source::Kind::component) listen_to(unit(source.index), source.output);
    if (source.kind != Source::Kind::role) continue;
    const Role& role = nth(state_.graph.roles, source.index);
    for (std::size_t f = 0; f < role.fillers.size(); ++f)
      listen_to(unit(role.fillers[f]), nth(role.provides[f], source.output));
  }
}

void Recorder::listen_to(const Unit& unit, int output) {
  if (output < 0) return;
  const Slot& slot = nth(unit.out.slots, output);
  // One component may fill two roles whose notices are listed.
  if (std::any_of(reported_.begin(), reported_.end(), [&](const Reported& t) { return t.slot == &slot; }))
    return;
  Reported reported{&slot,
                    slot.port->type->find("text"),
                    slot.port->type->find("severity"),
                    slot.port->type->find("cause"),
                    {}};
  if (!reported.text || reported.text->kind != FULMAR_TEXT) return;
  if (!reported.severity) reported.severity = slot.port->type->find("level");
  for (const Field** word : {&reported.severity, &reported.cause})
    if (*word && ((*word)->kind != FULMAR_ENUM || (*word)->shape != FULMAR_SCALAR)) *word = nullptr;
  if (slot.port->kind == FULMAR_OUT_VALUE) reported.last.assign(reported.text->stride, '\0');
  reported_.push_back(std::move(reported));
}

}  // namespace fulmar::core
