// SPDX-License-Identifier: BSD-3-Clause
// Phases: the component of each role.
#include <utility>

#include "core/run/flight/roles.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

void Roles::note_phase(const Phase& entered, const std::string& because) {
  std::vector<PhaseVisit>& visits = state_.result.phases;
  if (!visits.empty()) visits.back().to_ns = state_.now_ns;
  visits.push_back({entered.name, state_.now_ns, state_.now_ns, because});
  Event e = event_of(Code::phase_entered, "", entered.name);
  put(e.cause, because);
  say(e, run_messages::phase_entered, entered.name);
  recorder_.note(e);
}

void Roles::prepare_vehicle() {
  const int vehicle = state_.graph.vehicle;
  if (const std::vector<Overlay>* set = overlay_of(vehicle)) lay_over(vehicle, set);
}

/// A vehicle that rejects a phase's settings keeps its own: to stop it would not help.
void Roles::lay_over(int component, const std::vector<Overlay>* set) {
  Unit& unit = wiring_.unit(component);
  if (unit.retune(set)) return;
  if (component != state_.graph.vehicle) return stop(component);
  make_printable(unit.problem.text);
  Event e = event_of(Code::notice, unit.component->name);
  e.severity = Severity::warning;
  say(e, run_messages::phase_parameters_refused, present().name, unit.problem.text);
  recorder_.note(e);
  unit.retune(nullptr);
}

void Roles::begin() {
  const Phase& first = present();
  for (std::size_t r = 0; r < active_.size(); ++r) {
    const Assignment& a = first.roles[r];
    if (a.component < 0) continue;
    active_[r] = a.component;
    note_tenure(static_cast<int>(r));
    wiring_.expect_from(wiring_.unit(a.component));
    Unit& unit = wiring_.unit(a.component);
    const bool again = std::exchange(unit.active, true);  // it fills several roles
    if (!again && !a.set.empty()) lay_over(a.component, &a.set);
  }
  next_since_.assign(first.next.size(), never_ns);
  note_phase(first, "");
}

void Roles::transitions() {
  if (!try_transitions(state_.graph.any, any_since_)) try_transitions(present().next, next_since_);
}

bool Roles::try_transitions(const std::vector<Transition>& list, std::vector<std::int64_t>& since) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Transition& t = list[i];
    if (t.to == phase_ || !wiring_.held_for(*t.when, t.for_ns, since[i])) continue;
    since[i] = never_ns;
    enter(t.to, t.when->text());
    return true;
  }
  return false;
}

void Roles::enter(int phase, const std::string& because) {
  const Phase& before = present();
  phase_ = phase;
  const Phase& entered = present();
  next_since_.assign(entered.next.size(), never_ns);
  note_phase(entered, because);
  for (std::size_t r = 0; r < active_.size(); ++r) fill(static_cast<int>(r), !before.roles[r].set.empty());
  keep_groups_whole();
  for (const auto& unit : wiring_.units)
    if (unit->stopped) report_blind(entered.next, wiring_.index_of(*unit));
}

/// A component that the phase assigns to another role and that also fills this one, or -1.
int Roles::group_wanted_in(int role) const {
  for (const Assignment& a : present().roles)
    for (const int wanted : {a.component, a.fallback}) {
      if (wanted < 0 || wiring_.unit(wanted).stopped) continue;
      const Component& component = *wiring_.unit(wanted).component;
      if (component.roles.size() > 1 && component.fills(role)) return wanted;
      break;
    }
  return -1;
}

/// Active component of a role from now on: the one of the phase, else its fallback, else the present one.
void Roles::fill(int role, bool overlaid) {
  const Assignment& assignment = nth(present().roles, role);
  if (assignment.component < 0) return;
  const int group = group_wanted_in(role);
  const auto unless_group = [&](int component) { return component == group ? -1 : component; };
  for (const int wanted : {group, unless_group(assignment.component), unless_group(assignment.fallback)}) {
    if (wanted < 0 || wiring_.unit(wanted).stopped) continue;
    if (wanted != active(role)) {
      const bool tried =
          wiring_.unit(wanted).component->roles.front() != role;  // not in the first of its roles
      if (!tried && take_over(wanted, assignment)) return;
      continue;
    }
    const bool own = wanted == assignment.component && !assignment.set.empty();
    if (own || overlaid) lay_over(wanted, own ? &assignment.set : nullptr);
    return;
  }
  if (active(role) < 0) return;
  const std::string& stays = wiring_.unit(active(role)).component->name;
  Event e = event_of(Code::nobody_else, nth(state_.graph.roles, role).name, stays);
  say(e, run_messages::no_candidate, stays);
  recorder_.note(e);
}

}  // namespace fulmar::core
