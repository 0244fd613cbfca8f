// SPDX-License-Identifier: BSD-3-Clause
// The tick: vehicle read, steps in order, phase conditions, vehicle write. What is published goes to the tap at once.
#include <time.h>

#include <cstring>
#include <utility>

#include "core/run/allocation.hpp"
#include "core/run/flight_impl.hpp"
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
  const std::int64_t took = now - wall_ns - (log ? log->take_wait_ns() : 0);
  unit.stats.time.add(took);
  wall_ns = now;
  if (unit.component->budget_ns == 0 || unpaced()) return;  // an unpaced simulation knows no deadline
  if (took <= unit.component->budget_ns) {
    unit.overruns_in_a_row = 0;
    return;
  }
  ++unit.stats.overruns;
  if (++unit.overruns_in_a_row < overruns_allowed || unit.stopped || unit.info->vehicle) return;
  unit.fail("was over its time budget in 5 steps in a row");
  stop(static_cast<int>(unit.component - graph.components.data()));
}

void Flight::Impl::log_slot(Slot& slot) {
  if (slot.channel < 0 || now_ns < slot.log_due_ns) return;
  if (slot.log_period_ns > 0) {
    const bool late = slot.log_due_ns == std::numeric_limits<std::int64_t>::min() || slot.log_due_ns + slot.log_period_ns <= now_ns;
    slot.log_due_ns = (late ? now_ns : slot.log_due_ns) + slot.log_period_ns;
  }
  log->write(static_cast<std::size_t>(slot.channel), now_ns, slot.valid_at_ns, slot.published.data());
}

void Flight::Impl::log_probes(Unit& unit) {
  if (unit.probe_channel < 0 || now_ns < unit.probe_due_ns) return;
  const bool late = unit.probe_due_ns == std::numeric_limits<std::int64_t>::min() || unit.probe_due_ns + unit.probe_period_ns <= now_ns;
  unit.probe_due_ns = (late ? now_ns : unit.probe_due_ns) + unit.probe_period_ns;
  for (std::size_t k = 0; k < unit.probes.size(); ++k)
    std::memcpy(&unit.probe_values[k], unit.slots[unit.probes[k]].published.data(), sizeof(double));
  log->write(static_cast<std::size_t>(unit.probe_channel), now_ns, now_ns, reinterpret_cast<const std::byte*>(unit.probe_values.data()));
}

void Flight::Impl::publish(Unit& unit) {
  unit.publish([&](Slot& slot) {
    for (auto& [reader, plan] : slot.queues) reader->push(slot.published.data(), slot.valid_at_ns, *plan);
    if (slot.role) {
      slot.role->current = &slot;
      ++slot.role->sequence;
      for (auto& [reader, plans] : slot.role->queues)
        reader->push(slot.published.data(), slot.valid_at_ns, plans[static_cast<std::size_t>(slot.filler)]);
    }
    if (log) log_slot(slot);
    for (Told& told : tells)
      if (told.slot == &slot) tell(told);
  });
  if (log && !unit.probes.empty()) log_probes(unit);
}

void Flight::Impl::step_unit(int i) {
  Unit& unit = *units[static_cast<std::size_t>(i)];
  if (unit.remote() && !collect(unit, i)) return;
  if (!unit.active || unit.stopped || !unit.due(now_ns)) return;
  const bool idle = out_of_control && controls(unit);
  if (unit.fresh_start || (idle && !unit.remote())) {
    if (!unit.ready()) return;
    if (!unit.activate(now_ns, index, {})) {
      if (!idle || unit.dead()) return stop(i);
      unit.fresh_start = true;  // it flies nothing now; what is in its way may have passed when it does
      return;
    }
  }
  const Verdict verdict = unit.step(now_ns, index);
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
  was_armed = was_armed || graph.io == "fcu" || armed_flag.says(true) || control_flag.says(false);
  const bool was = std::exchange(out_of_control, was_armed && !control_flag.says(true));
  if (!was || out_of_control) return;
  for (const auto& unit : units)
    if (unit->active && unit->remote() && controls(*unit)) unit->fresh_start = true;
}

/// Results and samples that come from other threads. True when the unit can also be stepped.
bool Flight::Impl::collect(Unit& unit, int i) {
  Verdict verdict = unit.collect(now_ns);
  for (; verdict.kind == Verdict::Kind::stepped; verdict = unit.collect(now_ns))
    if (unit.active && !unit.stopped) publish(unit);
  if (verdict.kind == Verdict::Kind::bad && unit.active) stop(i);
  wall_ns = wall_clock_ns();
  return unit.component->run == RunMode::async;
}

bool Flight::Impl::tick() {
  Unit& vehicle = *units[static_cast<std::size_t>(graph.vehicle)];
  const Verdict read = vehicle.read(now_ns, index);
  if (index == 0) result.first_ns = now_ns;
  if (read.kind == Verdict::Kind::bad) {
    event(EventKind::guard, vehicle.component->name, vehicle.problem.text);
    result.guards.push_back({now_ns, vehicle.component->name, vehicle.problem.text, "flight ended"});
    finish(Outcome::failed, "the vehicle failed: " + std::string(vehicle.problem.text));
    return false;
  }
  if (index == 0) begin();
  publish(vehicle);
  watch_control();
  if (options.resume) resume_if_armed();
  clock(vehicle);

  for (const int i : graph.order) step_unit(i);
  transitions();

  if (in_failsafe && now_ns - failsafe_since_ns >= graph.failsafe_ns) vehicle.silent = true;
  if (vehicle.write(now_ns, index).kind == Verdict::Kind::bad) {
    event(EventKind::guard, vehicle.component->name, vehicle.problem.text);
    finish(Outcome::failed, "the vehicle failed: " + std::string(vehicle.problem.text));
    return false;
  }
  clock(vehicle);
  for (Reader* reader : delayed) reader->latch();
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

bool Flight::Impl::step() {
  if (ended) return false;
  if (index == 0 && graph.io == "fcu") stay_on_one_cpu();
  if (index == 0) wall_ns = wall_start_ns = progress_ns = wall_clock_ns();
  const std::uint64_t before = thread_allocations();
  if (!tick()) return false;
  if (index > 1) result.loop_allocations += thread_allocations() - before;
  if (options.speed > 0 && graph.io == "sim") pace();
  if (options.progress && wall_ns - progress_ns > 200'000'000) {
    progress_ns = wall_ns;
    options.progress(*static_cast<const Flight*>(owner));
  }
  return true;
}

FlightResult Flight::Impl::finish_flight() {
  if (!ended) finish(Outcome::interrupted, "ended by its owner");
  leave_cpu_of_loop();
  result.wall_s = 1e-9 * static_cast<double>(wall_clock_ns() - wall_start_ns);
  result.ticks = index;
  if (!result.phases.empty()) result.phases.back().to_ns = now_ns;
  for (const auto& unit : units) result.components.push_back(unit->stats);
  if (log) result.log = log->close();
  return std::move(result);
}

}  // namespace fulmar::core
