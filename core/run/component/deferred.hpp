// SPDX-License-Identifier: BSD-3-Clause
// Runners whose work is done in another thread, or was done in another flight: their results come by
// `collect`.
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/run/component/driver.hpp"
#include "core/run/component/runner.hpp"

namespace fulmar::core {

/// Due times of asynchronous results that a flight took late, in order, and the time at which it took each.
using LateResults = std::vector<std::pair<std::int64_t, std::int64_t>>;

/// `run: async`: a step gets the inputs of its tick, and its result becomes visible when its latency is over.
class AsyncRunner final : public Direct {
 public:
  /// `wait`: waits for a late result, as in simulation; else it is counted as missed, and taken when it
  /// comes. `late`: results that a replay takes as late as the flight did.
  AsyncRunner(const Component& component, std::uint64_t seed, std::int64_t period_ns, bool wait,
              LateResults late, ComponentStats& stats);

  void rest() noexcept override { async_.reset(); }
  bool retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept override;
  /// The first due result shows whether it takes over.
  bool activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept override;
  void deactivate() noexcept override;
  StepResult step(const fulmar_tick& tick, Intake& in, Outlets& out, fulmar_error& problem) noexcept override;
  StepResult collect(std::int64_t now_ns, Intake& in, Outlets& out, fulmar_error& problem) noexcept override;
  std::optional<std::int64_t> overdue_ns(std::int64_t now_ns) noexcept override;

 private:
  Async::Job* job(Async::Job::Call call, std::int64_t due_ns) noexcept;
  bool arrived(Async::Job& job) noexcept;
  void note_step(Async::Job& job, std::int64_t before_ns, Intake& in) noexcept;
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();

  const Component& component_;
  ComponentStats& stats_;
  bool wait_;
  LateResults late_;
  std::int64_t collected_ns_ = never, before_ns_ = never;  // the last two ticks of `collect`
  std::unique_ptr<Async> async_;                           // destroyed before the instance that it steps
};

/// Arrived samples, at most as many as one publication holds.
class Arrivals {
 public:
  Arrivals(std::unique_ptr<SampleSource> source, ComponentStats& stats)
      : source_(std::move(source)), stats_(stats) {}
  StepResult collect(std::int64_t now_ns, Outlets& out, fulmar_error& problem) noexcept;
  bool started() const noexcept { return started_; }
  void end() noexcept { source_.reset(); }

 private:
  std::unique_ptr<SampleSource> source_;
  ComponentStats& stats_;
  bool started_ = false;
};

/// `run: driver`: steps in its own thread, from the first request for samples on.
class DriverRunner final : public Direct {
 public:
  DriverRunner(const Component& component, std::uint64_t seed, ComponentStats& stats);

  void rest() noexcept override { arrivals_.end(); }
  bool retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept override;
  bool activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept override;
  void deactivate() noexcept override;
  StepResult collect(std::int64_t now_ns, Intake&, Outlets& out, fulmar_error& problem) noexcept override {
    return arrivals_.collect(now_ns, out, problem);
  }

 private:
  Arrivals arrivals_;
};

/// Replaces a driver by its samples from another flight. There is no instance.
class RecordedRunner final : public Runner {
 public:
  RecordedRunner(std::unique_ptr<SampleSource> source, ComponentStats& stats)
      : Runner(Results::unasked), arrivals_(std::move(source), stats) {}
  StepResult collect(std::int64_t now_ns, Intake&, Outlets& out, fulmar_error& problem) noexcept override {
    return arrivals_.collect(now_ns, out, problem);
  }

 private:
  Arrivals arrivals_;
};

}  // namespace fulmar::core
