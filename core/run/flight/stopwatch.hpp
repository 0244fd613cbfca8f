// SPDX-License-Identifier: BSD-3-Clause
// The clock on the wall: what a step takes of it, whether that is too much, and when the next tick may begin.
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
  /// [tick] At the begin of each. Where nothing is judged by the clock, one tick in eight is timed: to read
  /// it after each step costs more than many a step.
  void enter(std::uint64_t tick) noexcept;
  /// [tick] Charges the time since the last reading to `unit`: one reading between two steps times both. True
  /// when the unit has been over its budget for too long.
  bool charge(Unit& unit) noexcept;
  /// [tick] The time since the last reading is nobody's.
  void skip() noexcept;
  /// [tick] Flight time goes on from here, at a speed of its own: what it stood still is not caught up.
  void go_on() noexcept;
  /// [tick] Flight time has stood still since then.
  void note_stood(std::int64_t since_ns) noexcept;
  /// [tick] Sleeps until the wall clock has caught up with flight time. Seconds that flight time is behind.
  double pace() noexcept;
  /// [tick] Every 200 ms.
  bool time_to_show() noexcept;
  double elapsed_s() const noexcept;  // without what it stood still

 private:
  std::int64_t measure(Unit& unit) noexcept;

  const FlightState& state_;
  Recorder& recorder_;
  bool timed_ = true;  // this tick
  std::int64_t wall_ns_ = 0, begin_ns_ = 0, shown_ns_ = 0, stood_ns_ = 0;
  // where the flight's speed counts from; never: from the first tick
  std::int64_t paced_wall_ns_ = 0, paced_flight_ns_ = never_ns;
};

}  // namespace fulmar::core
