// SPDX-License-Identifier: BSD-3-Clause
// The inside of a flight: its parts, from the bottom up, and the loop that goes through them. For core/run
// alone.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "core/run/command/command.hpp"
#include "core/run/flight.hpp"
#include "core/run/flight/end.hpp"
#include "core/run/flight/protection.hpp"
#include "core/run/flight/roles.hpp"
#include "core/run/flight/stepper.hpp"
#include "core/run/flight/stopwatch.hpp"
#include "core/run/flight/wiring.hpp"
#include "core/run/record/recorder.hpp"
#include "core/run/state/state.hpp"
#include "core/tap/control.hpp"

namespace fulmar::core {

class DdsBridge;
class FlightControl;
class LiveView;

/// Those who look at a flight and speak to it. What comes later ends before what it speaks to.
struct Onlookers {
  std::unique_ptr<FlightControl> control;
  std::unique_ptr<LiveView> live;
  std::unique_ptr<DdsBridge> dds;
};

struct Flight::Impl {
  Impl(const Graph& graph, const FlightOptions& options, const Flight& owner);
  ~Impl();

  // setup.cpp
  void connect();  // as the graph says; whatever was connected before is not any more
  void open_tap();
  void open_to_others();
  void request_arming();

  // loop.cpp
  bool step();  // one tick, paced; false: the flight is over
  FlightResult finish();
  void conclude();
  bool tick();
  void begin();
  bool vehicle_failed();
  void report_control() noexcept;
  void note_behind(double seconds);

  // pause.cpp
  bool stand_still();  // between two ticks, as long as the flight is paused; false: it has ended meanwhile
  void report_pace(const PaceOrder& order);

  // commands.cpp: what enters between two ticks, checked before; these throw
  enum class Taken : std::uint8_t { yes, full, idle };
  /// Of a parameter `command` then holds the value that was in force.
  Taken take(Command& command, Reply answered);
  void apply_parameter(Command& command, Code reported);
  Taken apply_request(const Command& command, Reply answered);
  void apply_phase(const Command& command);
  void reset_guards(const Command& command);
  bool reset_guard(int component);

  // swap.cpp
  void swap(int component, const std::string& file);
  void replace(int component, const std::string& file);
  void rehearse_newcomer(const Unit& old, const Component& newcomer);
  void install(int component, Graph&& next, const std::string& words);
  void put_in_place(int component, std::unique_ptr<Unit> fresh, const char* why);
  void restart(int component);

  // resume.cpp
  void resume_if_armed();
  void resume_now(bool begun);  // `begun`: the flight is in its first phase already
  void resume_parameter(const Resume::Param& param);

  FlightState state;
  Wiring wiring;
  Recorder recorder;
  Protection protection;
  FlightEnd end;
  Stopwatch stopwatch;
  Stepper stepper;
  Roles roles;
  std::shared_ptr<const CommandTable> commands;  // what the graph has to command
  Onlookers onlookers;
  std::int64_t heard_ns = never_ns;    // the vehicle's first word, while it is open whether to resume
  bool catching_up = false;            // with the clock on the wall, and that was said
  std::map<int, std::string> swapped;  // by component: what its last swap did to its parameters
  const Flight& owner;
};

}  // namespace fulmar::core
