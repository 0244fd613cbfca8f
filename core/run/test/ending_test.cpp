// SPDX-License-Identifier: BSD-3-Clause
// The end of a flight without a flight: every state with every cue, and the actions for the facts of a tick.
#include "core/run/state/ending.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace ending_test {

using namespace fulmar::core;
using State = Ending::State;
using Cue = Ending::Cue;
using Act = Ending::Act;
using Reason = Ending::Reason;
using Facts = Ending::Facts;

namespace {

constexpr State states[] = {State::flying,    State::concluded, State::failsafe,
                            State::giving_up, State::silent,    State::over};
constexpr Cue cues[] = {Cue::done,         Cue::failed,        Cue::duration,       Cue::timeout,
                        Cue::none_left,    Cue::silence,       Cue::disarmed,       Cue::signal,
                        Cue::first_signal, Cue::second_signal, Cue::vehicle_failed, Cue::abandoned};

bool in_failsafe(State s) { return s == State::failsafe || s == State::giving_up || s == State::silent; }

/// The transition of each state for each cue, by the rules of docs/missions.md ("The end of a flight") and
/// docs/safety.md ("Signals on hardware").
Ending::Step expected(State s, Cue c) {
  const Ending::Step nothing{s, Act::none, Reason::none};
  if (s == State::over) return nothing;  // no transition from the end
  switch (c) {
    case Cue::done:  // a flight in its failsafe is never done, and the first verdict stands
      return s == State::flying ? Ending::Step{State::concluded, Act::report_done, Reason::done} : nothing;
    case Cue::failed:
      if (s == State::flying) return {State::concluded, Act::report_failed, Reason::failed};
      if (s == State::failsafe || s == State::giving_up) return {s, Act::report_failed, Reason::failed};
      return nothing;
    case Cue::duration:  // in the failsafe it was not flown
      if (s == State::flying) return {State::concluded, Act::report_duration, Reason::duration};
      if (s == State::failsafe || s == State::giving_up) return {s, Act::report_duration, Reason::failsafe};
      return nothing;
    case Cue::timeout: return {State::over, Act::end, Reason::timeout};
    case Cue::none_left:
      return in_failsafe(s) ? nothing : Ending::Step{State::failsafe, Act::none, Reason::none};
    case Cue::silence:
      if (s == State::failsafe) return {State::silent, Act::report_silent, Reason::failsafe};
      if (s == State::giving_up) return {State::over, Act::end, Reason::gave_up};
      return nothing;
    case Cue::disarmed:  // no decision yet in flight
      return s == State::flying ? nothing : Ending::Step{State::over, Act::end, Reason::none};
    case Cue::signal: return {State::over, Act::end, Reason::signal};
    case Cue::first_signal:
      return s == State::giving_up ? nothing : Ending::Step{s, Act::refuse_signal, Reason::none};
    case Cue::second_signal:
      if (s == State::giving_up) return nothing;
      if (s == State::silent) return {State::over, Act::end, Reason::failsafe};
      return {State::giving_up, s == State::failsafe ? Act::none : Act::give_up, Reason::none};
    case Cue::vehicle_failed: return {State::over, Act::end, Reason::vehicle_failed};
    case Cue::abandoned: return {State::over, Act::end, Reason::abandoned};
  }
  return nothing;
}

constexpr std::int64_t second = 1'000'000'000;

std::vector<Act> acts_of(const Ending::Acts& acts) { return {acts.begin(), acts.end()}; }

/// Facts at `t_s` on hardware, armed, with the change by `change`.
template <class F>
std::vector<Act> armed(Ending& e, double t_s, F change) {
  Facts f;
  f.now_ns = static_cast<std::int64_t>(t_s * 1e9);
  f.armed = true;
  change(f);
  return acts_of(e.tick(f));
}
std::vector<Act> armed(Ending& e, double t_s) {
  return armed(e, t_s, [](Facts&) {});
}
std::vector<Act> disarmed(Ending& e, double t_s) {
  return armed(e, t_s, [](Facts& f) { f.armed = false; });
}
constexpr auto with_signal = [](Facts& f) { f.signal = true; };

}  // namespace

