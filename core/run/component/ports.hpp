// SPDX-License-Identifier: BSD-3-Clause
// The ports of a component in flight. Its inputs are views of other components' outputs. Its outputs are
// double buffers: a step writes into `staging`, and a result that passes the guards is published. So a bad
// step keeps the last good output in place.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "core/due.hpp"
#include "core/graph/graph.hpp"
#include "core/run/component/problem.hpp"
#include "core/run/component/reply.hpp"
#include "core/types/hash.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

struct Reader;

/// Properties of the component that publishes. In a flight each one is a Unit.
struct Publisher {
  const Component* component = nullptr;
  const ComponentInfo* info = nullptr;
  bool active = false;            // fills a role now, or has none and always steps
  bool stopped = false;           // by a guard
  std::int64_t completed_ns = 0;  // end of its last step
};

/// Channel of the published samples in the tap, and their period in the log.
struct LogPlace {
  std::size_t channel = 0;
  std::int64_t period_ns = -1;  // -1: never, 0: every time
  Due due;
};

/// One output of one component: the last published sample, and the inputs that take every sample.
struct Slot {
  const Port* port = nullptr;
  Publisher* owner = nullptr;
  std::uint32_t size = 0;  // of one message
  std::vector<std::byte> staging, published;
  std::vector<std::int64_t> stamps;
  std::int64_t valid_at_ns = 0;
  std::uint64_t sequence = 0;  // 0: never published
  std::unique_ptr<Guard> guard;
  std::vector<std::pair<Reader*, const CopyPlan*>> queues;  // inputs that take every sample
  struct RoleSlot* role = nullptr;                          // the role output that this one provides
  int filler = -1;                                          // of that role
  std::unique_ptr<MessageHash> hash;                        // null: its samples are stored completely
  LogPlace log;
};

/// One output of a role: the slot of the component that published last while active.
struct RoleSlot {
  TypePtr type;
  const Publisher* filler = nullptr;  // publishes now; nullptr: none has begun
  const Slot* current = nullptr;
  std::uint64_t sequence = 0;
  std::vector<std::pair<Reader*, std::vector<CopyPlan>>> queues;  // plans: one per filler
  // for readers of the role's own table: conditions, figures
  std::vector<CopyPlan> plans;  // one per filler
  mutable std::vector<std::byte> copy;
  const std::byte* message() const noexcept {
    const CopyPlan& plan = nth(plans, current->filler);
    if (plan.whole) return current->published.data();
    plan.run(current->published.data(), copy.data());
    return copy.data();
  }
};

/// Samples at a queue or request input for the next step.
struct Pending {
  std::vector<std::byte> items;
  std::vector<std::int64_t> stamps;
  std::vector<fulmar_answer> answers;
  std::vector<Reply> replies;
  std::uint32_t count = 0, lost = 0;
};

/// One input of one component.
struct Reader {
  const Port* port = nullptr;
  const Wire* wire = nullptr;
  bool delayed = false;  // gets the sample of the end of the previous tick
  const Slot* slot = nullptr;
  const RoleSlot* role = nullptr;
  std::vector<CopyPlan> plans;  // value inputs: of the slot, or one per filler of the role
  std::vector<std::byte> copy;  // used where the plan is not a whole copy
  std::uint64_t copied = 0, seen = 0;
  std::int64_t copied_valid_ns = 0;
  Pending pending;
  int channel = -1;  // of the tap: input from outside is stored

  /// Component that is to publish on the wire; nullptr: none that a guard can stop.
  const Publisher* writer() const { return role ? role->filler : slot ? slot->owner : nullptr; }
  const Slot* source() const { return slot ? slot : role ? role->current : nullptr; }
  /// Samples published on the wire so far, and the number of them that a step may read.
  std::uint64_t published() const { return slot ? slot->sequence : role ? role->sequence : 0; }
  std::uint64_t sequence() const { return delayed ? copied : published(); }
  void latch() noexcept;  // delayed wires, at the end of a tick
  void push(const std::byte* message, std::int64_t valid_at_ns, const CopyPlan& plan) noexcept;
  /// A message of the port's own type.
  void push(const std::byte* message, std::int64_t valid_at_ns) noexcept;
};

