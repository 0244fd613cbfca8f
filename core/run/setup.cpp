// SPDX-License-Identifier: BSD-3-Clause
// Set-up of a flight: its components are created, connected and configured, its log and its interfaces are
// opened.
#include <algorithm>

#include "core/graph/live_options.hpp"
#include "core/loader/home.hpp"
#include "core/run/control.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/host_library.hpp"
#include "core/run/messages.hpp"
#include "core/say.hpp"
#include "core/types/named.hpp"
#include "links/dds/library.hpp"
#include "links/live/library.hpp"

namespace fulmar::core {
namespace {

const FlightOptions& checked(const Graph& graph, const FlightOptions& options) {
  const bool driven = std::any_of(graph.components.begin(), graph.components.end(),
                                  [](const Component& c) { return c.run == RunMode::driver; });
  if (!options.drivers_from.empty() && !driven)
    throw Error(run_messages::driver_missing(options.drivers_from.string(), graph.mission));
  return options;
}

const LiveLibrary& live_library(const LiveOptions& live) {
  try {
    check_live_options(live);
  } catch (const Error& fault) {
    throw Error(located(live.where, fault.diagnostic));
  }
  return host_library<LiveLibrary>(live.where);
}

}  // namespace

Flight::Impl::Impl(const Graph& graph, const FlightOptions& options, const Flight& whose)
    : state{graph, checked(graph, options), 0, 0, {}},
      wiring(state),
      recorder(state),
      protection(state),
      end(state, wiring, recorder, protection),
      stopwatch(state, recorder),
      stepper(state, wiring, recorder, protection, stopwatch),
      roles(state, wiring, recorder, protection, end, stepper),
      owner(whose) {
  connect();
  for (const auto& unit : wiring.units) unit->configure();
  if (graph.vehicle >= 0) wiring.vehicle().prepare_last_frame(graph.failsafe);
  commands = std::make_shared<const CommandTable>(state.graph);
  open_tap();
  if (graph.arm) request_arming();
  state.result.phases.reserve(64);
  state.result.guards.reserve(64);
}

Flight::Impl::~Impl() = default;

void Flight::Impl::connect() {
  wiring.connect();
  recorder.listen(wiring.units);
  protection.connect(wiring);
  stepper.connect();
  roles.connect();
}

/// `arm: auto`: sends a request to the vehicle's port `arm`, in its first tick.
void Flight::Impl::request_arming() {
  Unit& vehicle = wiring.vehicle();
  const int port = vehicle.info->input("arm");
  Reader* const reader = port < 0 ? nullptr : &nth(vehicle.in.readers, port);
  const Field* const armed = reader ? reader->port->type->find("armed") : nullptr;
  if (!armed || armed->kind != FULMAR_BOOL || reader->port->kind != FULMAR_IN_REQUEST)
    throw Error(
        located(vehicle.component->where, run_messages::arm_request_missing(vehicle.component->name)));
  std::vector<std::byte> message(reader->port->type->size);
  message[armed->offset] = std::byte{1};
  reader->push(message.data(), 0);
}

void Flight::Impl::open_tap() {
  const Graph& graph = state.graph;
  const bool logs = state.options.log && graph.record;
  const bool shown =
      !state.unpaced() && (graph.live.on || graph.dds.on);  // a flight at full speed is too fast for clients
  if (!logs && !shown) return;
  recorder.open(wiring.units, logs);
  if (shown) open_to_others();
}

/// Threads of clients start here, before the loop's thread is bound to a CPU and given its priority, which
/// they must not inherit.
void Flight::Impl::open_to_others() {
  const Graph& graph = state.graph;
  const LiveLibrary* const live = graph.live.on ? &live_library(graph.live) : nullptr;
  clients.control = std::make_unique<FlightControl>(*this);
  if (graph.dds.on)
    clients.dds = host_library<DdsLibrary>(graph.dds.where)
                      .open({*recorder.tap(), *clients.control, say_aloud}, graph.dds);
  if (live == nullptr) return;
  try {
    clients.live = live->open(*recorder.tap(), *clients.control, graph.live, page_folder());
  } catch (const Error& fault) {  // a port that another flight on this computer uses must not prevent the
                                  // flight
    if (state.options.say) state.options.say(run_messages::live_view_missing(fault.what()), true);
  }
}

}  // namespace fulmar::core
