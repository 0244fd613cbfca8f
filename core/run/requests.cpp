// SPDX-License-Identifier: BSD-3-Clause
// What enters a flight from outside, between ticks. There is one door, Flight::apply; the others make a
// command and go through it.
#include <cstring>
#include <utility>

#include "core/run/flight_impl.hpp"

namespace fulmar::core {

void Flight::apply(Command command, std::function<void(const std::string&)> answered) {
  impl_->commands->prepare(command);
  Reply reply;
  if (answered) reply = [answered = std::move(answered)](const char* refusal) { answered(refusal); };
  switch (impl_->take(command, std::move(reply))) {
    case Impl::Taken::yes:
      return;
    case Impl::Taken::idle:
      throw Error(command.component + " does not fly now");
    case Impl::Taken::full:
      const Reader& r = impl_->units[command.at]->in.readers[command.part];
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

// ---- in the loop
// ----------------------------------------------------------------------------------------------------------------

void Flight::Impl::put_command(const CommandNote& note) {
  const std::size_t channel = note.kind == CommandKind::parameter ? parameter_channel : command_channel;
  if (tap) tap->write(channel, now_ns, now_ns, reinterpret_cast<const std::byte*>(&note), true);
}

Flight::Impl::Taken Flight::Impl::take(Command& command, Reply answered) {
  switch (command.kind) {
    case CommandKind::parameter:
      apply_parameter(command, Code::parameter_set);
      break;
    case CommandKind::request:
      return apply_request(command, std::move(answered));
    case CommandKind::import:
      apply_import(command.part, command.message.data());
      break;
    case CommandKind::phase:
      apply_phase(command);
      break;
    case CommandKind::swap:
      swap(command.at, command.name);
      break;
    case CommandKind::reset:
      reset_guards(command);
      break;
  }
  return Taken::yes;
}

Flight::Impl::Taken Flight::Impl::apply_request(const Command& command, Reply answered) {
  Unit& unit = *units[command.at];
  Reader& r = unit.in.readers[command.part];
  if (index > 0 && (!unit.active || unit.stopped)) return Taken::idle;
  if (r.pending.count == r.port->capacity) return Taken::full;
  CopyPlan whole;
  whole.size = r.port->type->size;
  r.push(command.message.data(), now_ns, whole);
  r.pending.replies[r.pending.count - 1] = std::move(answered);
  if (tap) tap->write(static_cast<std::size_t>(r.channel), now_ns, now_ns, command.message.data(), true);
  Event e = event_of(Code::request_taken, unit.component->name, r.port->name);
  say(e, "%s", r.port->name.c_str());
  note(e, false);  // not told aloud: a tool may send hundreds
  return Taken::yes;
}

void Flight::Impl::apply_parameter(Command& command, Code told) {
  Unit& unit = *units[command.at];
  const CommandNote& taken = command.note;
  const std::vector<Overlay>* const overlay = overlay_of(static_cast<int>(command.at));
  std::swap(unit.base[command.part], command.value);
  if (!unit.runner().dead() && !unit.retune(overlay)) {
    std::swap(unit.base[command.part], command.value);
    unit.retune(overlay);
    throw Error(unit.component->name + ": " + unit.problem.text);
  }
  put_command(taken);
  Event e = event_of(told, taken.component.data(), taken.name.data());
  e.severity = Severity::info;
  e.value = unit.info->params[command.part].kind == FULMAR_NUMBER ? taken.number[0]
                                                                  : static_cast<double>(taken.integer);
  say(e, "%s = %s", taken.name.data(), taken.text.data());
  note(e, false);  // not told aloud: a script may set thousands
}

void Flight::Impl::apply_import(std::size_t import, const std::byte* message) {
  Import& i = imports[import];
  Slot& slot = i.slot;
  std::memcpy(slot.published.data(), message, slot.size);
  slot.valid_at_ns = now_ns;
  ++slot.sequence;
  if (i.reader->port->kind != FULMAR_IN_VALUE) {
    CopyPlan whole;
    whole.size = slot.size;
    i.reader->push(message, now_ns, whole);
  }
  if (tap) tap->write(static_cast<std::size_t>(i.reader->channel), now_ns, now_ns, message, true);
}

void Flight::Impl::apply_phase(const Command& command) {
  if (ending.in_failsafe()) throw Error("the flight is in its failsafe: no phase can be entered");
  put_command(command.note);
  enter(static_cast<int>(command.part));  // the present one, too: whoever it names takes over again
}

const std::vector<Overlay>* Flight::Impl::overlay_of(int component) const {
  for (const Assignment& a : graph.phases[static_cast<std::size_t>(phase)].roles)
    if (a.component == component && !a.set.empty()) return &a.set;
  return nullptr;
}

const Tape* Flight::tape(const std::string& component) const {
  return impl_->units[impl_->commands->component(component)]->tape.get();
}

void Flight::Impl::reset_guards(const Command& command) {
  put_command(command.note);
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!units[i]->stopped || !reset_guard(i)) continue;
    Event e = event_of(Code::guard_reset, units[i]->component->name);
    say(e, "guard reset");
    note(e);
  }
}

/// False: its process has ended, and this is no time to start another.
bool Flight::Impl::reset_guard(std::size_t i) {
  if (units[i]->runner().dead()) {
    if (const std::string why = in_use(); !why.empty()) {
      Event e = event_of(Code::guard_not_reset, units[i]->component->name);
      put(e.cause, why);
      say(e, "guard not reset: its process has ended, and is started anew on the ground; %s", why.c_str());
      note(e);
      return false;
    }
    restart(i);
  }
  units[i]->stopped = false;
  units[i]->overruns_in_a_row = 0;
  units[i]->fresh_start = true;
  return true;
}

}  // namespace fulmar::core
