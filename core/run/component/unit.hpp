// SPDX-License-Identifier: BSD-3-Clause
// A component in flight: its ports, its parameters, its schedule, and its runner.
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/run/component/deferred.hpp"
#include "core/run/component/ports.hpp"
#include "core/run/component/runner.hpp"
#include "core/run/component/stats.hpp"
#include "core/run/component/steering.hpp"
#include "core/run/component/tape.hpp"

namespace fulmar::core {

struct UnitOptions {
  std::int64_t tick_ns = 2'500'000;
  std::uint64_t seed = 0;
  std::int64_t hang_ns = 2'000'000'000;   // a child that does not answer a call within this time is killed
  std::vector<Death> deaths;              // of the child, in a replayed flight
  bool wait_for_async = true;             // simulation: waits for a late result; else it is counted
  std::size_t tape_steps = 0;             // inputs to keep; 0: none
  std::unique_ptr<Runner> runner;         // in place of the one of its `run:`
  std::unique_ptr<SampleSource> samples;  // in place of a driver
  LateResults late;                       // of an asynchronous component
};

class Unit : public Publisher {
 public:
  Unit(const Component& component, UnitOptions options);
  ~Unit();
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  /// [setup] Passes all base parameters. Throws Error.
  void configure();
  /// [tick] Base parameters with `overlay` on top.
  bool retune(const std::vector<Overlay>* overlay) noexcept;

  bool due(std::int64_t now_ns) const noexcept { return schedule_.due.is(now_ns); }
  void call_now(std::int64_t now_ns) noexcept { schedule_.due.call(now_ns); }

  /// [tick] Steps once if due and ready. On `bad`, `problem` gives the fault.
  StepResult step(std::int64_t now_ns, std::uint64_t index) noexcept;
  /// [tick] Collects a result of an asynchronous step, or samples of a driver. `not_due`: nothing more in
  /// this tick.
  StepResult collect(std::int64_t now_ns) noexcept;
  /// [tick] Of the vehicle. It advances the time.
  StepResult read(std::int64_t& now_ns, std::uint64_t index) noexcept;
  /// [tick] The vehicle gets its inputs, or the failsafe's values in their place, or none.
  StepResult write(std::int64_t now_ns, std::uint64_t index, Steering steering,
                   const std::vector<std::vector<std::byte>>& failsafe) noexcept;
  /// [tick] `last`: per output, the slot last applied in the role, or nullptr.
  bool activate(std::int64_t now_ns, std::uint64_t index, const std::vector<const Slot*>& last) noexcept;
  void deactivate() noexcept { runner_->deactivate(); }

  /// [setup] Steps through the inputs of its predecessor; false, and `problem`, at the first fault of a
  /// guard.
  bool rehearse(const Tape& from) noexcept;
  /// [setup] The present inputs of a step; nullptr when an input is missing.
  std::unique_ptr<Tape> present_inputs(std::int64_t now_ns, std::uint64_t index);
  /// [setup] Channels and periods in the log, from the unit that it replaces.
  void keep_log_settings(const Unit& from);
  /// [setup] Encodes the last frame for the device after the host's death, if the vehicle can.
  void prepare_last_frame(const std::vector<std::vector<std::byte>>& failsafe);

  Runner& runner() const noexcept { return *runner_; }
  void fail(const char* text) noexcept { put_problem(problem, text); }

  Intake in;
  Outlets out;
  std::vector<ParamValue> base;
  std::unique_ptr<Tape> tape;
  ComponentStats stats;
  fulmar_error problem{};
  bool fresh_start = true;  // activate has not been called yet
  int overruns_in_a_row = 0;

 private:
  struct Schedule {
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();
    std::int64_t tick_ns = 0, last_step_ns = never;
    Due due;
  };
  struct Arguments {  // room for the arguments of a call
    std::vector<fulmar_input> last;
    std::vector<fulmar_value> values;
  };
  std::unique_ptr<Runner> make_runner(UnitOptions& options);
  void fill_values(const std::vector<Overlay>* overlay, bool with_data) noexcept;
  void fill_last(std::int64_t now_ns, const std::vector<const Slot*>& last) noexcept;
  void steer(std::int64_t now_ns, Steering steering,
             const std::vector<std::vector<std::byte>>& failsafe) noexcept;
  StepResult guarded(StepResult result, std::int64_t now_ns) noexcept;
  bool heap_good() noexcept;
  fulmar_tick tick(std::int64_t now_ns, std::uint64_t index) const noexcept;
  void stepped(std::int64_t now_ns) noexcept;

  Arguments arguments_;
  Schedule schedule_;
  std::unique_ptr<Runner> runner_;
};

/// The component that publishes there.
inline Unit& unit_of(const Slot& slot) noexcept { return static_cast<Unit&>(*slot.owner); }

}  // namespace fulmar::core
