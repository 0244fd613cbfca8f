// SPDX-License-Identifier: BSD-3-Clause
// Writes current parameters back into their source files, for a client: a first request shows the lines that
// would change, a second one writes exactly these. The program fulmar-save does the work; a separate thread
// waits for it, because a disk may be slow.
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
  std::string reason;  // reason of a rejection; if accepted: skipped parameters and warnings
  std::string lines;   // as `fulmar param save --dry-run` prints them; after a write the names of the files
  std::string mark;    // identifies these lines for the write; "": there are none to write, or they have been
                       // written
};

/// Runs in the caller's thread. `mark`: "" only shows the lines. The program is stopped after `limit`. Never
/// throws.
SaveAnswer save(const FlightView& view, const std::string& component, const std::string& mark,
                std::chrono::seconds limit = std::chrono::seconds(60)) noexcept;

class Saving {
 public:
  /// Answers once, from another thread. One save at a time: others are rejected. A pending save still answers
  /// after the end of this object.
  void begin(FlightView view, std::string component, std::string mark,
             std::function<void(const SaveAnswer&)> answer);

 private:
  std::shared_ptr<std::atomic<bool>> busy_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace fulmar::core::live
