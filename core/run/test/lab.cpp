// SPDX-License-Identifier: BSD-3-Clause
// A laboratory for the loop: a cart that counts its ticks, and a law that misbehaves on demand.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cfenv>
#include <chrono>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <vector>

#include "fulmar/plugin.hpp"

using namespace fulmar;

namespace {

struct Signal {
  double x_m = 0;  ///< tick number
  double tick_s = 0;
};

struct Command {
  double u_frac = 0;
  double seen_m = 0;     ///< x of the signal that the command was computed from
  std::uint32_t by = 0;  ///< who computed it
};

struct Received {
  double u_frac = 0, seen_m = 0;
  std::uint32_t by = 0;
  bool present = false, fresh = false, stale = false;
};

struct Arm {
  bool armed = false;
};

struct Step {
  double to_m = 0;
};

struct Stance {
  bool stands = false, obeys = false;
};

struct Cart {
  struct Inputs {
    Optional<Command> command;
    Request<Arm> arm;
  };
  struct Outputs {
    Out<Signal> signal;
    Out<Received> applied;  ///< what write received in the tick before
    OutQueue<Signal, 4> burst;
    Out<Arm> status;
    Out<Stance> stance;  ///< flags that only a mission can name
    Probe distance_m;    ///< when it is asked for
  };
  struct Params {
    Param rate{400, "Hz", 1, 10000, "tick rate", setup};
    Param fail_at{1e9, "s", -1e9, 1e9, "read fails from here on"};
    Count burst_size{3, 0, 100, "samples per tick"};
    Count bad_item{100, 0, 100, "this sample of a burst is not finite"};
    Param mute_at{1e9, "s", -1e9, 1e9, "the signal falls silent here"};
    Flag probes{false, "publishes its probe"};
    Param stuck_at{1e9, "s", -1e9, 1e9, "time stands still here"};
    TextParam<200> device{"", "file that stands for the device: it gets the last frame"};
  };
  void configure(const Params& p) {
    if (p.device.view().empty()) return;
    frame_.fd = open(p.device.value.bytes.data(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  }
  const fulmar_last_frame* last_frame(const Inputs& failsafe) {
    std::memcpy(frame_.data, &failsafe.command->u_frac, sizeof(double));
    frame_.size = sizeof(double);
    return &frame_;
  }
  Status read(Tick& tick, const Params& p, Outputs& out) {
    tick.now_ns = n_ * static_cast<std::int64_t>(1e9 / p.rate) - 1'000'000'000;
    if (tick.now_s() > p.stuck_at) tick.now_ns = std::llround(1e9 * p.stuck_at);
    if (tick.now_s() >= p.fail_at) return Status::failed;
    Signal s{static_cast<double>(n_), tick.now_s()};
    if (tick.now_s() < p.mute_at) out.signal.publish(s);
    if (p.probes) out.distance_m = s.x_m;
    if (n_ > 0) out.applied.publish(applied_);
    for (int i = 0; i < p.burst_size; ++i)
      out.burst.push({i == p.bad_item ? std::numeric_limits<double>::quiet_NaN() : s.x_m + 0.1 * i, 0},
                     tick.now_ns + i);
    out.status.publish({armed_ && tick.now_ns >= 0});
    out.stance.publish({!armed_, armed_});
    ++n_;
    return Status::ok;
  }
  Status write(const Tick&, const Inputs& in, const Params&) {
    for (auto request : in.arm) {
      armed_ = request.value().armed;
      request.accept();
    }
    applied_ = {};
    if (in.command)
      applied_ = {in.command->u_frac, in.command->seen_m, in.command->by, true,
                  in.command.fresh(), in.command.stale()};
    return Status::ok;
  }

 private:
  std::int64_t n_ = 0;
  bool armed_ = false;
  Received applied_;
  fulmar_last_frame frame_{-1, 0, {}};
};

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
  moves,
  speaks,
  masks,
  deafens,
  listens,
  replaces,
  fosters,
  spawns,
  raises_usr1,
  raises_term,
  thread_crashes,
  thread_quits,
  forks,
  parts
};

// Recursion without an end that no compiler can turn into a loop.
double overflow(double x) {
  volatile char room[4096];
  room[static_cast<std::size_t>(x) % sizeof room] = 1;
  return x < 0 ? room[0] : overflow(x + 1) + room[1];
}

void* volatile nowhere = nullptr;

struct Parting {  // crashes when its library goes
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
    Probe error_m;
    Probe taken_over_frac;
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
      case Fault::moves: std::ignore = chdir("/"); break;
      case Fault::speaks: std::setlocale(LC_ALL, "C"); break;
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
      case Fault::replaces: {
        char name[] = "false";
        char* const words[] = {name, nullptr};
        execve("/bin/false", words, environ);
        execvp("false", words);
        execvpe("false", words, environ);
        execl("/bin/false", "false", nullptr);
        execlp("false", "false", nullptr);
        execle("/bin/false", "false", nullptr, environ);
        fexecve(open("/bin/false", O_RDONLY | O_CLOEXEC), words, environ);
        execv("/bin/false", words);
        break;
      }
      case Fault::fosters: {  // a process of its own, in which it may do as it likes
        const pid_t child = fork();
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
      case Fault::forks:
        if (fork() == 0) std::exit(0);
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
  std::vector<const char*> kept_;
};

struct Filter {  ///< fills a role between cart and law
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Out<Signal> signal;
  };
  struct Params {
    Param stop_at{1e9, "s", -1e9, 1e9, "throws from here on"};
    Param mute_at{1e9, "s", -1e9, 1e9, "says nothing from here on"};
    Param until{1e9, "s", -1e9, 1e9, "and speaks again"};
    Param mute_again{1e9, "s", -1e9, 1e9, "until here"};
    Count every{1, 1, 100, "speaks in every so manieth step"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.stop_at) throw std::runtime_error("the filter is broken");
    const bool mute = (tick.now_s() >= p.mute_at && tick.now_s() < p.until) || tick.now_s() >= p.mute_again;
    if (!mute && steps_++ % p.every == 0) out.signal.publish(*in.signal);
    return Status::ok;
  }

