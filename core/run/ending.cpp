// SPDX-License-Identifier: BSD-3-Clause
// When a flight ends. An armed aircraft on hardware is not left by the host: whatever the verdict, it flies
// or stays silent until disarmed.
#include <cstdio>

#include "core/run/flight_impl.hpp"

namespace fulmar::core {
namespace {

constexpr std::int64_t silence_ns = 1'000'000'000;  // after a failsafe before the flight is called lost
constexpr std::int64_t repeat_ns = 5'000'000'000;   // how long a refused signal can be repeated

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
  const bool open = conclusion.empty();
  if (open && graph.done && !in_failsafe && held_for(*graph.done, graph.done_for_ns, done_since_ns))
    conclude(Code::concluded, Outcome::flown, graph.done->text(), "done: ");
  else if (open && graph.failed && held_for(*graph.failed, graph.failed_for_ns, failed_since_ns))
    conclude(Code::concluded, Outcome::failed, graph.failed->text(), "failed: ");
  else if (in_failsafe && now_ns - failsafe_since_ns >= graph.failsafe_ns + silence_ns)
    after_failsafe();
  else if (open && options.duration_s && now_ns >= static_cast<std::int64_t>(*options.duration_s * 1e9))
    conclude(Code::duration_reached, in_failsafe ? Outcome::failed : Outcome::flown,
             in_failsafe ? failsafe_reason : "duration reached", "");
  else if (graph.timeout_ns > 0 && graph.io == Io::sim && now_ns >= graph.timeout_ns)
    finish(Outcome::failed,
           "not done within " + short_number(1e-9 * static_cast<double>(graph.timeout_ns)) + " s of flight");
  if (!ended && !conclusion.empty() && !armed_hardware()) {
    const bool lost = in_failsafe && conclusion_outcome == Outcome::flown;
    finish(lost ? Outcome::failed : conclusion_outcome, lost ? failsafe_reason : conclusion);
  }
  if (!ended && options.interrupt && options.interrupt->load(std::memory_order_relaxed) != 0) heed_signal();
  return ended;
}

void Flight::Impl::conclude(Code code, Outcome outcome, const std::string& reason, const char* what) {
  conclusion = reason;
  conclusion_outcome = outcome;
  if (!armed_hardware()) return;
  Event e = event_of(code);
  if (outcome == Outcome::failed) e.severity = Severity::error;
  say(e, "%s%s; flies on until disarmed", what, reason.c_str());
  note(e);
}

void Flight::Impl::after_failsafe() {
  if (silence_told) return;
  silence_told = true;
  conclusion = failsafe_reason;
  conclusion_outcome = Outcome::failed;
  if (giving_up) return finish(Outcome::interrupted, failsafe_reason);
  if (!armed_hardware()) return;
  Event e = event_of(Code::silent);
  say(e, "silent until disarmed: the aircraft is its pilot's");
  note(e);
}

/// A signal asks for the end. While the aircraft is armed it has to be repeated; what the signal's handler
/// does is in run_command.cpp.
void Flight::Impl::heed_signal() {
  if (!armed_hardware()) return finish(Outcome::interrupted, "by a signal");
  if (giving_up) return;
  if (refused_ns == never || now_ns - refused_ns > repeat_ns) {
    refused_ns = now_ns;
    options.interrupt->store(0, std::memory_order_relaxed);
    Event e = event_of(Code::signal_refused);
    say(e, "the aircraft is armed: Ctrl-C once more within 5 s gives up control");
    return note(e);
  }
  giving_up = true;
  if (silence_told) return finish(Outcome::failed, failsafe_reason);
  if (in_failsafe) return;
  Event why = event_of(Code::gave_up);
  say(why, "failsafe: control given up by a signal");
  failsafe(why);
}

void Flight::Impl::finish(Outcome outcome, std::string reason) {
  ended = true;
  result.outcome = outcome;
  result.reason = std::move(reason);
}

}  // namespace fulmar::core
