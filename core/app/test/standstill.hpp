// SPDX-License-Identifier: BSD-3-Clause
// Detects a standstill of the machine: a thread on each CPU wakes every millisecond and measures its largest
// delay.
#pragma once
#include <pthread.h>
#include <sched.h>
#include <time.h>

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace fulmar::fcu::testing {

class Standstill {
 public:
  /// `realtime`: above all other threads, so that only a standstill of the CPU is measured.
  explicit Standstill(bool realtime) {
    cpu_set_t allowed;
    if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &allowed)) threads_.emplace_back([this, cpu, realtime] { watch(cpu, realtime); });
  }
  ~Standstill() {
    over_ = true;
    for (std::thread& t : threads_) t.join();
  }
  Standstill(const Standstill&) = delete;
  Standstill& operator=(const Standstill&) = delete;

  double worst_s() const { return 1e-9 * static_cast<double>(worst_ns_.load()); }

 private:
  static constexpr std::int64_t period_ns = 1'000'000;

  static std::int64_t now_ns() {
    timespec t{};
    ::clock_gettime(CLOCK_MONOTONIC, &t);
    return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
  }
  void watch(int cpu, bool realtime) {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    CPU_SET(cpu, &mine);
    ::pthread_setaffinity_np(::pthread_self(), sizeof mine, &mine);
    const sched_param priority{80};
    if (realtime) ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &priority);
    while (!over_) {
      const std::int64_t due = now_ns() + period_ns;
      const timespec t{due / 1'000'000'000, due % 1'000'000'000};
      ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
      const std::int64_t late = now_ns() - due;
      for (std::int64_t worst = worst_ns_; late > worst && !worst_ns_.compare_exchange_weak(worst, late);) {
      }
    }
  }
  std::atomic<bool> over_{false};
  std::atomic<std::int64_t> worst_ns_{0};
  std::vector<std::thread> threads_;
};

}  // namespace fulmar::fcu::testing
