// SPDX-License-Identifier: BSD-3-Clause
// Phases: who fills which role when, overlays, transitions; and the ports that a mission names to show or to
// decide.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/record.hpp"

namespace fulmar::core {
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
  std::string why;
  if (known && draft.is_out(*known))
    why = not_there(draft, name);
  else if (known)
    why = name +
          (known->fills.empty() ? " does not fill " : " fills " + join(texts_of(known->fills)) + ", not ") +
          wanted.name + "." + choices_text("", fillers);
  else
    why =
        "there is no component '" + name + "' that fills " + wanted.name + "." + choices_text(name, fillers);
  draft.report.add(word.where, path.empty() ? why : path + ": " + why);
  return -1;
}

/// role -> the component that --role gives it in every phase, or -1
std::vector<int> chosen_by_command(Draft& draft) {
  std::vector<int> chosen(draft.roles.size(), -1);
  for (const auto& [role, component] : draft.overrides.roles) {
    const Where where{"--role " + role + "=" + component, 0};
    const int r = draft.role(role);
    if (r < 0)
      draft.report.add(where, no_such("there is no role", role, draft.roles));
    else
      nth(chosen, r) = filler_named(draft, r, {component, where}, "");
  }
  return chosen;
}

/// `replaced`: --role has put the component in another one's place: it takes what it has a live parameter
/// for.
std::vector<Overlay> read_overlay(Draft& draft, const Candidate& candidate, const Node& set,
                                  const std::string& path, bool replaced) {
  std::vector<Overlay> overlay;
  if (!candidate.loaded) return overlay;
  std::vector<std::string> live;
  for (const ParamInfo& param : candidate.info().params)
    if (param.live) live.push_back(param.name);
  for (const Node::Entry& entry : set.entries) {
    if (draft.report.full()) break;  // each of the others costs its hint
    const int p = param_path(candidate.info(), entry.key).param;
    const ParamInfo* const param = p < 0 ? nullptr : &nth(candidate.info().params, p);
    if (param && param->live) {
      Overlay item{p, nth(candidate.params, p)};
      read_param(*param, entry.value, path + "." + entry.key, item.value, draft.files, draft.report);
      overlay.push_back(std::move(item));
    } else if (!replaced && !param) {
      draft.report.add(entry.where(), path + ": " + candidate.name + " has no parameter '" + entry.key +
                                          "'." + choices_text(entry.key, live));
    } else if (!replaced) {
      draft.report.add(
          entry.where(),
          path + "." + entry.key +
              ": is fixed when the flight begins; a phase can set live parameters alone. Live: " +
              join(live) + ".");
    }
  }
  return overlay;
}

/// What a phase says of the vehicle: parameters of the one that flies, and of no other.
void read_vehicle_overlay(Draft& draft, const AssignmentText& text, const std::string& path, int usual,
                          int seated, Assignment& assignment) {
  if (!text.use.text.empty() && taken_away(draft, text.use.text, text.use.where, path)) return;
  const int named = text.use.text.empty() ? usual : draft.candidate(text.use.text);
  const bool flies = named >= 0 && (named == usual || named == seated);
  if (!flies || !text.fallback.text.empty() || text.set.is(Node::Kind::missing))
    return draft.report.add(text.where,
                            path +
                                ": the vehicle does not change in flight; choose it with io or with --role "
                                "vehicle=NAME. A phase can 'set' live parameters of the one that flies");
  for (const int component : {named, seated})
    assignment.set =
        read_overlay(draft, nth(draft.candidates, component), text.set, path + ".set", component != named);
}

