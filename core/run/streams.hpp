// SPDX-License-Identifier: BSD-3-Clause
// Outputs that may stay silent, and have spoken in every step so far: when one of them falls silent while its
// component steps on, somebody is told. It is not stopped: it may be a planner that has nothing to add.
#pragma once
#include <cstdint>
#include <vector>

#include "core/run/recorder.hpp"
#include "core/run/wiring.hpp"

namespace fulmar::core {

class Streams {
 public:
  /// [setup] Those that lead to the vehicle and whose age counts from their writer's steps.
  void connect(const Wiring& wiring, const FlightState& state);
  /// [tick] After the steps.
  void watch(std::int64_t now_ns, Recorder& recorder) noexcept;

 private:
  struct Stream {
    const Slot* slot = nullptr;
    std::int64_t limit_ns = 0;
    std::uint64_t sequence = 0;
    std::int64_t completed_ns = 0, published_ns = 0;
    int streak = 0;
    bool told = false;
  };
  void add(const Slot& slot, std::int64_t limit_ns);
  std::vector<Stream> streams_;
};

}  // namespace fulmar::core
