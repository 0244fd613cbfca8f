// SPDX-License-Identifier: BSD-3-Clause
// The inside of a flight: its parts, from the bottom up, and the loop over them. For core/run alone.
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

/// Clients of a flight. A later member uses the earlier ones and is destroyed before them.
struct Clients {
  std::unique_ptr<FlightControl> control;
  std::unique_ptr<LiveView> live;
  std::unique_ptr<DdsBridge> dds;
};

struct Flight::Impl {
  Impl(const Graph& graph, const FlightOptions& options, const Flight& owner);
  ~Impl();

  // setup.cpp
  void connect();  // connects by the graph; previous connections are removed
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
  bool stand_still();  // between two ticks, while the flight is paused; false: it has ended meanwhile
  void report_pace(const PaceOrder& order);

  // commands.cpp: what enters between two ticks, checked before; these throw
  enum class Taken : std::uint8_t { yes, full, idle };
  /// For a parameter, `command` then holds the previous value.
  Taken take(Command& command, Reply answered);
  void apply_parameter(Command& command, Code reported);
  Taken apply_request(const Command& command, Reply answered);
  void apply_phase(const Command& command);
  void reset_guards(const Command& command);
  bool reset_guard(int component);

  // swap.cpp
  void swap(int component, const std::string& file);
  void replace(int component, const std::string& file);
  void rehearse_successor(const Unit& old, const Component& successor);
  void install(int component, Graph&& next, const std::string& words);
  void put_in_place(int component, std::unique_ptr<Unit> fresh, const char* why);
  void restart(int component);

  // resume.cpp
  void resume_if_armed();
  void resume_now(bool begun);  // `begun`: the flight is already in its first phase
  void resume_parameter(const Resume::Param& param);

  FlightState state;
  Wiring wiring;
  Recorder recorder;
  Protection protection;
  FlightEnd end;
  Stopwatch stopwatch;
  Stepper stepper;
  Roles roles;
  std::shared_ptr<const CommandTable> commands;  // possible commands of the graph
  Clients clients;
  std::int64_t heard_ns = never_ns;    // time of the vehicle's first sample, while the decision to resume is
                                       // open
  bool catching_up = false;            // behind the wall clock, and this was reported
  std::map<int, std::string> swapped;  // by component: changes of its parameters by its last swap
  const Flight& owner;
};

}  // namespace fulmar::core