/// What a phase says of a role, checked also where --role then changes it. `usual`: who would fill it without
/// --role, `seated`: who does.
void read_assignment(Draft& draft, const AssignmentText& text, const std::string& path, int usual, int seated,
                     Assignment& assignment) {
  const int role = draft.role(text.role);
  if (text.role == "vehicle") return read_vehicle_overlay(draft, text, path, usual, seated, assignment);
  int use = usual;
  if (!text.use.text.empty()) use = filler_named(draft, role, text.use, path);
  const int fallback =
      text.fallback.text.empty() ? -1 : filler_named(draft, role, text.fallback, path + ".fallback");
  if (fallback >= 0 && fallback == use)
    draft.report.add(text.fallback.where, path + ".fallback: " + text.fallback.text +
                                              " is the component that fills the role already");
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

std::string phase_path(const PhaseText& phase) { return "phases." + phase.name; }

/// Those of the mission, or the only one of a mission that has none.
const std::vector<PhaseText>& phases_of(const MissionText& text) {
  static const std::vector<PhaseText> only = {{"flight", {}, {}, {}}};
  return text.phases.empty() ? only : text.phases;
}

/// Who fills which role in a phase: whom the command line or the phase names, with all roles that he fills;
/// then, for each role that is left, the first in file order whose roles are all free.
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

  /// Who sits in one of its roles already, or -1.
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
    if (text.role == "vehicle") return;  // the same one in all phases
    if (wanted < 0 || !nth(draft_.candidates, wanted).fills(role) || in_its_way(wanted, commanded) >= 0)
      return;
    const int other = in_its_way(wanted, seats_);
    if (other < 0) return seat(wanted);
    draft_.report.add(text.where, phase_path(phase_) + "." + text.role + ": " + not_together(wanted, other));
  }

  void seat_by_order(int role) {
    if (nth(seats_, role) >= 0) return;
    for (const int f : nth(draft_.roles, role).fillers)
      if (in_its_way(f, seats_) < 0) return seat(f);
  }

  std::string not_together(int one, int other) const {
    const auto words = [&](int candidate) {
      std::string text;
      for (const int r : roles_of(candidate))
        text += (text.empty() ? "" : " and ") + nth(draft_.roles, r).name;
      return nth(draft_.candidates, candidate).name + " fills " + text;
    };
    return words(one) + ", " + words(other) + "; they cannot fly together";
  }

  Draft& draft_;
  const PhaseText& phase_;
  const std::vector<int>& command_;
  std::vector<int> seats_;  // per role: a candidate, or -1
};

