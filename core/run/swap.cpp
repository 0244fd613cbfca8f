// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/swap.hpp"

#include <algorithm>
#include <tuple>

#include "core/graph/params.hpp"
#include "core/loader/probe.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/flown_plugin.hpp"

namespace fulmar::core {

std::string version_words(const PluginInfo& plugin) {
  return plugin.file + " " + plugin.version + " (" + plugin.sha256.substr(0, 12) + ")";
}

void carry_parameters(const ComponentInfo& from, const std::vector<ParamValue>& values, const ComponentInfo& to,
                      std::vector<ParamValue>& into) {
  for (std::size_t i = 0; i < from.params.size(); ++i) {
    const ParamInfo& old = from.params[i];
    const int k = to.param(old.name);
    if (k < 0) continue;
    const ParamInfo& now = to.params[static_cast<std::size_t>(k)];
    if (now.kind != old.kind || now.choices != old.choices) continue;
    if ((now.kind == FULMAR_RECORD || now.kind == FULMAR_VECTOR) && now.type->hash != old.type->hash) continue;
    const double number = now.kind == FULMAR_NUMBER ? values[i].number[0] : static_cast<double>(values[i].integer);
    const bool ranged = now.kind == FULMAR_NUMBER || now.kind == FULMAR_COUNT;
    if (ranged && !(number >= now.min && number <= now.max))
      throw Error("its parameter '" + now.name + "' does not allow the present value " + value_text(old, values[i]));
    into[static_cast<std::size_t>(k)] = values[i];
  }
}

std::string structural_difference(const Graph& now, const Graph& next) {
  const auto differs = [](const auto& a, const auto& b, auto same) {
    if (a.size() != b.size()) return true;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same(a[i], b[i])) return true;
    return false;
  };
  const auto same_component = [](const Component& a, const Component& b) {
    return a.name == b.name && a.role == b.role && a.period_ns == b.period_ns && a.run == b.run;
  };
  if (differs(now.components, next.components, same_component)) return "other components";
  if (differs(now.roles, next.roles, [](const Role& a, const Role& b) { return a.name == b.name && a.fillers == b.fillers; }))
    return "other roles";
  if (differs(now.phases, next.phases, [](const Phase& a, const Phase& b) { return a.name == b.name; })) return "other phases";
  if (now.order != next.order) return "another order of steps";
  if (now.tick_ns != next.tick_ns || now.io != next.io) return "another rate or io";
  const auto same_import = [](const auto& a, const auto& b) {
    return a.component == b.component && a.input == b.input && a.topic == b.topic;
  };
  if (differs(now.dds.imports, next.dds.imports, same_import)) return "other imports";
  return "";
}

void check_unloads(const PluginInfo& was, const ComponentInfo& component) {
  if (component.resident || !was.script.empty() || !stays_mapped(was.copy)) return;
  throw Error(was.file +
              " cannot be unloaded (a unique symbol or a thread-local destructor keeps it): the new file would fly its code. "
              "Restart the host");
}

bool same_inputs(const ComponentInfo& a, const ComponentInfo& b) {
  return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(), [](const Port& x, const Port& y) {
    return x.name == y.name && x.kind == y.kind && x.capacity == y.capacity && x.type->hash == y.type->hash;
  });
}

/// What comes in from outside, in order: requests and imported inputs.
bool same_entrances(const Component& a, const Component& b) {
  const auto entrances = [](const Component& c) {
    std::vector<std::tuple<std::string, std::uint32_t, std::uint64_t, int>> list;
    for (std::size_t i = 0; i < c.info().inputs.size(); ++i)
      if (const Port& port = c.info().inputs[i]; port.kind == FULMAR_IN_REQUEST || c.wires[i].import >= 0)
        list.emplace_back(port.name, port.capacity, port.type->hash, c.wires[i].import);
    return list;
  };
  return entrances(a) == entrances(b);
}

void rehearse(const Component& component, std::int64_t tick_ns, std::uint64_t seed, const Tape* tape) {
  Component in_child = component;
  in_child.run = RunMode::process;
  UnitOptions options;
  options.tick_ns = tick_ns;
  options.seed = seed;
  Unit unit(in_child, std::move(options));
  unit.configure();
  if (tape && !unit.rehearse(*tape)) throw Error(std::string(unit.problem.text));
}

// ---- in a flight that goes on -----------------------------------------------------------------------------------------------

std::string Flight::Impl::in_use() const {
  if (armed_flag.says(false)) return "the aircraft is armed";
  return ground_flag.says(true) ? "" : "the aircraft is in the air";
}

