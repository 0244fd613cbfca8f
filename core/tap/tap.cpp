// SPDX-License-Identifier: BSD-3-Clause
// The loop does not read the cursors: it announces the end of its next write, writes, and publishes the new
// end. A cursor copies a record and then checks whether the announced end has come round to it; the copy is
// then invalid. This is a sequence lock on positions that never wrap. Only the position of the cursor that
// holds back is read by the loop.
#include "core/tap/tap.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <utility>

#include "core/due.hpp"
#include "core/types/element.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t record_size(std::size_t data) {
  return (sizeof(Tap::Sample) + data + 7) & ~std::size_t{7};
}

/// The bytes of a message with content: all, or up to the last item of a list at its end.
struct Extent {
  std::uint32_t size = 0, count_at = 0, first_item = 0, stride = 0,
                capacity = 0;  // stride 0: no list at the end

  Extent() = default;
  explicit Extent(const Type& type) : size(type.size) {
    const auto last = std::max_element(type.fields.begin(), type.fields.end(),
                                       [](const Field& a, const Field& b) { return a.offset < b.offset; });
    if (last == type.fields.end() || last->shape != FULMAR_LIST) return;
    count_at = last->offset;
    first_item = last->offset + last->items;
    stride = last->stride;
    capacity = last->count;
  }
  std::size_t of(const std::byte* data) const noexcept {
    if (stride == 0) return size;
    return first_item + std::size_t{stride} * std::min(load<std::uint32_t>(data + count_at), capacity);
  }
};

struct Mark {
  std::uint32_t size, channel;
};

constexpr std::size_t word = sizeof(std::uint64_t);
static_assert(sizeof(Mark) == word && sizeof(Tap::Sample) % word == 0);

/// The loop may write a word while a sink reads it: each word is atomic, and an overtaken copy is invalid.
void store_words(std::uint64_t* to, const void* from, std::size_t bytes) noexcept {
  const auto* next = static_cast<const std::byte*>(from);
  for (; bytes >= word; bytes -= word, next += word, ++to)
    std::atomic_ref(*to).store(load<std::uint64_t>(next), std::memory_order_relaxed);
  if (bytes == 0) return;
  std::uint64_t rest = 0;
  std::memcpy(&rest, next, bytes);
  std::atomic_ref(*to).store(rest, std::memory_order_relaxed);
}

}  // namespace

struct Tap::Channel {
  Extent extent;
  std::uint64_t for_log = 0;  // samples
  Due due;
  std::atomic<std::int64_t> wanted_ns{-1};
};

Tap::Tap(std::vector<TapChannel> channels, std::size_t ring_bytes)
    : channels_(std::move(channels)), state_(channels_.size()) {
  std::size_t largest = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    state_[i].extent = Extent(*channels_[i].type);
    largest = std::max<std::size_t>(largest, channels_[i].type->size);
  }
  max_record_ = record_size(largest);
  capacity_ = std::bit_ceil(std::max(ring_bytes, 2 * slices * max_record_));
  memory_.resize(capacity_ / sizeof(std::uint64_t));
}

Tap::~Tap() = default;

// ---- the loop

bool Tap::wanted(std::size_t channel, std::int64_t now_ns) noexcept {
  Channel& c = state_[channel];
  const std::int64_t period_ns = c.wanted_ns.load(std::memory_order_relaxed);
  // every sample, also when a lower rate was enough until now
  return period_ns == 0 || c.due.take(now_ns, period_ns);
}

void Tap::put(const Sample& sample, const std::byte* data, std::size_t size) noexcept {
  const std::size_t at = pushed_ & (capacity_ - 1);
  const std::size_t skip = capacity_ - at < sample.size ? capacity_ - at : 0;
  const std::uint64_t begin = pushed_ + skip, end = begin + sample.size;
  reserved_.store(end, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);  // a reader of the record sees `reserved_`, too
  if (skip > 0) {
    const Mark mark{static_cast<std::uint32_t>(skip), skipped};
    store_words(words_at(at), &mark, sizeof mark);
  }
  std::uint64_t* const to = words_at(begin & (capacity_ - 1));
  store_words(to, &sample, sizeof sample);
  store_words(to + sizeof sample / word, data, size);
  if (const std::uint64_t slice = begin / (capacity_ / slices); slice != slice_) {
    slice_ = slice;
    begins_[slice % slices].store(begin, std::memory_order_release);
  }
  pushed_ = end;
  head_.store(end, std::memory_order_release);
}

void Tap::write(std::size_t channel, std::int64_t now_ns, std::int64_t valid_ns, const std::byte* data,
                bool for_log) noexcept {
  Channel& c = state_[channel];
  const std::size_t size = c.extent.of(data);
  const std::size_t need = record_size(size);
  if (held_.load(std::memory_order_relaxed)) wait_for_room(2 * need);
  put({static_cast<std::uint32_t>(need), static_cast<std::uint32_t>(channel), number_++, c.for_log, now_ns,
       valid_ns, for_log},
      data, size);
  if (for_log) ++c.for_log;
}

