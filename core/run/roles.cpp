// SPDX-License-Identifier: BSD-3-Clause
// Steps, and what happens when one goes wrong.
#include "core/run/roles.hpp"

#include <algorithm>
#include <utility>

#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

/// What a component said of itself when a guard stopped it.
Event guard_event(Code code, const std::string& component, const char* problem) noexcept {
  Event e = event_of(code, component);
  put(e.cause, problem);
  say(e, "%s", problem);
  return e;
}

}  // namespace

Roles::Roles(FlightState& state, Wiring& wiring, Recorder& recorder, Protection& protection, FlightEnd& end,
             Stopwatch& stopwatch)
    : state_(state),
      wiring_(wiring),
      recorder_(recorder),
      protection_(protection),
      end_(end),
      stopwatch_(stopwatch),
      active_(state.graph.roles.size(), -1),
      any_since_(state.graph.any.size(), never_ns) {
  std::size_t most = 0;
  for (const auto& unit : wiring.units) most = std::max(most, unit->out.slots.size());
  hand_over_.reserve(most);
}

void Roles::connect() {
  const Graph& graph = state_.graph;
  drives_vehicle_.assign(graph.roles.size(), false);
  control_roles_.assign(graph.roles.size(), false);
  for (const int role : graph.control) nth(control_roles_, role) = true;
  if (graph.vehicle < 0) return;
  for (const Wire& w : nth(graph.components, graph.vehicle).wires)
    if (w.from.kind == Source::Kind::role) nth(drives_vehicle_, w.from.index) = true;
}

const std::vector<Overlay>* Roles::overlay_of(int component) const noexcept {
  for (const Assignment& a : present().roles)
    if (a.component == component && !a.set.empty()) return &a.set;
  return nullptr;
}

// ---- steps

void Roles::step(int component) {
  Unit& unit = wiring_.unit(component);
  if (unit.runner().remote() && !collect(unit, component)) return;
  if (!unit.active || unit.stopped || !unit.due(state_.now_ns) || !ready_to_step(unit, component)) return;
  const StepResult result = unit.step(state_.now_ns, state_.index);
  if (!unit.in.refusals.empty()) recorder_.note_refusals(unit);
  const bool bad = result == StepResult::bad;
  if (has_stepped(result)) wiring_.publish(unit, recorder_);
  if (has_stepped(result) || bad) charge(unit);
  if (bad) stop(component);
}

/// Who begins is activated first, with nobody before it. Who is held begins anew in every step, so that
/// nothing winds up while the vehicle does not obey; in another thread once, when control returns.
bool Roles::ready_to_step(Unit& unit, int component) {
  const bool held = protection_.out_of_control() && is_held(unit);
  if (!unit.fresh_start && (!held || unit.runner().remote())) return true;
  if (!unit.in.ready()) return false;
  if (unit.activate(state_.now_ns, state_.index, {})) return true;
  if (!held || unit.runner().dead())
    stop(component);
  else
    unit.fresh_start = true;  // it flies nothing now; what is in its way may have passed when it does
  return false;
}

bool Roles::is_held(const Unit& unit) const noexcept {
  const int role = unit.component->role;
  return role >= 0 && nth(control_roles_, role);
}

void Roles::begin_anew() noexcept {
  for (const auto& unit : wiring_.units)
    if (unit->active && unit->runner().remote() && is_held(*unit)) unit->fresh_start = true;
}

void Roles::charge(Unit& unit) {
  if (!stopwatch_.charge(unit)) return;
  unit.fail("was over its time budget in 5 steps in a row");
  stop(wiring_.index_of(unit), Code::over_budget);
}

/// Results and samples that come from other threads. True when the unit can also be stepped.
bool Roles::collect(Unit& unit, int component) {
  StepResult result = unit.collect(state_.now_ns);
  tell_late(unit);
  for (; has_stepped(result); result = unit.collect(state_.now_ns))
    if (unit.active && !unit.stopped) wiring_.publish(unit, recorder_);
  tell_late(unit);
  if (!unit.in.refusals.empty()) recorder_.note_refusals(unit);
  if (result == StepResult::bad && unit.active) stop(component);
  stopwatch_.skip();
  return unit.runner().stepped_by_loop();
}

void Roles::note_late(const Unit& unit, std::int64_t due_ns) {
  Event e = event_of(Code::late_result, unit.component->name);
  e.value_ns = due_ns;
  say(e, "took late a result that was due at %lld ns", static_cast<long long>(due_ns));
  recorder_.note(e);
}

