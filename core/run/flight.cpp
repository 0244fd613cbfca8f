// SPDX-License-Identifier: BSD-3-Clause
// A flight, for those who embed one.
#include "core/run/flight.hpp"

#include <utility>

#include "core/run/flight_impl.hpp"
#include "core/run/last_words.hpp"

namespace fulmar::core {

Flight::Flight(const Graph& graph, const FlightOptions& options)
    : impl_(std::make_unique<Impl>(graph, options, *this)) {}

Flight::~Flight() {
  last_frame.store(nullptr, std::memory_order_release);
  if (impl_->onlookers.control)
    impl_->onlookers.control->end();  // answers go to those who asked, as long as they are there
}

FlightResult Flight::run() {
  while (impl_->step()) {
  }
  return impl_->finish();
}
bool Flight::step() { return impl_->step(); }
FlightResult Flight::finish() { return impl_->finish(); }

// ---- to look at

Control* Flight::control() const { return impl_->onlookers.control.get(); }
std::uint16_t Flight::live_port() const {
  return impl_->onlookers.live ? impl_->onlookers.live->port() : std::uint16_t{0};
}
std::int64_t Flight::now_ns() const { return impl_->state.now_ns; }
const std::string& Flight::phase() const {
  return impl_->state.graph.phases[static_cast<std::size_t>(impl_->roles.phase())].name;
}
const std::byte* Flight::sample(const Source& source) const {
  const Slot* const slot = impl_->wiring.slot_of(source);
  return slot && slot->sequence > 0 ? impl_->wiring.message_of(source) : nullptr;
}
const Tape* Flight::tape(const std::string& component) const {
  return impl_->wiring.units[impl_->commands->component(component)]->tape.get();
}

// ---- to command

void Flight::apply(Command command, std::function<void(const std::string&)> answered) {
  impl_->commands->prepare(command);
  Reply reply;
  if (answered) reply = [answered = std::move(answered)](const char* refusal) { answered(refusal); };
  switch (impl_->take(command, std::move(reply))) {
    case Impl::Taken::yes: return;
    case Impl::Taken::idle: throw Error(command.component + " does not fly now");
    case Impl::Taken::full:
      const Reader& r = impl_->wiring.units[command.at]->in.readers[command.part];
      throw Error(command.component + "." + command.name + " has " + std::to_string(r.pending.count) +
                  " requests waiting; there is no room for more");
  }
}

namespace {

/// With a message whose size is that of the port's type.
Command with_message(const CommandTable& commands, Command command, const std::byte* message) {
  const bool imported = command.kind == CommandKind::import;
  const Type& type = *commands.entrance(commands.component(command.component), command.name, imported).type;
  command.message.assign(message, message + type.size);
  return command;
}

}  // namespace

void Flight::request(const std::string& component, const std::string& port, const std::byte* message,
                     std::function<void(const std::string&)> answered) {
  apply(with_message(*impl_->commands, command_of(CommandKind::request, component, port), message),
        std::move(answered));
}

void Flight::publish(const std::string& component, const std::string& port, const std::byte* message) {
  apply(with_message(*impl_->commands, command_of(CommandKind::import, component, port), message));
}

void Flight::set_parameter(const std::string& component, const std::string& param, const ParamValue& value) {
  Command command = command_of(CommandKind::parameter, component, param);
  command.value = value;
  apply(std::move(command));
}

void Flight::enter_phase(const std::string& phase) { apply(command_of(CommandKind::phase, "", phase)); }
void Flight::swap(const std::string& component, const std::string& file) {
  apply(command_of(CommandKind::swap, component, file));
}
void Flight::reset_guards() { apply(command_of(CommandKind::reset)); }

}  // namespace fulmar::core
