// SPDX-License-Identifier: BSD-3-Clause
// The end of a flight, as ending.hpp decides it: what is looked at in each tick, and the words for it.
#include <cstdio>

#include "core/run/flight_impl.hpp"

namespace fulmar::core {
namespace {

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

}  // namespace

bool Flight::Impl::held_for(const Condition& condition, std::int64_t for_ns,
                            std::int64_t& since_ns) const noexcept {
  if (!condition.holds(*this)) {
    since_ns = never;
    return false;
  }
  if (since_ns == never) since_ns = now_ns;
  return now_ns - since_ns >= for_ns;
}

bool Flight::Impl::armed_hardware() const noexcept { return graph.io == Io::fcu && armed_flag.says(false); }

bool Flight::Impl::over() {
  Ending::Facts facts;
  facts.now_ns = now_ns;
  facts.armed = armed_hardware();
  facts.done = graph.done && ending.asks_done() && held_for(*graph.done, graph.done_for_ns, done_since_ns);
  facts.failed =
      graph.failed && ending.asks_failed() && held_for(*graph.failed, graph.failed_for_ns, failed_since_ns);
  facts.duration = options.duration_s && now_ns >= static_cast<std::int64_t>(*options.duration_s * 1e9);
  facts.timeout = graph.timeout_ns > 0 && graph.io == Io::sim && now_ns >= graph.timeout_ns;
  facts.signal = options.interrupt && options.interrupt->load(std::memory_order_relaxed) != 0;
  for (const Ending::Act act : ending.tick(facts)) carry_out(act);
  return ending.over();
}

void Flight::Impl::end_by(Ending::Cue cue) { carry_out(ending.take(cue, now_ns)); }

void Flight::Impl::carry_out(Ending::Act act) {
  switch (act) {
    case Ending::Act::none:
      return;
    case Ending::Act::tell_done:
      return tell_verdict(Code::concluded, "done: ");
    case Ending::Act::tell_failed:
      return tell_verdict(Code::concluded, "failed: ");
    case Ending::Act::tell_duration:
      return tell_verdict(Code::duration_reached, "");
    case Ending::Act::tell_silent: {
      Event e = event_of(Code::silent);
      say(e, "silent until disarmed: the aircraft is its pilot's");
      return note(e);
    }
    case Ending::Act::refuse_signal: {
      options.interrupt->store(0, std::memory_order_relaxed);
      Event e = event_of(Code::signal_refused);
      say(e, "the aircraft is armed: Ctrl-C once more within 5 s gives up control");
      return note(e);
    }
    case Ending::Act::give_up: {
      Event why = event_of(Code::gave_up);
      say(why, "failsafe: control given up by a signal");
      failsafe_words = why.words;
      return note(why);
    }
    case Ending::Act::end:
      result.outcome = Ending::outcome(ending.reason());
      result.reason = reason_text();
  }
}

void Flight::Impl::tell_verdict(Code code, const char* what) {
  Event e = event_of(code);
  if (Ending::outcome(ending.reason()) == Outcome::failed) e.severity = Severity::error;
  say(e, "%s%s; flies on until disarmed", what, reason_text().c_str());
  note(e);
}

std::string Flight::Impl::reason_text() const {
  switch (ending.reason()) {
    case Ending::Reason::none:
      return "";
    case Ending::Reason::done:
      return graph.done->text();
    case Ending::Reason::failed:
      return graph.failed->text();
    case Ending::Reason::duration:
      return "duration reached";
    case Ending::Reason::timeout:
      return "not done within " + short_number(1e-9 * static_cast<double>(graph.timeout_ns)) + " s of flight";
    case Ending::Reason::failsafe:
    case Ending::Reason::gave_up:
      return failsafe_words.data();
    case Ending::Reason::signal:
      return "by a signal";
    case Ending::Reason::vehicle_failed:
      return "the vehicle failed: " + std::string(units[static_cast<std::size_t>(graph.vehicle)]->problem.text);
    case Ending::Reason::abandoned:
      return "ended by its owner";
  }
  return "";
}

}  // namespace fulmar::core
