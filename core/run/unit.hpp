// SPDX-License-Identifier: BSD-3-Clause
// A component in flight: its instance, its inputs as views of other components' outputs, its outputs as double buffers.
// A step writes into `staging`; what passes the guards is published, so a bad step leaves the last good output in place.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/isolate/isolated.hpp"
#include "core/run/async.hpp"
#include "core/run/driver.hpp"
#include "core/run/ending.hpp"
#include "core/run/inside.hpp"
#include "core/run/stats.hpp"
#include "core/run/tape.hpp"
#include "core/types/hash.hpp"

namespace fulmar::core {

class Unit;
struct Reader;

/// One output of one component: the last published sample, and those that take every sample.
struct Slot {
  const Port* port = nullptr;
  Unit* owner = nullptr;
  std::uint32_t size = 0;  // of one message
  std::vector<std::byte> staging, published;
  std::vector<std::int64_t> stamps;
  std::int64_t valid_at_ns = 0;
  std::uint64_t sequence = 0;  // 0: never published
  std::unique_ptr<Guard> guard;
  std::vector<std::pair<Reader*, const CopyPlan*>> queues;  // inputs that take every sample
  struct RoleSlot* role = nullptr;                          // the role output that this one provides
  int filler = -1;                                          // of that role
  // tap
  std::size_t channel = 0;
  std::unique_ptr<MessageHash> hash;  // null: what it publishes is stored whole
  std::int64_t log_period_ns = -1, log_due_ns = std::numeric_limits<std::int64_t>::min();
};

/// One output of a role: the slot of whoever published last while active.
struct RoleSlot {
  TypePtr type;
  const Slot* current = nullptr;
  std::uint64_t sequence = 0;
  std::vector<std::pair<Reader*, std::vector<CopyPlan>>> queues;  // plans: one per filler
  // for those who know the role's own table: conditions, figures
  std::vector<CopyPlan> plans;  // one per filler
  mutable std::vector<std::byte> copy;
  const std::byte* message() const noexcept {
    const CopyPlan& plan = plans[static_cast<std::size_t>(current->filler)];
    if (plan.whole) return current->published.data();
    plan.run(current->published.data(), copy.data());
    return copy.data();
  }
};

/// One input of one component.
struct Reader {
  const Port* port = nullptr;
  const Wire* wire = nullptr;
  std::int64_t max_age_ns = 0;  // 0: any
  bool guarded = false;         // a sample that is too old stops the component
  const Slot* slot = nullptr;
  const RoleSlot* role = nullptr;
  std::vector<CopyPlan> plans;  // value inputs: of the slot, or one per filler of the role
  std::vector<std::byte> copy;  // where the plan is not a whole copy
  std::uint64_t copied = 0, seen = 0;
  std::int64_t copied_valid_ns = 0;
  // queue and request
  std::vector<std::byte> items;
  std::vector<std::int64_t> stamps;
  std::vector<fulmar_answer> answers;
  std::vector<Reply> replies;
  std::uint32_t count = 0, lost = 0;

