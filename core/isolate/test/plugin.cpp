// SPDX-License-Identifier: BSD-3-Clause
// A laboratory for isolation: a component with every kind of port and parameter, and components with every
// fault.
#include "fulmar/plugin.hpp"

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

#include "faults.hpp"

using namespace fulmar;
using namespace isolate_lab;

namespace {

struct Signal {
  double x_m = 0, y_m = 0;
  std::uint32_t turn = 0;
};
struct Word {
  Text<24> text;
  List<double, 5> part_ratio;
};
struct Ask {
  double to_m = 0;
};
struct Table {
  std::array<double, 40> gain_ratio{};
  std::uint32_t used = 0;
};
struct Sum {
  double sum_m = 0, age_s = 0, random_ratio = 0, dt_s = 0;
  std::uint64_t hash = 0;
};

enum class Law : std::uint8_t { straight, square, cube };

std::uint64_t mix(std::uint64_t h, const void* data, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    h = (h ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
  return h;
}
template <class T>
std::uint64_t mix(std::uint64_t h, const T& x) {
  return mix(h, &x, sizeof x);
}

/// Its outputs depend on all of its inputs and parameters.
struct Everything {
  struct Inputs {
    In<Signal> signal;
    Optional<Word> word;
    Queue<Signal> burst;
    Request<Ask> ask;
  };
  struct Outputs {
    Sum sum;
    Out<Word> echo;
    OutQueue<Signal, 3> series;
    Probe last_m;
    Probe rare_m;
  };
  struct Params {
    Param gain{1.5, "", 0, 10, "factor"};
    Flag negate{false, "sign"};
    Count every{3, 1, 1000, "period of the echo"};
    Choice<Law> law{Law::straight, "shape"};
    TextParam<16> tag{Text<16>("none"), "marks the echo"};
    Vector<Ned> offset{{1, 2, 3}, "m", -100, 100, "added"};
    Record<Table> table{"gains"};
    Blob bytes{"hashed"};
  };
  explicit Everything(std::uint64_t seed) : state_(seed) {}

  void configure(const Params& p) {
    kept_ = &p;
    seen_ = mix(14695981039346656037u, p.tag.value);
  }
  void retune(const Params& p) { seen_ = mix(seen_, p.gain.value); }
  Status activate(const Tick& tick, const Inputs& in, const Params&, const Outputs& last) {
    seen_ = mix(seen_, tick.now_ns);
    seen_ = mix(seen_, last.sum.sum_m);
    seen_ = mix(seen_, last.last_m.value);
    if (last.echo.written) seen_ = mix(seen_, last.echo.valid_at_ns);
    seen_ = mix(seen_, in.signal->x_m);
    return in.signal->x_m < -1000 ? Status::failed : Status::ok;
  }
  void deactivate() { seen_ += 1; }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    double x = in.signal->x_m * p.gain + p.offset.value.north;
    if (p.law == Law::square) x *= x;
    if (p.law == Law::cube) x *= x * x;
    if (p.negate) x = -x;
    hash(tick, in, p);
    out.sum = {x, in.signal.age_s(), static_cast<double>(state_ >> 11), tick.dt_s(), seen_};
    ++n_;
    if (n_ % static_cast<std::uint64_t>(p.every.value) == 0) {
      Word word;
      word.text = Text<24>(p.tag.view());
      word.part_ratio.push_back(x);
      n_ % 2 == 0 ? out.echo.publish(word) : out.echo.publish(word, tick.now_ns - 17);
    }
    for (std::uint64_t i = 0; i < n_ % 5; ++i)
      out.series.push({x, static_cast<double>(i), static_cast<std::uint32_t>(n_)},
                      tick.now_ns - static_cast<std::int64_t>(i));
    out.last_m = in.signal->y_m;
    if (n_ % 7 == 0) out.rare_m = x;
    return in.signal->turn % 11 == 0 ? Status::degraded : Status::ok;
  }

 private:
  void hash(const Tick& tick, const Inputs& in, const Params& p) {
    seen_ = mix(seen_, tick.index);
    seen_ = mix(seen_, in.signal.sequence());
    seen_ = mix(seen_, in.signal.fresh());
    seen_ = mix(seen_, in.signal.stale());
    if (in.word) {
      seen_ = mix(seen_, in.word->text);
      seen_ = mix(seen_, in.word->part_ratio);
      seen_ = mix(seen_, in.word.valid_at_ns());
    }
    for (const auto& sample : in.burst) {
      seen_ = mix(seen_, sample.value.x_m);
      seen_ = mix(seen_, sample.valid_at_ns);
    }
    seen_ = mix(seen_, in.burst.lost());
    for (auto request : in.ask) {
      seen_ = mix(seen_, request.value().to_m);
      if (request.value().to_m > 5)
        request.refuse("too far");
      else if (request.value().to_m >= 0)
        request.accept();
    }
    seen_ = mix(seen_, p.table->gain_ratio);
    seen_ = mix(seen_, p.table.given());
    if (p.bytes.data) seen_ = mix(seen_, p.bytes.data, p.bytes.size);
    seen_ = mix(seen_, p.bytes.name, std::strlen(p.bytes.name));
  }

  const Params* kept_ = nullptr;
  std::uint64_t state_, n_ = 0, seen_ = 0;
};

volatile std::uintptr_t nowhere = 4096;

int deeper(int depth, volatile char* above) {
  volatile char room[4096];
  room[0] = static_cast<char>(depth);
  above[0] = room[0];
  return depth < 0 ? 0 : deeper(depth + 1, room) + room[0];
}

void leak(std::size_t bytes) {
  auto* lost = new char[bytes];
  asm volatile("" ::"r"(lost) : "memory");
}

/// Copies the process by a direct system call, without a function of the C library.
pid_t clone_process() { return static_cast<pid_t>(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0)); }

