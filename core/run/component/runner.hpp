// SPDX-License-Identifier: BSD-3-Clause
// Runs a component: in the loop's thread, in a child, in a separate thread, continuously in a driver's
// thread, or from a log. The loop uses the calls of the contract for all of them.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/isolate/isolated.hpp"
#include "core/run/component/allocation.hpp"
#include "core/run/component/ports.hpp"
#include "core/run/component/stats.hpp"

namespace fulmar::core {

/// Result of a call.
enum class StepResult : std::uint8_t { stepped, degraded, not_due, waiting, submitted, bad };
/// Whether there is something to publish.
constexpr bool has_stepped(StepResult result) noexcept { return result <= StepResult::degraded; }

/// Source of a step's results: the step itself, or `collect`, either after a step of the loop or without one.
enum class Results : std::uint8_t { at_once, later, unasked };

class Runner {
 public:
  explicit Runner(Results results = Results::at_once) noexcept : results_(results) {}
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  virtual ~Runner() = default;

  /// [setup]
  virtual std::uint32_t configure(const fulmar_value*, fulmar_error&) { return FULMAR_OK; }
  /// [setup] Ends calls that do not return to the loop; afterwards all calls run in this thread.
  virtual void rest() noexcept {}
  /// [setup] The last frame for the device after the host's death; nullptr, and perhaps `problem`: none.
  virtual const fulmar_last_frame* last_frame(const fulmar_input*, fulmar_error&) { return nullptr; }

  /// [tick] False: rejected, `problem` gives the reason.
  virtual bool retune(const std::vector<fulmar_value>&, fulmar_error&) noexcept { return true; }
  /// [tick] `last`: the last applied value per output.
  virtual bool activate(const fulmar_tick&, const std::vector<fulmar_input>&,
                        const std::vector<fulmar_input>&, fulmar_error&) noexcept {
    return true;
  }
  virtual void deactivate() noexcept {}
  /// [tick] Steps on the prepared inputs. The outputs are then in `out`, unless the results come by
  /// `collect`.
  virtual StepResult step(const fulmar_tick&, Intake&, Outlets&, fulmar_error&) noexcept {
    return StepResult::waiting;
  }
  /// [tick] The next result that has arrived from another thread or a log. `not_due`: nothing more in this
  /// tick.
  virtual StepResult collect(std::int64_t, Intake&, Outlets&, fulmar_error&) noexcept {
    return StepResult::not_due;
  }
  /// [tick] Of a vehicle.
  virtual std::uint32_t read(fulmar_tick&, Outlets&, fulmar_error&) noexcept { return FULMAR_FAILED; }
  virtual std::uint32_t write(const fulmar_tick&, const Intake&, fulmar_error&) noexcept { return FULMAR_OK; }

  /// Whether its results come by `collect`, and whether the loop steps it.
  bool remote() const noexcept { return results_ != Results::at_once; }
  bool stepped_by_loop() const noexcept { return results_ != Results::unasked; }
  /// Whether its process has died, and whether the cause was a time-out: for wall-clock limits alone.
  virtual bool dead() noexcept { return false; }
  virtual bool hung() const noexcept { return false; }
  /// The call that did not return, "step"; "": none.
  virtual const char* died_in() const noexcept { return ""; }
  /// Heap use of its calls.
  HeapUse heap() const noexcept { return heap_; }
  /// Due time of a late result; nothing when none is late.
  virtual std::optional<std::int64_t> overdue_ns(std::int64_t) noexcept { return std::nullopt; }
  /// Due times of the results that the last `collect` took more than a tick late; room for some.
  std::vector<std::int64_t> late_due_ns;

 protected:
  HeapUse heap_;

 private:
  const Results results_;  // read in every step: no virtual function
};

/// An instance of a component, called in the caller's thread.
class Direct : public Runner {
 public:
  /// [setup] Throws Error when the component cannot be created.
  Direct(const Component& component, std::uint64_t seed, Results results = Results::at_once);
  ~Direct() override;

  std::uint32_t configure(const fulmar_value* values, fulmar_error& problem) override;
  const fulmar_last_frame* last_frame(const fulmar_input* failsafe, fulmar_error& problem) override;
  bool retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept override;
  bool activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept override;
  void deactivate() noexcept override;
  StepResult step(const fulmar_tick& tick, Intake& in, Outlets& out, fulmar_error& problem) noexcept override;
  std::uint32_t read(fulmar_tick& tick, Outlets& out, fulmar_error& problem) noexcept override;
  std::uint32_t write(const fulmar_tick& tick, const Intake& in, fulmar_error& problem) noexcept override;

 protected:
  Direct(const Component& component, const fulmar_component& functions, void* instance,
         Results results = Results::at_once)
      : Runner(results), name_(component.name), functions_(functions), instance_(instance) {}

  const std::string name_;
  const fulmar_component& functions_;  // of the library, or of a child's proxy
  void* instance_;
};

/// Death of a child in a replayed flight: its cause, such as the wall clock or an external signal, does not
/// exist in the replay.
struct Death {
  std::int64_t at_ns = 0;
  std::string call, cause;
  bool hung = false;
};

/// The same in a child: a crash or a hang costs the component, not the flight.
class Child final : public Direct {
 public:
  /// [setup] Throws Error. A child that does not answer a call within `hang_ns` is killed.
  Child(const Component& component, std::uint64_t seed, std::int64_t hang_ns, std::vector<Death> deaths = {});
  bool retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept override;
  bool activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept override;
  StepResult step(const fulmar_tick& tick, Intake& in, Outlets& out, fulmar_error& problem) noexcept override;
  bool dead() noexcept override { return !child_->check(); }
  bool hung() const noexcept override { return child_->hung(); }
  const char* died_in() const noexcept override { return died_in_; }

 private:
  Child(const Component& component, std::unique_ptr<Isolated> child, std::vector<Death> deaths);
  void die_again(const char* call, std::int64_t now_ns) noexcept;
  void note(const char* call) noexcept;
  std::unique_ptr<Isolated> child_;
  std::vector<Death> deaths_;
  const char* died_in_ = "";
};

/// Default message of a component that failed without one.
void put_if_silent(fulmar_error& problem, const char* text) noexcept;

}  // namespace fulmar::core
