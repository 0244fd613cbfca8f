// SPDX-License-Identifier: BSD-3-Clause
// Steps the components of a flight, in the loop's thread, and publishes their outputs.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/log/events.hpp"
#include "core/run/flight/protection.hpp"
#include "core/run/flight/stopwatch.hpp"
#include "core/run/flight/wiring.hpp"
#include "core/run/record/recorder.hpp"
#include "core/run/state/state.hpp"

namespace fulmar::core {

class Stepper {
 public:
  Stepper(FlightState& state, Wiring& wiring, Recorder& recorder, Protection& protection,
          Stopwatch& stopwatch);

  /// [setup] Finds the roles that are held while the vehicle does not obey. Call it again after an exchange
  /// of units.
  void connect();

  /// [tick] Steps a component if it is due, and publishes results that have arrived from other threads.
  /// Returns why the component is to be stopped, if it is.
  std::optional<Code> step(int component);
  /// [tick] Adds the time of a step to the component's budget. True, with `problem`, when it is used up.
  bool over_budget(Unit& unit);
  /// [tick] Components in other threads start again, after control has returned.
  void restart_held() noexcept;
  /// At the end of a flight: reports results that have not arrived. A replay does not have them either.
  void report_overdue();

 private:
  enum class Ready : std::uint8_t { yes, no, refused };
  Ready prepare(Unit& unit);
  bool collect(Unit& unit);
  bool is_held(const Unit& unit) const noexcept;
  void note_late(const Unit& unit, std::int64_t due_ns);
  void report_late(Unit& unit);

  FlightState& state_;
  Wiring& wiring_;
  Recorder& recorder_;
  Protection& protection_;
  Stopwatch& stopwatch_;
  std::vector<bool> control_roles_;  // per role: its component is held while the vehicle does not obey
};

}  // namespace fulmar::core