/// Commits `fault` in each call from `at` on.
struct Faulty {
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Signal signal;
  };
  struct Params {
    Choice<Fault> fault{Fault::none, "what it does"};
    Param at{0, "s", 0, 1e9, "from when on"};
    Choice<Fault> in_configure{Fault::none, "what it does there", setup};
    Choice<Fault> in_activate{Fault::none, "what it does there"};
    Choice<Fault> in_retune{Fault::none, "what it does there"};
  };
  void configure(const Params& p) { act(p.in_configure); }
  void retune(const Params& p) { act(p.in_retune); }
  Status activate(const Tick&, const Inputs&, const Params& p, const Outputs&) { return act(p.in_activate); }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    out.signal = *in.signal;
    if (tick.now_s() < p.at) return Status::ok;
    if (p.fault == Fault::not_a_number) out.signal.y_m = std::numeric_limits<double>::quiet_NaN();
    return act(p.fault);
  }

  static Status act(Fault fault) {
    switch (fault) {
      case Fault::segfault: *reinterpret_cast<volatile int*>(nowhere) = 1; break;
      case Fault::aborts: std::abort();
      case Fault::exits: std::exit(3);
      case Fault::hangs:
        for (;;) asm volatile("");
      case Fault::overflow: {
        volatile char room[1];
        return deeper(0, room) == 1 ? Status::failed : Status::ok;
      }
      case Fault::throws: throw std::runtime_error("the law is broken");
      case Fault::leaks: leak(1000); break;
      case Fault::killed: ::raise(SIGKILL); break;
      case Fault::divides: ::raise(SIGFPE); break;
      case Fault::prints: std::puts("a word of the component"); break;
      case Fault::allocates: {
        std::vector<double> v(32);
        asm volatile("" ::"r"(v.data()) : "memory");
        break;
      }
      case Fault::fails: return Status::failed;
      case Fault::terminates: std::terminate();
      case Fault::forks: return fork() < 0 ? Status::ok : Status::failed;
      case Fault::clones: clone_process(); break;
      case Fault::clone_crashes: {
        const pid_t copy = clone_process();
        if (copy == 0) *reinterpret_cast<volatile int*>(nowhere) = 1;
        int status = 0;
        return waitpid(copy, &status, 0) == copy && WIFSIGNALED(status) ? Status::ok : Status::failed;
      }
      case Fault::none:
      case Fault::not_a_number: break;
    }
    return Status::ok;
  }
};

/// Commits a fault where it has no parameters yet, or none any more.
template <Fault born, Fault ended>
struct Mortal {
  struct Inputs {};
  struct Outputs {
    Signal signal;
  };
  struct Params {};
  Mortal() { Faulty::act(born); }
  ~Mortal() { Faulty::act(ended); }
  Mortal(const Mortal&) = delete;
  Mortal& operator=(const Mortal&) = delete;
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
};
struct CrashBorn : Mortal<Fault::segfault, Fault::none> {};
struct ThrowBorn : Mortal<Fault::throws, Fault::none> {};
struct ExitBorn : Mortal<Fault::exits, Fault::none> {};
struct HangBorn : Mortal<Fault::hangs, Fault::none> {};
struct CrashEnd : Mortal<Fault::none, Fault::segfault> {};
struct HangEnd : Mortal<Fault::none, Fault::hangs> {};

/// Reports properties of its process.
struct Look {
  struct Inputs {};
  struct Outputs {
    Sum open;  ///< sum_m: descriptors above the third; age_s: bytes on standard input; random: denormals are
               ///< kept
  };
  struct Params {};
  Status step(const Tick&, const Inputs&, const Params&, Outputs& out) {
    out.open.sum_m = 0;
    for (int i = 4; i < 256; ++i) out.open.sum_m += fcntl_exists(i) ? 1 : 0;
    char byte = 0;
    out.open.age_s = static_cast<double>(::read(0, &byte, 1));
    volatile double smallest = std::numeric_limits<double>::denorm_min();
    out.open.random_ratio = smallest * 2 > 0 ? 1 : 0;
    return Status::ok;
  }
  static bool fcntl_exists(int descriptor) { return ::lseek(descriptor, 0, SEEK_CUR) >= 0 || errno != EBADF; }
};

}  // namespace

FULMAR_PLUGIN("1.0.0", Everything, Faulty, CrashBorn, ThrowBorn, ExitBorn, HangBorn, CrashEnd, HangEnd, Look)
