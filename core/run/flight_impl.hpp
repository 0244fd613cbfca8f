// SPDX-License-Identifier: BSD-3-Clause
// The inside of a flight: units, role outputs, phase, guards and log channels.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/graph/condition.hpp"
#include "core/run/flight.hpp"
#include "core/run/unit.hpp"

namespace fulmar::core {

enum class EventKind : std::uint8_t { phase, guard, request, parameter, failsafe };

/// What happened, for the log: topic /fulmar/event.
struct Event {
  EventKind kind = EventKind::phase;
  std::array<char, 48> component{};
  std::array<char, 207> text{};
};
TypePtr event_type();

struct RoleState {
  int active = -1;  // component that fills it now
  std::vector<RoleSlot> slots;
};

struct Flight::Impl final : SampleReader {
  Impl(const Graph& graph_, const FlightOptions& options_);

  // build.cpp
  void create_units();
  void wire();
  void wire_reader(Unit& unit, Reader& reader);
  void request_arming();
  void open_log();
  void add_channels(std::vector<LogChannel>& channels);
  void attach_texts();
  std::int64_t record_period(const std::string& port, const Slot& slot) const;  // -1: not recorded
  std::string parameters_text() const;

  // loop.cpp
  FlightResult run();
  bool tick();  // false: the flight is over
  void step_unit(int index);
  void publish(Unit& unit);
  void log_slot(Slot& slot);
  void log_probes(Unit& unit);
  void clock(Unit& unit);
  bool over();
  bool held_for(const Condition& condition, std::int64_t for_ns, std::int64_t& since_ns) const noexcept;
  void finish(Outcome outcome, std::string reason);
  void pace();

  // phases.cpp
  void begin();
  void transitions();
  bool try_transitions(const std::vector<Transition>& list, std::vector<std::int64_t>& since);
  void enter(int phase);
  void fill(int role, const Assignment& assignment, bool overlaid);
  bool take_over(int role, int component, const Assignment& assignment);
  void stop(int index);
  void failsafe(const char* why);
  const std::vector<Overlay>* overlay_of(int component) const;
  void event(EventKind kind, const std::string& component, const std::string& text);

  const std::byte* sample(const Source& source) const noexcept override;
  const Slot* slot_of(const Source& source) const;
  Unit& unit(const std::string& component);  // throws Error

  bool unpaced() const { return options.speed == 0 && graph.io == "sim"; }

  const Graph& graph;
  FlightOptions options;
  std::vector<std::unique_ptr<Unit>> units;
  std::vector<RoleState> roles;
  std::vector<Reader*> delayed;        // readers that see the previous tick's sample
  std::vector<const Slot*> hand_over;  // room for what was last applied
  Flight* owner = nullptr;
  std::unique_ptr<Log> log;
  int event_channel = -1;

  std::int64_t now_ns = 0;
  std::uint64_t index = 0;
  int phase = 0;
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();
  std::vector<std::int64_t> any_since, next_since;  // since when a transition's condition holds
  std::int64_t done_since_ns = never, failed_since_ns = never;
  std::int64_t failsafe_since_ns = 0;
  bool in_failsafe = false, ended = false;
  std::string failsafe_reason;
  std::vector<bool> drives_vehicle;  // per role

  FlightResult result;
  std::int64_t wall_ns = 0, wall_start_ns = 0, progress_ns = 0;
};

}  // namespace fulmar::core