/// Of a component that fills several roles: what the phase sets holds in all of them, and when it has a
/// fallback in one, the others have the one that the phase names, or the first that can fill them.
void complete_group(Draft& draft, const PhaseText& phase, int group, std::vector<Assignment>& roles) {
  const std::vector<int>& seats = nth(draft.candidates, group).roles;
  const std::vector<Overlay>* set = nullptr;
  bool falls_back = false;
  for (const int r : seats) {
    const Assignment& a = nth(roles, r);
    falls_back = falls_back || a.fallback >= 0;
    if (a.set.empty()) continue;
    if (set)
      draft.report.add(phase.where, phase_path(phase) + ": 'set' of " + nth(draft.candidates, group).name +
                                        " is there twice; one of its roles is enough");
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
  const std::vector<int> nobody(draft.roles.size(), -1);
  for (const PhaseText& phase : phases_of(draft.text)) {
    std::vector<Assignment> roles(draft.roles.size());
    const std::vector<int> usual = Seating(draft, phase, nobody).seats(),
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

// ---- ports that the mission names

namespace {

/// Thrown when a port belongs to a component that was refused: nothing more to say.
struct Unclear {};

/// Thrown when nobody who fills a role in this run has one of its optional outputs.
struct NobodyProvides : Error {
  using Error::Error;
};

/// `built`: sources count the components of the graph, else candidates, which are then marked as used.
FindPort finder(Draft& draft, bool built) {
  return [&draft, built](const std::string& owner, const std::string& port) {
    Target target = find_target(draft, {owner, port});
    if (target.unclear) {
      const int role = draft.role(owner);
      if (role < 0 || nth(draft.roles, role).unclear) throw Unclear{};
      throw NobodyProvides(owner + "." + port + " is provided by nobody in this run");
    }
    if (target.source.kind == Source::Kind::component) {
      Candidate& candidate = nth(draft.candidates, target.source.index);
      if (!built)
        candidate.used = true;
      else
        target.source.index = candidate.component;
    } else if (built && !provided(draft.graph, target.source)) {
      throw NobodyProvides(owner + "." + port + " is provided by nobody in this run");
    }
    return std::pair{target.source, target.type};
  };
}

template <class F>
void guarded(Draft& draft, const Where& where, const std::string& path, F run) {
  try {
    run();
  } catch (const Unclear&) {
  } catch (const Error& fault) {
    tell(draft, where, path, fault);
  }
}

/// What every result has: a summary must not write over it.
const std::vector<std::string> result_keys = {
    "allocations", "behind_max_s", "dds",        "flight_time_s", "guards",           "io",      "live",
    "log",         "log_dropped",  "log_sha256", "mission",       "not_reproducible", "phases",  "reason",
    "result",      "seed",         "speedup",    "step_time_us",  "wall_time_s",      "who_flew"};

std::pair<Source, TypePtr> find_port(const Word& word, const std::string& example, const FindPort& find) {
  const auto dot = word.text.find('.');
  if (dot == std::string::npos || word.text.find('.', dot + 1) != std::string::npos)
    throw Error("expected a port such as " + example + ", found '" + word.text + "'");
  return find(word.text.substr(0, dot), word.text.substr(dot + 1));
}

void read_summary(Draft& draft, const FindPort& find) {
  draft.graph.summary.clear();
  for (const auto& entry : draft.text.summary) {
    const std::string& key = entry.first;
    const Word& word = entry.second;
    guarded(draft, word.where, "summary." + key, [&] {
      if (std::find(result_keys.begin(), result_keys.end(), key) != result_keys.end())
        throw Error("'" + key + "' is a key of every result; choose another name");
      const auto [source, type] = find_port(word, "score.tracking", find);
      if (!type) throw Error("'" + word.text + "' is a probe; a summary shows messages");
      draft.graph.summary.emplace_back(key, source);
    });
  }
}

/// Ports of texts for people. That a vehicle has nothing to tell is no fault.
void read_told(Draft& draft, const FindPort& find) {
  draft.graph.tell.clear();
  for (const Word& word : draft.text.tell)
    guarded(draft, word.where, "tell", [&] {
      try {
        const auto [source, type] = find_port(word, "vehicle.notices", find);
        const Field* const text = type ? type->find("text") : nullptr;
        if (!text || text->kind != FULMAR_TEXT)
          throw Error("'" + word.text + "' is " + (type ? type->name : "a probe") +
                      ", which has no text 'text' to tell");
        draft.graph.tell.push_back(source);
      } catch (const NobodyProvides&) {
      }
    });
}

Shown shown(const Word& word, const FindPort& find) {
  Shown shown = find_shown(word.text, find);
  const Field& field = *shown.field.field;
  if (field.kind == FULMAR_STRUCT || field.kind == FULMAR_TEXT)
    throw Error("'" + word.text + "' is " + (field.kind == FULMAR_TEXT ? "text" : "a " + field.type->name) +
                ", not a number");
  return shown;
}

void read_shown(Draft& draft, const FindPort& find) {
  draft.graph.progress.clear();
  for (const Word& word : draft.text.progress) {
    if (draft.report.full()) break;
    guarded(draft, word.where, "progress", [&] { draft.graph.progress.push_back(shown(word, find)); });
  }
}

void read_resume(Draft& draft, const FindPort& find) {
  draft.graph.resume.clear();
  for (const auto& entry : draft.text.resume) {
    const std::string& param = entry.first;
    const Word& word = entry.second;
    guarded(draft, word.where, "resume." + param, [&] {
      const auto dot = param.find('.');
      if (dot == std::string::npos)
        throw Error("expected a parameter such as manage.first_item, found '" + param + "'");
      const std::string name = param.substr(0, dot), of = param.substr(dot + 1);
      const int i = draft.candidate(name);
      const ComponentText* const text = draft.text.component(name);
      if (text && draft.is_out(*text)) return;  // nothing of it goes on in this run
      if (i < 0) throw NoOwner(name, not_there(draft, name));
      const Candidate& candidate = nth(draft.candidates, i);
      if (!candidate.loaded) throw Unclear{};
      const auto& params = candidate.info().params;
      const ParamInfo& info = nth(params, require_named(params, of, name + " has no parameter"));
      if (info.kind != FULMAR_COUNT && info.kind != FULMAR_NUMBER) throw Error(param + " is no number");
      if (!info.live)
        throw Error(
            param +
            " is fixed when the flight begins; whether it resumes is known when the vehicle has spoken");
      draft.graph.resume.push_back({param, shown(word, find)});
    });
  }
}

std::shared_ptr<const Condition> compiled(Draft& draft, const Word& word, const std::string& path,
                                          const FindPort& find) {
  std::shared_ptr<const Condition> condition;
  guarded(draft, word.where, path, [&] { condition = Condition::compile(word.text, find); });
  return condition;
}

std::vector<Transition> transitions(Draft& draft, const std::vector<TransitionText>& texts,
                                    const std::string& path, const FindPort& find) {
  std::vector<Transition> list;
  const auto& phases = phases_of(draft.text);
  for (const TransitionText& text : texts) {
    Transition transition;
    transition.to = index_named(phases, text.to.text);
    if (transition.to < 0 && !text.to.text.empty() &&
        !draft.report.still_named({"phases." + text.to.text}, text.to.where, path + ".to"))
      draft.report.add(text.to.where, no_such(path + ".to: there is no phase", text.to.text, phases));
    if (!text.when.text.empty()) transition.when = compiled(draft, text.when, path + ".when", find);
    transition.for_ns = text.for_ns;
    transition.where = text.where;
    list.push_back(std::move(transition));
  }
  return list;
}

/// Everything that names ports, compiled into the graph.
void compile_all(Draft& draft, bool built) {
  const FindPort find = finder(draft, built);
  Graph& graph = draft.graph;
  if (draft.text.done) graph.done = compiled(draft, *draft.text.done, "done", find);
  if (draft.text.failed) graph.failed = compiled(draft, *draft.text.failed, "failed", find);
  read_shown(draft, find);
  read_summary(draft, find);
  read_told(draft, find);
  read_resume(draft, find);
  graph.phases.clear();
  for (const PhaseText& text : phases_of(draft.text))
    graph.phases.push_back(
        {text.name, {}, transitions(draft, text.next, phase_path(text) + ".next", find), text.where});
  graph.any = transitions(draft, draft.text.any, "phases.any.next", find);
}

/// Not where the way led through a phase that was taken away: that is told already.
void check_reachable(Draft& draft) {
  const Graph& graph = draft.graph;
  if (draft.report.misses("phases.")) return;
  std::vector<bool> reached(graph.phases.size(), false);
  std::vector<int> todo;
  const auto reach = [&](int phase) {
    if (phase < 0 || nth(reached, phase)) return;
    nth(reached, phase) = true;
    todo.push_back(phase);
  };
  reach(0);
  for (const Transition& transition : graph.any) reach(transition.to);
  while (!todo.empty()) {
    const int at = todo.back();
    todo.pop_back();
    for (const Transition& transition : nth(graph.phases, at).next) reach(transition.to);
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (!reached[i])
      draft.report.add(graph.phases[i].where, "phases." + graph.phases[i].name +
                                                  ": no transition leads here from " + graph.phases[0].name +
                                                  ", where the flight begins");
}

}  // namespace

void name_ports(Draft& draft) { compile_all(draft, false); }

void compile_phases(Draft& draft) {
  compile_all(draft, true);
  const auto component = [&](int candidate) {
    return candidate < 0 ? -1 : nth(draft.candidates, candidate).component;
  };
  for (std::size_t i = 0; i < draft.graph.phases.size(); ++i) {
    draft.graph.phases[i].roles = draft.assignments[i];
    for (Assignment& assignment : draft.graph.phases[i].roles) {
      assignment.component = component(assignment.component);
      assignment.fallback = component(assignment.fallback);
    }
  }
  check_reachable(draft);
}

}  // namespace fulmar::core