/// Sleeps until the ring is half empty, when it is full.
void Tap::wait_for_room(std::size_t bytes) noexcept {
  if (pushed_ + bytes - seen_tail_ <= capacity_) return;
  seen_tail_ = tail_.load(std::memory_order_acquire);
  if (pushed_ + bytes - seen_tail_ <= capacity_) return;
  const auto begin = std::chrono::steady_clock::now();
  waiting_.store(true, std::memory_order_seq_cst);
  for (seen_tail_ = tail_.load(std::memory_order_seq_cst); pushed_ - seen_tail_ > capacity_ / 2;
       seen_tail_ = tail_.load(std::memory_order_seq_cst))
    tail_.wait(seen_tail_);
  waiting_.store(false, std::memory_order_relaxed);
  waited_ns_ +=
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin).count();
}

std::int64_t Tap::take_wait_ns() noexcept { return std::exchange(waited_ns_, 0); }

// ---- sinks

Tap::Cursor::Cursor(Tap& tap, bool may_hold_back, bool at_once)
    : tap_(tap),
      may_hold_back_(may_hold_back),
      wants_(tap.channels_.size(), -1),
      room_(tap.max_record_ / sizeof(std::uint64_t)) {
  const std::lock_guard lock(tap_.mutex_);
  tap_.cursors_.push_back(this);
  read_ = released_ = seen_head_ = tap_.head_.load(std::memory_order_acquire);
  if (read_ == 0) expected_ = 0;
  if (!may_hold_back_) return;
  tap_.tail_.store(read_, std::memory_order_seq_cst);
  tap_.held_.store(at_once, std::memory_order_seq_cst);
}

Tap::Cursor::~Cursor() {
  const std::lock_guard lock(tap_.mutex_);
  std::erase(tap_.cursors_, this);
  for (std::size_t c = 0; c < wants_.size(); ++c)
    if (wants_[c] >= 0) tap_.combine_wants(c);
  if (!may_hold_back_) return;
  tap_.held_.store(false, std::memory_order_seq_cst);
  tap_.tail_.store(tap_.head_.load(), std::memory_order_seq_cst);
  tap_.tail_.notify_one();
}

bool Tap::Cursor::take(std::uint64_t at, std::size_t bytes, std::byte* to) const noexcept {
  std::uint64_t* from = tap_.words_at(at & (tap_.capacity_ - 1));
  for (std::size_t i = 0; i < bytes; i += word, ++from) {
    const std::uint64_t w = std::atomic_ref(*from).load(std::memory_order_relaxed);
    std::memcpy(to + i, &w, word);
  }
  std::atomic_thread_fence(std::memory_order_acquire);
  return tap_.reserved_.load(std::memory_order_relaxed) - at <= tap_.capacity_;
}

/// Moves to the first record of a slice that is half a ring behind the loop.
void Tap::Cursor::skip_ahead() noexcept {
  const std::uint64_t head = tap_.head_.load(std::memory_order_acquire), slice = tap_.capacity_ / slices;
  const std::uint64_t wanted = head / slice - slices / 2;
  const std::uint64_t begin = tap_.begins_[wanted % slices].load(std::memory_order_acquire);
  read_ = begin / slice == wanted && begin > read_ ? begin : head;
  seen_head_ = head;
}

const Tap::Sample* Tap::Cursor::next() noexcept {
  auto* const room = reinterpret_cast<std::byte*>(room_.data());
  for (;;) {
    if (may_hold_back_ && read_ != released_ &&
        (read_ - released_ >= tap_.capacity_ / 16 || read_ == seen_head_)) {
      released_ = read_;
      tap_.tail_.store(read_, std::memory_order_seq_cst);
      if (tap_.waiting_.load(std::memory_order_seq_cst)) tap_.tail_.notify_one();
    }
    if (read_ == seen_head_) seen_head_ = tap_.head_.load(std::memory_order_acquire);
    if (read_ == seen_head_) return nullptr;
    Mark mark{};
    if (!take(read_, sizeof mark, reinterpret_cast<std::byte*>(&mark))) {
      skip_ahead();
      continue;
    }
    if (mark.channel == skipped) {
      read_ += mark.size;
      continue;
    }
    if (!take(read_, mark.size, room)) {
      skip_ahead();
      continue;
    }
    read_ += mark.size;
    const auto* const sample = reinterpret_cast<const Sample*>(room);
    if (expected_ != unknown) lost_ += sample->number - expected_;
    expected_ = sample->number + 1;
    return sample;
  }
}

void Tap::Cursor::want(std::size_t channel, std::int64_t period_ns) {
  const std::lock_guard lock(tap_.mutex_);
  wants_[channel] = std::max<std::int64_t>(period_ns, -1);
  tap_.combine_wants(channel);
}

void Tap::combine_wants(std::size_t channel) {
  std::int64_t least = -1;
  for (const Cursor* c : cursors_)
    if (const std::int64_t w = c->wants_[channel]; w >= 0 && (least < 0 || w < least)) least = w;
  state_[channel].wanted_ns.store(least, std::memory_order_relaxed);
}

}  // namespace fulmar::core
