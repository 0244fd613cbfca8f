// SPDX-License-Identifier: BSD-3-Clause
// Times of ticks, and the samples that arrive with each.
#pragma once
#include <tuple>

#include "series.hpp"

namespace fulmar::sensor_log {

enum class Sensor : std::uint8_t { gnss, mag, baro, pitot, imu };  ///< imu is last: it triggers the tick
inline constexpr std::size_t sensor_count = 5;
inline constexpr std::uint32_t nothing = ~std::uint32_t{0};

struct PlannedTick {
  std::int64_t now_ns = 0;
  std::array<std::uint32_t, sensor_count> sample{nothing, nothing, nothing, nothing, nothing};
};

struct Event {
  std::int64_t at_ns = 0;
  Sensor sensor{};
  std::uint32_t sample = 0;
  bool withheld = false;
};

template <class Windows>
bool within(const Windows& windows, std::int64_t at_ns) {
  return std::any_of(windows.begin(), windows.end(),
                     [at_ns](const Window& w) { return at_ns >= ns_of(w.from_s) && at_ns < ns_of(w.to_s); });
}

/// Assigns samples to ticks. Each inertial sample has a tick, even a withheld one. Another sample arrives in
/// the first tick at or after its time. If a tick would get two of one sensor, the earlier ones have ticks of
/// their own, so that no sample is lost. Two ticks are at least a nanosecond apart.
class Planner {
 public:
  std::vector<PlannedTick> plan(std::vector<Event> events) {
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
      return std::tie(a.at_ns, a.sensor, a.sample) < std::tie(b.at_ns, b.sensor, b.sample);
    });
    for (const Event& event : events) {
      std::uint32_t& slot = next_.sample[static_cast<std::size_t>(event.sensor)];
      if (slot != nothing) close();
      next_.now_ns = event.at_ns;
      waiting_ = true;
      if (!event.withheld) slot = event.sample;
      if (event.sensor == Sensor::imu) close();
    }
    if (waiting_) close();
    return std::move(ticks_);
  }

 private:
  void close() {
    if (!ticks_.empty()) next_.now_ns = std::max(next_.now_ns, ticks_.back().now_ns + 1);
    ticks_.push_back(next_);
    next_ = {};
    waiting_ = false;
  }

  PlannedTick next_;
  bool waiting_ = false;
  std::vector<PlannedTick> ticks_;
};

}  // namespace fulmar::sensor_log
