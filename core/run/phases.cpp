// SPDX-License-Identifier: BSD-3-Clause
// Phases, hand-over, guards, failsafe: who flies, and what happens when they cannot.
#include <cstdio>
#include <cstring>

#include "core/run/flight_impl.hpp"
#include "core/run/last_words.hpp"

namespace fulmar::core {

namespace {

/// How bad what a component tells is, by the label that it gives it.
Severity severity_of(const Told& told) noexcept {
  if (!told.severity) return Severity::info;
  const auto label = static_cast<std::size_t>(told.slot->published[told.severity->offset]);
  if (label >= told.severity->labels.size()) return Severity::info;
  const std::string& word = told.severity->labels[label];
  return word == "warning"    ? Severity::warning
         : word == "error"    ? Severity::error
         : word == "critical" ? Severity::critical
                              : Severity::info;
}

/// What a component said of itself when a guard stopped it.
Event guard_event(Code code, const std::string& component, const char* problem) noexcept {
  Event e = event_of(code, component);
  put(e.cause, problem);
  say(e, "%s", problem);
  return e;
}

}  // namespace

void Flight::Impl::note(const Event& e, bool aloud) {
  if (tap) tap->write(event_channel, now_ns, now_ns, reinterpret_cast<const std::byte*>(&e), true);
  if (!options.say || !aloud) return;
  char time[32];
  std::snprintf(time, sizeof time, "%8.2f s  ", 1e-9 * static_cast<double>(now_ns));
  const std::string who = e.component[0] != '\0' ? e.component.data() + std::string(": ") : "";
  options.say(time + who + e.words.data(), e.severity >= Severity::warning);
}

/// Whoever asked has been told; this is for the log.
void Flight::Impl::note_refusals(Unit& unit) noexcept {
  for (const Intake::Refusal& r : unit.in.refusals) {
    const std::string& port = unit.info->inputs[r.input].name;
    Event e = event_of(Code::request_refused, unit.component->name, port);
    put(e.cause, r.reason.data());
    say(e, "%s refused: %s", port.c_str(), r.reason.data());
    note(e, false);
  }
  unit.in.refusals.clear();
}

/// What a component has to tell people. Its words are its own: any bytes.
void Flight::Impl::tell(Told& told) {
  const auto* const text = reinterpret_cast<const char*>(told.slot->published.data() + told.text->offset);
  const std::size_t size = strnlen(text, told.text->stride);
  if (!told.last.empty()) {
    if (std::memcmp(told.last.data(), text, told.text->stride) == 0) return;
    std::memcpy(told.last.data(), text, told.text->stride);
  }
  if (size == 0) return;
  Event e = event_of(Code::notice, told.slot->owner->component->name);
  e.severity = severity_of(told);
  say(e, "%.*s", static_cast<int>(size), text);
  note(e);
}

void Flight::Impl::note_phase(const Phase& entered) {
  Event e = event_of(Code::phase_entered, "", entered.name);
  say(e, "phase %s", entered.name.c_str());
  note(e);
}

/// The first phase: nobody has flown before, so each component is activated when its inputs have arrived.
void Flight::Impl::begin() {
  if (options.resume && !options.resume->if_armed) resume_now();
  const Phase& first = graph.phases[static_cast<std::size_t>(phase)];
  for (std::size_t r = 0; r < roles.size(); ++r) {
    const Assignment& a = first.roles[r];
    if (a.component < 0) continue;
    roles[r].active = a.component;
    Unit& unit = *units[static_cast<std::size_t>(a.component)];
    unit.active = true;
    if (!a.set.empty() && !unit.retune(&a.set)) stop(a.component);
  }
  next_since.assign(first.next.size(), never);
  result.phases.push_back({first.name, now_ns, now_ns});
  note_phase(first);
}

void Flight::Impl::transitions() {
  if (try_transitions(graph.any, any_since)) return;
  try_transitions(graph.phases[static_cast<std::size_t>(phase)].next, next_since);
}

bool Flight::Impl::try_transitions(const std::vector<Transition>& list, std::vector<std::int64_t>& since) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Transition& t = list[i];
    if (t.to == phase) continue;
    if (!held_for(*t.when, t.for_ns, since[i])) continue;
    since[i] = never;
    enter(t.to);
    return true;
  }
  return false;
}

