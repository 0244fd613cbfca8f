// SPDX-License-Identifier: BSD-3-Clause
// A guard has fired: fallback, hand-over, failsafe.
#include "core/run/flight/roles.hpp"

#include <algorithm>
#include <utility>

#include "core/run/messages.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

/// The component's message when a guard stopped it, or `code`.
Event guard_event(Code code, Unit& unit, const char* problem) noexcept {
  const bool dead = unit.runner().dead();
  Event e = event_of(!dead                  ? code
                     : unit.runner().hung() ? Code::hung
                                            : Code::died,
                     unit.component->name, dead ? unit.runner().died_in() : "");
  put(e.cause, problem);
  say(e, std::string_view(problem));
  return e;
}

}  // namespace

Roles::Roles(FlightState& state, Wiring& wiring, Recorder& recorder, Protection& protection, FlightEnd& end,
             Stepper& stepper)
    : state_(state),
      wiring_(wiring),
      recorder_(recorder),
      protection_(protection),
      end_(end),
      stepper_(stepper),
      active_(state.graph.roles.size(), -1),
      any_since_(state.graph.any.size(), never_ns) {
  std::size_t most = 0;
  for (const auto& unit : wiring.units) most = std::max(most, unit->out.slots.size());
  hand_over_.reserve(most);
}

void Roles::connect() {
  const Graph& graph = state_.graph;
  streams_.connect(wiring_, state_);
  drives_vehicle_.assign(graph.roles.size(), false);
  if (graph.vehicle < 0) return;
  for (const Wire& w : nth(graph.components, graph.vehicle).wires)
    if (w.from.kind == Source::Kind::role) nth(drives_vehicle_, w.from.index) = true;
}

const std::vector<Overlay>* Roles::overlay_of(int component) const noexcept {
  for (const Assignment& a : present().roles)
    if (a.component == component && !a.set.empty()) return &a.set;
  return nullptr;
}

void Roles::step(int component) {
  if (const std::optional<Code> code = stepper_.step(component)) stop(component, *code);
}

void Roles::charge(Unit& unit) {
  if (stepper_.over_budget(unit)) stop(wiring_.index_of(unit), Code::over_budget);
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
  recorder_.note(guard_event(code, unit, what.c_str()));
  std::vector<GuardEvent>& guards = state_.result.guards;
  guards.push_back({state_.now_ns, name, what, "held"});
  const std::size_t guard = guards.size() - 1;
  fall_back(component, guard);
  end_tenures([component](int filler, int) { return filler == component; });
  report_blind("done", state_.graph.judge.done.get(), component);
  report_blind("failed", state_.graph.judge.failed.get(), component);
  report_blind(state_.graph.any, component);
  report_blind(present().next, component);
  if (!nobody_drives(component)) return;
  guards[guard].action = "failsafe";
  nobody_flies(name, what);
}

void Roles::nobody_flies(const std::string& name, const std::string& what) {
  Event why = event_of(Code::failsafe, "", name);
  put(why.cause, what);
  say(why, run_messages::failsafe, name, what);
  end_.failsafe(why);
  end_tenures([this](int, int role) { return nth(drives_vehicle_, role); });
}

/// The vehicle's commands have stopped coming, although no filler of a role was stopped: they come from a
/// component without a role, or the mission sets their maximum age.
void Roles::watch_commands() {
  const std::vector<std::vector<std::byte>>& commands = state_.graph.failsafe;
  if (end_.in_failsafe()) return;
  const Slot* const mute = streams_.watch(protection_.out_of_control(), state_, recorder_);
  if (mute) stop_if_mute(*mute);
  if (mute && end_.in_failsafe()) return;
  Unit& vehicle = wiring_.vehicle();
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (commands[i].empty() || !vehicle.in.too_old(i, state_.now_ns, vehicle.problem)) continue;
    const std::string what = vehicle.problem.text, &name = vehicle.component->name;
    state_.result.guards.push_back({state_.now_ns, name, what, "failsafe"});
    return nobody_flies(name, what);
  }
}

