// SPDX-License-Identifier: BSD-3-Clause
// A laboratory for the loop: a cart that counts its ticks, and a law that misbehaves on demand.
#include <csignal>
#include <limits>
#include <stdexcept>
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

struct Applied {
  double u_frac = 0, seen_m = 0;
  std::uint32_t by = 0;
  bool present = false, fresh = false;
};

struct Arm {
  bool armed = false;
};

struct Step {
  double to_m = 0;
};

struct Cart {
  struct Inputs {
    Optional<Command> command;
    Request<Arm> arm;
  };
  struct Outputs {
    Out<Signal> signal;
    Out<Applied> applied;  ///< what write received in the tick before
    OutQueue<Signal, 4> burst;
    Out<Arm> status;
  };
  struct Params {
    Param rate{400, "Hz", 1, 10000, "tick rate", setup};
    Param fail_at{1e9, "s", -1e9, 1e9, "read fails from here on"};
    Count burst_size{3, 0, 100, "samples per tick"};
    Param mute_at{1e9, "s", -1e9, 1e9, "the signal falls silent here"};
  };
  Status read(Tick& tick, const Params& p, Outputs& out) {
    tick.now_ns = n_ * static_cast<std::int64_t>(1e9 / p.rate) - 1'000'000'000;
    if (tick.now_s() >= p.fail_at) return Status::failed;
    Signal s{static_cast<double>(n_), tick.now_s()};
    if (tick.now_s() < p.mute_at) out.signal.publish(s);
    if (n_ > 0) out.applied.publish(applied_);
    for (int i = 0; i < p.burst_size; ++i) out.burst.push({s.x_m + 0.1 * i, 0}, tick.now_ns + i);
    out.status.publish({armed_ && tick.now_ns >= 0});
    ++n_;
    return Status::ok;
  }
  Status write(const Tick&, const Inputs& in, const Params&) {
    for (auto request : in.arm) {
      armed_ = request.value().armed;
      request.accept();
    }
    applied_ = {};
    if (in.command) applied_ = {in.command->u_frac, in.command->seen_m, in.command->by, true, in.command.fresh()};
    return Status::ok;
  }

 private:
  std::int64_t n_ = 0;
  bool armed_ = false;
  Applied applied_;
};

enum class Fault : std::uint8_t { none, nan, range, throws, fails, slow, probe_nan, allocates, crashes, hangs };

struct Law {
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Command command;
    Probe error_m;
    Probe taken_over_frac;
  };
  struct Params {
    Param u{0.5, "", -1, 1, "what it commands"};
    Count id{1, 0, 100, "who it is"};
    Choice<Fault> fault{Fault::none, "what it does wrong"};
    Param fault_at{1e9, "s", -1e9, 1e9, "from when on"};
    Flag refuse{false, "refuses to take over"};
    Param fixed{1, "", 0, 2, "set-up parameter", setup};
  };
  Status activate(const Tick&, const Inputs&, const Params& p, const Outputs& last) {
    taken_ = last.command.u_frac;
    return p.refuse ? Status::failed : Status::ok;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const bool bad = tick.now_s() >= p.fault_at;
    out.command = {p.u, in.signal->x_m, static_cast<std::uint32_t>(p.id)};
    out.error_m = in.signal->x_m;
    out.taken_over_frac = taken_;
    if (!bad) return Status::ok;
    switch (p.fault) {
      case Fault::nan:
        out.command.u_frac = std::numeric_limits<double>::quiet_NaN();
        break;
      case Fault::range:
        out.command.u_frac = 1.5;
        break;
      case Fault::throws:
        throw std::runtime_error("the law is broken");
      case Fault::fails:
        return Status::failed;
      case Fault::probe_nan:
        out.error_m = std::numeric_limits<double>::infinity();
        break;
      case Fault::slow:
        for (int i = 0; i < 300'000; ++i) asm volatile("");
        break;
      case Fault::allocates: {
        std::vector<double> v(32);
        asm volatile("" ::"r"(v.data()) : "memory");
        break;
      }
      case Fault::crashes:
        raise(SIGSEGV);
        break;
      case Fault::hangs:
        for (;;) asm volatile("");
      default:
        break;
    }
    return Status::ok;
  }

 private:
  double taken_ = -9;
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
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.stop_at) throw std::runtime_error("the filter is broken");
    out.signal.publish(*in.signal);
    return Status::ok;
  }
};

struct Tally {
  double steps_ratio = 0, dt_s = 0, samples_ratio = 0, lost_ratio = 0, sum_m = 0, applied_seen_m = 0;
};

struct Watch {  ///< fills no role
  struct Inputs {
    Queue<Signal> burst;
    Optional<Applied> applied;
    Request<Step> ask;
  };
  struct Outputs {
    Tally tally;
  };
  struct Params {
    Param noise{0, "", 0, 1, "adds chance to the tally"};
  };
  explicit Watch(std::uint64_t seed) : seed_(seed) {}
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    tally_.steps_ratio += 1;
    tally_.dt_s = tick.dt_s();
    tally_.lost_ratio += in.burst.lost();
    for (const auto& sample : in.burst) {
      tally_.samples_ratio += 1;
      tally_.sum_m += sample.value.x_m;
    }
    if (in.applied) tally_.applied_seen_m = in.applied->seen_m;
    for (auto request : in.ask) {
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

struct Late {  ///< never has its input
  struct Inputs {
    In<Command> never;
  };
  struct Outputs {
    Out<Command> echo;
    Tally tally;
  };
  struct Params {};
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    out.tally.steps_ratio += 1;
    out.echo.publish(*in.never);
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

}  // namespace

FULMAR_PLUGIN("1.0.0", Cart, Law, Filter, Watch, OldReader, Late, Hungry)
