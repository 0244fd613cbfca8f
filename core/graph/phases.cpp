// SPDX-License-Identifier: BSD-3-Clause
// Phases: who fills which role when, overlays, transitions; and the ports that a mission names to show or to
// decide.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/record.hpp"

namespace fulmar::core {
namespace {

/// The candidate that a phase or the command line names for a role; -1 and a fault when it cannot fill it.
int filler_named(Draft& draft, std::size_t role, const std::string& name, const Where& where,
                 const std::string& path) {
  const RoleDraft& wanted = draft.roles[role];
  const int i = draft.candidate(name);
  std::vector<std::string> fillers;
  for (const int f : wanted.fillers) fillers.push_back(draft.candidates[static_cast<std::size_t>(f)].name());
  if (i >= 0 && std::find(wanted.fillers.begin(), wanted.fillers.end(), i) != wanted.fillers.end()) return i;
  const ComponentText* known = draft.text.component(name);
  std::string why;
  if (known && draft.is_out(*known))
    why = not_there(draft, name);
  else if (known)
    why = name + (known->fills.empty() ? " does not fill " : " fills " + known->fills + ", not ") +
          wanted.text->name + "." + choices_text("", fillers);
  else
    why = "there is no component '" + name + "' that fills " + wanted.text->name + "." +
          choices_text(name, fillers);
  draft.report.add(where, path.empty() ? why : path + ": " + why);
  return -1;
}

/// role -> the component that --role gives it in every phase, or -1
std::vector<int> chosen_by_command(Draft& draft) {
  std::vector<int> chosen(draft.roles.size(), -1);
  for (const auto& [role, component] : draft.overrides.roles) {
    const Where where{"--role " + role + "=" + component, 0};
    const int r = draft.role(role);
    if (r < 0)
      draft.report.add(where, "there is no role '" + role + "'." + choices_text(role, draft.role_names()));
    else
      chosen[static_cast<std::size_t>(r)] =
          filler_named(draft, static_cast<std::size_t>(r), component, where, "");
  }
  return chosen;
}

void read_overlay(Draft& draft, const Candidate& candidate, const Node& set, const std::string& path,
                  std::vector<Overlay>& overlay) {
  if (!set.is(Node::Kind::map) || !candidate.loaded) return;
  std::vector<std::string> live;
  for (const ParamInfo& param : candidate.info().params)
    if (param.live) live.push_back(param.name);
  for (const Node::Entry& entry : set.entries) {
    const int p = candidate.info().param(entry.key);
    if (p < 0) {
      draft.report.add(entry.where(), path + ": " + candidate.name() + " has no parameter '" + entry.key +
                                          "'." + choices_text(entry.key, live));
      continue;
    }
    const ParamInfo& param = candidate.info().params[static_cast<std::size_t>(p)];
    if (!param.live) {
      draft.report.add(
          entry.where(),
          path + "." + entry.key +
              ": is fixed when the flight begins; a phase can set live parameters alone. Live: " +
              join(live) + ".");
      continue;
    }
    Overlay item{p, initial_value(param)};
    read_param(param, entry.value, path + "." + entry.key, item.value, draft.files, draft.report);
    overlay.push_back(std::move(item));
  }
}

/// A phase's overlay on the component that --role puts in another one's place: the entries that it has a live
/// parameter for.
std::vector<Overlay> overlay_for(Draft& draft, const Candidate& candidate, const Node& set,
                                 const std::string& path) {
  std::vector<Overlay> overlay;
  if (!set.is(Node::Kind::map) || !candidate.loaded) return overlay;
  Node known = set;
  std::erase_if(known.entries, [&](const Node::Entry& entry) {
    const int p = candidate.info().param(entry.key);
    return p < 0 || !candidate.info().params[static_cast<std::size_t>(p)].live;
  });
  read_overlay(draft, candidate, known, path, overlay);
  return overlay;
}

/// What a phase says of a role, checked also where --role then changes it.
void read_assignment(Draft& draft, const AssignmentText& text, const std::string& path, int command,
                     Assignment& assignment) {
  const auto role = static_cast<std::size_t>(draft.role(text.role));
  if (text.role == "vehicle")
    return draft.report.add(
        text.where,
        path + ": the vehicle does not change in flight; choose it with io or with --role vehicle=NAME");
  int use = draft.roles[role].fillers.empty() ? -1 : draft.roles[role].fillers.front();
  if (!text.use.empty()) use = filler_named(draft, role, text.use, text.where_use, path);
  const int fallback = text.fallback.empty() ? -1
                                             : filler_named(draft, role, text.fallback, text.where_fallback,
                                                            path + ".fallback");
  if (fallback >= 0 && fallback == use)
    draft.report.add(text.where_fallback,
                     path + ".fallback: " + text.fallback + " is the component that fills the role already");
  std::vector<Overlay> overlay;
  if (use >= 0)
    read_overlay(draft, draft.candidates[static_cast<std::size_t>(use)], text.set, path + ".set", overlay);
  assignment.component = command >= 0 ? command : use;
  if (fallback != assignment.component) assignment.fallback = fallback;
  if (assignment.component == use)
    assignment.set = std::move(overlay);
  else if (command >= 0)
    assignment.set =
        overlay_for(draft, draft.candidates[static_cast<std::size_t>(command)], text.set, path + ".set");
}

std::string phase_path(const PhaseText& phase) { return "phases." + phase.name; }

const PhaseText& only_phase() {
  static const PhaseText phase{"flight", {}, {}, {}};
  return phase;
}

std::vector<const PhaseText*> phases_of(const MissionText& text) {
  std::vector<const PhaseText*> phases;
  for (const PhaseText& phase : text.phases) phases.push_back(&phase);
  if (phases.empty()) phases.push_back(&only_phase());
  return phases;
}

}  // namespace

void assign_roles(Draft& draft) {
  const std::vector<int> command = chosen_by_command(draft);
  for (const PhaseText* phase : phases_of(draft.text)) {
    std::vector<Assignment> roles(draft.roles.size());
    for (std::size_t r = 0; r < roles.size(); ++r) {
      const auto& fillers = draft.roles[r].fillers;
      roles[r].component = command[r] >= 0 ? command[r] : fillers.empty() ? -1 : fillers.front();
    }
    for (const AssignmentText& text : phase->roles) {
      const auto r = static_cast<std::size_t>(draft.role(text.role));
      read_assignment(draft, text, phase_path(*phase) + "." + text.role, command[r], roles[r]);
    }
    for (const Assignment& assignment : roles)
      for (const int i : {assignment.component, assignment.fallback})
        if (i >= 0) draft.candidates[static_cast<std::size_t>(i)].assigned = true;
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
      if (role < 0 || draft.roles[static_cast<std::size_t>(role)].unclear) throw Unclear{};
      throw NobodyProvides(owner + "." + port + " is provided by nobody in this run");
    }
    if (target.source.kind == Source::Kind::component) {
      Candidate& candidate = draft.candidates[static_cast<std::size_t>(target.source.index)];
      if (!built)
        candidate.used = true;
      else
        target.source.index = candidate.component;
    } else if (built) {
      const Role& role = draft.graph.roles[static_cast<std::size_t>(target.source.index)];
      const auto o = static_cast<std::size_t>(target.source.output);
      const bool provided = std::any_of(role.provides.begin(), role.provides.end(),
                                        [&](const auto& outputs) { return outputs[o] >= 0; });
      if (!provided) throw NobodyProvides(owner + "." + port + " is provided by nobody in this run");
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
    draft.report.add(where, path + ": " + fault.what());
  }
}

/// What every result has: a summary must not write over it.
const std::vector<std::string> result_keys = {
    "allocations", "dds",        "flight_time_s", "guards",           "io",     "live",   "log",
    "log_dropped", "log_sha256", "mission",       "not_reproducible", "phases", "reason", "result",
    "seed",        "speedup",    "step_time_us",  "wall_time_s"};

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
  const ShownField field = find_shown(word.text, find);
  const fulmar_kind kind = field.field.field->kind;
  if (kind == FULMAR_STRUCT || kind == FULMAR_TEXT)
    throw Error("'" + word.text + "' is " +
                (kind == FULMAR_TEXT ? "text" : "a " + field.field.field->type->name) + ", not a number");
  return {word.text, field.from, field.field, field.type};
}

