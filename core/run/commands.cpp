// SPDX-License-Identifier: BSD-3-Clause
// Input of a flight from outside, between ticks. Flight::Impl::take is its single entry: commands are checked
// and prepared before it, and each is in the log in the tick in which it takes effect.
#include <utility>

#include "core/run/flight_impl.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {

Flight::Impl::Taken Flight::Impl::take(Command& command, Reply answered) {
  switch (command.kind) {
    case CommandKind::parameter: apply_parameter(command, Code::parameter_set); break;
    case CommandKind::request: return apply_request(command, std::move(answered));
    case CommandKind::import:
      wiring.publish_import(command.part, command.message.data());
      recorder.put_input(wiring.imports[command.part].reader->channel, command.message.data());
      break;
    case CommandKind::phase: apply_phase(command); break;
    case CommandKind::swap: swap(static_cast<int>(command.at), command.name); break;
    case CommandKind::reset: reset_guards(command); break;
  }
  return Taken::yes;
}

Flight::Impl::Taken Flight::Impl::apply_request(const Command& command, Reply answered) {
  Unit& unit = *wiring.units[command.at];
  Reader& r = unit.in.readers[command.part];
  if (state.index > 0 && (!unit.active || unit.stopped)) return Taken::idle;
  if (r.pending.count == r.port->capacity) return Taken::full;
  r.push(command.message.data(), state.now_ns);
  r.pending.replies[r.pending.count - 1] = std::move(answered);
  recorder.put_input(r.channel, command.message.data());
  Event e = event_of(Code::request_taken, unit.component->name, r.port->name);
  say(e, r.port->name);
  recorder.note(e, false);  // not printed: a tool may send hundreds
  return Taken::yes;
}

void Flight::Impl::apply_parameter(Command& command, Code reported) {
  Unit& unit = *wiring.units[command.at];
  const CommandNote& taken = command.note;
  const std::vector<Overlay>* const overlay = roles.overlay_of(static_cast<int>(command.at));
  std::swap(unit.base[command.part], command.value);
  if (!unit.runner().dead() && !unit.retune(overlay)) {
    const std::string why = unit.problem.text;
    std::swap(unit.base[command.part], command.value);
    unit.retune(overlay);
    throw Error(located(unit.component->name, why));
  }
  recorder.put_command(taken);
  Event e = event_of(reported, taken.component.data(), taken.name.data());
  e.severity = Severity::info;
  const bool number = unit.info->params[command.part].kind == FULMAR_NUMBER;
  e.value = number ? taken.number[0] : static_cast<double>(taken.integer);
  say(e, run_messages::parameter_set, taken.name.data(), taken.text.data());
  recorder.note(e, false);  // not printed: a script may set thousands
}

void Flight::Impl::apply_phase(const Command& command) {
  if (end.in_failsafe()) throw Error(run_messages::failsafe_active());
  recorder.put_command(command.note);
  roles.enter(static_cast<int>(command.part));  // also the present one: its components take over again
}

void Flight::Impl::reset_guards(const Command& command) {
  recorder.put_command(command.note);
  for (const auto& unit : wiring.units) {
    const std::string& name = unit->component->name;
    if (!unit->stopped || !reset_guard(wiring.index_of(*unit))) continue;
    Event e = event_of(Code::guard_reset, name);
    say(e, run_messages::guard_reset);
    recorder.note(e);
  }
}

/// Returns false when its process has ended: a new one cannot be started now.
bool Flight::Impl::reset_guard(int component) {
  if (wiring.unit(component).runner().dead()) {
    if (const std::string why = protection.in_use(); !why.empty()) {
      Event e = event_of(Code::guard_not_reset, wiring.unit(component).component->name);
      put(e.cause, why);
      say(e, run_messages::guard_not_reset, why);
      recorder.note(e);
      return false;
    }
    restart(component);
  }
  Unit& unit = wiring.unit(component);
  unit.stopped = false;
  unit.overruns_in_a_row = 0;
  unit.fresh_start = true;
  roles.fly_again(component);
  return true;
}

}  // namespace fulmar::core
