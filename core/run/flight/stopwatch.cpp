// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight/stopwatch.hpp"

#include <time.h>

#include <utility>

#include "core/clock.hpp"
#include "core/run/component/replay_context.hpp"

namespace fulmar::core {
namespace {

constexpr int overruns_allowed = 5;  // steps over budget in a row
constexpr std::int64_t show_every_ns = 200'000'000;

}  // namespace

void Stopwatch::begin() noexcept { wall_ns_ = begin_ns_ = shown_ns_ = paced_wall_ns_ = monotonic_ns(); }

void Stopwatch::skip() noexcept { wall_ns_ = monotonic_ns(); }

void Stopwatch::go_on() noexcept {
  skip();
  paced_wall_ns_ = wall_ns_;
  paced_flight_ns_ = state_.now_ns;
}

void Stopwatch::note_stood(std::int64_t since_ns) noexcept { stood_ns_ += monotonic_ns() - since_ns; }

void Stopwatch::enter(std::uint64_t tick) noexcept {
  // By the golden ratio, so that all ticks of components of every period are sampled equally (Weyl).
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15, eighth = std::uint64_t{1} << 61;
  const bool was_timed = std::exchange(timed_, !state_.unpaced() || tick * golden < eighth);
  if (!timed_ || was_timed) return;
  recorder_.take_wait_ns();  // waits in ticks that are not timed
  skip();
}

/// The time in which the loop waited for the log's thread is not charged to the unit.
std::int64_t Stopwatch::measure(Unit& unit) noexcept {
  const std::int64_t now = monotonic_ns();
  const std::int64_t took = now - wall_ns_ - recorder_.take_wait_ns();
  unit.stats.time.add(took);
  wall_ns_ = now;
  return took;
}

bool Stopwatch::charge(Unit& unit) noexcept {
  const std::int64_t took = timed_ ? measure(unit) : 0;
  const auto& circumstances = state_.options.circumstances;
  if (circumstances && circumstances->ran_over(unit.component->name, state_.now_ns)) return true;
  if (unit.component->budget_ns == 0 || state_.unpaced())
    return false;  // an unpaced simulation has no deadline
  if (took <= unit.component->budget_ns) {
    unit.overruns_in_a_row = 0;
    return false;
  }
  ++unit.stats.overruns;
  return ++unit.overruns_in_a_row >= overruns_allowed && !unit.stopped && !unit.info->vehicle;
}

double Stopwatch::pace() noexcept {
  const std::int64_t from_ns = paced_flight_ns_ == never_ns ? state_.result.first_ns : paced_flight_ns_;
  const double flown_ns = static_cast<double>(state_.now_ns - from_ns);
  const std::int64_t due = paced_wall_ns_ + static_cast<std::int64_t>(flown_ns / state_.options.speed);
  const timespec t{due / 1'000'000'000, due % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
  skip();
  return 1e-9 * static_cast<double>(wall_ns_ - due);
}

bool Stopwatch::time_to_show() noexcept {
  if (wall_ns_ - shown_ns_ <= show_every_ns) return false;
  shown_ns_ = wall_ns_;
  return true;
}

double Stopwatch::elapsed_s() const noexcept {
  return 1e-9 * static_cast<double>(monotonic_ns() - begin_ns_ - stood_ns_);
}

}  // namespace fulmar::core