/// A law without commands to the vehicle is as lost as one with invalid commands, when all its inputs keep
/// coming. Other components may have a reason: an estimator without samples, a law without a path.
void Roles::stop_if_mute(const Slot& slot) {
  Unit& unit = unit_of(slot);
  bool drives = false;
  for (const int role : unit.component->roles) drives = drives || nth(drives_vehicle_, role);
  if (!drives || !slot.role || !unit.in.all_younger_than(Streams::min_silence_ns, state_.now_ns)) return;
  put_problem(unit.problem, run_messages::command_missing, slot.port->name);
  stop(wiring_.index_of(unit));
}

/// A condition on a stopped component never holds any more: a geofence without its watch is without effect.
void Roles::report_blind(const char* what, const Condition* condition, int stopped) {
  if (!condition) return;
  const std::vector<Source>& ports = condition->ports();
  const bool looks_at = std::any_of(ports.begin(), ports.end(), [&](const Source& port) {
    if (port.kind == Source::Kind::role) return active(port.index) == stopped;
    return port.kind == Source::Kind::component && port.index == stopped;
  });
  if (!looks_at) return;
  Event e = event_of(Code::notice, wiring_.unit(stopped).component->name);
  e.severity = Severity::warning;
  say(e, run_messages::condition_dead, what, condition->text());
  recorder_.note(e);
}

void Roles::report_blind(const std::vector<Transition>& list, int stopped) {
  for (const Transition& t : list)
    report_blind(nth(state_.graph.phases, t.to).name.c_str(), t.when.get(), stopped);
}

/// In each role that it has left, the present phase's fallback takes over in the same tick, if it can.
/// Components that feed others come first.
void Roles::fall_back(int stopped, std::size_t guard) {
  std::string names;
  const std::string& name = wiring_.unit(stopped).component->name;
  for (const int next : state_.graph.order)
    for (std::size_t r = 0; r < active_.size(); ++r) {
      const Assignment& a = present().roles[r];
      if (active_[r] != stopped || a.fallback != next || next == stopped || wiring_.unit(next).stopped)
        continue;
      if (!take_over(next, a)) continue;
      const std::string& other = wiring_.unit(next).component->name;
      names += (names.empty() ? "" : ", ") + other;
      state_.result.guards[guard].action = names + (names == other ? " takes over" : " take over");
      Event e = event_of(Code::took_over, name, other);
      say(e, run_messages::took_over, other);
      recorder_.note(e);
    }
}

/// Whether it is still active in a role that leads to the vehicle.
bool Roles::nobody_drives(int stopped) const noexcept {
  for (std::size_t r = 0; r < active_.size(); ++r)
    if (active_[r] == stopped && drives_vehicle_[r]) return true;
  return false;
}

/// The last applied outputs of the role, if the new component has the same message types.
void Roles::fill_hand_over(const Unit& unit) {
  hand_over_.assign(unit.out.slots.size(), nullptr);
  for (std::size_t i = 0; i < unit.out.slots.size(); ++i) {
    const Slot& own = unit.out.slots[i];
    const Slot* const applied = own.role ? own.role->current : nullptr;
    if (applied && applied->port->type->hash == own.port->type->hash) hand_over_[i] = applied;
  }
}

bool Roles::fills_any(int component) const noexcept {
  return std::find(active_.begin(), active_.end(), component) != active_.end();
}

bool Roles::nobody_has_flown(const Component& component) const noexcept {
  return std::all_of(component.roles.begin(), component.roles.end(),
                     [&](int role) { return active(role) < 0 || wiring_.unit(active(role)).fresh_start; });
}

void Roles::rest(Unit& unit) noexcept {
  unit.active = false;
  unit.in.refuse_requests("does not fly any more");
  if (!unit.fresh_start) unit.deactivate();
}