  const Slot* source() const { return slot ? slot : role ? role->current : nullptr; }
  /// Samples published on the wire so far; for a delayed wire, up to the end of the previous tick.
  std::uint64_t sequence() const { return delayed ? copied : slot ? slot->sequence : role ? role->sequence : 0; }
  void latch() noexcept;  // delayed wires, at the end of a tick
  bool delayed = false;
  int channel = -1;  // of the tap: what comes from outside is stored
  void push(const std::byte* message, std::int64_t valid_at_ns, const CopyPlan& plan) noexcept;
};

/// What a step came to.
struct Verdict {
  enum class Kind : std::uint8_t { stepped, not_due, waiting, bad, submitted } kind = Kind::stepped;
  bool degraded = false;
};

/// The vehicle's last word, encoded beforehand, for the handler of a crash; nullptr when it has none.
inline std::atomic<const fulmar_last_frame*> last_frame{nullptr};

struct UnitOptions {
  std::int64_t tick_ns = 2'500'000;
  std::uint64_t seed = 0;
  bool paced = false;                     // wall time matters: a child that hangs is given up after Component::hang_ns
  bool wait_for_async = true;             // simulation: a result that is late is waited for; else counted
  std::size_t tape_steps = 0;             // inputs to keep; 0: none
  std::unique_ptr<SampleSource> samples;  // in place of a driver
  class Playback* playback = nullptr;     // in place of the vehicle; outlives the unit
  /// In a replay: due time of an asynchronous result -> when it was taken, for those that were late.
  std::map<std::int64_t, std::int64_t> late;
};

class Unit {
 public:
  Unit(const Component& component, UnitOptions options);
  ~Unit();
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  /// [setup] Hands over all base parameters. Throws Error.
  void configure();
  /// [tick] Base parameters with `overlay` on top.
  bool retune(const std::vector<Overlay>* overlay) noexcept;

  bool ready() const noexcept;  // every required input has a sample
  bool due(std::int64_t now_ns) const noexcept { return now_ns >= due_ns_; }
  void call_now(std::int64_t now_ns) noexcept { due_ns_ = now_ns; }

  /// [tick] Steps once if due and ready. On `bad`, `problem` says what.
  Verdict step(std::int64_t now_ns, std::uint64_t index) noexcept;
  /// [tick] What has arrived from elsewhere: a result of an asynchronous step, samples of a driver. `not_due`: nothing more in this tick.
  Verdict collect(std::int64_t now_ns) noexcept;
  /// [setup] Steps through what another one saw; false, and `problem`, at the first thing that a guard would not let pass.
  bool rehearse(const Tape& from) noexcept;
  /// [setup] What a step would see now; nullptr when an input is missing.
  std::unique_ptr<Tape> present_inputs(std::int64_t now_ns, std::uint64_t index);
  /// [setup] Channels and periods in the log, of the one whose place it takes.
  void keep_log_settings(const Unit& from);
  /// Whether its child has died.
  bool dead() noexcept { return child_ && !child_->check(); }
  /// Whether it died because it did not answer in time: for the wall clock alone.
  bool hung() const noexcept { return child_ && child_->hung(); }
  /// Whether its results come by `collect`.
  bool remote() const noexcept { return async_ || samples_; }
  /// When a result was due that has not come; nothing when none is late.
  std::optional<std::int64_t> overdue_ns(std::int64_t now_ns) noexcept;
  /// [setup] Encodes the frame that the device is to get when the host dies, if the vehicle can.
  void prepare_last_frame(const std::vector<std::vector<std::byte>>& failsafe);
  Verdict read(std::int64_t& now_ns, std::uint64_t index) noexcept;  // the vehicle
  /// The vehicle gets its inputs, or the failsafe's values in their place, or none.
  Verdict write(std::int64_t now_ns, std::uint64_t index, Ending::Steering steering,
                const std::vector<std::vector<std::byte>>& failsafe) noexcept;
  /// [tick] `last`: per output, the slot last applied in the role, or nullptr.
  bool activate(std::int64_t now_ns, std::uint64_t index, const std::vector<const Slot*>& last) noexcept;
  void deactivate() noexcept;
  void forget_queues() noexcept;  // what came in while another one flew is not news
  /// Requests that it will not answer: whoever asked is told why.
  void refuse_requests(const char* why) noexcept;

  /// [tick] Publishes what the last good step wrote; `publish(slot, message, valid_at)` for each sample.
  template <class F>
  void publish(F&& each);

  void fail(const char* text) noexcept;

