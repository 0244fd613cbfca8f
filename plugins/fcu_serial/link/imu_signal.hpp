// SPDX-License-Identifier: BSD-3-Clause
// Wakes the loop at the arrival of an inertial sample: the waiter sleeps on a counter. Source: futex(2).
#pragma once
#include <linux/futex.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>

namespace fulmar::fcu {

class ImuSignal {
 public:
  /// Called by the thread that feeds the queue, after it has put in `samples`.
  void raise(std::uint32_t samples) noexcept {
    count_.fetch_add(samples, std::memory_order_seq_cst);
    if (sleeping_.load(std::memory_order_seq_cst)) futex(FUTEX_WAKE_PRIVATE, 1, nullptr);
  }

  /// Called by the loop, which has taken `taken` samples so far. Returns false when the monotonic clock
  /// reaches `deadline_ns` without a sample.
  bool wait(std::uint32_t taken, std::int64_t deadline_ns) noexcept {
    const timespec deadline{deadline_ns / 1'000'000'000, deadline_ns % 1'000'000'000};
    while (!come(taken)) {
      sleeping_.store(true, std::memory_order_seq_cst);
      const bool late =
          futex(FUTEX_WAIT_BITSET_PRIVATE, taken, &deadline) != 0 && errno != EAGAIN && errno != EINTR;
      sleeping_.store(false, std::memory_order_relaxed);
      if (late) return come(taken);
    }
    return true;
  }

 private:
  bool come(std::uint32_t taken) const noexcept { return count_.load(std::memory_order_acquire) != taken; }

  long futex(int operation, std::uint32_t value, const timespec* deadline) noexcept {
    static_assert(sizeof count_ == sizeof value && std::atomic<std::uint32_t>::is_always_lock_free);
    return syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&count_), operation, value, deadline, nullptr,
                   FUTEX_BITSET_MATCH_ANY);
  }

  alignas(64) std::atomic<std::uint32_t> count_{0};
  std::atomic<bool> sleeping_{false};
};

}  // namespace fulmar::fcu
