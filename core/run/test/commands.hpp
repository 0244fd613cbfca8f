// SPDX-License-Identifier: BSD-3-Clause
// Commands of tests to a flight, by kind.
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/run/command/command.hpp"
#include "core/run/flight.hpp"

namespace fulmar::core {

using Answered = std::function<void(const std::string&)>;

/// `message`: a struct of the port's type.
template <class Message>
void send(Flight& flight, CommandKind kind, const std::string& component, const std::string& port,
          const Message& message, Answered answered = {}) {
  Command command = command_of(kind, component, port);
  const auto* const bytes = reinterpret_cast<const std::byte*>(&message);
  command.message.assign(bytes, bytes + sizeof message);
  flight.apply(std::move(command), std::move(answered));
}
/// The message of a request that is one number, such as the lab's Watch.ask.
inline std::vector<std::byte> ask(double number) {
  const auto bytes = std::as_bytes(std::span(&number, 1));
  return {bytes.begin(), bytes.end()};
}
template <class Message>
void request(Flight& flight, const std::string& component, const std::string& port, const Message& message,
             Answered answered = {}) {
  send(flight, CommandKind::request, component, port, message, std::move(answered));
}
template <class Message>
void publish(Flight& flight, const std::string& component, const std::string& port, const Message& message) {
  send(flight, CommandKind::import, component, port, message);
}
inline void set_parameter(Flight& flight, const std::string& component, const std::string& param,
                          const ParamValue& value) {
  Command command = command_of(CommandKind::parameter, component, param);
  command.value = value;
  flight.apply(std::move(command));
}
inline void enter_phase(Flight& flight, const std::string& phase) {
  flight.apply(command_of(CommandKind::phase, "", phase));
}
inline void swap(Flight& flight, const std::string& component, const std::string& file) {
  flight.apply(command_of(CommandKind::swap, component, file));
}
inline void reset_guards(Flight& flight) { flight.apply(command_of(CommandKind::reset)); }

}  // namespace fulmar::core
