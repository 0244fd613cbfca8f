// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock time: duration of a step, its budget, and the start time of the next tick.
#pragma once
#include <cstdint>

#include "core/run/record/recorder.hpp"
#include "core/run/state/state.hpp"

namespace fulmar::core {

class Stopwatch {
 public:
  Stopwatch(const FlightState& state, Recorder& recorder) : state_(state), recorder_(recorder) {}

  /// [tick] In the first one.
  void begin() noexcept;
  /// [tick] At the start of each. Where no limit uses the clock, one tick in eight is timed: a reading after
  /// each step costs more than many a step.
  void enter(std::uint64_t tick) noexcept;
  /// [tick] Charges the time since the last reading to `unit`: one reading between two steps serves both.
  /// True when the unit has exceeded its budget for too long.
  bool charge(Unit& unit) noexcept;
  /// [tick] Charges the time since the last reading to no unit.
  void skip() noexcept;
  /// [tick] Flight time continues from here, at its present speed: a pause is not made up for.
  void go_on() noexcept;
  /// [tick] Flight time has been paused since then.
  void note_stood(std::int64_t since_ns) noexcept;
  /// [tick] Sleeps until the wall clock has reached flight time. Returns the delay of flight time, s.
  double pace() noexcept;
  /// [tick] Every 200 ms.
  bool time_to_show() noexcept;
  double elapsed_s() const noexcept;  // without pauses

 private:
  std::int64_t measure(Unit& unit) noexcept;

  const FlightState& state_;
  Recorder& recorder_;
  bool timed_ = true;  // this tick
  std::int64_t wall_ns_ = 0, begin_ns_ = 0, shown_ns_ = 0, stood_ns_ = 0;
  // start point of the flight's speed; never: from the first tick
  std::int64_t paced_wall_ns_ = 0, paced_flight_ns_ = never_ns;
};

}  // namespace fulmar::core