/// A replay takes them as late as the flight did.
void Roles::tell_late(Unit& unit) {
  for (const std::int64_t due_ns : unit.runner().late_due_ns) note_late(unit, due_ns);
  unit.runner().late_due_ns.clear();
}

/// What has not come counts as taken after the last tick.
void Roles::tell_overdue() {
  for (const auto& unit : wiring_.units) {
    const auto due_ns = unit->runner().overdue_ns(state_.now_ns);
    if (!due_ns) continue;
    const std::int64_t last_ns = std::exchange(state_.now_ns, state_.now_ns + 1);
    note_late(*unit, *due_ns);
    state_.now_ns = last_ns;
  }
}

// ---- guards and hand-over

void Roles::stop(int component, Code code) {
  Unit& unit = wiring_.unit(component);
  if (unit.stopped) return;
  unit.stopped = true;
  unit.in.refuse_requests("was stopped");
  make_printable(unit.problem.text);
  const std::string what = unit.problem.text;
  const std::string& name = unit.component->name;
  const int role = unit.component->role;
  recorder_.note(guard_event(unit.runner().hung() ? Code::hung : code, name, what.c_str()));
  std::vector<GuardEvent>& guards = state_.result.guards;
  guards.push_back({state_.now_ns, name, what, "held"});
  const std::size_t guard = guards.size() - 1;
  if (role < 0 || active(role) != component || fall_back(role, component, guard)) return;
  if (!nth(drives_vehicle_, role)) return;
  guards[guard].action = "failsafe";
  Event why = event_of(Code::failsafe, "", name);
  put(why.cause, what);
  say(why, "failsafe: %s: %s", name.c_str(), what.c_str());
  end_.failsafe(why);
}

/// The present phase's fallback, if it can fly, flies in this same tick.
bool Roles::fall_back(int role, int stopped, std::size_t guard) {
  const Assignment& a = nth(present().roles, role);
  if (a.fallback < 0 || a.fallback == stopped || wiring_.unit(a.fallback).stopped) return false;
  if (!take_over(role, a.fallback, a)) return false;
  const std::string& other = wiring_.unit(a.fallback).component->name;
  state_.result.guards[guard].action = other + " takes over";
  Event e = event_of(Code::took_over, wiring_.unit(stopped).component->name, other);
  say(e, "%s takes over", other.c_str());
  recorder_.note(e);
  return true;
}

/// The outputs last applied in the role, as far as the newcomer's messages are of the same make.
void Roles::fill_hand_over(const Unit& unit) {
  hand_over_.assign(unit.out.slots.size(), nullptr);
  for (std::size_t i = 0; i < unit.out.slots.size(); ++i) {
    const Slot& own = unit.out.slots[i];
    const Slot* const applied = own.role ? own.role->current : nullptr;
    if (applied && applied->port->type->hash == own.port->type->hash) hand_over_[i] = applied;
  }
}

bool Roles::take_over(int role, int component, const Assignment& assignment) {
  Unit& unit = wiring_.unit(component);
  Unit* const old = active(role) >= 0 ? &wiring_.unit(active(role)) : nullptr;
  const bool tuned = unit.retune(component == assignment.component ? &assignment.set : nullptr);
  if (tuned && !unit.in.ready() &&
      (!old || old->fresh_start)) {  // nobody has flown yet: it begins when its inputs are there
    if (old) old->active = false;
    active(role) = component;
    unit.active = unit.fresh_start = true;
    return true;
  }
  fill_hand_over(unit);
  unit.in.forget_queues();
  if (!tuned || !unit.activate(state_.now_ns, state_.index, hand_over_)) {
    cannot_take_over(unit, active(role) >= 0);
    return false;
  }
  if (old) {
    old->active = false;
    old->in.refuse_requests("does not fly any more");
    if (!old->fresh_start) old->deactivate();
  }
  active(role) = component;
  unit.active = true;
  unit.call_now(state_.now_ns);
  step(component);
  return true;
}

void Roles::cannot_take_over(Unit& unit, bool somebody_stays) {
  make_printable(unit.problem.text);
  const std::string& name = unit.component->name;
  Event e = guard_event(unit.runner().hung() ? Code::hung : Code::cannot_take_over, name, unit.problem.text);
  say(e, "cannot take over: %s", unit.problem.text);
  recorder_.note(e);
  state_.result.guards.push_back(
      {state_.now_ns, name, e.words.data(), somebody_stays ? "the old one stays" : "nobody flies"});
}

}  // namespace fulmar::core
