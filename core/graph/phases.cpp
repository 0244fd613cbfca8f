// SPDX-License-Identifier: BSD-3-Clause
// Phases: the component of each role, and the overlays of parameters.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"
#include "core/graph/record.hpp"

namespace fulmar::core {

std::string phase_path(const PhaseText& phase) { return "phases." + phase.name; }

const std::vector<PhaseText>& phases_of(const MissionText& text) {
  static const std::vector<PhaseText> only = {{"flight", {}, {}, {}}};
  return text.phases.empty() ? only : text.phases;
}

namespace {

std::vector<std::string> texts_of(const std::vector<Word>& words) {
  std::vector<std::string> texts;
  for (const Word& word : words) texts.push_back(word.text);
  return texts;
}

/// The candidate that a phase or the command line names for a role; -1 and a fault when it cannot fill it.
int filler_named(Draft& draft, int role, const Word& word, const std::string& path) {
  const std::string& name = word.text;
  const RoleDraft& wanted = nth(draft.roles, role);
  const int i = draft.candidate(name);
  std::vector<std::string> fillers;
  for (const int f : wanted.fillers) fillers.push_back(nth(draft.candidates, f).name);
  if (i >= 0 && std::find(wanted.fillers.begin(), wanted.fillers.end(), i) != wanted.fillers.end()) return i;
  if (taken_away(draft, name, word.where, path.empty() ? "--role" : path)) return -1;
  const ComponentText* known = draft.text.component(name);
  Diagnostic why;
  if (known && draft.is_out(*known))
    why = not_there(draft, name);
  else if (known && known->fills.empty())
    why = graph_messages::role_not_filled_by(name, wanted.name, choices_text("", fillers));
  else if (known)
    why = graph_messages::role_filled_by_other(name, join(texts_of(known->fills)), wanted.name,
                                               choices_text("", fillers));
  else
    why = graph_messages::filler_unknown(name, wanted.name, choices_text(name, fillers));
  draft.report.add(word.where, located(path, why));
  return -1;
}

/// role -> the component that --role gives it in every phase, or -1
std::vector<int> chosen_by_command(Draft& draft) {
  std::vector<int> chosen(draft.roles.size(), -1);
  for (const auto& [role, component] : draft.overrides.roles) {
    const Where where{"--role " + role + "=" + component, 0};
    const int r = draft.role(role);
    if (r < 0)
      draft.report.add(where, no_such("role", role, draft.roles));
    else
      nth(chosen, r) = filler_named(draft, r, {component, where}, "");
  }
  return chosen;
}

/// `replaced`: --role has replaced the component; the new one takes the values of its own live parameters.
std::vector<Overlay> read_overlay(Draft& draft, const Candidate& candidate, const Node& set,
                                  const std::string& path, bool replaced) {
  std::vector<Overlay> overlay;
  if (!candidate.loaded) return overlay;
  std::vector<std::string> live;
  for (const ParamInfo& param : candidate.info().params)
    if (param.live) live.push_back(param.name);
  for (const Node::Entry& entry : set.entries) {
    if (draft.report.full()) break;  // each further fault costs a hint
    const int p = param_path(candidate.info(), entry.key).param;
    const ParamInfo* const param = p < 0 ? nullptr : &nth(candidate.info().params, p);
    if (param && param->live) {
      Overlay item{p, nth(candidate.params, p)};
      read_param(*param, entry.value, path + "." + entry.key, item.value, draft.files, draft.report);
      overlay.push_back(std::move(item));
    } else if (!replaced && !param) {
      draft.report.add(entry.where(),
                       located(path, graph_messages::phase_parameter_unknown(candidate.name, entry.key,
                                                                             choices_text(entry.key, live))));
    } else if (!replaced) {
      draft.report.add(entry.where(), graph_messages::phase_parameter_fixed(path, entry.key, join(live)));
    }
  }
  return overlay;
}

/// A phase's settings of the vehicle: parameters of the vehicle in use, and of no other.
void read_vehicle_overlay(Draft& draft, const AssignmentText& text, const std::string& path, int usual,
                          int seated, Assignment& assignment) {
  if (!text.use.text.empty() && taken_away(draft, text.use.text, text.use.where, path)) return;
  const int named = text.use.text.empty() ? usual : draft.candidate(text.use.text);
  const bool flies = named >= 0 && (named == usual || named == seated);
  if (!flies || !text.fallback.text.empty() || text.set.is(Node::Kind::missing))
    return draft.report.add(text.where, located(path, graph_messages::phase_vehicle_fixed()));
  for (const int component : {named, seated})
    assignment.set =
        read_overlay(draft, nth(draft.candidates, component), text.set, path + ".set", component != named);
}

/// A phase's entry of a role, checked also where --role then changes it. `usual`: the filler without --role,
/// `seated`: the actual one.
void read_assignment(Draft& draft, const AssignmentText& text, const std::string& path, int usual, int seated,
                     Assignment& assignment) {
  const int role = draft.role(text.role);
  if (text.role == "vehicle") return read_vehicle_overlay(draft, text, path, usual, seated, assignment);
  int use = usual;
  if (!text.use.text.empty()) use = filler_named(draft, role, text.use, path);
  const int fallback =
      text.fallback.text.empty() ? -1 : filler_named(draft, role, text.fallback, path + ".fallback");
  if (fallback >= 0 && fallback == use)
    draft.report.add(text.fallback.where, graph_messages::fallback_already_active(path, text.fallback.text));
  assignment.component = seated >= 0 ? seated : use;
  if (fallback != assignment.component) assignment.fallback = fallback;
  const auto overlay = [&](int component) {
    return component < 0 ? std::vector<Overlay>()
                         : read_overlay(draft, nth(draft.candidates, component), text.set, path + ".set",
                                        component != use);
  };
  assignment.set = overlay(use);
  if (assignment.component != use) assignment.set = overlay(assignment.component);
}

/// Chooses the component of each role in a phase. First come those that the command line or the phase names,
/// with all their roles. Each role that is left gets the first component in file order whose roles are all
/// free.
class Seating {
 public:
  Seating(Draft& draft, const PhaseText& phase, const std::vector<int>& command)
      : draft_(draft), phase_(phase), command_(command), seats_(draft.roles.size(), -1) {}

