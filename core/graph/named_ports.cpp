// SPDX-License-Identifier: BSD-3-Clause
// The ports that a mission names for figures and decisions: conditions, figures, texts, and the transitions
// between phases.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

/// Thrown when a port belongs to a component that was rejected: no further fault.
struct Unclear {};

/// Thrown when no component that fills a role in this run has one of its optional outputs.
struct NobodyProvides : Error {
  using Error::Error;
};

/// `built`: sources are indexes of the graph's components, else of candidates, which are then marked as used.
FindPort finder(Draft& draft, bool built) {
  return [&draft, built](const std::string& owner, const std::string& port) {
    Target target = find_target(draft, {owner, port});
    if (target.unclear) {
      const int role = draft.role(owner);
      if (role < 0 || nth(draft.roles, role).unclear) throw Unclear{};
      throw NobodyProvides(graph_messages::port_not_provided(owner, port));
    }
    if (target.source.kind == Source::Kind::component) {
      Candidate& candidate = nth(draft.candidates, target.source.index);
      if (!built)
        candidate.used = true;
      else
        target.source.index = candidate.component;
    } else if (built && !provided(draft.graph, target.source)) {
      throw NobodyProvides(graph_messages::port_not_provided(owner, port));
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
    report(draft, where, path, fault);
  }
}

/// Whether a key that only reports has lost its component: a layer removed it, it belongs to the other io, or
/// a layer gave it another plugin without such an output.
bool is_left_out(const Draft& draft, const Word& word) {
  const auto dot = word.text.find('.');
  const std::string owner = word.text.substr(0, dot);
  const ComponentText* const text = draft.text.component(owner);
  if (!text) return draft.report.is_taken_away("components." + owner);
  if (draft.is_out(*text)) return true;
  const int i = draft.candidate(owner);
  if (dot == std::string::npos || i < 0 || !nth(draft.candidates, i).loaded) return false;
  const auto& below = draft.text.below;
  const bool replaced = std::any_of(below.begin(), below.end(), [&](const MissionText& layer) {
    const ComponentText* const was = layer.component(owner);
    return was && was->use.text != text->use.text;
  });
  return replaced && index_named(nth(draft.candidates, i).info().outputs, word.text.substr(dot + 1)) < 0;
}

/// Like `guarded`, for a key that only reports: it is dropped with its component. Returns whether it stays.
template <class F>
bool report_of(Draft& draft, const Word& word, const std::string& path, F run) {
  const bool gone = is_left_out(draft, word);
  if (gone)
    draft.graph.judge.left_out.push_back({path, word.text});
  else
    guarded(draft, word.where, path, run);
  return !gone;
}

/// Keys of every result: a summary must not overwrite them.
const std::vector<std::string> result_keys = {
    "allocations", "behind_max_s", "dds",     "flight_time_s",    "guards",
    "io",          "live",         "log",     "log_dropped",      "log_error",
    "log_sha256",  "misses",       "mission", "not_reproducible", "phases",
    "reason",      "result",       "seed",    "speedup",          "step_time_us",
    "verdict",     "wall_time_s",  "who_flew"};

std::pair<Source, TypePtr> find_port(const Word& word, const std::string& example, const FindPort& find) {
  const auto dot = word.text.find('.');
  if (dot == std::string::npos || word.text.find('.', dot + 1) != std::string::npos)
    throw Error(graph_messages::port_name_expected(example, word.text));
  return find(word.text.substr(0, dot), word.text.substr(dot + 1));
}

void read_summary(Draft& draft, const FindPort& find) {
  draft.graph.judge.summary.clear();
  for (const auto& entry : draft.text.judge.summary) {
    const std::string& key = entry.first;
    const Word& word = entry.second;
    const bool stays = report_of(draft, word, "summary." + key, [&] {
      if (std::find(result_keys.begin(), result_keys.end(), key) != result_keys.end())
        throw Error(graph_messages::summary_key_reserved(key));
      const auto [source, type] = find_port(word, "score.tracking", find);
      if (!type) throw Error(graph_messages::summary_of_probe(word.text));
      draft.graph.judge.summary.emplace_back(key, source);
    });
    if (!stays) draft.graph.judge.summary.emplace_back(key, Source{});
  }
}

/// Ports of texts for users. A vehicle without such a text is no fault.
void read_reported(Draft& draft, const FindPort& find) {
  draft.graph.report.clear();
  for (const Word& word : draft.text.report)
    report_of(draft, word, "tell", [&] {
      try {
        const auto [source, type] = find_port(word, "vehicle.notices", find);
        const Field* const text = type ? type->find("text") : nullptr;
        if (!text || text->kind != FULMAR_TEXT)
          throw Error(graph_messages::text_field_missing(word.text, type ? type->name : "a probe"));
        draft.graph.report.push_back(source);
      } catch (const NobodyProvides&) {
      }
    });
}

/// The verdict of the flight: a word and a sentence.
void read_verdict(Draft& draft, const FindPort& find) {
  draft.graph.judge.verdict.reset();
  if (!draft.text.judge.verdict) return;
  const Word& word = *draft.text.judge.verdict;
  report_of(draft, word, "verdict", [&] {
    const auto [source, type] = find_port(word, "score.verdict", find);
    const Field* const of = type ? type->find("word") : nullptr;
    const Field* const text = type ? type->find("text") : nullptr;
    if (!of || !text || of->kind != FULMAR_TEXT || text->kind != FULMAR_TEXT)
      throw Error(graph_messages::event_fields_missing(word.text, type ? type->name : "a probe"));
    draft.graph.judge.verdict = VerdictPort{source, of->offset, text->offset, of->stride, text->stride};
  });
}

Shown shown(const Word& word, const FindPort& find) {
  Shown shown = find_shown(word.text, find);
  const Field& field = *shown.field.field;
  if (field.kind == FULMAR_STRUCT || field.kind == FULMAR_TEXT)
    throw Error(graph_messages::field_not_number(
        word.text, field.kind == FULMAR_TEXT ? "text" : "a " + field.type->name));
  return shown;
}

void read_shown(Draft& draft, const FindPort& find) {
  draft.graph.judge.progress.clear();
  for (const Word& word : draft.text.judge.progress) {
    if (draft.report.full()) break;
    guarded(draft, word.where, "progress", [&] { draft.graph.judge.progress.push_back(shown(word, find)); });
  }
}

void read_resume(Draft& draft, const FindPort& find) {
  draft.graph.resume.clear();
  for (const auto& entry : draft.text.resume) {
    const std::string& param = entry.first;
    const Word& word = entry.second;
    guarded(draft, word.where, "resume." + param, [&] {
      const auto dot = param.find('.');
      if (dot == std::string::npos) throw Error(graph_messages::parameter_name_expected(param));
      const std::string name = param.substr(0, dot), of = param.substr(dot + 1);
      const int i = draft.candidate(name);
      const ComponentText* const text = draft.text.component(name);
      if (text && draft.is_out(*text)) return;  // the component does not exist in this run
      if (i < 0) throw NoOwner(name, not_there(draft, name));
      const Candidate& candidate = nth(draft.candidates, i);
      if (!candidate.loaded) throw Unclear{};
      const auto& params = candidate.info().params;
      const ParamInfo& info = nth(params, require_named(params, of, name, "parameter"));
      if (info.kind != FULMAR_COUNT && info.kind != FULMAR_NUMBER)
        throw Error(graph_messages::parameter_not_number(param));
      if (!info.live) throw Error(graph_messages::parameter_not_live(param));
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
      draft.report.add(text.to.where, located(path + ".to", no_such("phase", text.to.text, phases)));
    if (!text.when.text.empty()) transition.when = compiled(draft, text.when, path + ".when", find);
    transition.for_ns = text.for_ns;
    transition.where = text.where;
    list.push_back(std::move(transition));
  }
  return list;
}

/// Compiles all that names ports into the graph.
void compile_all(Draft& draft, bool built) {
  const FindPort find = finder(draft, built);
  Graph& graph = draft.graph;
  graph.judge.left_out.clear();
  if (draft.text.judge.done) graph.judge.done = compiled(draft, *draft.text.judge.done, "done", find);
  if (draft.text.judge.failed) graph.judge.failed = compiled(draft, *draft.text.judge.failed, "failed", find);
  if (draft.text.judge.flown) graph.judge.flown = compiled(draft, *draft.text.judge.flown, "flown", find);
  read_verdict(draft, find);
  read_shown(draft, find);
  read_summary(draft, find);
  read_reported(draft, find);
  read_resume(draft, find);
  graph.phases.clear();
  for (const PhaseText& text : phases_of(draft.text))
    graph.phases.push_back(
        {text.name, {}, transitions(draft, text.next, phase_path(text) + ".next", find), text.where});
  graph.any = transitions(draft, draft.text.any, "phases.any.next", find);
}

/// No check while a removed phase is still named: that fault is reported already.
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
      draft.report.add(graph.phases[i].where,
                       graph_messages::phase_unreachable(graph.phases[i].name, graph.phases[0].name));
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
  std::vector<std::string> gone;
  for (const auto& [key, port] : draft.graph.judge.left_out) gone.push_back(key + " (" + port + ")");
  if (!gone.empty())
    draft.graph.source.warnings.push_back(
        located(Where{draft.text.file->name, 0}, graph_messages::outputs_not_in_flight(join(gone))).line());
}

}  // namespace fulmar::core
