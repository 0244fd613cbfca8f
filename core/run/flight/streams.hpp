// SPDX-License-Identifier: BSD-3-Clause
// Observes outputs that need not publish in every step but do so regularly. It reports a pause that is much
// longer than any before, while the component steps on and returns `ok`. An output that publishes only on
// changes has longer pauses and is not reported.
#pragma once
#include <cstdint>
#include <vector>

#include "core/graph/condition.hpp"
#include "core/run/flight/wiring.hpp"
#include "core/run/record/recorder.hpp"

namespace fulmar::core {

class Streams {
 public:
  static constexpr std::int64_t min_silence_ns = 1'000'000'000;  // when no wire sets a longer one

  /// [setup] Selects outputs that lead to the vehicle and whose age counts from their writer's steps, and
  /// those that the mission's conditions read.
  void connect(const Wiring& wiring, const FlightState& state);
  /// [tick] After the steps: checks one of them, in turn. `held`: the vehicle does not follow commands, so no
  /// output is expected. Returns an output that has just become silent. Its first report is a guard event of
  /// the flight.
  const Slot* watch(bool held, FlightState& state, Recorder& recorder) noexcept;

 private:
  struct Stream {
    const Slot* slot = nullptr;
    std::int64_t limit_ns = 0;
    std::uint64_t sequence = 0, degraded = 0;
    std::int64_t completed_ns = 0;
    std::int64_t silent_ns = 0, max_ns = 0;  // time of its steps without a sample: now, and largest
    std::uint64_t samples = 0;               // since its component became active
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