  std::vector<int> seats() {
    for (std::size_t r = 0; r < seats_.size(); ++r) seat_by_command(static_cast<int>(r));
    const std::vector<int> commanded = seats_;
    for (const AssignmentText& text : phase_.roles) seat_by_phase(text, commanded);
    for (std::size_t r = 0; r < seats_.size(); ++r) seat_by_order(static_cast<int>(r));
    return seats_;
  }

 private:
  std::vector<int> roles_of(int candidate) const { return nth(draft_.candidates, candidate).roles; }

  void seat(int candidate) {
    for (const int r : roles_of(candidate)) nth(seats_, r) = candidate;
  }

  /// Component that already has one of its roles, or -1.
  int in_its_way(int candidate, const std::vector<int>& seats) const {
    for (const int r : roles_of(candidate))
      if (nth(seats, r) >= 0 && nth(seats, r) != candidate) return nth(seats, r);
    return -1;
  }

  void seat_by_command(int role) {
    const int wanted = nth(command_, role);
    if (wanted < 0) return;
    const int other = in_its_way(wanted, seats_);
    if (other < 0) return seat(wanted);
    if (&phase_ == &phases_of(draft_.text).front())
      draft_.report.add({"--role", 0}, not_together(wanted, other));
  }

  void seat_by_phase(const AssignmentText& text, const std::vector<int>& commanded) {
    const int role = draft_.role(text.role), wanted = draft_.candidate(text.use.text);
    if (text.role == "vehicle") return;  // the vehicle is the same in all phases
    if (wanted < 0 || !nth(draft_.candidates, wanted).fills(role) || in_its_way(wanted, commanded) >= 0)
      return;
    const int other = in_its_way(wanted, seats_);
    if (other < 0) return seat(wanted);
    draft_.report.add(text.where, located(phase_path(phase_) + "." + text.role, not_together(wanted, other)));
  }

