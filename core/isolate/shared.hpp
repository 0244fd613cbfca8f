// SPDX-License-Identifier: BSD-3-Clause
// Shared memory of the host and the child of an isolated component, and the wait of one side for the other.
// Both compute the same layout from the component's tables. No pointer crosses, and the host checks every
// number from the child.
#pragma once
#include <linux/futex.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/clock.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

// ---- contents

inline constexpr int shared_descriptor = 3;  // of the memory, in the child
inline constexpr std::uint32_t shared_version = 1;
inline constexpr std::size_t cache_line = 64;

enum class Call : std::uint32_t { create = 1, configure, retune, activate, deactivate, step, quit };
enum class Stage : std::uint32_t { loaded, created, running };

/// Start of the memory. Each side writes its own cache lines, so that a call moves only two lines.
struct ControlBlock {
  // written by the host
  alignas(cache_line) std::atomic<std::uint32_t> request;  // counts calls; the child sleeps on it
  std::atomic<std::uint32_t> host_sleeps;
  Call call;
  std::uint32_t reserved;
  fulmar_tick tick;
  // written by the child
  alignas(cache_line) std::atomic<std::uint32_t> answer;  // number of the last answered call; the host sleeps
                                                          // on it
  std::atomic<std::uint32_t> child_sleeps;
  std::uint32_t status, has_error;
  std::uint64_t allocations;  // of all steps
  std::int64_t heap_growth;   // bytes since configure
  // rarely written
  alignas(cache_line) std::atomic<std::uint32_t> signal;  // signal that ends the child, written in its
                                                          // handler
  std::atomic<std::uint32_t> stack_overflow;
  std::atomic<Stage> stage;
  struct {
    std::uint32_t version;
    std::int64_t spin_ns;
    std::int64_t host_pid;
    std::uint64_t signature, layout_size, values_size;
    char component[256];
  } set_up;  // written by the host
  fulmar_error error;
};
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

inline constexpr std::uint32_t has_data = 1, has_stamps = 2, has_answers = 4, has_nothing = 0;

/// A fulmar_input without its pointers.
struct SharedInput {
  std::int64_t valid_at_ns, age_ns;
  std::uint64_t sequence;
  std::uint32_t count, lost, flags, has;
};

struct SharedOutput {
  std::int64_t valid_at_ns;
  std::uint32_t count, lost;
};

/// A fulmar_value. At configure, text and data lie behind the layout at the offsets; at retune, text lies at
/// the parameter's place.
struct SharedValue {
  double number[3];
  std::int64_t integer;
  std::uint64_t size, text_at, data_at;
  std::uint32_t has, reserved;
};

/// Offsets of the samples of one port, bytes from the start of the memory.
struct Place {
  std::size_t data = 0, stamps = 0, answers = 0, message = 0;  // message: bytes of one message
  std::uint32_t capacity = 1;
  fulmar_port_kind kind = FULMAR_IN_VALUE;
};

struct TextPlace {
  std::size_t at = 0, capacity = 0;  // 0: not a text parameter
};

struct Layout {
  explicit Layout(const ComponentInfo& info);

  std::vector<Place> inputs, outputs, last;
  std::vector<TextPlace> texts;                                           // one per parameter
  std::size_t inputs_at = 0, outputs_at = 0, last_at = 0, values_at = 0;  // the heads, one after the other
  std::size_t size = 0;                                                   // whole pages
  std::uint64_t signature = 0;                                            // hash of the inputs of the layout
};

// ---- waiting

/// Sleeps while `word` equals `seen`, at most `limit_ns`. May return early.
inline void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t seen, std::int64_t limit_ns) noexcept {
  const timespec limit{static_cast<time_t>(limit_ns / 1'000'000'000),
                       static_cast<long>(limit_ns % 1'000'000'000)};
  syscall(SYS_futex, &word, FUTEX_WAIT, seen, &limit, nullptr, 0);
}

inline void futex_wake(std::atomic<std::uint32_t>& word) noexcept {
  syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

/// Hints to the CPU that this is a busy-wait loop.
inline void spin_hint() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// Polls `done` for at most `limit_ns`; returns whether it became true.
template <class Done>
bool spin_until(std::int64_t limit_ns, Done&& done) noexcept {
  if (done()) return true;
  if (limit_ns <= 0) return false;
  for (const std::int64_t end = monotonic_ns() + limit_ns; monotonic_ns() < end;)
    for (int i = 0; i < 16; ++i) {
      if (done()) return true;
      spin_hint();
    }
  return false;
}

}  // namespace fulmar::core
