// SPDX-License-Identifier: BSD-3-Clause
// The end of a flight: collects the facts of each tick for ending.hpp, and carries out its answers.
#pragma once
#include <cstdint>
#include <string>

#include "core/log/events.hpp"
#include "core/run/flight/protection.hpp"
#include "core/run/flight/wiring.hpp"
#include "core/run/record/recorder.hpp"
#include "core/run/state/ending.hpp"
#include "core/run/state/state.hpp"

namespace fulmar::core {

class FlightEnd {
 public:
  FlightEnd(FlightState& state, const Wiring& wiring, Recorder& recorder, const Protection& protection)
      : state_(state),
        wiring_(wiring),
        recorder_(recorder),
        protection_(protection),
        ending_(state.graph.failsafe_ns) {}

  /// [tick] At its end: whether it was the last one.
  bool reached();
  /// [tick] A role has no usable component.
  void failsafe(const Event& why);
  /// At once.
  void end_by(Ending::Cue cue) { carry_out(ending_.take(cue, state_.now_ns)); }

  /// [setup] A host that resumes a flight has not observed all of it: the mission's `flown` condition may
  /// have held.
  void taken_up() noexcept { flown_ = true; }
  bool over() const noexcept { return ending_.over(); }
  bool in_failsafe() const noexcept { return ending_.in_failsafe(); }
  bool abandoned() const noexcept { return ending_.reason() == Ending::Reason::abandoned; }
  Ending::Steering steering() const noexcept { return ending_.steering(state_.now_ns); }

 private:
  void carry_out(Ending::Act act);
  void give_up();
  void refuse_signal();
  void report_verdict(Code code, const char* what);
  void conclude();
  std::string reason_text() const;

  FlightState& state_;
  const Wiring& wiring_;
  Recorder& recorder_;
  const Protection& protection_;
  Ending ending_;
  std::int64_t done_since_ns_ = never_ns, failed_since_ns_ = never_ns, flown_since_ns_ = never_ns;
  bool flown_ = false;                       // the mission's `flown` condition has held
  decltype(Event::words) failsafe_words_{};  // reason of the failsafe
};

}  // namespace fulmar::core
