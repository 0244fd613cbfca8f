// SPDX-License-Identifier: BSD-3-Clause
// The file that a thread loads or unloads, for the report of a crash or an exit: its code runs at that time,
// before the host calls it. A file that passed its probe may still crash.
#pragma once
#include <atomic>
#include <string>

namespace fulmar::core {

/// Name of the file that this thread loads or unloads, or nullptr.
inline constinit thread_local std::atomic<const char*> file_in_hand{nullptr};
inline constinit thread_local std::atomic<const char*> file_is_being{"loaded"};  // or "unloaded"

/// Marks the file as loaded or unloaded in this thread for the lifetime of the object. The name must live as
/// long.
class InHand {
 public:
  InHand(const std::string& file, const char* being) noexcept
      : file_(file_in_hand.load(std::memory_order_relaxed)),
        being_(file_is_being.load(std::memory_order_relaxed)) {
    set(file.c_str(), being);
  }
  ~InHand() { set(file_, being_); }
  InHand(const InHand&) = delete;
  InHand& operator=(const InHand&) = delete;

 private:
  static void set(const char* file, const char* being) noexcept {
    file_is_being.store(being, std::memory_order_relaxed);
    file_in_hand.store(file, std::memory_order_relaxed);
  }
  const char *file_, *being_;  // previous values, restored at the end: closing a script closes its host
                               // plugin
};

}  // namespace fulmar::core
