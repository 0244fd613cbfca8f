// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight/end.hpp"

#include <cstdio>

#include "core/run/messages.hpp"

namespace fulmar::core {
namespace {

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

}  // namespace

bool FlightEnd::reached() {
  const Graph& graph = state_.graph;
  const FlightOptions& options = state_.options;
  Ending::Facts facts;
  facts.now_ns = state_.now_ns;
  facts.armed = protection_.armed_hardware();
  facts.done = graph.judge.done && ending_.asks_done() &&
               wiring_.held_for(*graph.judge.done, graph.done_for_ns, done_since_ns_);
  facts.failed = graph.judge.failed && ending_.asks_failed() &&
                 wiring_.held_for(*graph.judge.failed, graph.failed_for_ns, failed_since_ns_);
  if (graph.judge.flown && !flown_)
    flown_ = wiring_.held_for(*graph.judge.flown, graph.flown_for_ns, flown_since_ns_);
  facts.duration =
      options.duration_s && state_.now_ns >= static_cast<std::int64_t>(*options.duration_s * 1e9);
  facts.timeout = graph.timeout_ns > 0 && !state_.on_hardware() && state_.now_ns >= graph.timeout_ns;
  facts.signal = options.interrupt && options.interrupt->load(std::memory_order_relaxed) != 0;
  for (const Ending::Act act : ending_.tick(facts)) carry_out(act);
  return ending_.over();
}

void FlightEnd::failsafe(const Event& why) {
  if (ending_.in_failsafe()) return;
  end_by(Ending::Cue::none_left);
  failsafe_words_ = why.words;
  recorder_.note(why);
}

void FlightEnd::carry_out(Ending::Act act) {
  switch (act) {
    case Ending::Act::none: return;
    case Ending::Act::report_done: return report_verdict(Code::concluded, "done: ");
    case Ending::Act::report_failed: return report_verdict(Code::concluded, "failed: ");
    case Ending::Act::report_duration: return report_verdict(Code::duration_reached, "");
    case Ending::Act::report_silent: {
      Event e = event_of(Code::silent);
      say(e, run_messages::failsafe_over);
      return recorder_.note(e);
    }
    case Ending::Act::refuse_signal: return refuse_signal();
    case Ending::Act::give_up: return give_up();
    case Ending::Act::end: return conclude();
  }
}

void FlightEnd::conclude() {
  FlightResult& result = state_.result;
  result.outcome = Ending::outcome(ending_.reason());
  result.reason = reason_text();
  const bool short_of_it = ending_.reason() == Ending::Reason::done && state_.graph.judge.flown && !flown_;
  if (!short_of_it) return;
  result.outcome = Outcome::aborted;
  result.reason += "; never held: " + state_.graph.judge.flown->text();
}

/// run_command.cpp has the signal handler's part.
void FlightEnd::refuse_signal() {
  state_.options.interrupt->store(0, std::memory_order_relaxed);
  Event e = event_of(Code::signal_refused);
  say(e, run_messages::signal_refused);
  recorder_.note(e);
}

void FlightEnd::give_up() {
  Event why = event_of(Code::gave_up);
  say(why, run_messages::control_given_up);
  failsafe_words_ = why.words;
  recorder_.note(why);
}

void FlightEnd::report_verdict(Code code, const char* what) {
  Event e = event_of(code);
  if (Ending::outcome(ending_.reason()) == Outcome::failed) e.severity = Severity::error;
  say(e, run_messages::end_deferred, what, reason_text());
  recorder_.note(e);
}

std::string FlightEnd::reason_text() const {
  switch (ending_.reason()) {
    case Ending::Reason::none: break;
    case Ending::Reason::done: return state_.graph.judge.done->text();
    case Ending::Reason::failed: return state_.graph.judge.failed->text();
    case Ending::Reason::duration: return "duration reached";
    case Ending::Reason::timeout:
      return run_messages::mission_not_done(short_number(1e-9 * static_cast<double>(state_.graph.timeout_ns)))
          .line();
    case Ending::Reason::failsafe:
    case Ending::Reason::gave_up: return failsafe_words_.data();
    case Ending::Reason::signal: return run_messages::ended_by_signal().line();
    case Ending::Reason::vehicle_failed:
      return run_messages::vehicle_failed(wiring_.vehicle().problem.text).line();
    case Ending::Reason::abandoned:
      return state_.restart ? run_messages::ended_for_restart().line()
                            : run_messages::ended_by_owner().line();
  }
  return "";
}

}  // namespace fulmar::core
