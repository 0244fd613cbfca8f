// SPDX-License-Identifier: BSD-3-Clause
// The host does not end the flight of an armed aircraft on hardware. After any verdict it continues, or sends
// nothing, until the aircraft is disarmed.
#include "core/run/state/ending.hpp"

namespace fulmar::core {
namespace {

using State = Ending::State;
using Act = Ending::Act;
using Reason = Ending::Reason;
using Table = std::array<std::array<Ending::Step, 12>, 6>;

constexpr Ending::Step stays(State state) { return {state, Act::none, Reason::none}; }
constexpr Ending::Step ends(Reason why) { return {State::over, Act::end, why}; }
constexpr Ending::Step as_decided = {State::over, Act::end, Reason::none};

/// Rows: the states; columns: the cues, in the order of their declarations.
constexpr Table transition_table = {{
    // flying
    {{{State::concluded, Act::report_done, Reason::done},
      {State::concluded, Act::report_failed, Reason::failed},
      {State::concluded, Act::report_duration, Reason::duration},
      ends(Reason::timeout),
      {State::failsafe, Act::none, Reason::none},
      stays(State::flying),
      stays(State::flying),
      ends(Reason::signal),
      {State::flying, Act::refuse_signal, Reason::none},
      {State::giving_up, Act::give_up, Reason::none},
      ends(Reason::vehicle_failed),
      ends(Reason::abandoned)}},
    // concluded: the first verdict stands
    {{stays(State::concluded),
      stays(State::concluded),
      stays(State::concluded),
      ends(Reason::timeout),
      {State::failsafe, Act::none, Reason::none},
      stays(State::concluded),
      as_decided,
      ends(Reason::signal),
      {State::concluded, Act::refuse_signal, Reason::none},
      {State::giving_up, Act::give_up, Reason::none},
      ends(Reason::vehicle_failed),
      ends(Reason::abandoned)}},
    // failsafe: never done; the owner of a duration gets the result that it was not flown
    {{stays(State::failsafe),
      {State::failsafe, Act::report_failed, Reason::failed},
      {State::failsafe, Act::report_duration, Reason::failsafe},
      ends(Reason::timeout),
      stays(State::failsafe),
      {State::silent, Act::report_silent, Reason::failsafe},
      as_decided,
      ends(Reason::signal),
      {State::failsafe, Act::refuse_signal, Reason::none},
      {State::giving_up, Act::none, Reason::none},
      ends(Reason::vehicle_failed),
      ends(Reason::abandoned)}},
    // giving_up: no output from its first tick on, then the host ends
    {{stays(State::giving_up),
      {State::giving_up, Act::report_failed, Reason::failed},
      {State::giving_up, Act::report_duration, Reason::failsafe},
      ends(Reason::timeout),
      stays(State::giving_up),
      ends(Reason::gave_up),
      as_decided,
      ends(Reason::signal),
      stays(State::giving_up),
      stays(State::giving_up),
      ends(Reason::vehicle_failed),
      ends(Reason::abandoned)}},
    // silent: there is nothing left to give up
    {{stays(State::silent),
      stays(State::silent),
      stays(State::silent),
      ends(Reason::timeout),
      stays(State::silent),
      stays(State::silent),
      as_decided,
      ends(Reason::signal),
      {State::silent, Act::refuse_signal, Reason::none},
      ends(Reason::failsafe),
      ends(Reason::vehicle_failed),
      ends(Reason::abandoned)}},
    // over
    {{stays(State::over), stays(State::over), stays(State::over), stays(State::over), stays(State::over),
      stays(State::over), stays(State::over), stays(State::over), stays(State::over), stays(State::over),
      stays(State::over), stays(State::over)}},
}};

constexpr bool is_reported(Act act) {
  return act == Act::report_done || act == Act::report_failed || act == Act::report_duration ||
         act == Act::report_silent;
}

}  // namespace

Ending::Step Ending::step(State state, Cue cue) noexcept {
  return transition_table[static_cast<std::size_t>(state)][static_cast<std::size_t>(cue)];
}

Outcome Ending::outcome(Reason reason) noexcept {
  switch (reason) {
    case Reason::done:
    case Reason::duration: return Outcome::flown;
    case Reason::gave_up:
    case Reason::signal:
    case Reason::abandoned: return Outcome::interrupted;
    default: return Outcome::failed;
  }
}

Ending::Act Ending::take(Cue cue, std::int64_t now_ns) noexcept {
  const Step step = Ending::step(state_, cue);
  const bool was_flown = !in_failsafe(), gives_up = step.next == State::giving_up && state_ != step.next;
  state_ = step.next;
  if (step.reason != Reason::none) reason_ = step.reason;
  if (step.act == Act::refuse_signal) refused_ns_ = now_ns;
  if (was_flown && in_failsafe()) {
    failsafe_since_ns_ = now_ns;
    // a result of flown is lost now
    if (reason_ != Reason::none && outcome(reason_) == Outcome::flown) reason_ = Reason::failsafe;
  }
  if (gives_up) failsafe_since_ns_ = now_ns - failsafe_ns_;  // its values would delay the pilot's control
  return step.act;
}

/// The first of the cues that exclude each other.
Ending::Cue Ending::cue_of(const Facts& f, bool& any) const noexcept {
  any = true;
  if (f.done && asks_done()) return Cue::done;
  if (f.failed && asks_failed()) return Cue::failed;
  if (in_failsafe() && f.now_ns - failsafe_since_ns_ >= failsafe_ns_ + silence_ns) return Cue::silence;
  if (f.duration && asks_failed()) return Cue::duration;
  any = f.timeout;
  return Cue::timeout;
}

Ending::Cue Ending::signal_cue(const Facts& f) const noexcept {
  if (!f.armed) return Cue::signal;
  return refused_ns_ != never && f.now_ns - refused_ns_ <= repeat_ns ? Cue::second_signal : Cue::first_signal;
}

Ending::Acts Ending::tick(const Facts& facts) noexcept {
  Acts acts;
  const auto give = [&](Cue cue) {
    const Act act = take(cue, facts.now_ns);
    if (act != Act::none && (facts.armed || !is_reported(act))) acts.list[acts.count++] = act;
  };
  bool any = false;
  if (const Cue cue = cue_of(facts, any); any) give(cue);
  if (reason_ != Reason::none && !facts.armed) give(Cue::disarmed);
  if (facts.signal) give(signal_cue(facts));
  return acts;
}

Ending::Steering Ending::steering(std::int64_t now_ns) const noexcept {
  if (!in_failsafe()) return Steering::commands;
  return now_ns - failsafe_since_ns_ >= failsafe_ns_ ? Steering::nothing : Steering::failsafe;
}

}  // namespace fulmar::core
