// SPDX-License-Identifier: BSD-3-Clause
// What enters a flight from outside, between ticks: requests, live parameters, the reset of a guard.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/graph/params.hpp"
#include "core/run/flight_impl.hpp"

namespace fulmar::core {

Unit& Flight::Impl::unit(const std::string& component) {
  std::vector<std::string> names;
  for (const auto& u : units) {
    if (u->component->name == component) return *u;
    names.push_back(u->component->name);
  }
  throw Error("there is no component '" + component + "'." + choices_text(component, names));
}

void Flight::request(const std::string& component, const std::string& port, const std::byte* message,
                     std::function<void(const std::string&)> answered) {
  Unit& unit = impl_->unit(component);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < unit.readers.size(); ++i) {
    const Reader& r = unit.readers[i];
    if (r.port->kind != FULMAR_IN_REQUEST) continue;
    names.push_back(r.port->name);
    if (r.port->name != port) continue;
    if (const Guard guard(*r.port->type); !guard.check(message)) throw Error(component + "." + port + ": " + guard.explain(message));
    const auto index = static_cast<std::size_t>(unit.component - impl_->graph.components.data());
    Reply reply;
    if (answered) reply = [answered = std::move(answered)](const char* refusal) { answered(refusal); };
    switch (impl_->apply_request(index, i, message, std::move(reply))) {
      case Impl::Taken::yes:
        return;
      case Impl::Taken::idle:
        throw Error(component + " does not fly now");
      case Impl::Taken::full:
        throw Error(component + "." + port + " has " + std::to_string(r.count) + " requests waiting; there is no room for more");
    }
  }
  throw Error("'" + component + "' takes no request '" + port + "'." + choices_text(port, names));
}

Flight::Impl::Taken Flight::Impl::apply_request(std::size_t component, std::size_t input, const std::byte* message, Reply answered) {
  Unit& unit = *units[component];
  Reader& r = unit.readers[input];
  if (index > 0 && (!unit.active || unit.stopped)) return Taken::idle;
  if (r.count == r.port->capacity) return Taken::full;
  CopyPlan whole;
  whole.size = r.port->type->size;
  r.push(message, now_ns, whole);
  r.replies[r.count - 1] = std::move(answered);
  if (tap) tap->write(static_cast<std::size_t>(r.channel), now_ns, now_ns, message, true);
  Event e = event_of(Code::request_taken, unit.component->name, r.port->name);
  say(e, "%s", r.port->name.c_str());
  this->note(e, false);  // not told aloud: a tool may send hundreds
  return Taken::yes;
}

void Flight::set_parameter(const std::string& component, const std::string& param, const ParamValue& value) {
  Unit& unit = impl_->unit(component);
  const int i = unit.info->param(param);
  if (i < 0) {
    std::vector<std::string> names;
    for (const ParamInfo& p : unit.info->params) names.push_back(p.name);
    throw Error("'" + component + "' has no parameter '" + param + "'." + choices_text(param, names));
  }
  const ParamInfo& info = unit.info->params[static_cast<std::size_t>(i)];
  if (!info.live) throw Error(component + "." + param + " is a set-up parameter: it cannot change in flight");
  const double number = info.kind == FULMAR_NUMBER ? value.number[0] : static_cast<double>(value.integer);
  if (info.kind != FULMAR_VECTOR && !(number >= info.min && number <= info.max))
    throw Error(component + "." + param + ": " + std::to_string(number) + " is outside " + std::to_string(info.min) + " .. " +
                std::to_string(info.max));
  ParameterNote note;
  std::snprintf(note.component.data(), note.component.size(), "%s", component.c_str());
  std::snprintf(note.name.data(), note.name.size(), "%s", param.c_str());
  std::snprintf(note.text.data(), note.text.size(), "%s", value_text(info, value).c_str());
  ParamValue taken = value;
  impl_->apply_parameter(static_cast<std::size_t>(unit.component - impl_->graph.components.data()), static_cast<std::size_t>(i), taken,
                         note);
}