void Flight::Impl::swap(std::size_t at, const std::string& file) {
  const std::string& name = units[at]->component->name;
  if (static_cast<int>(at) == graph.vehicle)
    throw Error(name + " is the vehicle: it holds the aircraft, and is changed when no flight goes on");
  if (graph.file.empty()) throw Error("this flight was not read from a mission file: nothing can be swapped in it");
  if (const std::string why = in_use(); !why.empty())
    throw Error(name + " cannot be swapped: " + why + ". A component is swapped on the ground, disarmed");
  replace(at, file);
}

/// Reads the mission again with the new file; what is in the way is told by the same sentences as at the start.
void Flight::Impl::replace(std::size_t at, const std::string& file) {
  Unit& old = *units[at];
  const std::string name = old.component->name;
  check_unloads(*old.component->plugin, *old.info);
  Overrides overrides = graph.overrides;
  std::erase_if(overrides.with, [&](const auto& with) { return with.first == name; });
  overrides.with.emplace_back(name, file);
  Graph next = load_mission(graph.file, overrides);
  if (const std::string difference = structural_difference(graph, next); !difference.empty())
    throw Error(graph.file + " has changed since this flight began (" + difference + "): end it, and fly again");
  Component& component = next.components[at];
  const ComponentInfo &was = *old.info, &is = component.info();
  for (const Port& port : was.outputs) {
    const int k = is.output(port.name);
    if (k < 0 || (port.type && is.outputs[static_cast<std::size_t>(k)].type->hash != port.type->hash) ||
        was.outputs.size() != is.outputs.size())
      throw Error(name + ": its outputs are not those of " + old.component->plugin->file +
                  ", and the log of this flight has room for those alone");
  }
  if (!same_entrances(*old.component, component))
    throw Error(name + ": its requests and imported inputs are not those of " + old.component->plugin->file +
                ", and the log of this flight has room for those alone");
  carry_parameters(was, old.base, is, component.params);
  const std::uint64_t seed = component_seed(graph.seed, name);
  std::unique_ptr<Tape> now;  // nobody has stepped it yet: what it would see now
  const Tape* tape = old.tape.get();
  if (component.run != RunMode::driver) {
    if (!tape || tape->size() == 0) now = old.present_inputs(now_ns, index), tape = now.get();
    rehearse(component, graph.tick_ns, seed, same_inputs(was, is) ? tape : nullptr);
  }
  install(at, std::move(next));
}

/// A new child for a component whose child has died; parameters are those of now.
void Flight::Impl::restart(std::size_t i) {
  Unit& old = *units[i];
  auto fresh = std::make_unique<Unit>(graph.components[i], unit_options(graph.components[i]));
  fresh->base = old.base;
  fresh->configure();
  fresh->active = old.active;
  fresh->keep_log_settings(old);
  old.in.refuse_requests("was started anew");
  units[i] = std::move(fresh);
  connect();
  if (const std::vector<Overlay>* overlay = overlay_of(static_cast<int>(i)); overlay) units[i]->retune(overlay);
}

/// From here on nothing can fail but what ends the host: the newcomer has been created before the old one goes.
void Flight::Impl::install(std::size_t i, Graph&& next) {
  Component before = graph.components[i];
  const CommandNote command = swap_note(before.name, *next.components[i].plugin);
  const bool active = units[i]->active;
  Unit& old = *units[i];
  std::swap(graph.components[i], next.components[i]);
  std::unique_ptr<Unit> fresh;
  try {
    fresh = std::make_unique<Unit>(graph.components[i], unit_options(graph.components[i]));
    fresh->configure();
  } catch (...) {
    std::swap(graph.components[i], next.components[i]);
    throw;
  }
  fresh->active = active;
  fresh->keep_log_settings(old);
  graph.phases = std::move(next.phases);
  graph.any = std::move(next.any);
  graph.roles = std::move(next.roles);
  graph.done = std::move(next.done), graph.failed = std::move(next.failed);
  graph.overrides = std::move(next.overrides);
  old.in.refuse_requests("was swapped");
  units[i] = std::move(fresh);
  connect();
  if (const std::vector<Overlay>* overlay = overlay_of(static_cast<int>(i)); overlay) units[i]->retune(overlay);
  const PluginInfo& plugin = *graph.components[i].plugin;
  Event e = event_of(Code::swapped, before.name);
  say(e, "swapped: %s -> %s", version_words(*before.plugin).c_str(), version_words(plugin).c_str());
  note(e);
  put_command(command);
  if (log) {
    auto pairs = flown_pairs(plugin);
    pairs.emplace(pairs.begin(), "component", before.name);
    log->metadata("swap", pairs);
  }
  commands = std::make_shared<const CommandTable>(graph);
  next = Graph{};
  if (before.library && before.library.use_count() == 1) Library::unload(std::move(before.library));
}

}  // namespace fulmar::core