/// The inputs of a component, in the form of its functions.
class Intake {
 public:
  enum class State : std::uint8_t { good, missing, stale };
  /// A request that was rejected in the last step, for the log.
  struct Refusal {
    std::uint32_t input = 0;
    std::array<char, sizeof(fulmar_answer::reason)> reason{};
  };

  explicit Intake(const Component& component);
  /// [tick] Whether every required input has a sample.
  bool ready() const noexcept;
  /// [tick] Whether a required input will never have a sample, because its writer was stopped; `problem`
  /// names it.
  bool in_vain(fulmar_error& problem) const noexcept;
  /// [tick] Whether a value is older than its wire allows; `problem` names it. False without a value or a
  /// limit.
  bool too_old(std::size_t input, std::int64_t now_ns, fulmar_error& problem) const noexcept;
  /// [tick] Whether there are required values, and each has come within this time.
  bool all_younger_than(std::int64_t limit_ns, std::int64_t now_ns) const noexcept;
  /// [tick] Fills `views`. When an input is too old, `problem` names it.
  State prepare(std::int64_t now_ns, fulmar_error& problem) noexcept;
  /// [tick] Names in `problem` the required input that has no sample.
  void report_missing(fulmar_error& problem) const noexcept;
  /// [tick] After a step: marks its samples as read, and passes its answers to the senders.
  void consume() noexcept;
  void answer(std::size_t input, Reply& reply, const fulmar_answer& a) noexcept;
  /// [tick] Drops the samples that arrived while another component was active.
  void forget_queues() noexcept;
  /// [tick] Rejects pending requests: each sender gets the reason.
  void refuse_requests(const char* why) noexcept;

  std::vector<Reader> readers;
  std::vector<fulmar_input> views;
  std::vector<Refusal> refusals;  // room for some
};

/// All probes of a component are one message of the tap.
struct Probes {
  std::vector<std::uint32_t> outputs;
  std::vector<double> values;
  LogPlace log;
};

/// The outputs of a component, including probes, in the form of its functions.
class Outlets {
 public:
  Outlets(const Component& component, Publisher& owner);
  /// [tick] Clears the outputs for a step; their default time is now.
  void prepare(std::int64_t now_ns) noexcept;
  /// [tick] Whether the outputs of the step pass the guards; else `problem` names the fault.
  bool good(std::int64_t now_ns, fulmar_error& problem) noexcept;
  /// [tick] Publishes the outputs; `each(slot)` for each sample.
  template <class F>
  void publish(F&& each);

  std::vector<Slot> slots;
  std::vector<fulmar_output> views;
  Probes probes;

 private:
  /// Whether a step has written the output. Most outputs are not written in most steps, and reading their
  /// slots would cost more than the step.
  bool written(std::size_t i) const noexcept {
    return views[i].count > 0 || views[i].lost > 0 || values_[i] != 0;
  }

  std::vector<fulmar_output> blank_;  // initial state for a step
  std::vector<std::uint8_t> values_;  // whether it is written in every step
};

template <class F>
void Outlets::publish(F&& each) {
  for (std::size_t i = 0, count = slots.size(); i < count; ++i) {
    if (!written(i)) continue;
    Slot& s = slots[i];
    const fulmar_output& out = views[i];
    if (s.port->kind == FULMAR_OUT_PROBE) {
      if (out.count > 0) {
        std::memcpy(s.published.data(), s.staging.data(), sizeof(double));
        ++s.sequence;
      }
      continue;
    }
    const std::uint32_t samples = s.port->kind == FULMAR_OUT_VALUE ? 1 : out.count;
    if (out.lost > 0) {
      for (auto& [reader, plan] : s.queues) reader->pending.lost += out.lost;
      if (s.role)
        for (auto& [reader, plans] : s.role->queues) reader->pending.lost += out.lost;
    }
    for (std::uint32_t k = 0; k < samples; ++k) {
      std::memcpy(s.published.data(), s.staging.data() + std::size_t{k} * s.size, s.size);
      s.valid_at_ns = s.port->kind == FULMAR_OUT_QUEUE ? s.stamps[k] : out.valid_at_ns;
      ++s.sequence;
      each(s);
    }
  }
}

}  // namespace fulmar::core