void Flight::publish(const std::string& component, const std::string& port, const std::byte* message) {
  for (const Reader& r : impl_->unit(component).readers) {
    if (r.port->name != port || r.wire->import < 0) continue;
    if (const Guard guard(*r.port->type); !guard.check(message)) throw Error(component + "." + port + ": " + guard.explain(message));
    return impl_->apply_import(static_cast<std::size_t>(r.wire->import), message);
  }
  throw Error("'" + component + "' takes no imported samples for '" + port + "'");
}

void Flight::enter_phase(const std::string& phase) {
  std::vector<std::string> names;
  for (const Phase& p : impl_->graph.phases) names.push_back(p.name);
  const auto at = std::find(names.begin(), names.end(), phase);
  if (at == names.end()) throw Error("there is no phase '" + phase + "'." + choices_text(phase, names));
  CommandNote note;
  note.kind = CommandNote::Kind::phase;
  std::snprintf(note.text.data(), note.text.size(), "%s", phase.c_str());
  impl_->apply_phase(static_cast<int>(at - names.begin()), note);
}

/// `value` is what was in force when this returns.
void Flight::Impl::apply_parameter(std::size_t component, std::size_t param, ParamValue& value, const ParameterNote& note) {
  Unit& unit = *units[component];
  std::swap(unit.base[param], value);
  if (!unit.dead() && !unit.retune(overlay_of(static_cast<int>(component)))) {
    std::swap(unit.base[param], value);
    unit.retune(overlay_of(static_cast<int>(component)));
    throw Error(unit.component->name + ": " + unit.problem.text);
  }
  if (tap) tap->write(parameter_channel, now_ns, now_ns, reinterpret_cast<const std::byte*>(&note), true);
  Event e = event_of(resuming ? Code::resumed : Code::parameter_set, note.component.data(), note.name.data());
  e.severity = Severity::info;
  e.value = unit.base[param].number[0];
  say(e, "%s = %s", note.name.data(), note.text.data());
  this->note(e, false);  // not told aloud: a script may set thousands
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

void Flight::Impl::apply_phase(int to, const CommandNote& note) {
  if (in_failsafe) throw Error("the flight is in its failsafe: no phase can be entered");
  if (tap) tap->write(command_channel, now_ns, now_ns, reinterpret_cast<const std::byte*>(&note), true);
  enter(to);  // the present one, too: whoever it names takes over again
}

const std::vector<Overlay>* Flight::Impl::overlay_of(int component) const {
  for (const Assignment& a : graph.phases[static_cast<std::size_t>(phase)].roles)
    if (a.component == component && !a.set.empty()) return &a.set;
  return nullptr;
}

const Tape* Flight::tape(const std::string& component) const { return impl_->unit(component).tape.get(); }

void Flight::reset_guards() {
  CommandNote note;
  note.kind = CommandNote::Kind::reset;
  if (impl_->tap) impl_->tap->write(impl_->command_channel, impl_->now_ns, impl_->now_ns, reinterpret_cast<const std::byte*>(&note), true);
  for (std::size_t i = 0; i < impl_->units.size(); ++i) {
    Unit* unit = impl_->units[i].get();
    if (!unit->stopped) continue;
    const std::string name = unit->component->name;
    if (unit->dead()) {
      if (const std::string why = impl_->in_use(); !why.empty()) {
        Event e = event_of(Code::guard_not_reset, name);
        put(e.cause, why);
        say(e, "guard not reset: its process has ended, and is started anew on the ground; %s", why.c_str());
        impl_->note(e);
        continue;
      }
      impl_->restart(i);
      unit = impl_->units[i].get();
    }
    unit->stopped = false;
    unit->overruns_in_a_row = 0;
    unit->fresh_start = true;
    Event e = event_of(Code::guard_reset, name);
    say(e, "guard reset");
    impl_->note(e);
  }
}

}  // namespace fulmar::core