void read_shown(Draft& draft, const FindPort& find) {
  draft.graph.progress.clear();
  for (const Word& word : draft.text.progress)
    guarded(draft, word.where, "progress", [&] { draft.graph.progress.push_back(shown(word, find)); });
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
      if (i < 0) throw Error(not_there(draft, name));
      const Candidate& candidate = draft.candidates[static_cast<std::size_t>(i)];
      if (!candidate.loaded) throw Unclear{};
      const int p = candidate.info().param(of);
      std::vector<std::string> names;
      for (const ParamInfo& each : candidate.info().params) names.push_back(each.name);
      if (p < 0) throw Error(name + " has no parameter '" + of + "'." + choices_text(of, names));
      const ParamInfo& info = candidate.info().params[static_cast<std::size_t>(p)];
      if (info.kind != FULMAR_COUNT && info.kind != FULMAR_NUMBER) throw Error(param + " is no number");
      if (!info.live)
        throw Error(
            param +
            " is fixed when the flight begins; whether it resumes is known when the vehicle has spoken");
      draft.graph.resume.push_back({param, shown(word, find)});
    });
  }
}

std::shared_ptr<const Condition> compiled(Draft& draft, const std::string& text, const Where& where,
                                          const std::string& path, const FindPort& find) {
  std::shared_ptr<const Condition> condition;
  guarded(draft, where, path, [&] { condition = Condition::compile(text, find); });
  return condition;
}