 private:
  std::int64_t steps_ = 0;
};

struct Tally {
  double steps_ratio = 0, dt_s = 0, samples_ratio = 0, lost_ratio = 0, sum_m = 0, applied_seen_m = 0;
};

struct Watch {  ///< fills no role
  struct Inputs {
    Queue<Signal> burst;
    Optional<Received> applied;
    Request<Step> ask;
  };
  struct Outputs {
    Tally tally;
  };
  struct Params {
    Param noise{0, "", 0, 1, "adds chance to the tally"};
    Param stop_at{1e9, "s", -1e9, 1e9, "throws from here on"};
  };
  explicit Watch(std::uint64_t seed) : seed_(seed) {}
  void retune(const Params& p) {
    if (p.noise == 1) throw std::runtime_error("too loud");
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.stop_at) throw std::runtime_error("nothing to be seen");
    tally_.steps_ratio += 1;
    tally_.dt_s = tick.dt_s();
    tally_.lost_ratio += in.burst.lost();
    for (const auto& sample : in.burst) {
      tally_.samples_ratio += 1;
      tally_.sum_m += sample.value.x_m;
    }
    if (in.applied) tally_.applied_seen_m = in.applied->seen_m;
    for (auto request : in.ask) {
      if (request.value().to_m > 100) continue;  // passes it over
      if (request.value().to_m < 0)
        request.refuse("cannot go back");
      else
        request.accept();
    }
    out.tally = tally_;
    if (p.noise > 0) out.tally.sum_m += static_cast<double>(seed_ % 1000);
    return Status::ok;
  }

 private:
  std::uint64_t seed_;
  Tally tally_;
};

// The same message as Command, as another SDK knows it: a field more, in front.
namespace newer {
struct Command {
  double extra_m = 0, u_frac = 0, seen_m = 0;
  std::uint32_t by = 0;
};
}  // namespace newer

struct NewLaw {
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    newer::Command command;
  };
  struct Params {};
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    out.command = {-77, 0.75, in.signal->x_m, 9};
    return Status::ok;
  }
};

// The same message as Signal, as an older SDK knew it: one field less.
namespace older {
struct Signal {
  double tick_s = 0;
};
}  // namespace older

struct OldReader {
  struct Inputs {
    In<older::Signal> signal;
  };
  struct Outputs {
    Tally tally;
  };
  struct Params {};
  Status step(const Tick& tick, const Inputs& in, const Params&, Outputs& out) {
    out.tally.dt_s = in.signal->tick_s - tick.now_s();
    out.tally.steps_ratio += 1;
    return Status::ok;
  }
};

