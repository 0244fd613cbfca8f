// SPDX-License-Identifier: BSD-3-Clause
// Set-up of a flight: creates and configures components, connects their ports, opens the log.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/run/circumstances.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/flown_plugin.hpp"
#include "core/live/gate.hpp"
#include "core/log/sbom.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

constexpr std::int64_t default_period_ns = 100'000'000;     // 10 Hz for what a replay computes anew
constexpr std::size_t tape_steps = 256;                     // of inputs kept per component, for the rehearsal of a swap
constexpr std::int64_t default_max_age_ns = 1'000'000'000;  // of what a role publishes

}  // namespace

Flight::Impl::Impl(const Graph& g, const FlightOptions& o) : graph(g), options(o), ending(g.failsafe_ns) {
  const bool driven =
      std::any_of(graph.components.begin(), graph.components.end(), [](const Component& c) { return c.run == RunMode::driver; });
  if (!options.drivers_from.empty() && !driven)
    throw Error("--drivers-from " + options.drivers_from.string() + ": the mission " + graph.mission +
                " has no component with 'run: driver'");
  imports = std::vector<Import>(graph.dds.imports.size());
  for (const Component& c : graph.components) units.push_back(std::make_unique<Unit>(c, unit_options(c)));
  connect();
  for (const auto& unit : units) unit->configure();
  if (graph.vehicle >= 0) units[static_cast<std::size_t>(graph.vehicle)]->prepare_last_frame(graph.failsafe);
  commands = std::make_shared<const CommandTable>(graph);
  open_tap();
  if (graph.arm) request_arming();
  std::size_t most = 0;
  for (const auto& unit : units) most = std::max(most, unit->out.slots.size());
  hand_over.reserve(most);
  any_since.assign(graph.any.size(), never);
  result.phases.reserve(64);
  result.guards.reserve(64);
}

UnitOptions Flight::Impl::unit_options(const Component& c) const {
  UnitOptions o;
  o.tick_ns = graph.tick_ns;
  o.seed = component_seed(graph.seed, c.name);
  o.paced = !unpaced();
  o.wait_for_async = graph.io == Io::sim;
  o.tape_steps = options.keep_inputs && !c.info().vehicle && c.run != RunMode::driver ? tape_steps : 0;
  if (c.run == RunMode::driver && !options.drivers_from.empty()) o.samples = recorded_samples(c);
  if (options.circumstances) options.circumstances->stand_in(graph, c, o);
  return o;
}

std::unique_ptr<SampleSource> Flight::Impl::recorded_samples(const Component& c) const {
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < c.info().outputs.size(); ++i) {
    std::string name = c.info().outputs[i].type ? "/" + topic_name(graph, c, i) : "";
    std::replace(name.begin(), name.end(), '.', '/');
    topics.push_back(name);
  }
  return std::make_unique<RecordedSamples>(options.drivers_from, c.info(), topics, graph.epoch_ns);
}

/// `arm: auto`: asks the vehicle's request port `arm`, in its first tick.
void Flight::Impl::request_arming() {
  Unit& vehicle = *units[static_cast<std::size_t>(graph.vehicle)];
  const int port = vehicle.info->input("arm");
  const Field* armed = port < 0 ? nullptr : vehicle.in.readers[static_cast<std::size_t>(port)].port->type->find("armed");
  if (!armed || armed->kind != FULMAR_BOOL || vehicle.in.readers[static_cast<std::size_t>(port)].port->kind != FULMAR_IN_REQUEST)
    throw Error(vehicle.component->where.text() + ": arm: auto needs a vehicle with a request 'arm' that has a field 'armed'; " +
                vehicle.component->name + " has none");
  Reader& reader = vehicle.in.readers[static_cast<std::size_t>(port)];
  std::vector<std::byte> message(reader.port->type->size);
  message[armed->offset] = std::byte{1};
  CopyPlan whole;
  whole.size = reader.port->type->size;
  reader.push(message.data(), 0, whole);
}

