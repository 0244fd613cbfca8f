// SPDX-License-Identifier: BSD-3-Clause
// Parameters that fly, written back into the files that they came from, for a client: first the lines that
// would change are shown, then those and no others are written. The program fulmar-save does it; a thread of
// its own waits for that, since a disk takes its time.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "core/tap/control.hpp"

namespace fulmar::core::live {

struct SaveAnswer {
  bool accepted = false;
  std::string reason;  // why not; of what is accepted: what is left out, and what should be known
  std::string lines;   // as `fulmar param save --dry-run` prints them; of what was written the files' names
  std::string mark;  // of these lines, to write them; "": there are none to write, or they have been written
};

/// In the caller's thread. `mark`: "" only shows. The program is stopped after `limit`. Never throws.
SaveAnswer save(const FlightView& view, const std::string& component, const std::string& mark,
                std::chrono::seconds limit = std::chrono::seconds(60)) noexcept;

class Saving {
 public:
  /// Answers from another thread, once. One at a time: others are refused. What is under way when this goes
  /// answers later.
  void begin(FlightView view, std::string component, std::string mark,
             std::function<void(const SaveAnswer&)> answer);

 private:
  std::shared_ptr<std::atomic<bool>> busy_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace fulmar::core::live
