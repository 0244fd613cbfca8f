// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/realtime.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {
namespace {

cpu_set_t usual_cpus;     // before the loop was bound to one CPU
bool has_stayed = false;  // set before the reading threads begin

rlim_t limit_of(auto resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

[[noreturn]] void refuse(int priority, const std::string& what, int fault) {
  std::error_code none;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe", none).string();
  throw Error(run_messages::realtime_not_permitted(what, std::strerror(fault), priority, self));
}

/// Touches the stack in advance: a tick must not have page faults.
[[gnu::noinline]] void take_stack() {
  constexpr std::size_t wanted = 512 * 1024;
  if (limit_of(RLIMIT_STACK) < 2 * wanted) return;
  char pages[wanted];
  explicit_bzero(pages, sizeof pages);
}

/// Whether all memory can be locked. A limit that is just enough now would make a later allocation fail. A
/// process that may exceed the limit may also raise it.
bool may_lock_all() {
  const rlim_t limit = limit_of(RLIMIT_MEMLOCK);
  if (limit == RLIM_INFINITY) return true;
  const std::size_t size = limit + 4096;
  void* reserved = mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved == MAP_FAILED) return false;
  munmap(reserved, size);
  return true;
}

}  // namespace

void take_real_time(int priority) {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0 || !may_lock_all()) {
    const int fault = errno;
    munlockall();
    refuse(priority, "to lock its memory (limit " + std::to_string(limit_of(RLIMIT_MEMLOCK) / 1024) + " kB)",
           fault);
  }
  const sched_param wanted{priority};
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) != 0) {
    const int fault = errno;
    munlockall();
    refuse(priority,
           "to run with priority " + std::to_string(priority) + " (limit " +
               std::to_string(limit_of(RLIMIT_RTPRIO)) + ")",
           fault);
  }
  mallopt(M_TRIM_THRESHOLD,
          -1);  // keeps freed memory in the heap, without new page faults: for components that allocate
  mallopt(M_MMAP_MAX, 0);
  take_stack();
}

void stay_on_one_cpu() noexcept {
  if (!has_stayed && sched_getaffinity(0, sizeof usual_cpus, &usual_cpus) != 0) return;
  cpu_set_t own;
  CPU_ZERO(&own);
  int last = CPU_SETSIZE - 1;
  while (last > 0 && !CPU_ISSET(last, &usual_cpus)) --last;
  CPU_SET(last, &own);
  has_stayed = sched_setaffinity(0, sizeof own, &own) == 0;
}

void leave_cpu_of_loop() noexcept {
  if (has_stayed) sched_setaffinity(0, sizeof usual_cpus, &usual_cpus);
}

void wait_for_child(pid_t child) noexcept {
  if (has_stayed) sched_setaffinity(child, sizeof usual_cpus, &usual_cpus);
  sched_param own{};
  const int policy = sched_getscheduler(0);
  if (policy < 0 || (policy & ~SCHED_RESET_ON_FORK) != SCHED_FIFO || sched_getparam(0, &own) != 0) return;
  const sched_param below{std::max(1, own.sched_priority - 1)};
  sched_setscheduler(child, SCHED_FIFO | SCHED_RESET_ON_FORK, &below);
}

}  // namespace fulmar::core
