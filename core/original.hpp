// SPDX-License-Identifier: BSD-3-Clause
// Distinguishes a process from a copy that a component has forked. A copy has the log, ports and devices of
// the host, and must not act as the host.
#pragma once
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>

namespace fulmar::core {

/// A byte that the kernel clears in every forked copy of this process, for each kind of fork. Reading it
/// costs no system call.
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

/// Reason why a component may not fork in flight.
inline constexpr const char* copy_would_fly = "the copy of the process would fly, too";

/// Ends a copy, without the exit handlers, which belong to the host.
[[noreturn]] inline void end_copy() noexcept {
  for (;;) syscall(SYS_exit_group, 0);
}

}  // namespace fulmar::core
