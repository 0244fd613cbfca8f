// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/tape.hpp"

#include <algorithm>

namespace fulmar::core {

namespace {
constexpr std::size_t most_bytes = 1u << 20;  // per input
}

Tape::Tape(const ComponentInfo& info, std::size_t steps) : entries_(steps) {
  for (const Port& port : info.inputs) {
    Samples s;
    s.item = port.type->size;
    s.capacity = port.capacity;
    s.value = port.kind == FULMAR_IN_VALUE;
    s.slots = std::clamp<std::size_t>(most_bytes / (std::size_t{s.item} * s.capacity), 2, steps + 1);
    s.data.resize(s.slots * s.capacity * s.item);
    if (!s.value) {
      s.stamps.resize(s.slots * s.capacity);
      s.answers.resize(s.capacity);
    }
    samples_.push_back(std::move(s));
  }
  for (Entry& entry : entries_) entry.inputs.resize(samples_.size());
}

void Tape::record(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs) noexcept {
  Entry& entry = entries_[static_cast<std::size_t>(count_++ % entries_.size())];
  entry.tick = tick;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Samples& s = samples_[i];
    fulmar_input& to = entry.inputs[i];
    to = inputs[i];
    const std::size_t count = std::min(to.count, s.capacity);
    if (!to.data || count == 0) continue;
    if (!s.value || to.sequence != s.sequence) {
      s.slot = (s.slot + 1) % s.slots;
      s.sequence = to.sequence;
      std::memcpy(s.data.data() + s.slot * s.capacity * s.item, to.data, count * s.item);
      if (to.stamps_ns)
        std::memcpy(s.stamps.data() + s.slot * s.capacity, to.stamps_ns, count * sizeof(std::int64_t));
    }
    to.data = s.data.data() + s.slot * s.capacity * s.item;
    if (to.stamps_ns) to.stamps_ns = s.stamps.data() + s.slot * s.capacity;
    if (to.answers) to.answers = s.answers.data();
  }
}

Tape::Step Tape::step(std::size_t i) const {
  const Entry& entry = entries_[static_cast<std::size_t>((count_ - size() + i) % entries_.size())];
  return {entry.tick, entry.inputs};
}

}  // namespace fulmar::core
