// SPDX-License-Identifier: BSD-3-Clause
// Lock-free queue of a fixed number of values between one producer and one consumer. Neither waits, neither
// allocates.
#pragma once
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace fulmar::fcu {

template <class T, std::size_t N>
class SpscQueue {
  static_assert(std::has_single_bit(N), "a power of two, so that counts may wrap");

 public:
  static constexpr std::size_t capacity = N;

  /// Producer. Returns false when fewer than `spare` + 1 places are free: spare places are for items that
  /// must not be lost.
  bool push(const T& value, std::size_t spare = 0) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (head - seen_tail_ + spare >= N) {
      seen_tail_ = tail_.load(std::memory_order_acquire);
      if (head - seen_tail_ + spare >= N) return false;
    }
    items_[head % N] = value;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Consumer.
  bool pop(T& out) noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == seen_head_) {
      seen_head_ = head_.load(std::memory_order_acquire);
      if (tail == seen_head_) return false;
    }
    out = items_[tail % N];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Consumer.
  bool empty() const noexcept {
    return tail_.load(std::memory_order_relaxed) == head_.load(std::memory_order_acquire);
  }

 private:
  // Separate cache lines for the two threads.
  alignas(64) std::atomic<std::uint64_t> head_{0};
  std::uint64_t seen_tail_ = 0;
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  std::uint64_t seen_head_ = 0;
  alignas(64) std::array<T, N> items_{};
};

}  // namespace fulmar::fcu
