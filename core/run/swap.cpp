// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/swap.hpp"

#include <algorithm>
#include <tuple>

#include "core/graph/params.hpp"
#include "core/loader/probe.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/published.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

std::string version_words(const PluginInfo& plugin) {
  return plugin.file + " " + plugin.version + " (" + plugin.sha256.substr(0, 12) + ")";
}

namespace {

bool can_carry(const ParamInfo& old, const ParamInfo& now) {
  if (now.kind != old.kind || now.choices != old.choices) return false;
  return (now.kind != FULMAR_RECORD && now.kind != FULMAR_VECTOR) || now.type->hash == old.type->hash;
}

std::string listed(const char* what, const std::vector<std::string>& items) {
  return items.empty() ? "" : std::string("; ") + what + join(items);
}

}  // namespace

std::string parameter_words(const ComponentInfo& from, const std::vector<ParamValue>& values,
                            const ComponentInfo& to, const std::vector<ParamValue>& into) {
  std::vector<std::string> kept, fresh, gone;
  for (std::size_t k = 0; k < to.params.size(); ++k) {
    const ParamInfo& now = to.params[k];
    const int i = from.param(now.name);
    if (i < 0 || !can_carry(nth(from.params, i), now)) {
      fresh.push_back(now.name + " = " + value_text(now, into[k]));
      continue;
    }
    const ParamInfo& old = nth(from.params, i);
    const std::string is = value_text(old, nth(values, i)), usual = value_text(now, initial_value(now));
    if (usual != value_text(old, initial_value(old)) && is != usual && is != value_text(now, into[k]))
      kept.push_back(now.name + " = " + is + " (new default " + usual + ")");
  }
  for (const ParamInfo& old : from.params)
    if (const int k = to.param(old.name); k < 0) gone.push_back(old.name);
  const std::string all = listed("keeps ", kept) + listed("new: ", fresh) + listed("gone: ", gone);
  return all.empty() ? all : all.substr(2);
}

void carry_parameters(const ComponentInfo& from, const std::vector<ParamValue>& values,
                      const ComponentInfo& to, std::vector<ParamValue>& into) {
  for (std::size_t i = 0; i < from.params.size(); ++i) {
    const ParamInfo& old = from.params[i];
    const int k = to.param(old.name);
    if (k < 0) continue;
    const ParamInfo& now = nth(to.params, k);
    if (!can_carry(old, now)) continue;
    const double number =
        now.kind == FULMAR_NUMBER ? values[i].number[0] : static_cast<double>(values[i].integer);
    const bool ranged = now.kind == FULMAR_NUMBER || now.kind == FULMAR_COUNT;
    if (ranged && !(number >= now.min && number <= now.max))
      throw Error("its parameter '" + now.name + "' does not allow the present value " +
                  value_text(old, values[i]));
    nth(into, k) = values[i];
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
    return a.name == b.name && a.roles == b.roles && a.period_ns == b.period_ns && a.run == b.run;
  };
  if (differs(now.components, next.components, same_component)) return "other components";
  if (differs(now.roles, next.roles,
              [](const Role& a, const Role& b) { return a.name == b.name && a.fillers == b.fillers; }))
    return "other roles";
  if (differs(now.phases, next.phases, [](const Phase& a, const Phase& b) { return a.name == b.name; }))
    return "other phases";
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
              " cannot be unloaded (a unique symbol or a thread-local destructor keeps it): the new file "
              "would fly its code. "
              "Restart the host");
}