  void seat_by_order(int role) {
    if (nth(seats_, role) >= 0) return;
    for (const int f : nth(draft_.roles, role).fillers)
      if (in_its_way(f, seats_) < 0) return seat(f);
  }

  Diagnostic not_together(int one, int other) const {
    const auto filled = [&](int candidate) {
      std::string text;
      for (const int r : roles_of(candidate))
        text += (text.empty() ? "" : " and ") + nth(draft_.roles, r).name;
      return text;
    };
    return graph_messages::components_share_roles(nth(draft_.candidates, one).name, filled(one),
                                                  nth(draft_.candidates, other).name, filled(other));
  }

  Draft& draft_;
  const PhaseText& phase_;
  const std::vector<int>& command_;
  std::vector<int> seats_;  // per role: a candidate, or -1
};

/// For a component that fills several roles: the phase's settings apply in all of them. When it has a
/// fallback in one, the others get the one that the phase names, or the first that can fill them.
void complete_group(Draft& draft, const PhaseText& phase, int group, std::vector<Assignment>& roles) {
  const std::vector<int>& seats = nth(draft.candidates, group).roles;
  const std::vector<Overlay>* set = nullptr;
  bool falls_back = false;
  for (const int r : seats) {
    const Assignment& a = nth(roles, r);
    falls_back = falls_back || a.fallback >= 0;
    if (a.set.empty()) continue;
    if (set)
      draft.report.add(
          phase.where,
          located(phase_path(phase), graph_messages::phase_set_repeated(nth(draft.candidates, group).name)));
    set = &a.set;
  }
  const std::vector<Overlay> shared = set ? *set : std::vector<Overlay>();
  for (const int r : seats) {
    Assignment& a = nth(roles, r);
    a.set = shared;
    if (!falls_back || a.fallback >= 0) continue;
    for (const int f : nth(draft.roles, r).fillers)
      if (a.fallback < 0 && nth(draft.candidates, f).roles.size() == 1) a.fallback = f;
  }
}

void complete_groups(Draft& draft, const PhaseText& phase, std::vector<Assignment>& roles) {
  for (std::size_t r = 0; r < roles.size(); ++r) {
    const int c = roles[r].component;
    if (c < 0 || nth(draft.candidates, c).roles.size() < 2) continue;
    if (nth(draft.candidates, c).roles.front() == static_cast<int>(r)) complete_group(draft, phase, c, roles);
  }
}

}  // namespace

void assign_roles(Draft& draft) {
  const std::vector<int> command = chosen_by_command(draft);
  const std::vector<int> unfilled(draft.roles.size(), -1);
  for (const PhaseText& phase : phases_of(draft.text)) {
    std::vector<Assignment> roles(draft.roles.size());
    const std::vector<int> usual = Seating(draft, phase, unfilled).seats(),
                           seated = Seating(draft, phase, command).seats();
    for (std::size_t r = 0; r < roles.size(); ++r) roles[r].component = seated[r];
    for (const AssignmentText& text : phase.roles) {
      const int r = draft.role(text.role);
      read_assignment(draft, text, phase_path(phase) + "." + text.role, nth(usual, r), nth(seated, r),
                      nth(roles, r));
    }
    complete_groups(draft, phase, roles);
    for (const Assignment& assignment : roles)
      for (const int i : {assignment.component, assignment.fallback})
        if (i >= 0) nth(draft.candidates, i).assigned = true;
    draft.assignments.push_back(std::move(roles));
  }
}

}  // namespace fulmar::core
