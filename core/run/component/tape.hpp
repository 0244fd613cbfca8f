// SPDX-License-Identifier: BSD-3-Clause
// The inputs of a component's last steps, for the rehearsal of its successor. Fixed memory.
#pragma once
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

class Tape {
 public:
  struct Step {
    fulmar_tick tick{};
    std::vector<fulmar_input> inputs;
  };

  Tape(const ComponentInfo& info, std::size_t steps);
  /// [tick]
  void record(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs) noexcept;

  std::size_t size() const {
    return static_cast<std::size_t>(count_ < entries_.size() ? count_ : entries_.size());
  }
  /// The i-th of the stored steps, oldest first. The pointers belong to the tape.
  Step step(std::size_t i) const;

 private:
  /// The samples of one input, each copied once for all steps that read it. A big message that changes often
  /// is kept for fewer steps: older steps then have a newer sample.
  struct Samples {
    std::uint32_t item = 0, capacity = 1;
    std::vector<std::byte> data;
    std::vector<std::int64_t> stamps;
    std::vector<fulmar_answer> answers;
    std::size_t slots = 0, slot = 0;
    std::uint64_t sequence = 0;
    bool value = true;
  };
  struct Entry {
    fulmar_tick tick{};
    std::vector<fulmar_input> inputs;
  };
  std::vector<Samples> samples_;
  std::vector<Entry> entries_;
  std::uint64_t count_ = 0;
};

}  // namespace fulmar::core
