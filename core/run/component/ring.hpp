// SPDX-License-Identifier: BSD-3-Clause
// Lock-free ring of records of any size between one producer (the loop) and one consumer (a sink's thread).
//
// A record is contiguous and 8-aligned; a record without channel fills the rest at the end of the memory.
// `head_` and `tail_` count bytes and never wrap. Each thread keeps a copy of the other's count and reads it
// again only when that copy is used up.
#pragma once
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <vector>

namespace fulmar::core {

class Ring {
 public:
  struct Record {
    std::uint32_t size = 0;  // of the whole record
    std::uint32_t channel = 0;
    std::uint64_t sequence = 0;
    std::int64_t log_ns = 0;
    std::int64_t valid_ns = 0;
    const std::byte* data() const { return reinterpret_cast<const std::byte*>(this + 1); }
  };

  /// At least `bytes`, and room for four records of `max_data`: then a half-empty ring has room for any
  /// record.
  Ring(std::size_t bytes, std::size_t max_data)
      : capacity_(std::bit_ceil(std::max(bytes, 4 * record_size(max_data)))),
        memory_(capacity_ / sizeof(std::uint64_t)) {}

  /// Producer. False, and nothing written, when there is no room.
  bool push(Record record, const std::byte* data, std::size_t size) noexcept {
    const std::size_t need = record_size(size);
    const std::size_t at = pushed_ & (capacity_ - 1);
    const std::size_t skip = capacity_ - at < need ? capacity_ - at : 0;
    if (pushed_ + skip + need - seen_tail_ > capacity_) {
      seen_tail_ = tail_.load(std::memory_order_acquire);
      if (pushed_ + skip + need - seen_tail_ > capacity_) return false;
    }
    if (skip > 0) put(at, skip_mark(skip));
    record.size = static_cast<std::uint32_t>(need);
    std::byte* to = memory() + (skip > 0 ? 0 : at);
    std::memcpy(to, &record, sizeof record);
    std::memcpy(to + sizeof record, data, size);
    pushed_ += skip + need;
    head_.store(pushed_, std::memory_order_release);
    return true;
  }

  /// Producer. Sleeps until the ring is half empty. The consumer must be running.
  void wait_for_room() noexcept {
    waiting_.store(true, std::memory_order_seq_cst);
    for (std::uint64_t tail = tail_.load(std::memory_order_seq_cst); pushed_ - tail > capacity_ / 2;
         tail = tail_.load(std::memory_order_seq_cst)) {
      tail_.wait(tail);
    }
    waiting_.store(false, std::memory_order_relaxed);
  }

  /// Consumer. The next record, or null. Valid until `release`.
  const Record* next() noexcept {
    if (read_ == seen_head_) seen_head_ = head_.load(std::memory_order_acquire);
    if (read_ == seen_head_) return nullptr;
    const auto* record = std::launder(reinterpret_cast<const Record*>(memory() + (read_ & (capacity_ - 1))));
    read_ += record->size;
    return record->channel == skipped ? next() : record;
  }

  /// Consumer. Returns the room of all read records to the producer. Cheap enough for each record.
  void release() noexcept {
    if (read_ - released_ < capacity_ / 16 && read_ != seen_head_) return;
    released_ = read_;
    tail_.store(read_, std::memory_order_seq_cst);
    if (waiting_.load(std::memory_order_seq_cst)) tail_.notify_one();
  }

  std::size_t capacity() const { return capacity_; }

 private:
  static constexpr std::uint32_t skipped = ~0u;
  static constexpr std::size_t line = 64;  // bytes of a cache line; each thread writes its own lines

  static constexpr std::size_t record_size(std::size_t data) {
    return (sizeof(Record) + data + 7) & ~std::size_t{7};
  }
  struct Mark {
    std::uint32_t size, channel;
  };
  static Mark skip_mark(std::size_t size) { return {static_cast<std::uint32_t>(size), skipped}; }
  void put(std::size_t at, Mark mark) noexcept { std::memcpy(memory() + at, &mark, sizeof mark); }
  std::byte* memory() { return reinterpret_cast<std::byte*>(memory_.data()); }

  const std::size_t capacity_;
  std::vector<std::uint64_t> memory_;
  alignas(line) std::atomic<std::uint64_t> head_{0};  // producer writes
  std::uint64_t pushed_ = 0, seen_tail_ = 0;
  alignas(line) std::atomic<std::uint64_t> tail_{0};  // consumer writes
  std::uint64_t read_ = 0, seen_head_ = 0, released_ = 0;
  alignas(line) std::atomic<bool> waiting_{false};
};

}  // namespace fulmar::core
