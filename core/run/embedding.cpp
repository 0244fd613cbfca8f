// SPDX-License-Identifier: BSD-3-Clause
// Interface of a flight for programs that embed one.
#include <utility>

#include "core/run/component/last_frame.hpp"
#include "core/run/control.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"
#include "links/live/library.hpp"

namespace fulmar::core {

Flight::Flight(const Graph& graph, const FlightOptions& options)
    : impl_(std::make_unique<Impl>(graph, options, *this)) {}

Flight::~Flight() {
  last_frame.store(nullptr, std::memory_order_release);
  if (impl_->clients.control) impl_->clients.control->end();  // answers reach their clients while these exist
}

FlightResult Flight::run() {
  while (impl_->step()) {
  }
  return impl_->finish();
}
bool Flight::step() { return impl_->step(); }
FlightResult Flight::finish() { return impl_->finish(); }

const std::optional<Restart>& Flight::restart() const { return impl_->state.restart; }

// ---- observation

Control* Flight::control() const { return impl_->clients.control.get(); }
std::uint16_t Flight::live_port() const {
  return impl_->clients.live ? impl_->clients.live->port() : std::uint16_t{0};
}
std::int64_t Flight::now_ns() const { return impl_->state.now_ns; }
const std::string& Flight::phase() const { return nth(impl_->state.graph.phases, impl_->roles.phase()).name; }
bool Flight::paused() const { return impl_->clients.control && impl_->clients.control->stands(); }
const std::byte* Flight::sample(const Source& source) const {
  const Slot* const slot = impl_->wiring.slot_of(source);
  return slot && slot->sequence > 0 ? impl_->wiring.message_of(source) : nullptr;
}
const Tape* Flight::tape(const std::string& component) const {
  return impl_->wiring.units[impl_->commands->component(component)]->tape.get();
}

// ---- commands

void Flight::apply(Command command, std::function<void(const std::string&)> answered) {
  impl_->commands->prepare(command);
  Reply reply;
  if (answered) reply = [answered = std::move(answered)](const char* refusal) { answered(refusal); };
  switch (impl_->take(command, std::move(reply))) {
    case Impl::Taken::yes: return;
    case Impl::Taken::idle: throw Error(run_messages::component_not_active(command.component));
    case Impl::Taken::full:
      const Reader& r = impl_->wiring.units[command.at]->in.readers[command.part];
      throw Error(run_messages::too_many_requests(command.component, command.name, r.pending.count));
  }
}

}  // namespace fulmar::core
