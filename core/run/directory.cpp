// SPDX-License-Identifier: BSD-3-Clause
// A description of the flight for clients.
#include <cstring>
#include <filesystem>

#include "core/graph/live_options.hpp"
#include "core/run/control_impl.hpp"
#include "core/run/flight_impl.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

std::string source_name(const Graph& graph, const Wire& wire) {
  if (wire.from.kind == Source::Kind::none) return "";
  const auto index = static_cast<std::size_t>(wire.from.index),
             output = static_cast<std::size_t>(wire.from.output);
  if (wire.from.kind == Source::Kind::role)
    return graph.roles[index].name + "." + graph.roles[index].outputs[output].name;
  const Component& c = graph.components[index];
  return c.name + "." + c.info().outputs[output].name;
}

/// The mission's origin, from a component whose parameter `origin` is given.
std::optional<Geodetic> origin_of(const Graph& graph) {
  for (const Component& c : graph.components) {
    const auto& params = c.info().params;
    for (std::size_t i = 0; i < params.size(); ++i) {
      if (params[i].kind != FULMAR_RECORD || params[i].name != "origin" || !params[i].type) continue;
      const auto at = [&](const char* name, fulmar_kind kind) -> const std::byte* {
        const Field* const field = params[i].type->find(name);
        return field && field->kind == kind ? c.params[i].data.data() + field->offset : nullptr;
      };
      const std::byte* const given = at("given", FULMAR_BOOL);
      if (!given || *given == std::byte{0}) continue;
      Geodetic origin;
      bool whole = true;
      for (const auto& [name, to] :
           {std::pair("lat_deg", &origin.lat_deg), std::pair("lon_deg", &origin.lon_deg),
            std::pair("alt_msl_m", &origin.alt_msl_m)}) {
        const std::byte* const from = at(name, FULMAR_F64);
        whole = whole && from;
        if (from) std::memcpy(to, from, sizeof *to);
      }
      if (whole) return origin;
    }
  }
  return std::nullopt;
}

ComponentView view_of(const Flight::Impl& flight, const Unit& unit) {
  static constexpr const char* modes[] = {"tick", "process", "async", "driver"};
  const Component& c = *unit.component;
  ComponentView v;
  v.name = c.name;
  v.use = c.use;
  v.doc = c.info().doc;
  v.run = modes[static_cast<std::size_t>(c.run)];
  v.budget_us = 1e-3 * static_cast<double>(c.budget_ns);
  for (const int role : c.roles)
    v.role += (v.role.empty() ? "" : ", ") + nth(flight.state.graph.roles, role).name;
  for (std::size_t i = 0; i < c.info().params.size(); ++i)
    v.params.push_back({c.info().params[i], unit.base[i], false});
  for (std::size_t i = 0; i < unit.in.readers.size(); ++i) {
    const Reader& r = unit.in.readers[i];
    PortView port{r.port->name, r.port->type, source_name(flight.state.graph, c.wires[i])};
    port.request = r.port->kind == FULMAR_IN_REQUEST;
    port.imported = c.wires[i].import >= 0;
    port.channel = r.channel;
    v.inputs.push_back(std::move(port));
  }
  for (const Slot& s : unit.out.slots) {
    PortView port{s.port->name, s.port->type, ""};
    port.channel = static_cast<int>(s.port->type ? s.log.channel : unit.out.probes.log.channel);
    v.outputs.push_back(std::move(port));
  }
  return v;
}

}  // namespace

FlightControl::Directory::Directory(const Flight::Impl& flight) : commands(flight.commands) {
  if (!flight.state.graph.source.file.empty())
    view.file = std::filesystem::absolute(flight.state.graph.source.file).string();
  view.mission = flight.state.graph.mission;
  view.io = io_word(flight.state.graph.io);
  view.epoch_ns = flight.state.graph.epoch_ns;
  view.seed = flight.state.graph.seed;
  view.origin = origin_of(flight.state.graph);
  view.map.tiles = flight.state.graph.live.tiles;
  view.map.attribution = flight.state.graph.live.attribution;
  view.no_save = why_no_save(flight.state.graph.live);
  for (const auto& [name, text] : flight.state.graph.source.overrides.set) view.set.push_back(name);
  for (const Phase& p : flight.state.graph.phases) {
    view.phase.all.push_back(p.name);
    overlaid.emplace_back();
    for (const Assignment& a : p.roles)
      for (const Overlay& o : a.set)
        overlaid.back().emplace_back(static_cast<std::size_t>(a.component),
                                     static_cast<std::size_t>(o.param));
  }
  for (const auto& unit : flight.wiring.units) view.components.push_back(view_of(flight, *unit));
  for (const auto& [component, words] : flight.swapped) nth(view.components, component).swapped = words;
}

}  // namespace fulmar::core
