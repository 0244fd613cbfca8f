// SPDX-License-Identifier: BSD-3-Clause
// The end of a flight as one state machine. Its inputs are the facts at the end of a tick, its outputs are
// actions and reports. It does not depend on aircraft, missions or texts, so its table is tested alone.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/run/component/steering.hpp"

namespace fulmar::core {

/// Aborted: `done` holds, but the mission's `flown` condition never did.
enum class Outcome : std::uint8_t { flown, aborted, failed, interrupted };

class Ending {
 public:
  enum class State : std::uint8_t {
    flying,     // no decision yet
    concluded,  // the outcome is decided; an armed aircraft flies on under command
    failsafe,   // a role has no usable component: the vehicle gets the failsafe's values for their time, then
                // nothing
    giving_up,  // a signal has requested the end: the vehicle gets nothing from now on, its pilot has control
    silent,     // the vehicle has had no command for a while: its pilot has control, if it is still armed
    over,
  };
  /// Inputs of the state machine.
  enum class Cue : std::uint8_t {
    done,            // the mission's condition holds
    failed,          // the same
    duration,        // the requested duration has been flown
    timeout,         // of a simulated flight
    none_left,       // a role has no usable component
    silence,         // the failsafe is over, and a second has passed since
    disarmed,        // there is no armed aircraft, and the end has been decided
    signal,          // to the host, and there is no armed aircraft
    first_signal,    // while the aircraft is armed
    second_signal,   // soon after a first one
    vehicle_failed,  // it does not advance the time any more
    abandoned,       // by the owner of the flight
  };
  /// Actions of the flight. Reports are for armed aircraft alone: for others the result is enough.
  enum class Act : std::uint8_t {
    none,
    report_done,
    report_failed,
    report_duration,
    report_silent,
    refuse_signal,
    give_up,
    end,
  };
  /// Why the flight has ended or will end.
  enum class Reason : std::uint8_t {
    none,
    done,
    failed,
    duration,
    timeout,
    failsafe,
    gave_up,
    signal,
    vehicle_failed,
    abandoned,
  };

  struct Step {
    State next = State::flying;
    Act act = Act::none;
    Reason reason = Reason::none;  // none: as it was
    friend bool operator==(const Step&, const Step&) = default;
  };
  /// The table of transitions.
  static Step step(State state, Cue cue) noexcept;
  static Outcome outcome(Reason reason) noexcept;

  /// Facts at the end of a tick.
  struct Facts {
    std::int64_t now_ns = 0;
    bool armed = false;  // on hardware: the host must not end the flight of such an aircraft
    bool done = false, failed = false, duration = false, timeout = false, signal = false;
  };
  /// Actions, in order.
  struct Acts {
    std::array<Act, 3> list{};
    std::size_t count = 0;
    const Act* begin() const noexcept { return list.data(); }
    const Act* end() const noexcept { return list.data() + count; }
  };
  using Steering = core::Steering;

  /// `failsafe_ns`: how long the failsafe's values are sent; 0: there are none.
  explicit Ending(std::int64_t failsafe_ns) : failsafe_ns_(failsafe_ns) {}

  /// [tick] At its end.
  Acts tick(const Facts& facts) noexcept;
  /// [tick] Takes effect immediately: none_left, vehicle_failed, abandoned.
  Act take(Cue cue, std::int64_t now_ns) noexcept;

  State state() const noexcept { return state_; }
  Reason reason() const noexcept { return reason_; }
  bool over() const noexcept { return state_ == State::over; }
  bool in_failsafe() const noexcept {
    return state_ == State::failsafe || state_ == State::giving_up || state_ == State::silent;
  }
  /// Whether `done`, and whether `failed` and the duration, can still decide the end.
  bool asks_done() const noexcept { return state_ == State::flying; }
  bool asks_failed() const noexcept { return reason_ == Reason::none && !over(); }
  Steering steering(std::int64_t now_ns) const noexcept;

  static constexpr std::int64_t silence_ns =
      1'000'000'000;  // after a failsafe, before the flight counts as lost
  static constexpr std::int64_t repeat_ns = 5'000'000'000;  // time in which a rejected signal can be repeated

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();
  Cue cue_of(const Facts& facts, bool& any) const noexcept;
  Cue signal_cue(const Facts& facts) const noexcept;

  std::int64_t failsafe_ns_;
  State state_ = State::flying;
  Reason reason_ = Reason::none;
  std::int64_t failsafe_since_ns_ = 0;
  std::int64_t refused_ns_ = never;  // a signal
};

}  // namespace fulmar::core
