// SPDX-License-Identifier: BSD-3-Clause
// Active components: the present phase, the component of each role in it, hand-over, guards and fallbacks.
#pragma once
#include <cstdint>
#include <vector>

#include "core/log/events.hpp"
#include "core/run/flight/end.hpp"
#include "core/run/flight/protection.hpp"
#include "core/run/flight/stepper.hpp"
#include "core/run/flight/streams.hpp"
#include "core/run/flight/wiring.hpp"
#include "core/run/record/recorder.hpp"
#include "core/run/state/state.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

class Roles {
 public:
  Roles(FlightState& state, Wiring& wiring, Recorder& recorder, Protection& protection, FlightEnd& end,
        Stepper& stepper);
  /// [setup] Finds the roles that feed the vehicle. Call it again after an exchange of units.
  void connect();

  int phase() const noexcept { return phase_; }
  /// The present phase's overlay of a component's parameters, or nullptr.
  const std::vector<Overlay>* overlay_of(int component) const noexcept;

  // phases.cpp
  /// [tick] Starts in another phase than the first one. Before `begin`.
  void begin_in(int phase) noexcept { phase_ = phase; }
  /// [tick] Before the first read of the vehicle: applies the first phase's settings of it.
  void prepare_vehicle();
  /// [tick] In the first tick: no component was active before, so each is activated when its inputs have
  /// arrived.
  void begin();
  void transitions();
  /// [tick] Before the vehicle writes.
  void watch_commands();
  void enter(int phase, const std::string& because = {});

  // roles.cpp
  /// [tick] Steps a component, and stops it after a fault of its step or its budget.
  void step(int component);
  /// [tick] The same for the time of the vehicle.
  void charge(Unit& unit);
  /// [tick] A guard has fired: the last good output is held, the fallback takes over; without a usable
  /// fallback, failsafe.
  void stop(int component, Code code = Code::guard);
  /// Ends the list of active components. When the vehicle was never commanded, it finds the first role
  /// without an output.
  void conclude();
  /// A guard was reset: the component fills its roles again.
  void fly_again(int component);
  std::string idle_role() const;

 private:
  bool try_transitions(const std::vector<Transition>& list, std::vector<std::int64_t>& since);
  void note_phase(const Phase& entered, const std::string& because);
  void lay_over(int component, const std::vector<Overlay>* set);
  void fill(int role, bool overlaid);
  int group_wanted_in(int role) const;
  bool take_over(int component, const Assignment& assignment);
  void occupy(int component);
  void note_tenure(int role);
  template <class Ends>
  void end_tenures(const Ends& ends);
  void rest(Unit& unit) noexcept;
  void keep_groups_whole();
  bool fills_any(int component) const noexcept;
  bool nobody_has_flown(const Component& component) const noexcept;
  void fill_hand_over(const Unit& unit);
  void cannot_take_over(Unit& unit, bool somebody_stays);
  void stop_if_mute(const Slot& slot);
  void report_blind(const char* what, const Condition* condition, int stopped);
  void report_blind(const std::vector<Transition>& list, int stopped);
  void fall_back(int stopped, std::size_t guard);
  bool nobody_drives(int stopped) const noexcept;
  void nobody_flies(const std::string& name, const std::string& what);
  const Phase& present() const noexcept { return nth(state_.graph.phases, phase_); }
  int& active(int role) noexcept { return nth(active_, role); }
  int active(int role) const noexcept { return nth(active_, role); }

  FlightState& state_;
  Wiring& wiring_;
  Recorder& recorder_;
  Protection& protection_;
  FlightEnd& end_;
  Stepper& stepper_;
  int phase_ = 0;
  std::vector<int> active_;                           // per role: the component that fills it now, or -1
  std::vector<bool> drives_vehicle_;                  // per role
  std::vector<std::int64_t> any_since_, next_since_;  // times since which a transition's condition holds
  std::vector<const Slot*> hand_over_;                // room for the last applied outputs
  Streams streams_;
};

}  // namespace fulmar::core
