// SPDX-License-Identifier: BSD-3-Clause
// The file that a thread is loading or unloading, for whoever has to tell of a crash or an exit: its code
// runs then, before anybody has asked it for anything. A file may have behaved where it was tried.
#pragma once
#include <atomic>
#include <string>

namespace fulmar::core {

/// Name of the file that this thread has in hand, or nullptr.
inline constinit thread_local std::atomic<const char*> file_in_hand{nullptr};
inline constinit thread_local std::atomic<const char*> file_is_being{"loaded"};  // or "unloaded"

/// As long as it lives, the file is being loaded, or unloaded, in this thread. The name has to live as long.
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
  const char *file_, *being_;  // of before: a script that is closed closes its host
};

}  // namespace fulmar::core