TEST_CASE("every state handles every cue by the rules") {
  for (const State s : states)
    for (const Cue c : cues) {
      CAPTURE(static_cast<int>(s));
      CAPTURE(static_cast<int>(c));
      CHECK(Ending::step(s, c) == expected(s, c));
    }
}

TEST_CASE("the state over is final, and every other state can be left") {
  for (const Cue c : cues) CHECK(Ending::step(State::over, c).next == State::over);
  for (const State s : states)
    for (const Cue c : {Cue::signal, Cue::vehicle_failed, Cue::abandoned})
      CHECK(Ending::step(s, c).next == State::over);
}

TEST_CASE("the outcome follows from the reason") {
  for (const Reason r : {Reason::done, Reason::duration}) CHECK(Ending::outcome(r) == Outcome::flown);
  for (const Reason r : {Reason::failed, Reason::timeout, Reason::failsafe, Reason::vehicle_failed})
    CHECK(Ending::outcome(r) == Outcome::failed);
  for (const Reason r : {Reason::gave_up, Reason::signal, Reason::abandoned})
    CHECK(Ending::outcome(r) == Outcome::interrupted);
}

TEST_CASE("without an armed aircraft a verdict ends the flight in its tick, without a report") {
  Ending e(2 * second);
  Facts f;
  f.done = true;
  CHECK(acts_of(e.tick(f)) == std::vector{Act::end});
  CHECK(e.over());
  CHECK(e.reason() == Reason::done);
}

TEST_CASE(
    "of two verdicts in one tick done counts; failed comes before the duration, that before the timeout") {
  Facts f;
  f.done = f.failed = f.duration = f.timeout = true;
  for (const Reason expected_reason : {Reason::done, Reason::failed, Reason::duration, Reason::timeout}) {
    Ending e(0);
    e.tick(f);
    CHECK(e.reason() == expected_reason);
    f.done = expected_reason != Reason::done && f.done;
    if (expected_reason == Reason::done) f.done = false;
    if (expected_reason == Reason::failed) f.failed = false;
    if (expected_reason == Reason::duration) f.duration = false;
  }
}

TEST_CASE("an armed aircraft that is done flies on, is reported once, and ends when it is disarmed") {
  Ending e(2 * second);
  const auto done = [](Facts& f) { f.done = true; };
  CHECK(armed(e, 1, done) == std::vector{Act::report_done});
  CHECK(armed(e, 2, done).empty());
  CHECK(armed(e, 3, [](Facts& f) { f.failed = f.duration = true; }).empty());  // the first verdict stands
  CHECK(e.steering(3 * second) == Ending::Steering::commands);
  CHECK(disarmed(e, 4) == std::vector{Act::end});
  CHECK(e.reason() == Reason::done);
}

TEST_CASE("the failsafe's values are sent for their time, then nothing; a second later it is reported") {
  Ending e(2 * second);
  e.take(Cue::none_left, 10 * second);
  CHECK(e.steering(10 * second) == Ending::Steering::failsafe);
  CHECK(e.steering(12 * second - 1) == Ending::Steering::failsafe);
  CHECK(e.steering(12 * second) == Ending::Steering::nothing);
  CHECK(armed(e, 12.9).empty());
  CHECK(armed(e, 13) == std::vector{Act::report_silent});
  CHECK(armed(e, 14).empty());
  CHECK(e.steering(14 * second) == Ending::Steering::nothing);
  CHECK(disarmed(e, 20) == std::vector{Act::end});
  CHECK(e.reason() == Reason::failsafe);
  Ending without(0);
  without.take(Cue::none_left, 5);
  CHECK(without.steering(5) == Ending::Steering::nothing);
}

