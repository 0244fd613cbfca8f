// SPDX-License-Identifier: BSD-3-Clause
// A laboratory for the loop: a cart that counts its ticks (lab_cart.hpp), a law with configurable faults
// (lab_law.hpp), and further components.
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "lab_law.hpp"

namespace {

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
      if (request.value().to_m > 100) continue;  // not answered
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

struct Said {
  Text<16> word;
  Text<64> text;
};

struct Herald {  ///< publishes the verdict of the flight
  struct Inputs {};
  struct Outputs {
    Out<Said> said;
    Out<Tally> other;
  };
  struct Params {
    Param at{0.15, "s", -1e9, 1e9, "speaks from here on"};
    Flag names{true, "gives a word of its own"};
  };
  Status step(const Tick& tick, const Inputs&, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.at) out.said.publish({p.names ? "crashed" : "", "the nose\ntouched"});
    return Status::ok;
  }
};

// The message Command of another SDK version: one more field, in front.
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

// The message Signal of an older SDK: one field less.
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

/// A device: one sample per millisecond of the wall clock, at most `samples`; then it fails, or becomes
/// silent.
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

/// A slow component with a large heap: its outputs belong to the tick in which its step began.
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

struct Late {  ///< passes its input on; usually there is none
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

struct Mute {  ///< a law that may publish nothing
  struct Inputs {
    In<Signal> signal;
  };
  struct Outputs {
    Out<Command> command;
  };
  struct Params {
    Param mute_at{1e9, "s", -1e9, 1e9, "says nothing from here on"};
    Flag explains{false, "says that it is degraded when it says nothing"};
    Param dated_at{1e9, "s", -1e9, 1e9, "dates what it says from here on"};
    Param ahead{0, "s", -1e10, 1e10, "so far ahead of now"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() >= p.mute_at) return p.explains ? Status::degraded : Status::ok;
    Command c;
    c.u_frac = 0.3;
    c.seen_m = in.signal->x_m;
    const double at_s = tick.now_s() + p.ahead;
    if (tick.now_s() < p.dated_at)
      out.command.publish(c);
    else
      out.command.publish(c,
                          at_s > 9e9 ? std::numeric_limits<std::int64_t>::max() : std::llround(1e9 * at_s));
    return Status::ok;
  }
};

struct Hungry {  ///< a law with an input that never comes, without activate
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
    Probe taken_over_frac;  ///< the last applied value at that time
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
FULMAR_PLUGIN("1.0.0", Cart, Law, Filter, Watch, Herald, OldReader, Late, Mute, Hungry, Ticker, Thinker,
              NewLaw, Both)
#endif
