// SPDX-License-Identifier: BSD-3-Clause
// The laboratory's law with configurable faults. Part of lab.cpp, compiled as several variants.
#pragma once
#include <fcntl.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "lab_cart.hpp"

namespace {

enum class Fault : std::uint8_t {
  none,
  nan,
  range,
  throws,
  fails,
  slow,
  stutters,
  probe_nan,
  allocates,
  crashes,
  hangs,
  aborts,
  exits,
  overflows,
  leaks,
  divides,
  quits,
  rounds,
  masks,
  deafens,
  listens,
  fosters,
  spawns,
  raises_usr1,
  raises_term,
  thread_crashes,
  thread_quits,
  threads_terminate,
  forks,
  forks_on,
  vforks_on,
  clones_on,
  clones_end,
  narrows,
  parts
};

/// Copies the process by a direct system call, without a function of the C library.
pid_t clone_process() { return static_cast<pid_t>(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0)); }

/// Whether a copy of the process ends by the signal that it raises.
bool copy_ends_by(int signal) {
  const pid_t copy = clone_process();
  if (copy == 0) {
    raise(signal);
    _exit(0);
  }
  int status = 0;
  return waitpid(copy, &status, 0) == copy && WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

// Endless recursion that no compiler can turn into a loop.
double overflow(double x) {
  volatile char room[4096];
  room[static_cast<std::size_t>(x) % sizeof room] = 1;
  return x < 0 ? room[0] : overflow(x + 1) + room[1];
}

void* volatile nowhere = nullptr;

/// Threads that end the program at the same time, by a handler that throws.
inline void terminate_together() {
  constexpr int most = 6;
  static std::atomic<int> ready{0};
  std::set_terminate([] { throw std::runtime_error("no end"); });
  std::vector<std::thread> threads;
  for (int i = 0; i < most; ++i)
    threads.emplace_back([] {
      for (++ready; ready < most;) std::this_thread::yield();
      std::terminate();
    });
  for (std::thread& thread : threads) thread.join();
}

struct Parting {  // crashes when its library is unloaded
  bool crashes = false;
  ~Parting() {
    if (crashes) *static_cast<volatile int*>(nowhere) = 1;
  }
} parting;

struct Law {
#ifdef LAB_THROWING
  Law() { throw std::runtime_error("no law today"); }
#else
  Law() = default;
#endif
  Law(const Law&) = delete;
  Law& operator=(const Law&) = delete;
  ~Law() {
    for (const char* p : kept_) delete[] p;
  }
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Command command;
#ifdef LAB_WIDER
    Probe taken_over_frac;
    Probe error_m;
#else
    Probe error_m;
    Probe taken_over_frac;
#endif
  };
  struct Params {
#ifdef LAB_WIDER
    Param reserve{0, "", -1, 1, "of no matter"};
#endif
#ifdef LAB_BETTER
    Param u{0.5, "", -0.5, 1, "what it commands"};
#else
    Param u{0.5, "", -1, 1, "what it commands"};
#endif
    Count id{1, 0, 100, "who it is"};
    Choice<Fault> fault{Fault::none, "what it does wrong"};
    Param fault_at{1e9, "s", -1e9, 1e9, "from when on"};
    Flag refuse{false, "refuses to take over"};
#ifdef LAB_WIDER
    Param fixed{1.5, "", 0, 2, "set-up parameter", setup};
#else
    Param fixed{1, "", 0, 2, "set-up parameter", setup};
#endif
  };
  Status activate(const Tick&, const Inputs&, const Params& p, const Outputs& last) {
    taken_ = last.command.u_frac;
    return p.refuse ? Status::failed : Status::ok;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const bool bad = tick.now_s() >= p.fault_at;
    out.command.u_frac = p.u;
    out.command.seen_m = in.signal->x_m;
    out.command.by = static_cast<std::uint32_t>(p.id);
#if defined(LAB_BETTER)
    out.command.u_frac = p.u / 2;
#elif defined(LAB_WILD)
    if (++steps_ == 20) out.command.u_frac = std::numeric_limits<double>::quiet_NaN();
#elif defined(LAB_CRASHING)
    if (++steps_ == 20) raise(SIGSEGV);
#endif
    out.error_m = in.signal->x_m;
    out.taken_over_frac = taken_;
    if (!bad) return Status::ok;
    switch (p.fault) {
      case Fault::nan: out.command.u_frac = std::numeric_limits<double>::quiet_NaN(); break;
      case Fault::range: out.command.u_frac = 1.5; break;
      case Fault::throws:
        throw std::runtime_error(
            "the law is broken\n\x01\xff\xc3\xa9\xc2\x9b"
            "2J");
      case Fault::fails: return Status::failed;
      case Fault::probe_nan: out.error_m = std::numeric_limits<double>::infinity(); break;
      case Fault::stutters:
        if (++late_ % 2 == 0) break;
        [[fallthrough]];
      case Fault::slow:
        for (int i = 0; i < 3'000'000; ++i) asm volatile("");
        break;
      case Fault::allocates: {
        std::vector<double> v(32);
        asm volatile("" ::"r"(v.data()) : "memory");
        break;
      }
      case Fault::crashes: raise(SIGSEGV); break;
      case Fault::hangs:
        for (;;) asm volatile("");
      case Fault::aborts: std::abort();
      case Fault::exits: std::exit(3);
      case Fault::overflows: out.error_m = overflow(1); break;
      case Fault::leaks: kept_.push_back(new char[1'000'000]); break;
      case Fault::divides: raise(SIGFPE); break;
      case Fault::quits: _exit(0);
      case Fault::rounds: std::fesetround(FE_UPWARD); break;
      case Fault::narrows: {
#if defined(__x86_64__)
        const std::uint16_t double_precision = 0x027f;  // precision of the x87's numbers, which are long
                                                        // double
        asm volatile("fldcw %0" ::"m"(double_precision));
#else
        std::fesetround(FE_UPWARD);
#endif
        break;
      }
      case Fault::masks: {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_BLOCK, &all, nullptr);
        break;
      }
      case Fault::deafens: std::signal(SIGINT, SIG_IGN); break;
      case Fault::listens: {
        struct sigaction action {};
        action.sa_handler = SIG_IGN;
        sigaction(SIGSEGV, &action, nullptr);
        break;
      }
      case Fault::fosters: {  // a separate process, which is unrestricted
        const pid_t child = clone_process();
        if (child == 0) {
          char name[] = "true";
          char* const words[] = {name, nullptr};
          if (std::signal(SIGINT, SIG_DFL) == SIG_ERR) _exit(1);
          execv("/bin/true", words);
          _exit(2);
        }
        int status = 1;
        if (waitpid(child, &status, 0) != child || status != 0) return Status::failed;
        break;
      }
      case Fault::spawns: {
        char name[] = "true";
        char* const words[] = {name, nullptr};
        pid_t child = 0;
        int status = 1;
        for (const auto& start : {posix_spawn, posix_spawnp})
          if (start(&child, "/bin/true", nullptr, nullptr, words, environ) == 0 &&
              (waitpid(child, &status, 0) != child || status != 0))
            return Status::failed;
        break;
      }
      case Fault::raises_usr1: raise(SIGUSR1); break;
      case Fault::raises_term: raise(SIGTERM); break;
      case Fault::thread_crashes: std::thread([] { *static_cast<volatile int*>(nowhere) = 1; }).join(); break;
      case Fault::thread_quits: std::thread([] { std::exit(0); }).join(); break;
      case Fault::threads_terminate: terminate_together(); break;
      case Fault::forks:
        if (clone_process() == 0) std::exit(0);
        break;
      case Fault::forks_on: std::ignore = fork(); break;  // and both continue
      case Fault::vforks_on: std::ignore = vfork(); break;
      case Fault::clones_on:
        if (!std::exchange(cloned_, true)) clone_process();
        break;
      case Fault::clones_end:
        for (const int signal : {SIGSEGV, SIGTERM, SIGUSR1, SIGRTMIN + 1})
          if (!copy_ends_by(signal)) return Status::failed;
        break;
      case Fault::parts: parting.crashes = true; break;
      default: break;
    }
    return Status::ok;
  }

 private:
  double taken_ = -9;
  [[maybe_unused]] int steps_ = 0;
  int late_ = 0;
  bool cloned_ = false;
  std::vector<const char*> kept_;
};

}  // namespace