bool same_inputs(const ComponentInfo& a, const ComponentInfo& b) {
  return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(),
                    [](const Port& x, const Port& y) {
                      return x.name == y.name && x.kind == y.kind && x.capacity == y.capacity &&
                             x.type->hash == y.type->hash;
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

// ---- in a flight that goes on

void Flight::Impl::swap(int at, const std::string& file) {
  const std::string& name = wiring.unit(at).component->name;
  if (at == state.graph.vehicle)
    throw Error(name + " is the vehicle: it holds the aircraft, and is changed when no flight goes on");
  if (state.graph.file.empty())
    throw Error("this flight was not read from a mission file: nothing can be swapped in it");
  if (const std::string why = protection.in_use(); !why.empty())
    throw Error(name + " cannot be swapped: " + why + ". A component is swapped on the ground, disarmed");
  replace(at, file);
}

namespace {

/// The first output that one of the two has and the other has not, or not so.
std::string what_differs(const Component& was, const Component& is) {
  for (const Port& port : is.info().outputs)
    if (was.info().output(port.name) < 0) return "the new file has an output '" + port.name + "' more";
  for (const Port& port : was.info().outputs)
    if (is.info().output(port.name) < 0) return "the new file has no output '" + port.name + "'";
  for (const Port& port : was.info().outputs)
    if (port.type && nth(is.info().outputs, is.info().output(port.name)).type->hash != port.type->hash)
      return "the message of its output '" + port.name + "' has changed";
  return "its outputs are not those that it had";
}

/// The log of a flight has room for the ports that it began with.
void check_ports(const Component& was, const Component& is) {
  for (const Port& port : was.info().outputs) {
    const int k = is.info().output(port.name);
    if (k >= 0 && was.info().outputs.size() == is.info().outputs.size() &&
        (!port.type || nth(is.info().outputs, k).type->hash == port.type->hash))
      continue;
    throw Error(was.name + ": " + what_differs(was, is) +
                "; what leaves a flight is settled when it begins. Start it anew, or fly with --watch");
  }
  if (!same_entrances(was, is))
    throw Error(was.name + ": its requests and imported inputs are not those of " + was.plugin->file +
                ", and the log of this flight has room for those alone");
}

}  // namespace

/// Reads the mission again with the new file; what is in the way is told by the same sentences as at the
/// start.
void Flight::Impl::replace(int at, const std::string& file) {
  const Graph& graph = state.graph;
  const Unit& old = wiring.unit(at);
  const std::string name = old.component->name;
  check_unloads(*old.component->plugin, *old.info);
  Overrides overrides = graph.overrides;
  std::erase_if(overrides.with, [&](const auto& with) { return with.first == name; });
  overrides.with.emplace_back(name, file);
  overrides.swaps = name;
  Graph next = load_mission(graph.file, overrides);
  if (const std::string difference = structural_difference(graph, next); !difference.empty())
    throw Error(graph.file + " has changed since this flight began (" + difference +
                "): end it, and fly again");
  Component& newcomer = nth(next.components, at);
  check_ports(*old.component, newcomer);
  const std::string words = parameter_words(*old.info, old.base, newcomer.info(), newcomer.params);
  carry_parameters(*old.info, old.base, newcomer.info(), newcomer.params);
  if (newcomer.run != RunMode::driver) rehearse_newcomer(old, newcomer);
  install(at, std::move(next), words);
}

/// On what its predecessor saw last, or, when nobody has stepped yet, on what it would see now.
void Flight::Impl::rehearse_newcomer(const Unit& old, const Component& newcomer) {
  std::unique_ptr<Tape> now;
  const Tape* tape = old.tape.get();
  if (!tape || tape->size() == 0) {
    now = wiring.unit(wiring.index_of(old)).present_inputs(state.now_ns, state.index);
    tape = now.get();
  }
  const std::uint64_t seed = component_seed(state.graph.seed, newcomer.name);
  rehearse(newcomer, state.graph.tick_ns, seed, same_inputs(*old.info, newcomer.info()) ? tape : nullptr);
}

/// A configured unit takes the place of another: what asked the old one is told `why`.
void Flight::Impl::put_in_place(int at, std::unique_ptr<Unit> fresh, const char* why) {
  std::unique_ptr<Unit>& place = nth(wiring.units, at);
  fresh->active = place->active;
  fresh->keep_log_settings(*place);
  place->in.refuse_requests(why);
  place = std::move(fresh);
  connect();
  if (const std::vector<Overlay>* overlay = roles.overlay_of(at); overlay) place->retune(overlay);
}

/// A new child for a component whose child has died; parameters are those of now.
void Flight::Impl::restart(int at) {
  const Unit& old = wiring.unit(at);
  std::unique_ptr<Unit> fresh = wiring.make_unit(*old.component);
  fresh->base = old.base;
  fresh->configure();
  put_in_place(at, std::move(fresh), "was started anew");
}

/// From here on nothing can fail but what ends the host: the newcomer has been created before the old one
/// goes.
void Flight::Impl::install(int at, Graph&& next, const std::string& words) {
  Graph& graph = state.graph;
  const auto i = static_cast<std::size_t>(at);
  Component before = graph.components[i];
  const CommandNote command = swap_note(before.name, *next.components[i].plugin);
  std::swap(graph.components[i], next.components[i]);
  std::unique_ptr<Unit> fresh;
  try {
    fresh = wiring.make_unit(graph.components[i]);
    fresh->configure();
  } catch (...) {
    std::swap(graph.components[i], next.components[i]);
    throw;
  }
  graph.phases = std::move(next.phases);
  graph.any = std::move(next.any);
  graph.roles = std::move(next.roles);
  graph.done = std::move(next.done), graph.failed = std::move(next.failed);
  graph.overrides = std::move(next.overrides);
  put_in_place(at, std::move(fresh), "was swapped");
  swapped[at] = words;
  const PluginInfo& plugin = *graph.components[i].plugin;
  Event e = event_of(Code::swapped, before.name);
  say(e, "swapped: %s -> %s%s%s", version_words(*before.plugin).c_str(), version_words(plugin).c_str(),
      words.empty() ? "" : "; ", words.c_str());
  recorder.note(e);
  recorder.put_command(command);
  recorder.note_swap(before.name, plugin);
  commands = std::make_shared<const CommandTable>(graph);
  next = Graph{};
  if (before.library && before.library.use_count() == 1) Library::unload(std::move(before.library));
}

}  // namespace fulmar::core