  const Component* component;
  const ComponentInfo* info;
  std::vector<Slot> slots;      // one per output; probes too
  std::vector<Reader> readers;  // one per input
  std::vector<ParamValue> base;
  std::unique_ptr<Tape> tape;
  ComponentStats stats;
  fulmar_error problem{};
  bool active = false;                                          // fills a role now, or fills none and always steps
  bool stopped = false;                                         // by a guard
  bool fresh_start = true;                                      // activate has not been called yet
  int overruns_in_a_row = 0;
  std::vector<std::int64_t> late_due_ns;  // asynchronous results that the last `collect` took after a tick too late; room for some
  struct Refusal {
    std::uint32_t input = 0;
    std::array<char, sizeof(fulmar_answer::reason)> reason{};
  };
  std::vector<Refusal> refusals;  // of requests, in the last step, for the log; room for some
  std::size_t probe_channel = 0;
  std::vector<std::uint32_t> probes;  // outputs that are probes
  std::vector<double> probe_values;
  std::int64_t probe_due_ns = std::numeric_limits<std::int64_t>::min(), probe_period_ns = -1;

 private:
  void create(const UnitOptions& options);
  bool heap_good() noexcept;
  Verdict submit(std::int64_t now_ns, const fulmar_tick& tick) noexcept;
  Verdict collect_async(std::int64_t now_ns) noexcept;
  Verdict collect_samples(std::int64_t now_ns) noexcept;
  Async::Job* job(Async::Job::Call call, std::int64_t now_ns) noexcept;
  enum class Inputs : std::uint8_t { good, missing, stale };
  Inputs prepare_inputs(std::int64_t now_ns) noexcept;
  void tell_missing() noexcept;
  void answer(std::size_t input, Reply& reply, const fulmar_answer& a) noexcept;
  void prepare_outputs(std::int64_t now_ns) noexcept;
  bool outputs_good() noexcept;
  void consume() noexcept;
  void fill_values(std::vector<fulmar_value>& values, const std::vector<Overlay>* overlay, bool with_data) noexcept;
  fulmar_tick tick(std::int64_t now_ns, std::uint64_t index) const noexcept;
  void stepped(std::int64_t now_ns) noexcept;

  const fulmar_component* functions_ = nullptr;  // of the library, or of the child's proxy
  void* instance_ = nullptr;
  std::unique_ptr<Isolated> child_;
  std::vector<fulmar_input> inputs_;
  std::vector<fulmar_output> outputs_;
  std::vector<fulmar_input> last_;
  std::vector<fulmar_value> values_;
  std::unique_ptr<SampleSource> samples_;
  std::unique_ptr<Async> async_;
  bool wait_for_async_ = true;
  std::map<std::int64_t, std::int64_t> late_;
  std::int64_t collected_ns_ = std::numeric_limits<std::int64_t>::min(), before_ns_ = collected_ns_;  // the last two ticks of `collect`
  std::int64_t tick_ns_;
  bool started_ = false;  // the driver's thread
  std::int64_t heap_growth_ = 0;
  std::int64_t due_ns_ = std::numeric_limits<std::int64_t>::min(), last_step_ns_ = std::numeric_limits<std::int64_t>::min();
};

template <class F>
void Unit::publish(F&& each) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Slot& s = slots[i];
    const fulmar_output& out = outputs_[i];
    if (s.port->kind == FULMAR_OUT_PROBE) {
      if (out.count > 0) std::memcpy(s.published.data(), s.staging.data(), sizeof(double)), ++s.sequence;
      continue;
    }
    const std::uint32_t count = s.port->kind == FULMAR_OUT_VALUE ? 1 : out.count;
    if (out.lost > 0) {
      for (auto& [reader, plan] : s.queues) reader->lost += out.lost;
      if (s.role)
        for (auto& [reader, plans] : s.role->queues) reader->lost += out.lost;
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      std::memcpy(s.published.data(), s.staging.data() + std::size_t{k} * s.size, s.size);
      s.valid_at_ns = s.port->kind == FULMAR_OUT_QUEUE ? s.stamps[k] : out.valid_at_ns;
      ++s.sequence;
      each(s);
    }
  }
}

}  // namespace fulmar::core
