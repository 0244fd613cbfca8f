// SPDX-License-Identifier: BSD-3-Clause
// Everything that leaves the loop: one ring, into which the loop copies each message once, and a cursor per
// sink (log, live view, DDS), each read by the sink's own thread. A sink that is slow loses samples, counted,
// and delays nobody; the log alone may hold back an unpaced simulation.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

struct TapChannel {
  std::string topic;  // "/nav/state"
  TypePtr type;
  bool may_stay_silent = false;  // of a port that need not publish in every step: its last sample is for
                                 // those who come later, too
  std::size_t past = 0;          // so many last samples are for those who come later, too, however fast
};

class Tap {
 public:
  /// One message as it lies in the ring. Flight times.
  struct Sample {
    std::uint32_t size = 0;     // of the record
    std::uint32_t channel = 0;  // into channels()
    std::uint64_t number = 0;   // of all records, from 0
    std::uint64_t sequence =
        0;  // of the channel's samples for the log, from 0: counts those that the log lost, too
    std::int64_t now_ns = 0, valid_ns = 0;
    bool for_log = false;
    const std::byte* data() const {
      return reinterpret_cast<const std::byte*>(this + 1);
    }  // a struct of the channel's type
  };

  explicit Tap(std::vector<TapChannel> channels, std::size_t ring_bytes = 8u << 20);
  ~Tap();
  Tap(const Tap&) = delete;
  Tap& operator=(const Tap&) = delete;

  const std::vector<TapChannel>& channels() const { return channels_; }

  /// [tick] Whether a sink other than the log wants a sample of the channel at this flight time. Counts it as
  /// given when it says so.
  bool wanted(std::size_t channel, std::int64_t now_ns) noexcept;
  /// [tick] No allocation, no lock. Waits only for a cursor that `holds_back`.
  void write(std::size_t channel, std::int64_t now_ns, std::int64_t valid_ns, const std::byte* data,
             bool for_log) noexcept;
  /// [tick] Whether `write` waits from now on for the cursor that may hold back. There has to be one.
  void hold_back(bool on) noexcept { held_.store(on, std::memory_order_seq_cst); }
  /// [tick] How long `write` has waited for room since this was last asked.
  std::int64_t take_wait_ns() noexcept;
  std::size_t ring_bytes() const { return capacity_; }
  /// Bytes that have gone through the ring.
  std::uint64_t written() const noexcept { return head_.load(std::memory_order_acquire); }

  /// A sink's place in the ring. One thread. It begins at what is written after its creation.
  class Cursor {
   public:
    /// `may_hold_back`: the loop waits for it rather than write over what it has not read, at once or when
    /// `hold_back` says so; one cursor at most.
    explicit Cursor(Tap& tap, bool may_hold_back = false, bool at_once = true);
    ~Cursor();
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;

    /// The next sample, a copy of its own that is valid until the next call; nullptr when there is nothing
    /// new.
    const Sample* next() noexcept;
    /// Bytes of `written` that are behind it.
    std::uint64_t read() const noexcept { return read_; }
    /// Samples written over before they were read, of all channels.
    std::uint64_t lost() const noexcept { return lost_; }
    /// From now on at least one sample of the channel each so many ns of flight time; 0: every one; below 0:
    /// none. Others may want more. What the log stores comes in any case: look at the times.
    void want(std::size_t channel, std::int64_t period_ns);

   private:
    friend class Tap;
    bool take(std::uint64_t at, std::size_t bytes, std::byte* to) const noexcept;
    void skip_ahead() noexcept;

    Tap& tap_;
    bool may_hold_back_;
    static constexpr std::uint64_t unknown = ~std::uint64_t{0};
    std::uint64_t read_ = 0, released_ = 0, seen_head_ = 0, expected_ = unknown, lost_ = 0;
    std::vector<std::int64_t> wants_;  // guarded by tap_.mutex_
    std::vector<std::uint64_t> room_;  // the copy
  };

 private:
  struct Channel;
  static constexpr std::uint32_t skipped = ~0u;
  static constexpr std::size_t line = 64;   // bytes of a cache line; each thread writes lines of its own
  static constexpr std::size_t slices = 8;  // of the ring: each remembers where its first record begins

  std::uint64_t* words_at(std::size_t byte) noexcept { return memory_.data() + byte / sizeof(std::uint64_t); }
  void put(const Sample& sample, const std::byte* data, std::size_t size) noexcept;
  void wait_for_room(std::size_t bytes) noexcept;
  void combine_wants(std::size_t channel);

  const std::vector<TapChannel> channels_;
  std::vector<Channel> state_;  // the loop's
  std::size_t max_record_ = 0, capacity_ = 0;
  std::vector<std::uint64_t> memory_;
  std::uint64_t pushed_ = 0, number_ = 0, seen_tail_ = 0, slice_ = ~std::uint64_t{0};  // the loop's
  std::int64_t waited_ns_ = 0;
  std::array<std::atomic<std::uint64_t>, slices> begins_{};
  alignas(line) std::atomic<std::uint64_t> reserved_{0};  // the loop may be writing up to here
  std::atomic<std::uint64_t> head_{0};                    // whole records up to here
  alignas(line) std::atomic<std::uint64_t> tail_{0};      // of the cursor that holds back
  std::atomic<bool> held_{false}, waiting_{false};
  alignas(line) std::mutex mutex_;  // of the sinks among themselves
  std::vector<Cursor*> cursors_;
};

}  // namespace fulmar::core
