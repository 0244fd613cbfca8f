// SPDX-License-Identifier: BSD-3-Clause
// Replaces the file of a component between ticks, on the ground.
#include "core/graph/params.hpp"
#include "core/run/command/swap_checks.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/messages.hpp"
#include "core/run/state/published.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

void Flight::Impl::swap(int at, const std::string& file) {
  const std::string& name = wiring.unit(at).component->name;
  if (at == state.graph.vehicle) throw Error(run_messages::vehicle_not_swappable(name));
  if (state.graph.source.file.empty()) throw Error(run_messages::mission_file_missing());
  if (const std::string why = protection.in_use(); !why.empty())
    throw Error(run_messages::swap_not_possible(name, why));
  replace(at, file);
}

namespace {

/// The first output that only one of the two has, or that differs.
std::string what_differs(const Component& was, const Component& is) {
  for (const Port& port : is.info().outputs)
    if (was.info().output(port.name) < 0) return run_messages::output_added(port.name).line();
  for (const Port& port : was.info().outputs)
    if (is.info().output(port.name) < 0) return run_messages::output_removed(port.name).line();
  for (const Port& port : was.info().outputs)
    if (port.type && nth(is.info().outputs, is.info().output(port.name)).type->hash != port.type->hash)
      return run_messages::output_type_changed(port.name).line();
  return run_messages::outputs_changed().line();
}

/// The log of a flight has channels only for the ports of its start.
void check_ports(const Component& was, const Component& is) {
  for (const Port& port : was.info().outputs) {
    const int k = is.info().output(port.name);
    if (k >= 0 && was.info().outputs.size() == is.info().outputs.size() &&
        (!port.type || nth(is.info().outputs, k).type->hash == port.type->hash))
      continue;
    throw Error(located(was.name, run_messages::outputs_differ(what_differs(was, is))));
  }
  if (!same_entrances(was, is))
    throw Error(located(was.name, run_messages::entrances_differ(was.plugin->file)));
}

}  // namespace

/// Reads the mission again with the new file; faults have the same messages as at the start.
void Flight::Impl::replace(int at, const std::string& file) {
  const Graph& graph = state.graph;
  const Unit& old = wiring.unit(at);
  const std::string name = old.component->name;
  check_unloads(*old.component->plugin, *old.info);
  Overrides overrides = graph.source.overrides;
  std::erase_if(overrides.with, [&](const auto& with) { return with.first == name; });
  overrides.with.emplace_back(name, file);
  overrides.swaps = name;
  Graph next = load_mission(graph.source.file, overrides);
  if (const std::string difference = structural_difference(graph, next); !difference.empty())
    throw Error(run_messages::mission_changed(graph.source.file, difference));
  Component& successor = nth(next.components, at);
  check_ports(*old.component, successor);
  const std::string words = parameter_words(*old.info, old.base, successor.info(), successor.params);
  carry_parameters(*old.info, old.base, successor.info(), successor.params);
  if (successor.run != RunMode::driver) rehearse_successor(old, successor);
  install(at, std::move(next), words);
}

/// On the last inputs of its predecessor or, before the first step, on the present ones.
void Flight::Impl::rehearse_successor(const Unit& old, const Component& successor) {
  std::unique_ptr<Tape> now;
  const Tape* tape = old.tape.get();
  if (!tape || tape->size() == 0) {
    now = wiring.unit(wiring.index_of(old)).present_inputs(state.now_ns, state.index);
    tape = now.get();
  }
  const std::uint64_t seed = component_seed(state.graph.seed, successor.name);
  rehearse(successor, state.graph.tick_ns, seed, same_inputs(*old.info, successor.info()) ? tape : nullptr);
}

/// A configured unit replaces another; pending requests of the old one are rejected with `why`.
void Flight::Impl::put_in_place(int at, std::unique_ptr<Unit> fresh, const char* why) {
  std::unique_ptr<Unit>& place = nth(wiring.units, at);
  fresh->active = place->active;
  fresh->keep_log_settings(*place);
  place->in.refuse_requests(why);
  place = std::move(fresh);
  connect();
  if (const std::vector<Overlay>* overlay = roles.overlay_of(at); overlay) place->retune(overlay);
}

/// A new child for a component whose child has died, with the present parameters.
void Flight::Impl::restart(int at) {
  const Unit& old = wiring.unit(at);
  std::unique_ptr<Unit> fresh = wiring.make_unit(*old.component);
  fresh->base = old.base;
  fresh->configure();
  put_in_place(at, std::move(fresh), "was started anew");
}

/// From here on only an end of the host can interrupt the swap: the new unit exists before the old one is
/// removed.
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
  graph.judge = std::move(next.judge);
  graph.source.overrides = std::move(next.source.overrides);
  put_in_place(at, std::move(fresh), "was swapped");
  swapped[at] = words;
  const PluginInfo& plugin = *graph.components[i].plugin;
  Event e = event_of(Code::swapped, before.name);
  say(e, run_messages::plugin_swapped, version_words(*before.plugin), version_words(plugin),
      words.empty() ? "" : "; ", words);
  recorder.note(e);
  recorder.put_command(command);
  recorder.note_swap(before.name, plugin);
  commands = std::make_shared<const CommandTable>(graph);
  next = Graph{};
  if (before.library && before.library.use_count() == 1) Library::unload(std::move(before.library));
}

}  // namespace fulmar::core