std::vector<Transition> transitions(Draft& draft, const std::vector<TransitionText>& texts,
                                    const std::string& path, const FindPort& find) {
  std::vector<Transition> list;
  const auto phases = phases_of(draft.text);
  std::vector<std::string> names;
  for (const PhaseText* phase : phases) names.push_back(phase->name);
  for (const TransitionText& text : texts) {
    Transition transition;
    const auto it = std::find(names.begin(), names.end(), text.to);
    if (it == names.end() && !text.to.empty())
      draft.report.add(text.where_to,
                       path + ".to: there is no phase '" + text.to + "'." + choices_text(text.to, names));
    if (it != names.end()) transition.to = static_cast<int>(it - names.begin());
    if (!text.when.empty())
      transition.when = compiled(draft, text.when, text.where_when, path + ".when", find);
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
  graph.done_for_ns = draft.text.done_for_ns;
  graph.failed_for_ns = draft.text.failed_for_ns;
  if (draft.text.done)
    graph.done = compiled(draft, draft.text.done->text, draft.text.done->where, "done", find);
  if (draft.text.failed)
    graph.failed = compiled(draft, draft.text.failed->text, draft.text.failed->where, "failed", find);
  read_shown(draft, find);
  read_summary(draft, find);
  read_told(draft, find);
  read_resume(draft, find);
  graph.phases.clear();
  for (const PhaseText* text : phases_of(draft.text)) {
    Phase phase;
    phase.name = text->name;
    phase.where = text->where;
    phase.next = transitions(draft, text->next, phase_path(*text) + ".next", find);
    graph.phases.push_back(std::move(phase));
  }
  graph.any = transitions(draft, draft.text.any, "phases.any.next", find);
}

void check_reachable(Draft& draft) {
  const Graph& graph = draft.graph;
  std::vector<bool> reached(graph.phases.size(), false);
  std::vector<std::size_t> todo{0};
  reached[0] = true;
  const auto follow = [&](const std::vector<Transition>& next) {
    for (const Transition& transition : next) {
      if (transition.to < 0 || reached[static_cast<std::size_t>(transition.to)]) continue;
      reached[static_cast<std::size_t>(transition.to)] = true;
      todo.push_back(static_cast<std::size_t>(transition.to));
    }
  };
  follow(graph.any);
  while (!todo.empty()) {
    const std::size_t at = todo.back();
    todo.pop_back();
    follow(graph.phases[at].next);
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
    return candidate < 0 ? -1 : draft.candidates[static_cast<std::size_t>(candidate)].component;
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
