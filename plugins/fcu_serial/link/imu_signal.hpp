// SPDX-License-Identifier: BSD-3-Clause
// Wakes the loop when an inertial sample has come: a count that the waiter sleeps on. Source: futex(2).
#pragma once
#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>

namespace fulmar::fcu {

class ImuSignal {
 public:
  /// The thread that feeds the queue, after so many samples were put in.
  void raise(std::uint32_t samples) noexcept {
    count_.fetch_add(samples, std::memory_order_seq_cst);
    if (sleeping_.load(std::memory_order_seq_cst)) futex(FUTEX_WAKE_PRIVATE, 1, nullptr);
  }

  /// The loop, which has taken `taken` samples from the queue so far. False: the monotonic clock has reached `deadline_ns` without one.
  /// A sleeper wakes some 50 us late. Samples come evenly: a moment before the next one is due the loop stops sleeping and looks for it.
  bool wait(std::uint32_t taken, std::int64_t deadline_ns) noexcept {
    const bool look = worth_looking();
    const std::int64_t due_ns = seen_ns_ + period_ns_;
    bool there = look && sleep(taken, std::min(due_ns - early_ns, deadline_ns));
    if (look && !there) {
      there = spin(taken, std::min(due_ns + late_ns, deadline_ns));
      misses_ = there ? 0 : misses_ + 1;
    }
    if (!there) there = sleep(taken, deadline_ns);
    if (there) learn();
    return there;
  }

 private:
  static constexpr std::int64_t early_ns = 150'000, late_ns = 100'000;
  static constexpr std::int64_t shortest_ns = 1'000'000, longest_ns = 10'000'000;  ///< of a period that is worth learning
  static constexpr int most_misses = 4, rest_waits = 400;

  bool come(std::uint32_t taken) const noexcept { return count_.load(std::memory_order_acquire) != taken; }

  bool sleep(std::uint32_t taken, std::int64_t until_ns) noexcept {
    const timespec deadline{until_ns / 1'000'000'000, until_ns % 1'000'000'000};
    while (!come(taken)) {
      sleeping_.store(true, std::memory_order_seq_cst);
      const bool late = futex(FUTEX_WAIT_BITSET_PRIVATE, taken, &deadline) != 0 && errno != EAGAIN && errno != EINTR;
      sleeping_.store(false, std::memory_order_relaxed);
      if (late) return come(taken);
    }
    return true;
  }

  bool spin(std::uint32_t taken, std::int64_t until_ns) const noexcept {
    while (!come(taken))
      if (monotonic_ns() >= until_ns) return come(taken);
    return true;
  }

  /// Not on a single CPU, where who looks keeps the other thread from running; not while the samples come unevenly.
  bool worth_looking() noexcept {
    if (misses_ > most_misses) rest_ = rest_waits, misses_ = 0;
    if (rest_ > 0) --rest_;
    return several_cpus_ && rest_ == 0 && period_ns_ > 0;
  }

  void learn() noexcept {
    const std::int64_t now_ns = monotonic_ns(), gap_ns = now_ns - seen_ns_;
    seen_ns_ = now_ns;
    if (gap_ns < shortest_ns || gap_ns > longest_ns) return;
    period_ns_ = period_ns_ == 0 ? gap_ns : period_ns_ + (gap_ns - period_ns_) / 16;
  }

  static bool several_cpus() noexcept {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    return sched_getaffinity(0, sizeof cpus, &cpus) == 0 && CPU_COUNT(&cpus) > 1;
  }
  static std::int64_t monotonic_ns() noexcept {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1'000'000'000 + now.tv_nsec;
  }

  long futex(int operation, std::uint32_t value, const timespec* deadline) noexcept {
    static_assert(sizeof count_ == sizeof value && std::atomic<std::uint32_t>::is_always_lock_free);
    return syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&count_), operation, value, deadline, nullptr, FUTEX_BITSET_MATCH_ANY);
  }

  alignas(64) std::atomic<std::uint32_t> count_{0};
  std::atomic<bool> sleeping_{false};
  // Of the loop alone.
  std::int64_t seen_ns_ = 0, period_ns_ = 0;
  int misses_ = 0, rest_ = 0;
  const bool several_cpus_ = several_cpus();
};

}  // namespace fulmar::fcu