void Flight::Impl::connect() {
  delayed.clear();
  roles.resize(graph.roles.size());
  drives_vehicle.assign(graph.roles.size(), false);
  control_roles.assign(graph.roles.size(), false);
  for (const int role : graph.control) control_roles[static_cast<std::size_t>(role)] = true;
  for (const auto& unit : units)
    for (Slot& slot : unit->out.slots) slot.queues.clear(), slot.role = nullptr, slot.filler = -1;
  for (std::size_t r = 0; r < roles.size(); ++r) {
    const Role& role = graph.roles[r];
    roles[r].slots.resize(role.outputs.size());
    for (std::size_t k = 0; k < role.outputs.size(); ++k) {
      RoleSlot& role_slot = roles[r].slots[k];
      role_slot.type = role.outputs[k].type;
      role_slot.queues.clear();
      role_slot.plans.assign(role.fillers.size(), CopyPlan{});
      role_slot.copy.resize(role_slot.type ? role_slot.type->size : 0);
      const Slot* const current = std::exchange(role_slot.current, nullptr);
      for (std::size_t f = 0; f < role.fillers.size(); ++f) {
        const int output = role.provides[f][k];
        if (output < 0) continue;
        Slot& slot = units[static_cast<std::size_t>(role.fillers[f])]->out.slots[static_cast<std::size_t>(output)];
        slot.role = &role_slot;
        slot.filler = static_cast<int>(f);
        role_slot.plans[f] = copy_plan(*slot.port->type, *role_slot.type);
        if (&slot == current) role_slot.current = current;
      }
    }
  }
  for (const auto& unit : units)
    for (Reader& reader : unit->in.readers) wire_reader(*unit, reader);
  find_told();
  if (graph.vehicle < 0) return;
  find_flags();
  for (const Wire& w : graph.components[static_cast<std::size_t>(graph.vehicle)].wires)
    if (w.from.kind == Source::Kind::role) drives_vehicle[static_cast<std::size_t>(w.from.index)] = true;
}

void Flight::Impl::find_flags() {
  const auto view = [this](const VehicleFlag& flag) { return FlagView{slot_of(flag.from), flag.offset}; };
  armed_flag = view(graph.flags.armed);
  ground_flag = view(graph.flags.on_ground);
  control_flag = view(graph.flags.in_control);
}

void Flight::Impl::find_told() {
  tells.clear();
  const auto add = [&](int component, int output) {
    if (output < 0) return;
    const Slot& slot = units[static_cast<std::size_t>(component)]->out.slots[static_cast<std::size_t>(output)];
    Told told{&slot, slot.port->type->find("text"), slot.port->type->find("severity"), {}};
    if (!told.text || told.text->kind != FULMAR_TEXT) return;
    if (!told.severity) told.severity = slot.port->type->find("level");
    if (told.severity && (told.severity->kind != FULMAR_ENUM || told.severity->shape != FULMAR_SCALAR)) told.severity = nullptr;
    if (slot.port->kind == FULMAR_OUT_VALUE) told.last.assign(told.text->stride, '\0');
    tells.push_back(std::move(told));
  };
  for (const Source& source : graph.tell) {
    if (source.kind == Source::Kind::component) add(source.index, source.output);
    if (source.kind != Source::Kind::role) continue;
    const Role& role = graph.roles[static_cast<std::size_t>(source.index)];
    for (std::size_t f = 0; f < role.fillers.size(); ++f) add(role.fillers[f], role.provides[f][static_cast<std::size_t>(source.output)]);
  }
}

/// An input that is fed from outside reads a slot that no component writes.
void Flight::Impl::import_into(const Unit& unit, Reader& reader) {
  Import& import = imports[static_cast<std::size_t>(reader.wire->import)];
  import.reader = &reader;
  import.slot.port = reader.port;
  import.slot.size = reader.port->type->size;
  import.slot.published.resize(import.slot.size);
  if (reader.port->kind != FULMAR_IN_VALUE) return;
  reader.slot = &import.slot;
  reader.plans.push_back(copy_plan(*reader.port->type, *reader.port->type));
  // Nobody here can tell whether it still comes: a law must not fly on what has fallen silent.
  reader.guarded = !reader.port->optional && unit.component->role >= 0;
  if (reader.guarded && reader.max_age_ns == 0) reader.max_age_ns = default_max_age_ns;
}

void Flight::Impl::wire_reader(Unit& unit, Reader& reader) {
  const Source& from = reader.wire->from;
  reader.plans.clear();
  reader.slot = nullptr, reader.role = nullptr;
  reader.copied = 0;
  if (reader.wire->import >= 0) return import_into(unit, reader);
  if (from.kind == Source::Kind::none) return;
  const bool value = reader.port->kind == FULMAR_IN_VALUE;
  if (from.kind == Source::Kind::component) {
    Slot& slot = units[static_cast<std::size_t>(from.index)]->out.slots[static_cast<std::size_t>(from.output)];
    reader.slot = &slot;
    reader.plans.push_back(copy_plan(*slot.port->type, *reader.port->type));
    if (!value) slot.queues.emplace_back(&reader, &reader.plans.front());
  } else {
    const Role& role = graph.roles[static_cast<std::size_t>(from.index)];
    RoleSlot& slot = roles[static_cast<std::size_t>(from.index)].slots[static_cast<std::size_t>(from.output)];
    reader.role = &slot;
    for (std::size_t f = 0; f < role.fillers.size(); ++f) {
      const int output = role.provides[f][static_cast<std::size_t>(from.output)];
      const Unit& filler = *units[static_cast<std::size_t>(role.fillers[f])];
      reader.plans.push_back(output < 0 ? CopyPlan{}
                                        : copy_plan(*filler.out.slots[static_cast<std::size_t>(output)].port->type, *reader.port->type));
    }
    if (!value) slot.queues.emplace_back(&reader, reader.plans);
    // What a role publishes is watched: a law that is fed by nobody must not fly on. Sensors come and go, estimators know.
    const bool watched = value && !reader.port->optional && unit.component->role >= 0 && !unit.info->vehicle &&
                         role.fillers.end() == std::find(role.fillers.begin(), role.fillers.end(), graph.vehicle);
    if (watched && reader.max_age_ns == 0) reader.max_age_ns = default_max_age_ns;
  }
  reader.guarded = reader.max_age_ns > 0 && !reader.port->optional && unit.component->role >= 0;
  reader.delayed = value && reader.wire->delayed;
  if (reader.delayed) delayed.push_back(&reader);
  for (const CopyPlan& plan : reader.plans)
    if (reader.delayed || !plan.whole) reader.copy.assign(reader.port->type->size, std::byte{0});
}

