// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight/stepper.hpp"

#include <utility>

#include "core/run/messages.hpp"

namespace fulmar::core {

Stepper::Stepper(FlightState& state, Wiring& wiring, Recorder& recorder, Protection& protection,
                 Stopwatch& stopwatch)
    : state_(state), wiring_(wiring), recorder_(recorder), protection_(protection), stopwatch_(stopwatch) {}

void Stepper::connect() {
  control_roles_.assign(state_.graph.roles.size(), false);
  for (const int role : state_.graph.control) nth(control_roles_, role) = true;
}

std::optional<Code> Stepper::step(int component) {
  Unit& unit = wiring_.unit(component);
  if (unit.runner().remote() && !collect(unit)) return Code::guard;
  if (unit.runner().remote() && !unit.runner().stepped_by_loop()) return std::nullopt;
  if (!unit.active || unit.stopped || !unit.due(state_.now_ns)) return std::nullopt;
  switch (prepare(unit)) {
    case Ready::no: return std::nullopt;
    case Ready::refused: return Code::guard;
    case Ready::yes: break;
  }
  const StepResult result = unit.step(state_.now_ns, state_.index);
  if (!unit.in.refusals.empty()) recorder_.note_refusals(unit);
  const bool bad = result == StepResult::bad;
  if (has_stepped(result)) wiring_.publish(unit, recorder_);
  if ((has_stepped(result) || bad) && over_budget(unit)) return Code::over_budget;
  return bad ? std::optional(Code::guard) : std::nullopt;
}

/// A component that starts is activated first, without a predecessor. A held component starts again in every
/// step, so that nothing winds up while the vehicle does not obey; in another thread once, when control
/// returns.
Stepper::Ready Stepper::prepare(Unit& unit) {
  const bool held = protection_.out_of_control() && is_held(unit);
  if (!unit.fresh_start && (!held || unit.runner().remote())) return Ready::yes;
  if (!unit.in.ready()) return unit.in.in_vain(unit.problem) ? Ready::refused : Ready::no;
  if (unit.activate(state_.now_ns, state_.index, {})) return Ready::yes;
  if (!held || unit.runner().dead()) return Ready::refused;
  unit.fresh_start = true;  // it controls nothing now; the cause may have passed when it does
  return Ready::no;
}

bool Stepper::is_held(const Unit& unit) const noexcept {
  for (const int role : unit.component->roles)
    if (nth(control_roles_, role)) return true;
  return false;
}

void Stepper::restart_held() noexcept {
  for (const auto& unit : wiring_.units)
    if (unit->active && unit->runner().remote() && is_held(*unit)) unit->fresh_start = true;
}

bool Stepper::over_budget(Unit& unit) {
  if (!stopwatch_.charge(unit)) return false;
  unit.fail(run_messages::time_budget_exceeded.c_str());
  return true;
}

/// Takes results and samples that have arrived from other threads. False when a guard refuses one of an
/// active component.
bool Stepper::collect(Unit& unit) {
  StepResult result = unit.collect(state_.now_ns);
  report_late(unit);
  for (; has_stepped(result); result = unit.collect(state_.now_ns))
    if (unit.active && !unit.stopped) wiring_.publish(unit, recorder_);
  report_late(unit);
  if (!unit.in.refusals.empty()) recorder_.note_refusals(unit);
  stopwatch_.skip();
  return result != StepResult::bad || !unit.active;
}

void Stepper::note_late(const Unit& unit, std::int64_t due_ns) {
  Event e = event_of(Code::late_result, unit.component->name);
  e.value_ns = due_ns;
  say(e, run_messages::result_late, due_ns);
  recorder_.note(e);
}

/// A replay takes them as late as the flight did.
void Stepper::report_late(Unit& unit) {
  for (const std::int64_t due_ns : unit.runner().late_due_ns) note_late(unit, due_ns);
  unit.runner().late_due_ns.clear();
}

/// What has not come counts as taken after the last tick.
void Stepper::report_overdue() {
  for (const auto& unit : wiring_.units) {
    const auto due_ns = unit->runner().overdue_ns(state_.now_ns);
    if (!due_ns) continue;
    const std::int64_t last_ns = std::exchange(state_.now_ns, state_.now_ns + 1);
    note_late(*unit, *due_ns);
    state_.now_ns = last_ns;
  }
}

}  // namespace fulmar::core
