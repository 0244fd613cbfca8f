// SPDX-License-Identifier: BSD-3-Clause
// The tick: vehicle read, steps in order, phase conditions, vehicle write. Samples go to the tap at once.
#include <algorithm>
#include <array>
#include <cstdio>

#include "core/run/component/allocation.hpp"
#include "core/run/component/realtime.hpp"
#include "core/run/component/replay_context.hpp"
#include "core/run/control.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/messages.hpp"
#include "core/run/verdict.hpp"
#include "links/dds/library.hpp"
#include "links/live/library.hpp"

namespace fulmar::core {

/// Ends the flight: time does not advance without the vehicle.
bool Flight::Impl::vehicle_failed() {
  Unit& vehicle = wiring.vehicle();
  make_printable(vehicle.problem.text);
  Event e = event_of(Code::vehicle_failed, vehicle.component->name);
  put(e.cause, vehicle.problem.text);
  say(e, std::string_view(vehicle.problem.text));
  recorder.note(e);
  end.end_by(Ending::Cue::vehicle_failed);
  return false;
}

void Flight::Impl::begin() {
  if (state.options.resume && !state.options.resume->if_armed) resume_now(false);
  roles.begin();
}

bool Flight::Impl::tick() {
  Unit& vehicle = wiring.vehicle();
  if (state.index == 0 && !state.options.resume) roles.prepare_vehicle();
  const StepResult read = vehicle.read(state.now_ns, state.index);
  if (state.index == 0) state.result.first_ns = state.now_ns;
  if (read == StepResult::bad) {
    vehicle_failed();
    state.result.guards.push_back(
        {state.now_ns, vehicle.component->name, vehicle.problem.text, "flight ended"});
    return false;
  }
  if (state.index == 0) begin();
  wiring.publish(vehicle, recorder);
  if (protection.watch()) stepper.restart_held();
  if (state.options.resume) resume_if_armed();
  roles.charge(vehicle);

  for (const int component : state.graph.order) roles.step(component);
  roles.transitions();
  roles.watch_commands();

  const StepResult written = vehicle.write(state.now_ns, state.index, end.steering(), state.graph.failsafe);
  if (written == StepResult::bad) return vehicle_failed();
  vehicle.in.refusals.clear();  // not logged: a replay has no component that could reject them
  roles.charge(vehicle);
  wiring.latch();
  recorder.note_tick();
  ++state.index;
  state.result.last_ns = state.now_ns;
  return !end.reached();
}

/// Reports the flight's state to clients; that of its components at a lower rate.
void Flight::Impl::report_control() noexcept {
  constexpr std::uint64_t every = 16;
  if (!clients.control) return;
  clients.control->note(roles.phase(), state.now_ns, protection.armed());
  clients.control->ticked();
  if (state.index % every != 0) return;
  for (std::size_t i = 0; i < wiring.units.size(); ++i) clients.control->note_unit(i, *wiring.units[i]);
}

/// After a standstill, as of a stopped program or a suspended machine, the flight catches up. It is reported,
/// because this is not real time.
void Flight::Impl::note_behind(double seconds) {
  constexpr double worth_saying_s = 0.5, caught_up_s = 0.05;
  state.result.wall.behind_max_s = std::max(state.result.wall.behind_max_s, seconds);
  if (seconds < caught_up_s) catching_up = false;
  if (seconds < worth_saying_s || catching_up) return;
  catching_up = true;
  if (!state.options.say) return;
  std::array<char, 200> words;
  const int begin =
      std::snprintf(words.data(), words.size(), "%8.2f s  ", 1e-9 * static_cast<double>(state.now_ns));
  const auto used = static_cast<std::size_t>(begin);
  run_messages::flight_behind.write(words.data() + used, words.size() - used, Fixed{seconds, 1});
  state.options.say(words.data(), true);
}

bool Flight::Impl::step() {
  if (end.over()) return false;
  const bool first = state.index == 0;
  const std::uint64_t entering = thread_allocations();
  const bool counted = !clients.control || first || clients.control->apply();
  const std::uint64_t entered = counted ? thread_allocations() - entering : 0;
  if (clients.control && clients.control->stands() && !stand_still()) return false;
  if (end.over()) return false;  // for another flight
  if (first && state.on_hardware()) stay_on_one_cpu();
  if (first) stopwatch.begin();
  stopwatch.enter(state.index);
  const std::uint64_t before = thread_allocations();
  const bool goes_on = tick();
  report_control();
  recorder.check_log();
  if (!goes_on) return false;
  if (state.index > 1) state.result.loop_allocations += thread_allocations() - before + entered;
  const bool paused = clients.control && clients.control->paused();
  if (state.options.speed > 0 && !paused && !state.on_hardware()) note_behind(stopwatch.pace());
  if (state.options.progress && stopwatch.time_to_show()) state.options.progress(owner);
  return true;
}

/// The verdict, for the log and for clients. A replay stops at the end of its log, and takes the reason from
/// there.
void Flight::Impl::conclude() {
  const FlightResult& result = state.result;
  std::string word = result_word(result), reason = reason_of(result);
  if (state.options.circumstances) {
    const Event* const was = state.options.circumstances->conclusion();
    if (!was) return;
    if (end.abandoned()) {
      word = was->name.data();
      reason = was->cause.data();
    }
  }
  Event e = event_of(Code::concluded, "", word);
  if (!word.starts_with("flown")) e.severity = Severity::error;
  put(e.cause, reason);
  say(e, run_messages::concluded, verdict_line(state.graph, owner, word), e.cause.data());
  recorder.note(e, false);
}

FlightResult Flight::Impl::finish() {
  FlightResult& result = state.result;
  if (!end.over()) end.end_by(Ending::Cue::abandoned);
  leave_cpu_of_loop();
  result.wall.took_s = stopwatch.elapsed_s();
  result.ticks = state.index;
  if (!result.phases.empty()) result.phases.back().to_ns = state.now_ns;
  for (const auto& unit : wiring.units) result.components.push_back(unit->stats);
  if (clients.control) clients.control->end();
  if (clients.live) result.live = clients.live->stats();
  if (clients.dds) result.dds = clients.dds->stats();
  stepper.report_overdue();
  roles.conclude();
  if (!protection.has_flown()) result.idle = roles.idle_role();
  conclude();
  result.log = recorder.close();
  return std::move(result);
}

}  // namespace fulmar::core