TEST_CASE("a failsafe without an armed aircraft ends a second after its values, failed") {
  Ending e(2 * second);
  e.take(Cue::none_left, 0);
  CHECK(disarmed(e, 2.9).empty());
  CHECK(disarmed(e, 3) == std::vector{Act::end});
  CHECK(e.reason() == Reason::failsafe);
}

TEST_CASE(
    "what was flown before a failsafe has failed; what had failed before has failed for its own reason") {
  for (const bool failed : {false, true}) {
    Ending e(2 * second);
    armed(e, 1, [&](Facts& f) { (failed ? f.failed : f.done) = true; });
    e.take(Cue::none_left, 2 * second);
    CHECK(disarmed(e, 3) == std::vector{Act::end});
    CHECK(e.reason() == (failed ? Reason::failed : Reason::failsafe));
  }
}

TEST_CASE("a failsafe does not begin again, and a later verdict is reported once") {
  Ending e(2 * second);
  e.take(Cue::none_left, 0);
  e.take(Cue::none_left, 1 * second);
  CHECK(e.steering(2 * second) == Ending::Steering::nothing);
  CHECK(armed(e, 2, [](Facts& f) { f.done = f.duration = true; }) == std::vector{Act::report_duration});
  CHECK(armed(e, 2.1, [](Facts& f) { f.duration = f.failed = true; }).empty());
  CHECK(e.reason() == Reason::failsafe);
}

TEST_CASE(
    "a signal is refused while armed; a second one within five seconds is silent at once, and ends after the "
    "silence") {
  Ending e(2 * second);
  CHECK(armed(e, 1, with_signal) == std::vector{Act::refuse_signal});
  CHECK(armed(e, 6.1, with_signal) == std::vector{Act::refuse_signal});  // too late: a first one again
  CHECK(armed(e, 11, with_signal) == std::vector{Act::give_up});
  CHECK(e.steering(11 * second) == Ending::Steering::nothing);  // no throttle 0: the pilot's sticks apply
  CHECK(armed(e, 11.1, with_signal).empty());
  CHECK(e.steering(11'100'000'000) == Ending::Steering::nothing);
  CHECK(armed(e, 11.9, with_signal).empty());
  CHECK(armed(e, 12, with_signal) == std::vector{Act::end});
  CHECK(e.reason() == Reason::gave_up);
}

TEST_CASE("a signal without an armed aircraft ends the flight, unless the end was decided before") {
  Ending e(2 * second);
  CHECK(armed(e, 1, [](Facts& f) {
          f.signal = true;
          f.armed = false;
        }) == std::vector{Act::end});
  CHECK(e.reason() == Reason::signal);
  Ending decided(2 * second);
  armed(decided, 1, [](Facts& f) { f.done = true; });
  armed(decided, 2, [](Facts& f) {
    f.signal = true;
    f.armed = false;
  });
  CHECK(decided.reason() == Reason::done);
}

TEST_CASE("in silence a repeated signal ends the host at once") {
  Ending e(second);
  e.take(Cue::none_left, 0);
  CHECK(armed(e, 2) == std::vector{Act::report_silent});
  CHECK(armed(e, 3, with_signal) == std::vector{Act::refuse_signal});
  CHECK(armed(e, 4, with_signal) == std::vector{Act::end});
  CHECK(e.reason() == Reason::failsafe);
}

TEST_CASE("giving up in a failsafe ends it: silent at once, over after the silence") {
  Ending e(2 * second);
  e.take(Cue::none_left, 0);
  CHECK(armed(e, 1, with_signal) == std::vector{Act::refuse_signal});
  CHECK(armed(e, 1.5, with_signal).empty());
  CHECK(e.state() == State::giving_up);
  CHECK(e.steering(1'500'000'000) == Ending::Steering::nothing);
  CHECK(armed(e, 2.4).empty());
  CHECK(armed(e, 2.5) == std::vector{Act::end});
  CHECK(e.reason() == Reason::gave_up);
}

}  // namespace ending_test
