// SPDX-License-Identifier: BSD-3-Clause
// All output of the loop: one ring, into which the loop copies each message once, and a cursor per sink (log,
// live view, DDS). Each sink reads its cursor in its own thread. A slow sink loses samples, counted, and
// delays nothing else; only the log may hold back an unpaced simulation.
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
  bool may_stay_silent = false;  // port that need not publish in every step: its last sample is kept for
                                 // later clients
  std::size_t past = 0;          // number of last samples that are kept for later clients, at any rate
};

class Tap {
 public:
  /// One message in the ring. Times are flight times.
  struct Sample {
    std::uint32_t size = 0;     // of the record
    std::uint32_t channel = 0;  // into channels()
    std::uint64_t number = 0;   // of all records, from 0
    std::uint64_t sequence =
        0;  // of the channel's samples for the log, from 0: also counts those that the log lost
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

  /// [tick] Whether a sink other than the log wants a sample of the channel at this flight time. A true
  /// result counts as a delivered sample.
  bool wanted(std::size_t channel, std::int64_t now_ns) noexcept;
  /// [tick] No allocation, no lock. Waits only for a cursor that `holds_back`.
  void write(std::size_t channel, std::int64_t now_ns, std::int64_t valid_ns, const std::byte* data,
             bool for_log) noexcept;
  /// [tick] Whether `write` waits from now on for the cursor that may hold back. There must be one.
  void hold_back(bool on) noexcept { held_.store(on, std::memory_order_seq_cst); }
  /// [tick] Time that `write` has waited for room since the last call.
  std::int64_t take_wait_ns() noexcept;
  std::size_t ring_bytes() const { return capacity_; }
  /// Bytes that have gone through the ring.
  std::uint64_t written() const noexcept { return head_.load(std::memory_order_acquire); }

  /// A sink's place in the ring. One thread. It starts at the first sample after its creation.
  class Cursor {
   public:
    /// `may_hold_back`: the loop waits instead of overwriting samples that this cursor has not read, at once
    /// or after `hold_back`; one cursor at most.
    explicit Cursor(Tap& tap, bool may_hold_back = false, bool at_once = true);
    ~Cursor();
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;

    /// The next sample, a copy that is valid until the next call; nullptr when there is none.
    const Sample* next() noexcept;
    /// Bytes of `written` before the cursor.
    std::uint64_t read() const noexcept { return read_; }
    /// Samples of all channels that were overwritten before they were read.
    std::uint64_t lost() const noexcept { return lost_; }
    /// Requests at least one sample of the channel per period of flight time, ns; 0: every one; below 0:
    /// none. Other sinks may request more. Samples for the log are always delivered: check the times.
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
  static constexpr std::size_t line = 64;   // bytes of a cache line; each thread writes its own lines
  static constexpr std::size_t slices = 8;  // of the ring: each stores the start of its first record

  std::uint64_t* words_at(std::size_t byte) noexcept { return memory_.data() + byte / sizeof(std::uint64_t); }
  void put(const Sample& sample, const std::byte* data, std::size_t size) noexcept;
  void wait_for_room(std::size_t bytes) noexcept;
  void combine_wants(std::size_t channel);

  const std::vector<TapChannel> channels_;
  std::vector<Channel> state_;  // loop only
  std::size_t max_record_ = 0, capacity_ = 0;
  std::vector<std::uint64_t> memory_;
  std::uint64_t pushed_ = 0, number_ = 0, seen_tail_ = 0, slice_ = ~std::uint64_t{0};  // loop only
  std::int64_t waited_ns_ = 0;
  std::array<std::atomic<std::uint64_t>, slices> begins_{};
  alignas(line) std::atomic<std::uint64_t> reserved_{0};  // the loop may be writing up to here
  std::atomic<std::uint64_t> head_{0};                    // whole records up to here
  alignas(line) std::atomic<std::uint64_t> tail_{0};      // of the cursor that holds back
  std::atomic<bool> held_{false}, waiting_{false};
  alignas(line) std::mutex mutex_;  // shared by the sinks
  std::vector<Cursor*> cursors_;
};

}  // namespace fulmar::core
