// SPDX-License-Identifier: BSD-3-Clause
// fulmar-child NAME COPY SCRIPT PATH FILE INDEX SEED: runs one component for a host over the memory at
// descriptor 3. Started by the host.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "core/isolate/child/crash.hpp"
#include "core/isolate/child/heap.hpp"
#include "core/isolate/child/session.hpp"
#include "core/loader/crash_signal.hpp"

using namespace fulmar::core;

namespace {

void close_others() {
#ifdef SYS_close_range
  if (::syscall(SYS_close_range, shared_descriptor + 1, ~0u, 0) == 0) return;
#endif
  for (int descriptor = shared_descriptor + 1; descriptor < 1024; ++descriptor) ::close(descriptor);
}

// No life after the host, no core file unless somebody wants one, nothing of the host's but the shared
// memory.
void prepare() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  close_others();
  ::fcntl(shared_descriptor, F_SETFD, FD_CLOEXEC);
  if (std::getenv("FULMAR_CORE") == nullptr) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
  }
  rlimit stack{};
  constexpr rlim_t enough =
      64u << 20;  // without a limit a runaway recursion would take all memory before it is found out
  if (::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur == RLIM_INFINITY) {
    stack.rlim_cur = enough;
    ::setrlimit(RLIMIT_STACK, &stack);
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
}

int work(Session& session, const Order& order) {
  try {
    session.open(order);
  } catch (const std::exception& fault) {
    fulmar_error error{};
    std::snprintf(error.text, sizeof error.text, "%s", fault.what());
    session.answer(1, FULMAR_FAILED, error);
    return 1;
  }
  session.answer(1, FULMAR_OK, {});
  session.serve();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  struct stat about {};
  if (argc != 8 || ::fstat(shared_descriptor, &about) != 0) {
    std::fputs("usage: fulmar-child NAME COPY SCRIPT PATH FILE INDEX SEED (run by the host)\n", stderr);
    return 2;
  }
  prepare();
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size < sizeof(ControlBlock)) return 2;
  void* memory =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, shared_descriptor, 0);
  if (memory == MAP_FAILED) return 2;
  Session session(static_cast<std::byte*>(memory), size);
  if (::getppid() != session.control().host_pid)
    return 1;  // it died before this process asked to die with it
  tell_crashes(session.control());
  count_heap();
  const Order order{argv[2],
                    argv[3],
                    argv[4],
                    argv[5],
                    std::strtoull(argv[6], nullptr, 10),
                    std::strtoull(argv[7], nullptr, 10)};
  const int code = work(session, order);
  ::_exit(code);  // the plugin's exit handlers are not run: nobody waits for them
}
