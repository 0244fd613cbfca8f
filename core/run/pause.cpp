// SPDX-License-Identifier: BSD-3-Clause
// Pause of a simulation: flight time stands still between two ticks, and commands are still answered. The log
// does not contain the pause, because its time is flight time.
#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "core/clock.hpp"
#include "core/run/control.hpp"
#include "core/run/flight_impl.hpp"

namespace fulmar::core {

bool Flight::Impl::stand_still() {
  constexpr auto interval = std::chrono::milliseconds(2);
  const std::int64_t since_ns = monotonic_ns();
  const std::atomic<int>* const interrupt = state.options.interrupt;
  while (clients.control->stands() && !end.over()) {
    std::this_thread::sleep_for(interval);
    clients.control->apply();
    stopwatch.skip();  // not charged to a unit
    if (interrupt && interrupt->load(std::memory_order_relaxed) != 0) end.end_by(Ending::Cue::signal);
    if (state.options.progress && stopwatch.time_to_show()) state.options.progress(owner);
  }
  stopwatch.note_stood(since_ns);
  return !end.over();
}

void Flight::Impl::report_pace(const PaceOrder& order) {
  if (!state.options.say) return;
  const std::string what =
      order.what == PaceOrder::What::pause ? "paused" : "goes on, speed " + speed_text(state.options.speed);
  std::array<char, 80> words;
  std::snprintf(words.data(), words.size(), "%8.2f s  %s", 1e-9 * static_cast<double>(state.now_ns),
                what.c_str());
  state.options.say(words.data(), false);
}

}  // namespace fulmar::core
