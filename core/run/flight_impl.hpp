// SPDX-License-Identifier: BSD-3-Clause
// The inside of a flight: units, role outputs, phase, guards and log channels.
#pragma once
#include <string>
#include <vector>

#include "core/graph/condition.hpp"
#include "core/run/command.hpp"
#include "core/run/ending.hpp"
#include "core/run/flight.hpp"
#include "core/run/flight_control.hpp"
#include "core/run/published.hpp"
#include "core/run/unit.hpp"
#include "core/dds/bridge.hpp"
#include "core/log/events.hpp"
#include "core/live/server.hpp"
#include "core/tap/tap.hpp"

namespace fulmar::core {

/// A flag of the vehicle's contract, as it stands now. `unknown`: what counts of a vehicle that has no such
/// flag, or has not published it yet.
struct FlagView {
  const Slot* slot = nullptr;
  std::uint32_t offset = 0;
  bool says(bool unknown) const noexcept { return slot && slot->sequence > 0 ? slot->published[offset] != std::byte{0} : unknown; }
};

/// A port whose texts are for people.
struct Told {
  const Slot* slot = nullptr;
  const Field *text = nullptr, *severity = nullptr;
  std::vector<char> last;  // of a port that is written in every step: told when it changes
};

struct RoleState {
  int active = -1;  // component that fills it now
  std::vector<RoleSlot> slots;
};

struct Flight::Impl final : SampleReader {
  Impl(const Graph& graph_, const FlightOptions& options_);

  // build.cpp
  UnitOptions unit_options(const Component& component) const;
  void connect();  // as the graph says; whatever was connected before is not any more
  void wire_reader(Unit& unit, Reader& reader);
  void import_into(const Unit& unit, Reader& reader);
  void find_flags();
  void find_told();
  void request_arming();
  void open_tap();
  void open_log();
  void open_to_others();
  std::vector<TapChannel> channels();
  void attach_texts();
  std::unique_ptr<SampleSource> recorded_samples(const Component& component) const;
  std::int64_t record_period(const std::string& port, const Slot& slot) const;  // -1: not recorded
  std::string parameters_text() const;

  // loop.cpp
  bool step();
  FlightResult finish_flight();
  bool tick();  // false: the flight is over
  bool collect(Unit& unit, int index);
  void step_unit(int index);
  void publish(Unit& unit);
  void put_slot(Slot& slot);
  void put_probes(Unit& unit);
  void note_tick();
  void put_ticks();
  void tell_control() noexcept;
  void clock(Unit& unit);
  void stop_over_budget(Unit& unit);
  void note_late(const Unit& unit, std::int64_t due_ns);
  void tell_late(Unit& unit);
  bool vehicle_failed();
  void tell_overdue();
  void note_refusals(Unit& unit) noexcept;
  bool controls(const Unit& unit) const noexcept;
  void watch_control() noexcept;
  void pace();

  // verdict.cpp
  bool over();
  bool held_for(const Condition& condition, std::int64_t for_ns, std::int64_t& since_ns) const noexcept;
  bool armed_hardware() const noexcept;
  void end_by(Ending::Cue cue);
  void carry_out(Ending::Act act);
  void tell_verdict(Code code, const char* what);
  std::string reason_text() const;

  // swap.cpp
  void swap(std::size_t index, const std::string& file);
  void replace(std::size_t index, const std::string& file);
  void install(std::size_t index, Graph&& next);
  void restart(std::size_t index);
  std::string in_use() const;  // why nothing can be swapped now, or ""

  // requests.cpp: what enters between two ticks, checked before; these throw
  enum class Taken : std::uint8_t { yes, full, idle };
  /// Of a parameter `command` then holds the value that was in force.
  Taken take(Command& command, Reply answered);
  void apply_parameter(Command& command, Code told);
  Taken apply_request(const Command& command, Reply answered);
  void apply_import(std::size_t import, const std::byte* message);
  void apply_phase(const Command& command);
  void reset_guards(const Command& command);
  bool reset_guard(std::size_t index);
  void put_command(const CommandNote& note);

  // resume.cpp
  void resume_now();
  void resume_if_armed();
  std::function<std::string(std::size_t, const std::byte*)> lasting() const;

  // phases.cpp
  void begin();
  void transitions();
  bool try_transitions(const std::vector<Transition>& list, std::vector<std::int64_t>& since);
  void enter(int phase);
  void fill(int role, const Assignment& assignment, bool overlaid);
  bool take_over(int role, int component, const Assignment& assignment);
  void stop(int index, Code code = Code::guard);
  void failsafe(const Event& why);
  void note_phase(const Phase& entered);
  const std::vector<Overlay>* overlay_of(int component) const;
  /// What happened: for the log, and aloud for people.
  void note(const Event& event, bool aloud = true);
  void tell(Told& told);

  const std::byte* sample(const Source& source) const noexcept override;
  const Slot* slot_of(const Source& source) const;
  const std::byte* message_of(const Source& source) const noexcept;

  bool unpaced() const { return options.circumstances || (options.speed == 0 && graph.io == Io::sim); }

  Graph graph;  // its own: a swap changes it
  FlightOptions options;
  std::vector<std::unique_ptr<Unit>> units;
  std::vector<RoleState> roles;
  std::vector<Reader*> delayed;        // readers that see the previous tick's sample
  std::vector<const Slot*> hand_over;  // room for what was last applied
  Flight* owner = nullptr;
  std::shared_ptr<const CommandTable> commands;  // what the graph has to command
  std::unique_ptr<Tap> tap;                      // before what hangs on it
  std::unique_ptr<Log> log;
  std::unique_ptr<FlightControl> control;
  std::unique_ptr<LiveServer> live_server;  // these two end before what they speak to
  std::unique_ptr<DdsBridge> dds_bridge;
  std::size_t event_channel = 0, ticks_channel = 0, parameter_channel = 0, command_channel = 0;
  struct Import {
    Slot slot;
    Reader* reader = nullptr;
  };
  std::vector<Import> imports;  // as in graph.dds.imports
  Ticks ticks;
  std::uint64_t tick_hash = 0;

  std::int64_t now_ns = 0;
  std::uint64_t index = 0;
  int phase = 0;
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();
  std::vector<std::int64_t> any_since, next_since;  // since when a transition's condition holds
  std::int64_t done_since_ns = never, failed_since_ns = never;
  Ending ending;
  decltype(Event::words) failsafe_words{};  // why nobody can fly any more
  std::vector<bool> drives_vehicle, control_roles;  // per role
  FlagView armed_flag, ground_flag, control_flag;
  bool was_armed = false;
  bool out_of_control = false;  // the vehicle says that it does not obey
  std::vector<Told> tells;
  std::int64_t heard_ns = never;  // the vehicle's first word, while it is open whether to resume

  bool log_told = false;

  FlightResult result;
  std::int64_t wall_ns = 0, wall_start_ns = 0, progress_ns = 0;
};

}  // namespace fulmar::core