std::int64_t Flight::Impl::record_period(const std::string& port, const Slot& slot) const {
  if (slot.owner->info->vehicle || slot.owner->component->run == RunMode::driver) return 0;  // a replay needs all of it
  for (const RecordRule& rule : graph.record_rules) {
    if (rule.ports.empty()) return rule.period_ns;
    for (const std::string& pattern : rule.ports)
      if (port_matches(port, pattern)) return rule.period_ns;
  }
  if (!graph.record_rules.empty()) return -1;
  return slot.port->kind == FULMAR_OUT_QUEUE ? 0 : default_period_ns;
}

std::vector<TapChannel> Flight::Impl::channels() {
  std::vector<TapChannel> list;
  const auto find = [&](const std::string& topic) {
    return static_cast<std::size_t>(std::find_if(list.begin(), list.end(), [&](const TapChannel& c) { return c.topic == topic; }) -
                                    list.begin());
  };
  const auto channel = [&](std::string topic, const TypePtr& type) {
    std::replace(topic.begin(), topic.end(), '.', '/');
    list.push_back({"/" + topic, type});
    return list.size() - 1;
  };
  // Who fills a role publishes as the role: one topic, whoever flies. Under its own name when its message has other fields than theirs.
  const auto shared = [&](std::string name, const std::string& own, const TypePtr& type) {
    std::replace(name.begin(), name.end(), '.', '/');
    const std::size_t at = find("/" + name);
    if (at == list.size()) return channel(name, type);
    return list[at].type->hash == type->hash ? at : channel(own, type);
  };
  event_channel = channel("fulmar.event", host_type<Event>());
  ticks_channel = channel("fulmar.ticks", host_type<Ticks>());
  parameter_channel = channel("fulmar.parameter", host_type<CommandNote>());
  command_channel = channel("fulmar.command", host_type<CommandNote>());
  for (const auto& unit : units) {
    const Component& c = *unit->component;
    const bool stored_whole = c.info().vehicle || c.run == RunMode::driver;
    for (std::size_t i = 0; i < unit->out.slots.size(); ++i) {
      Slot& slot = unit->out.slots[i];
      if (!slot.port->type) continue;
      const std::string name = topic_name(graph, c, i);
      slot.log.channel = shared(name, c.name + "." + slot.port->name, slot.port->type);
      if (slot.port->kind == FULMAR_OUT_EVENT) list[slot.log.channel].may_stay_silent = true;
      slot.log.period_ns = record_period(name, slot);
      if (!stored_whole) slot.hash = std::make_unique<MessageHash>(*slot.port->type);
    }
    for (Reader& reader : unit->in.readers)
      if (reader.port->kind == FULMAR_IN_REQUEST || reader.wire->import >= 0)
        reader.channel = static_cast<int>(channel(c.name + "." + reader.port->name, reader.port->type));
    if (unit->out.probes.outputs.empty()) continue;
    unit->out.probes.log.period_ns = record_period(c.name + ".probes", unit->out.slots[unit->out.probes.outputs.front()]);
    unit->out.probes.log.channel = channel(c.name + ".probes", probes_type(*c.plugin, c.info()));
  }
  return list;
}

void Flight::Impl::open_tap() {
  const bool logs = options.log && graph.record;
  const bool shown = !unpaced() && (graph.live.on || graph.dds.on);  // as fast as possible is too fast for onlookers
  if (!logs && !shown) return;
  tap = std::make_unique<Tap>(channels());
  if (logs) open_log();
  if (shown) open_to_others();
}