/// A device of its own: one sample per millisecond of the wall clock, at most `samples`; then it fails, or
/// falls silent.
struct Ticker {
  struct Inputs {};
  struct Outputs {
    OutQueue<Signal, 4> reading;
    Probe count_ratio;
  };
  struct Params {
    Count samples{10, 0, 1000, "before it ends"};
    Flag fails{false, "fails at the end"};
    Flag dated{false, "knows when each sample was taken: at its number, in ms"};
    Flag counts{true, "counts them in its probe"};
  };
  Status step(const Tick&, const Inputs&, const Params& p, Outputs& out) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (n_ == p.samples) return p.fails ? Status::failed : Status::ok;
    ++n_;
    out.reading.push({static_cast<double>(n_), 0}, p.dated ? n_ * 1'000'000 : FULMAR_ON_ARRIVAL);
    out.count_ratio = p.counts ? static_cast<double>(n_) : 0;
    return Status::ok;
  }

 private:
  int n_ = 0;
};

/// Takes its time and its memory: what it publishes belongs to the tick in which it began.
struct Thinker {
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Out<Signal> thought;
  };
  struct Params {
    Param takes{5, "ms", 0, 1000, "of the wall clock"};
    Param gain{1, "", -10, 10, "on what it saw"};
    Flag fails{false, "fails"};
    Param takes_over{0, "ms", 0, 1000, "of the wall clock until it has taken over"};
  };
  Status activate(const Tick&, const Inputs& in, const Params& p, const Outputs&) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(p.takes_over));
    began_m_ = in.signal->x_m;
    return Status::ok;
  }
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    std::vector<double> memory(1000, 1.0);
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(p.takes));
    out.thought.publish({p.gain * in.signal->x_m * memory[999], began_m_});
    return p.fails ? Status::failed : Status::ok;
  }

 private:
  double began_m_ = -1;
};

struct Late {  ///< hands on what comes; mostly that is never
  struct Inputs {
    In<Command> never;
  };
  struct Outputs {
    Out<Command> echo;
    Tally tally;
  };
  struct Params {
    Param stop_at{1e9, "s", -1e9, 1e9, "throws from here on"};
    Param mute_at{1e9, "s", -1e9, 1e9, "says nothing from here on"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    out.tally.steps_ratio += 1;
    if (tick.now_s() >= p.stop_at) throw std::runtime_error("the relay is broken");
    if (tick.now_s() < p.mute_at) out.echo.publish(*in.never);
    return Status::ok;
  }
};

struct Mute {  ///< a law that may say nothing
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Out<Command> command;
  };
  struct Params {
    Param mute_at{1e9, "s", -1e9, 1e9, "says nothing from here on"};
    Flag explains{false, "says that it is degraded when it says nothing"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.mute_at) return p.explains ? Status::degraded : Status::ok;
    Command c;
    c.u_frac = 0.3;
    c.seen_m = in.signal->x_m;
    out.command.publish(c);
    return Status::ok;
  }
};

struct Hungry {  ///< a law with an input that never comes, and no activate
  struct Inputs {
    In<Signal> signal;
    In<Command> never;
  };
  struct Outputs {
    Command command;
  };
  struct Params {};
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    out.command = *in.never;
    return Status::ok;
  }
};

/// Filter and law in one: fills both roles.
struct Both {
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Out<Signal> signal;
    Command command;
    Probe steps_ratio;      ///< since it took over
    Probe taken_over_frac;  ///< what was applied then
    Probe taken_over_m;
  };
  struct Params {
    Param u{0.5, "", -1, 1, "what it commands"};
    Param fails_at{1e9, "s", -1e9, 1e9, "throws from here on"};
    Flag refuse{false, "refuses to take over"};
  };
  Status activate(const Tick&, const Inputs&, const Params& p, const Outputs& last) {
    steps_ = 0;
    taken_frac_ = last.command.u_frac;
    taken_m_ = last.signal.value.x_m;
    return p.refuse ? Status::failed : Status::ok;
  }
  void deactivate() { steps_ = -1e6; }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.fails_at) throw std::runtime_error("both are broken");
    out.signal.publish(*in.signal);
    out.command.u_frac = p.u;
    out.command.seen_m = in.signal->x_m;
    out.command.by = 7;
    out.steps_ratio = ++steps_;
    out.taken_over_frac = taken_frac_;
    out.taken_over_m = taken_m_;
    return Status::ok;
  }

 private:
  double steps_ = 0, taken_frac_ = -9, taken_m_ = -9;
};

#ifdef LAB_RENAMED
struct Statute {
  using Inputs = Law::Inputs;
  struct Outputs {
    Received applied;
  };
  using Params = Law::Params;
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
};
}  // namespace
FULMAR_PLUGIN("2.0.0", Statute)
#else
}  // namespace
FULMAR_PLUGIN("1.0.0", Cart, Law, Filter, Watch, OldReader, Late, Mute, Hungry, Ticker, Thinker, NewLaw, Both)
#endif