void Flight::Impl::enter(int to) {
  const Phase& from_phase = graph.phases[static_cast<std::size_t>(phase)];
  const Phase& to_phase = graph.phases[static_cast<std::size_t>(to)];
  phase = to;
  next_since.assign(to_phase.next.size(), never);
  if (!result.phases.empty()) result.phases.back().to_ns = now_ns;
  result.phases.push_back({to_phase.name, now_ns, now_ns});
  note_phase(to_phase);
  for (std::size_t r = 0; r < roles.size(); ++r)
    fill(static_cast<int>(r), to_phase.roles[r], !from_phase.roles[r].set.empty());
}

/// Who flies in a role from now on: the component that the phase names, else its fallback, else who flies
/// already.
void Flight::Impl::fill(int role, const Assignment& assignment, bool overlaid) {
  RoleState& state = roles[static_cast<std::size_t>(role)];
  if (assignment.component < 0) return;
  for (const int wanted : {assignment.component, assignment.fallback}) {
    if (wanted < 0 || units[static_cast<std::size_t>(wanted)]->stopped) continue;
    if (wanted != state.active) {
      if (take_over(role, wanted, assignment)) return;
      continue;
    }
    const bool own = wanted == assignment.component && !assignment.set.empty();
    if ((own || overlaid) &&
        !units[static_cast<std::size_t>(wanted)]->retune(own ? &assignment.set : nullptr))
      stop(wanted);
    return;
  }
  if (state.active < 0) return;
  const std::string& present = units[static_cast<std::size_t>(state.active)]->component->name;
  Event e = event_of(Code::nobody_else, graph.roles[static_cast<std::size_t>(role)].name, present);
  say(e, "nobody that this phase names can fly: %s goes on", present.c_str());
  note(e);
}

bool Flight::Impl::take_over(int role, int component, const Assignment& assignment) {
  RoleState& state = roles[static_cast<std::size_t>(role)];
  Unit& unit = *units[static_cast<std::size_t>(component)];
  Unit* old = state.active >= 0 ? units[static_cast<std::size_t>(state.active)].get() : nullptr;
  const bool tuned = unit.retune(component == assignment.component ? &assignment.set : nullptr);
  if (tuned && !unit.in.ready() &&
      (!old || old->fresh_start)) {  // nobody has flown yet: the newcomer begins when its inputs are there
    if (old) old->active = false;
    state.active = component;
    unit.active = unit.fresh_start = true;
    return true;
  }
  // The outputs last applied in the role, as far as the newcomer's messages are of the same make.
  std::vector<const Slot*>& last = hand_over;
  last.assign(unit.out.slots.size(), nullptr);
  for (std::size_t i = 0; i < unit.out.slots.size(); ++i) {
    const RoleSlot* slot = unit.out.slots[i].role;
    if (slot && slot->current && slot->current->port->type->hash == unit.out.slots[i].port->type->hash)
      last[i] = slot->current;
  }
  unit.in.forget_queues();
  if (!tuned || !unit.activate(now_ns, index, last)) {
    make_printable(unit.problem.text);
    Event e = guard_event(unit.runner().hung() ? Code::hung : Code::cannot_take_over, unit.component->name,
                          unit.problem.text);
    say(e, "cannot take over: %s", unit.problem.text);
    note(e);
    result.guards.push_back({now_ns, unit.component->name, e.words.data(),
                             state.active >= 0 ? "the old one stays" : "nobody flies"});
    return false;
  }
  if (old) {
    old->active = false;
    old->in.refuse_requests("does not fly any more");
    if (!old->fresh_start) old->deactivate();
  }
  state.active = component;
  unit.active = true;
  unit.call_now(now_ns);
  step_unit(component);
  return true;
}

