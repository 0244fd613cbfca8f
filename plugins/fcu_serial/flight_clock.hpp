// SPDX-License-Identifier: BSD-3-Clause
// Flight time from the arrivals of inertial samples.
#pragma once
#include <algorithm>
#include <cstdint>

#include "state.hpp"

namespace fulmar::fcu {

/// Flight time from arrivals, so that the age of a sample is its transport delay. The host's times are those
/// of the link.
class FlightClock {
 public:
  bool begun() const { return zero_ns_ != never_ns; }
  void begin(std::int64_t host_ns) { zero_ns_ = host_ns; }
  std::int64_t flight_ns(std::int64_t host_ns) const { return host_ns - zero_ns_; }

  /// A tick. `arrived_ns`: arrival of its inertial sample, or never. Returns the time since the tick before;
  /// 0 for the first.
  std::int64_t tick(std::int64_t arrived_ns, std::int64_t host_ns) {
    const std::int64_t since_ns = read_ns_ != never_ns ? host_ns - read_ns_ : 0;
    arrived_ns_ = arrived_ns;
    read_ns_ = host_ns;
    now_ns_ = std::max(flight_ns(arrived_ns != never_ns ? arrived_ns : host_ns), now_ns_ + min_step_ns);
    return since_ns;
  }
  std::int64_t now_ns() const { return now_ns_; }
  /// Host time of this tick's inertial sample, or never.
  std::int64_t arrived_ns() const { return arrived_ns_; }

 private:
  static constexpr std::int64_t min_step_ns = 100'000;  ///< samples that arrive together get separate ticks

  std::int64_t zero_ns_ = never_ns, arrived_ns_ = never_ns, read_ns_ = never_ns;  ///< host time
  std::int64_t now_ns_ = -min_step_ns;
};

}  // namespace fulmar::fcu
