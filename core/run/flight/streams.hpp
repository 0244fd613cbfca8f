// SPDX-License-Identifier: BSD-3-Clause
// Outputs that may stay silent, and have a habit of speaking: when one of them says nothing for much longer
// than ever before while its component steps on and says `ok`, somebody is told. A planner that speaks when
// something changes has longer pauses, and is left alone.
#pragma once
#include <cstdint>
#include <vector>

#include "core/graph/condition.hpp"
#include "core/run/flight/wiring.hpp"
#include "core/run/record/recorder.hpp"

namespace fulmar::core {

class Streams {
 public:
  static constexpr std::int64_t min_silence_ns = 1'000'000'000;  // where no wire says more

  /// [setup] Those that lead to the vehicle and whose age counts from their writer's steps, and those that
  /// the mission's conditions look at.
  void connect(const Wiring& wiring, const FlightState& state);
  /// [tick] After the steps: looks at one of them, in turn. `held`: the vehicle does not obey, and nobody has
  /// to speak. Returns it when it has just fallen silent. What is told of each for the first time is a guard
  /// of the flight.
  const Slot* watch(bool held, FlightState& state, Recorder& recorder) noexcept;

 private:
  struct Stream {
    const Slot* slot = nullptr;
    std::int64_t limit_ns = 0;
    std::uint64_t sequence = 0, degraded = 0;
    std::int64_t completed_ns = 0;
    std::int64_t silent_ns = 0, max_ns = 0;  // of its steps without a sample: now, and ever
    std::uint64_t samples = 0;               // since its owner is active
    bool reported = false, ever_reported = false;
  };
  void add_source(const Source& from, std::int64_t limit_ns, const Wiring& wiring, const Graph& graph);
  void add_condition(const Condition* condition, const Wiring& wiring, const Graph& graph);
  void add(const Slot& slot, std::int64_t limit_ns);
  void report(Stream& s, bool lapses, FlightState& state, Recorder& recorder) noexcept;
  std::vector<Stream> streams_;
  std::size_t looked_at_ = 0;
};

}  // namespace fulmar::core