/// A guard has fired: the last good output is held; the fallback takes over; when nobody is left, failsafe.
void Flight::Impl::stop(int i, Code code) {
  Unit& unit = *units[static_cast<std::size_t>(i)];
  if (unit.stopped) return;
  unit.stopped = true;
  unit.in.refuse_requests("was stopped");
  make_printable(unit.problem.text);
  const std::string what = unit.problem.text;
  const std::string name = unit.component->name;
  const int role = unit.component->role;
  note(guard_event(unit.runner().hung() ? Code::hung : code, name, what.c_str()));
  result.guards.push_back({now_ns, name, what, "held"});
  const std::size_t at = result.guards.size() - 1;
  if (role < 0) return;
  RoleState& state = roles[static_cast<std::size_t>(role)];
  if (state.active != i) return;
  const Assignment& a = graph.phases[static_cast<std::size_t>(phase)].roles[static_cast<std::size_t>(role)];
  const int fallback = a.fallback;
  if (fallback >= 0 && fallback != i && !units[static_cast<std::size_t>(fallback)]->stopped &&
      take_over(role, fallback, a)) {
    const std::string& other = graph.components[static_cast<std::size_t>(fallback)].name;
    result.guards[at].action = other + " takes over";
    Event e = event_of(Code::took_over, name, other);
    say(e, "%s takes over", other.c_str());
    note(e);
    return;
  }
  if (!drives_vehicle[static_cast<std::size_t>(role)]) return;
  result.guards[at].action = "failsafe";
  Event why = event_of(Code::failsafe, "", name);
  put(why.cause, what);
  say(why, "failsafe: %s: %s", name.c_str(), what.c_str());
  failsafe(why);
}

void Flight::Impl::failsafe(const Event& why) {
  if (ending.in_failsafe()) return;
  end_by(Ending::Cue::nobody);
  failsafe_words = why.words;
  note(why);
}

const Slot* Flight::Impl::slot_of(const Source& source) const {
  if (source.kind == Source::Kind::component)
    return &units[static_cast<std::size_t>(source.index)]->out.slots[static_cast<std::size_t>(source.output)];
  if (source.kind == Source::Kind::role)
    return roles[static_cast<std::size_t>(source.index)]
        .slots[static_cast<std::size_t>(source.output)]
        .current;
  return nullptr;
}

/// A sample is stale for a condition when whoever wrote it has been stopped.
const std::byte* Flight::Impl::sample(const Source& source) const noexcept {
  const Slot* slot = slot_of(source);
  if (!slot || slot->sequence == 0 || slot->owner->stopped) return nullptr;
  return message_of(source);
}

const std::byte* Flight::Impl::message_of(const Source& source) const noexcept {
  if (source.kind == Source::Kind::role)
    return roles[static_cast<std::size_t>(source.index)]
        .slots[static_cast<std::size_t>(source.output)]
        .message();
  return slot_of(source)->published.data();
}

Flight::Flight(const Graph& graph, const FlightOptions& options)
    : impl_(std::make_unique<Impl>(graph, options)) {
  impl_->owner = this;
}
Flight::~Flight() {
  last_frame.store(nullptr, std::memory_order_release);
  if (impl_->control) impl_->control->end();  // answers go to those who asked, as long as they are there
}
FlightResult Flight::run() {
  while (impl_->step()) {
  }
  return impl_->finish_flight();
}
bool Flight::step() { return impl_->step(); }
Control* Flight::control() const { return impl_->control.get(); }
std::uint16_t Flight::live_port() const {
  return impl_->live_server ? impl_->live_server->port() : std::uint16_t{0};
}
FlightResult Flight::finish() { return impl_->finish_flight(); }
std::int64_t Flight::now_ns() const { return impl_->now_ns; }
const std::string& Flight::phase() const {
  return impl_->graph.phases[static_cast<std::size_t>(impl_->phase)].name;
}
const std::byte* Flight::sample(const Source& source) const {
  const Slot* slot = impl_->slot_of(source);
  return slot && slot->sequence > 0 ? impl_->message_of(source) : nullptr;
}

}  // namespace fulmar::core
