// SPDX-License-Identifier: BSD-3-Clause
// Distinguishes a process from a copy of it that a component has forked. A copy has the log, ports and
// devices of the host, and must not act as the host.
#pragma once
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>

namespace fulmar::core {

/// A byte that the kernel clears in a process that was forked from this one, whichever call has forked it:
/// looking at it costs no system call.
class OriginalMark {
 public:
  OriginalMark() noexcept {
    void* const page = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    const bool own_page = page != MAP_FAILED;
    if (own_page) mark_ = static_cast<std::atomic<unsigned char>*>(page);
    if (own_page && madvise(page, size, MADV_WIPEONFORK) == 0) return;
    pthread_atfork(nullptr, nullptr, clear);  // a kernel before 4.14
  }
  void set() const noexcept { mark_->store(1, std::memory_order_relaxed); }
  bool is_set() const noexcept { return mark_->load(std::memory_order_relaxed) != 0; }

 private:
  static void clear() noexcept;
  static constexpr std::size_t size = 4096;
  static inline std::atomic<unsigned char> spare_{0};
  std::atomic<unsigned char>* mark_ = &spare_;
};

inline const OriginalMark original_mark;

inline void OriginalMark::clear() noexcept { original_mark.mark_->store(0, std::memory_order_relaxed); }

/// Why a component that flies may not fork.
inline constexpr const char* copy_would_fly = "the copy of the process would fly, too";

/// Ends a copy, which has no use: without exit handlers, since they are the host's.
[[noreturn]] inline void end_copy() noexcept {
  for (;;) syscall(SYS_exit_group, 0);
}

}  // namespace fulmar::core