/// Records the new component of the role.
void Roles::note_tenure(int role) {
  end_tenures([role](int, int of) { return of == role; });
  state_.result.tenures.push_back({nth(state_.graph.roles, role).name,
                                   wiring_.unit(active(role)).component->name, state_.now_ns, never_ns});
}

/// Ends the tenure of each role for which `ends(component, role)` holds: a stopped component is not active.
template <class Ends>
void Roles::end_tenures(const Ends& ends) {
  for (std::size_t r = 0; r < active_.size(); ++r) {
    const int role = static_cast<int>(r);
    if (!ends(active_[r], role)) continue;
    for (Tenure& tenure : state_.result.tenures)
      if (tenure.role == state_.graph.roles[r].name && tenure.to_ns == never_ns) tenure.to_ns = state_.now_ns;
  }
}

void Roles::fly_again(int component) {
  for (std::size_t r = 0; r < active_.size(); ++r)
    if (active_[r] == component) note_tenure(static_cast<int>(r));
}

void Roles::conclude() {
  end_tenures([](int, int) { return true; });
}

std::string Roles::idle_role() const {
  std::string first;
  bool commanded = true;
  for (std::size_t r = 0; r < active_.size(); ++r) {
    if (active_[r] < 0 || wiring_.has_published(r)) continue;
    if (first.empty()) first = state_.graph.roles[r].name;
    commanded = commanded && !drives_vehicle_[r];
  }
  return commanded ? "" : first;
}

/// It fills all its roles from now on; a component without a role becomes inactive.
void Roles::occupy(int component) {
  for (const int role : wiring_.unit(component).component->roles) {
    const int old = std::exchange(active(role), component);
    if (old != component) note_tenure(role);
    if (old >= 0 && old != component && !fills_any(old)) rest(wiring_.unit(old));
  }
  wiring_.unit(component).active = true;
  wiring_.expect_from(wiring_.unit(component));
}

bool Roles::take_over(int component, const Assignment& assignment) {
  Unit& unit = wiring_.unit(component);
  const bool tuned = unit.retune(component == assignment.component ? &assignment.set : nullptr);
  if (tuned && !unit.in.ready() && nobody_has_flown(*unit.component)) {  // it begins when its inputs exist
    unit.fresh_start = true;
    occupy(component);
    return true;
  }
  fill_hand_over(unit);
  unit.in.forget_queues();
  if (!tuned || !unit.activate(state_.now_ns, state_.index, hand_over_)) {
    cannot_take_over(unit, active(unit.component->roles.front()) >= 0);
    return false;
  }
  occupy(component);
  unit.call_now(state_.now_ns);
  step(component);
  return true;
}

/// A component that fills several roles leaves all of them or none. It continues when one of its successors
/// could not take over.
void Roles::keep_groups_whole() {
  for (const int component : state_.graph.order) {
    Unit& unit = wiring_.unit(component);
    if (unit.component->roles.size() < 2 || unit.stopped || !fills_any(component)) continue;
    const auto has = [&](int role) { return active(role) == component; };
    const std::vector<int>& roles = unit.component->roles;
    if (std::all_of(roles.begin(), roles.end(), has)) continue;
    occupy(component);
    for (Slot& slot : unit.out.slots)
      if (slot.role && slot.sequence > 0) slot.role->current = &slot;
  }
}

void Roles::cannot_take_over(Unit& unit, bool somebody_stays) {
  make_printable(unit.problem.text);
  const std::string& name = unit.component->name;
  Event e = guard_event(Code::cannot_take_over, unit, unit.problem.text);
  say(e, run_messages::cannot_take_over, unit.problem.text);
  recorder_.note(e);
  state_.result.guards.push_back(
      {state_.now_ns, name, e.words.data(), somebody_stays ? "the old one stays" : "nobody flies"});
}

}  // namespace fulmar::core
