// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight/streams.hpp"

#include <algorithm>
#include <utility>

#include "core/run/component/unit.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::uint64_t habit = 20;  // samples of a regular output
constexpr std::int64_t pauses = 10;  // factor on its longest pause

}  // namespace

void Streams::add(const Slot& slot, std::int64_t limit_ns) {
  if (slot.port->kind != FULMAR_OUT_EVENT || slot.owner->info->vehicle) return;
  for (Stream& s : streams_)
    if (s.slot == &slot) {
      s.limit_ns = std::min(s.limit_ns, limit_ns);
      return;
    }
  streams_.push_back({.slot = &slot, .limit_ns = limit_ns});
}

void Streams::add_source(const Source& from, std::int64_t limit_ns, const Wiring& wiring,
                         const Graph& graph) {
  const auto add_of = [&](int component, int output) {
    const Component& c = nth(graph.components, component);
    const std::int64_t usual_ns = std::max(min_silence_ns, 3 * c.period_ns + c.latency_ns);
    add(nth(wiring.unit(component).out.slots, output), limit_ns > 0 ? limit_ns : usual_ns);
  };
  if (from.kind == Source::Kind::component) add_of(from.index, from.output);
  if (from.kind != Source::Kind::role) return;
  const Role& role = nth(graph.roles, from.index);
  for (std::size_t f = 0; f < role.fillers.size(); ++f)
    if (const int output = nth(role.provides[f], from.output); output >= 0) add_of(role.fillers[f], output);
}

void Streams::add_condition(const Condition* condition, const Wiring& wiring, const Graph& graph) {
  if (!condition) return;
  for (const Source& port : condition->ports()) add_source(port, 0, wiring, graph);
}

void Streams::connect(const Wiring& wiring, const FlightState& state) {
  const Graph& graph = state.graph;
  streams_.clear();
  for (const auto& unit : wiring.units)
    for (const Reader& reader : unit->in.readers) {
      const Wire& wire = *reader.wire;
      if (wire.by_steps && (wire.max_age_ns > 0 || unit->info->vehicle))
        add_source(wire.from, wire.max_age_ns, wiring, graph);
    }
  add_condition(graph.judge.done.get(), wiring, graph);
  add_condition(graph.judge.failed.get(), wiring, graph);
  for (const Transition& t : graph.any) add_condition(t.when.get(), wiring, graph);
  for (const Phase& phase : graph.phases)
    for (const Transition& t : phase.next) add_condition(t.when.get(), wiring, graph);
}

void Streams::report(Stream& s, bool lapses, FlightState& state, Recorder& recorder) noexcept {
  const std::string &name = s.slot->owner->component->name, &port = s.slot->port->name;
  Event e = event_of(Code::notice, name);
  e.severity = Severity::warning;
  if (!lapses) {
    say(e, run_messages::output_resumed, port);
    return recorder.note(e);
  }
  fulmar_error what{};
  put_problem(what, run_messages::output_silent, port, Fixed{1e-9 * static_cast<double>(s.silent_ns), 1});
  say(e, run_messages::output_silent_event, what.text);
  recorder.note(e);
  if (!s.ever_reported)
    state.result.guards.push_back({state.now_ns, name, what.text, "its last sample stays"});
  s.ever_reported = true;
}

const Slot* Streams::watch(bool held, FlightState& state, Recorder& recorder) noexcept {
  if (streams_.empty()) return nullptr;
  if (++looked_at_ >= streams_.size()) looked_at_ = 0;
  Stream& s = streams_[looked_at_];
  const Unit& unit = unit_of(*s.slot);
  if (!unit.active || unit.stopped) {
    s.samples = 0;
    s.silent_ns = 0;
    s.reported = false;
    return nullptr;
  }
  if (unit.completed_ns == s.completed_ns) return nullptr;
  // a standstill of the whole host does not count as silence
  const std::int64_t stepped_ns = std::min(unit.completed_ns - s.completed_ns, s.limit_ns / 3);
  s.completed_ns = unit.completed_ns;
  const std::uint64_t news = s.slot->sequence - s.sequence;
  s.sequence = s.slot->sequence;
  const bool explained = std::exchange(s.degraded, unit.stats.degraded) != unit.stats.degraded;
  s.silent_ns = held || explained ? 0 : s.silent_ns + stepped_ns;
  if (news == 0) {
    if (s.reported || s.samples < habit || s.silent_ns <= std::max(s.limit_ns, pauses * s.max_ns))
      return nullptr;
    s.reported = true;
    report(s, true, state, recorder);
    return s.slot;
  }
  if (!s.reported && s.samples > 0) s.max_ns = std::max(s.max_ns, s.silent_ns);
  if (s.reported) report(s, false, state, recorder);
  s.reported = false;
  s.silent_ns = 0;
  s.samples += news;
  return nullptr;
}

}  // namespace fulmar::core
