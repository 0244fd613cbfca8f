// SPDX-License-Identifier: BSD-3-Clause
// The tick: vehicle read, steps in order, phase conditions, vehicle write. What is published goes to the tap at once.
#include <time.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/run/allocation.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/circumstances.hpp"
#include "core/run/realtime.hpp"

namespace fulmar::core {
namespace {

std::int64_t wall_clock_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

constexpr int overruns_allowed = 5;  // steps over budget in a row

}  // namespace

/// One reading of the clock between two steps times both: this charges the time since the last reading to `unit`, but for what the log has
/// waited for its thread.
void Flight::Impl::clock(Unit& unit) {
  const std::int64_t now = wall_clock_ns();
  const std::int64_t took = now - wall_ns - (tap ? tap->take_wait_ns() : 0);
  unit.stats.time.add(took);
  wall_ns = now;
  if (options.circumstances && options.circumstances->ran_over(unit.component->name, now_ns)) return stop_over_budget(unit);
  if (unit.component->budget_ns == 0 || unpaced()) return;  // an unpaced simulation knows no deadline
  if (took <= unit.component->budget_ns) {
    unit.overruns_in_a_row = 0;
    return;
  }
  ++unit.stats.overruns;
  if (++unit.overruns_in_a_row < overruns_allowed || unit.stopped || unit.info->vehicle) return;
  stop_over_budget(unit);
}

void Flight::Impl::stop_over_budget(Unit& unit) {
  unit.fail("was over its time budget in 5 steps in a row");
  stop(static_cast<int>(unit.component - graph.components.data()), Code::over_budget);
}

void Flight::Impl::put_slot(Slot& slot) {
  if (slot.hash)
    tick_hash = slot.hash->of(mix(mix(tick_hash, slot.log.channel), static_cast<std::uint64_t>(slot.valid_at_ns)), slot.published.data());
  const bool for_log = log && slot.log.due.take(now_ns, slot.log.period_ns);
  if (tap->wanted(slot.log.channel, now_ns) || for_log) tap->write(slot.log.channel, now_ns, slot.valid_at_ns, slot.published.data(), for_log);
}

void Flight::Impl::put_probes(Unit& unit) {
  for (std::size_t k = 0; k < unit.out.probes.outputs.size(); ++k)
    std::memcpy(&unit.out.probes.values[k], unit.out.slots[unit.out.probes.outputs[k]].published.data(), sizeof(double));
  const auto* const values = reinterpret_cast<const std::byte*>(unit.out.probes.values.data());
  if (!unit.info->vehicle) tick_hash = hash_bytes(mix(tick_hash, unit.out.probes.log.channel), values, 8 * unit.out.probes.values.size());
  const bool for_log = log && unit.out.probes.log.due.take(now_ns, unit.out.probes.log.period_ns);
  if (tap->wanted(unit.out.probes.log.channel, now_ns) || for_log) tap->write(unit.out.probes.log.channel, now_ns, now_ns, values, for_log);
}

/// At the end of a tick.
void Flight::Impl::note_tick() {
  if (index > 0 && now_ns - result.last_ns > std::int64_t{UINT32_MAX})
    put_ticks();  // a period that has no room: the next message tells the time
  if (ticks.hashes == 0) ticks.first = index, ticks.time_ns = now_ns;
  const std::int64_t period_ns = index == 0 ? 0 : now_ns - result.last_ns;
  ticks.period_ns[ticks.periods++] = static_cast<std::uint32_t>(std::clamp<std::int64_t>(period_ns, 0, UINT32_MAX));
  ticks.hash[ticks.hashes++] = static_cast<std::uint32_t>(tick_hash ^ (tick_hash >> 32));
  tick_hash = 0;
  if (ticks.hashes == Ticks::most) put_ticks();
}

void Flight::Impl::put_ticks() {
  if (ticks.hashes == 0) return;
  tap->write(ticks_channel, now_ns, now_ns, reinterpret_cast<const std::byte*>(&ticks), true);
  ticks.periods = ticks.hashes = 0;
}

void Flight::Impl::publish(Unit& unit) {
  unit.out.publish([&](Slot& slot) {
    for (auto& [reader, plan] : slot.queues) reader->push(slot.published.data(), slot.valid_at_ns, *plan);
    if (slot.role) {
      slot.role->current = &slot;
      ++slot.role->sequence;
      for (auto& [reader, plans] : slot.role->queues)
        reader->push(slot.published.data(), slot.valid_at_ns, plans[static_cast<std::size_t>(slot.filler)]);
    }
    if (tap) put_slot(slot);
    for (Told& told : tells)
      if (told.slot == &slot) tell(told);
  });
  if (tap && !unit.out.probes.outputs.empty()) put_probes(unit);
}

void Flight::Impl::step_unit(int i) {
  Unit& unit = *units[static_cast<std::size_t>(i)];
  if (unit.runner().remote() && !collect(unit, i)) return;
  if (!unit.active || unit.stopped || !unit.due(now_ns)) return;
  const bool idle = out_of_control && controls(unit);
  if (unit.fresh_start || (idle && !unit.runner().remote())) {
    if (!unit.in.ready()) return;
    if (!unit.activate(now_ns, index, {})) {
      if (!idle || unit.runner().dead()) return stop(i);
      unit.fresh_start = true;  // it flies nothing now; what is in its way may have passed when it does
      return;
    }
  }
  const Verdict verdict = unit.step(now_ns, index);
  if (!unit.in.refusals.empty()) note_refusals(unit);
  if (verdict.kind == Verdict::Kind::stepped) publish(unit);
  if (verdict.kind == Verdict::Kind::stepped || verdict.kind == Verdict::Kind::bad) clock(unit);
  if (verdict.kind == Verdict::Kind::bad) stop(i);
}

bool Flight::Impl::controls(const Unit& unit) const noexcept {
  const int role = unit.component->role;
  return role >= 0 && control_roles[static_cast<std::size_t>(role)];
}

/// Nothing may wind up while nobody obeys. What works in another thread is not called anew in every step, but once when control returns.
/// A simulated aircraft is armed at a known time: until then its controllers may do as they like.
void Flight::Impl::watch_control() noexcept {
  was_armed = was_armed || graph.io == Io::fcu || armed_flag.says(true) || control_flag.says(false);
  const bool was = std::exchange(out_of_control, was_armed && !control_flag.says(true));
  if (!was || out_of_control) return;
  for (const auto& unit : units)
    if (unit->active && unit->runner().remote() && controls(*unit)) unit->fresh_start = true;
}

void Flight::Impl::note_late(const Unit& unit, std::int64_t due_ns) {
  Event e = event_of(Code::late_result, unit.component->name);
  e.value_ns = due_ns;
  say(e, "took late a result that was due at %lld ns", static_cast<long long>(due_ns));
  note(e);
}

/// A replay takes them as late as the flight did.
void Flight::Impl::tell_late(Unit& unit) {
  for (const std::int64_t due_ns : unit.runner().late_due_ns) note_late(unit, due_ns);
  unit.runner().late_due_ns.clear();
}

/// At the end of a flight: a result that has not come is not there in a replay either. It counts as taken after the last tick.
void Flight::Impl::tell_overdue() {
  for (const auto& unit : units) {
    const auto due_ns = unit->runner().overdue_ns(now_ns);
    if (!due_ns) continue;
    const std::int64_t last_ns = std::exchange(now_ns, now_ns + 1);
    note_late(*unit, *due_ns);
    now_ns = last_ns;
  }
}

/// Results and samples that come from other threads. True when the unit can also be stepped.
bool Flight::Impl::collect(Unit& unit, int i) {
  Verdict verdict = unit.collect(now_ns);
  if (!unit.runner().late_due_ns.empty()) tell_late(unit);
  for (; verdict.kind == Verdict::Kind::stepped; verdict = unit.collect(now_ns))
    if (unit.active && !unit.stopped) publish(unit);
  if (!unit.runner().late_due_ns.empty()) tell_late(unit);
  if (!unit.in.refusals.empty()) note_refusals(unit);
  if (verdict.kind == Verdict::Kind::bad && unit.active) stop(i);
  wall_ns = wall_clock_ns();
  return unit.runner().stepped_by_loop();
}

/// The flight is over.
bool Flight::Impl::vehicle_failed() {
  Unit& vehicle = *units[static_cast<std::size_t>(graph.vehicle)];
  make_printable(vehicle.problem.text);
  Event e = event_of(Code::vehicle_failed, vehicle.component->name);
  put(e.cause, vehicle.problem.text);
  say(e, "%s", vehicle.problem.text);
  note(e);
  end_by(Ending::Cue::vehicle_failed);
  return false;
}

bool Flight::Impl::tick() {
  Unit& vehicle = *units[static_cast<std::size_t>(graph.vehicle)];
  const Verdict read = vehicle.read(now_ns, index);
  if (index == 0) result.first_ns = now_ns;
  if (read.kind == Verdict::Kind::bad) {
    const bool goes_on = vehicle_failed();
    result.guards.push_back({now_ns, vehicle.component->name, vehicle.problem.text, "flight ended"});
    return goes_on;
  }
  if (index == 0) begin();
  publish(vehicle);
  watch_control();
  if (options.resume) resume_if_armed();
  clock(vehicle);

  for (const int i : graph.order) step_unit(i);
  transitions();

  if (vehicle.write(now_ns, index, ending.steering(now_ns), graph.failsafe).kind == Verdict::Kind::bad)
    return vehicle_failed();
  vehicle.in.refusals.clear();  // not noted: in a replay there is nobody to refuse anything
  clock(vehicle);
  for (Reader* reader : delayed) reader->latch();
  if (tap) note_tick();
  ++index;
  result.last_ns = now_ns;
  return !over();
}

/// Sleeps until the wall clock has caught up with flight time.
void Flight::Impl::pace() {
  const std::int64_t due = wall_start_ns + static_cast<std::int64_t>(static_cast<double>(now_ns - result.first_ns) / options.speed);
  const timespec t{due / 1'000'000'000, due % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
  wall_ns = wall_clock_ns();
}

/// What onlookers are told of the flight as a whole. Of its components now and then.
void Flight::Impl::tell_control() noexcept {
  constexpr std::uint64_t every = 16;
  control->note(phase, now_ns, armed_flag.says(false));
  if (index % every != 0) return;
  for (std::size_t i = 0; i < units.size(); ++i) control->note_stopped(i, units[i]->active, units[i]->stopped);
}

bool Flight::Impl::step() {
  if (ending.over()) return false;
  const std::uint64_t entering = thread_allocations();
  const bool counted = !control || index == 0 || control->apply();
  const std::uint64_t entered = counted ? thread_allocations() - entering : 0;
  if (index == 0 && graph.io == Io::fcu) stay_on_one_cpu();
  if (index == 0) wall_ns = wall_start_ns = progress_ns = wall_clock_ns();
  const std::uint64_t before = thread_allocations();
  const bool goes_on = tick();
  if (control) tell_control();
  if (log && !log_told && log->failed()) {
    log_told = true;
    Event e = event_of(Code::log_failed);
    put(e.cause, log->error());
    say(e, "the flight goes on without its log: %s", log->error().c_str());
    note(e);
  }
  if (!goes_on) return false;
  if (index > 1) result.loop_allocations += thread_allocations() - before + entered;
  if (options.speed > 0 && graph.io == Io::sim) pace();
  if (options.progress && wall_ns - progress_ns > 200'000'000) {
    progress_ns = wall_ns;
    options.progress(*static_cast<const Flight*>(owner));
  }
  return true;
}

FlightResult Flight::Impl::finish_flight() {
  if (!ending.over()) end_by(Ending::Cue::abandoned);
  leave_cpu_of_loop();
  result.wall_s = 1e-9 * static_cast<double>(wall_clock_ns() - wall_start_ns);
  result.ticks = index;
  if (!result.phases.empty()) result.phases.back().to_ns = now_ns;
  for (const auto& unit : units) result.components.push_back(unit->stats);
  if (control) control->end();
  if (live_server) result.live = live_server->stats();
  if (dds_bridge) result.dds = dds_bridge->stats();
  tell_overdue();
  if (tap) put_ticks();
  if (log) result.log = log->close();
  return std::move(result);
}

}  // namespace fulmar::core