/// Its threads are begun here, before the loop's thread is bound to a CPU and given its priority, which they must not inherit.
void Flight::Impl::open_to_others() {
  if (graph.live.on) {
    try {
      live::check_options(graph.live);
    } catch (const Error& fault) {
      throw Error(graph.live.where.text() + ": " + fault.what());
    }
  }
  control = std::make_unique<FlightControl>(*this);
  if (graph.dds.on) dds_bridge = std::make_unique<DdsBridge>(*tap, *control, graph.dds);
  if (!graph.live.on) return;
  try {
    live_server = std::make_unique<LiveServer>(*tap, *control, graph.live);
  } catch (const Error& fault) {  // another flight on this computer is no reason not to fly
    if (options.say) options.say(std::string("nobody can watch this flight: ") + fault.what(), true);
  }
}

void Flight::Impl::open_log() {
  Log::Options o;
  o.file = options.log_file;
  o.epoch_ns = graph.epoch_ns;
  o.wait = unpaced();
  o.rotate_bytes = graph.rotate_bytes, o.rotate_ns = graph.rotate_ns;
  o.lasting = lasting();
  // What the host says and what comes from outside, always. A role's topic when anybody who fills it is recorded.
  o.channels.assign(tap->channels().size(), true);
  const auto each = [&](auto&& set) {
    for (const auto& unit : units) {
      for (const Slot& slot : unit->out.slots)
        if (slot.port->type) set(slot.log.channel, slot.log.period_ns);
      if (!unit->out.probes.outputs.empty()) set(unit->out.probes.log.channel, unit->out.probes.log.period_ns);
    }
  };
  each([&](std::size_t channel, std::int64_t) { o.channels[channel] = false; });
  each([&](std::size_t channel, std::int64_t period_ns) { o.channels[channel] = o.channels[channel] || period_ns >= 0; });
  log = std::make_unique<Log>(o, *tap);
  attach_texts();
}

std::string Flight::Impl::parameters_text() const {
  nlohmann::json all = nlohmann::json::object();
  for (const auto& unit : units) {
    nlohmann::json& mine = all[unit->component->name] = nlohmann::json::object();
    for (std::size_t i = 0; i < unit->base.size(); ++i) {
      const ParamInfo& p = unit->info->params[i];
      const ParamValue& v = unit->base[i];
      switch (p.kind) {
        case FULMAR_NUMBER:
          mine[p.name] = v.number[0];
          break;
        case FULMAR_FLAG:
          mine[p.name] = v.integer != 0;
          break;
        case FULMAR_COUNT:
          mine[p.name] = v.integer;
          break;
        case FULMAR_CHOICE:
          mine[p.name] = p.choices.at(static_cast<std::size_t>(v.integer));
          break;
        case FULMAR_VECTOR:
          mine[p.name] = {v.number[0], v.number[1], v.number[2]};
          break;
        case FULMAR_RECORD:
          mine[p.name] = to_json(*p.type, v.data.data(), false);
          break;
        default:
          mine[p.name] = v.text;
          break;
      }
    }
  }
  return all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

namespace {

/// What the command line changed, so that a replay can do the same.
std::vector<std::pair<std::string, std::string>> overrides_text(const Overrides& o) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (o.io) pairs.emplace_back("io", *o.io);
  if (o.seed) pairs.emplace_back("seed", std::to_string(*o.seed));
  for (const auto& [role, component] : o.roles) pairs.emplace_back("role " + role, component);
  for (const auto& [param, value] : o.set) pairs.emplace_back("set " + param, value);
  return pairs;
}

}  // namespace

void Flight::Impl::attach_texts() {
  for (const auto& [name, text] : graph.attachments) log->attach(name, "application/yaml", text);
  log->attach("parameters.json", "application/json", parameters_text());
  std::string order;
  for (const int i : graph.order) order += graph.components[static_cast<std::size_t>(i)].name + "\n";
  log->attach("order.txt", "text/plain", order);
  std::vector<std::pair<std::string, std::string>> plugins;
  std::vector<const PluginInfo*> loaded;
  for (const Component& c : graph.components) {
    const PluginInfo& p = *c.plugin;
    for (const auto& [key, value] : flown_pairs(p)) plugins.emplace_back(c.name + "." + key, value);
    if (std::find(loaded.begin(), loaded.end(), &p) == loaded.end()) loaded.push_back(&p);
  }
  log->attach("sbom.json", "application/json", sbom_text(loaded));
  log->metadata("plugins", plugins);
  log->metadata("overrides", overrides_text(graph.overrides));
  log->metadata("fulmar", {{"version", FULMAR_VERSION},
                           {"abi", std::to_string(FULMAR_ABI_MAJOR) + "." + std::to_string(FULMAR_ABI_MINOR)},
                           {"toolchain", __VERSION__},
                           {"mission", graph.mission},
                           {"io", io_word(graph.io)},
                           {"epoch_ns", std::to_string(graph.epoch_ns)},
                           {"seed", std::to_string(graph.seed)}});
}

}  // namespace fulmar::core
