// SPDX-License-Identifier: BSD-3-Clause
// A vehicle like hardware: its pilot arms, takes over and gives back at given times, and it has messages. And
// a law with an integrator.
#include <time.h>

#include <algorithm>
#include <cmath>

#include "fulmar/plugin.hpp"

using namespace fulmar;

namespace {

struct Command {
  double u_frac = 0;
};

struct State {
  bool armed = false;
  bool on_ground = false;
  bool in_control = false;
  double tick_s = 0;
};

struct Received {
  double u_frac = 0;
  bool present = false;
};

enum class Level : std::uint8_t { info, warning, error };

enum class Cause : std::uint8_t { none, alarm };

struct Note {
  Text<40> text;
  Level level = Level::info;
  Cause cause = Cause::none;
};

struct Craft {
  struct Inputs {
    Optional<Command> command;
  };
  struct Outputs {
    Out<State> status;
    Out<Received> applied;  ///< what write received in the tick before
    OutQueue<Note, 4> notices;
    Note remark;  ///< written in every tick
  };
  struct Params {
    Param arm_at{0, "s", -1, 1e9, "the pilot arms"};
    Param disarm_at{1e9, "s", -1, 1e9, "the pilot disarms"};
    Param pilot_from{1e9, "s", -1, 1e9, "the pilot takes over"};
    Param pilot_until{1e9, "s", -1, 1e9, "the pilot gives back"};
    Param note_at{1e9, "s", -1, 1e9, "two notices are sent, and the remark changes"};
    Param jump_at{1e9, "s", -1, 1e9, "the computer stands still here, for ten seconds"};
    Flag real_time{false, "ticks follow the wall clock"};
  };
  Status read(Tick& tick, const Params& p, Outputs& out) {
    tick.now_ns = 2'500'000 * n_++;
    if (tick.now_s() >= p.jump_at) tick.now_ns += 10'000'000'000;
    const double t = tick.now_s();
    if (p.real_time) {
      const timespec pause{0, 2'500'000};
      nanosleep(&pause, nullptr);
    }
    const bool armed = t >= p.arm_at && t < p.disarm_at;
    const bool pilot = t >= p.pilot_from && t < p.pilot_until;
    out.status.publish({armed, !armed, armed && !pilot, t});
    if (n_ > 1) out.applied.publish(applied_);
    if (n_ > 1 && t >= p.note_at && t < p.note_at + 0.0025) {
      out.notices.push({"all is well", Level::info}, tick.now_ns);
      out.notices.push({"bell\a rings", Level::error, Cause::alarm}, tick.now_ns);
    }
    out.remark.text = t >= p.note_at ? "changed" : "";
    return Status::ok;
  }
  Status write(const Tick&, const Inputs& in, const Params&) {
    applied_ = {};
    if (in.command) applied_ = {in.command->u_frac, true};
    return Status::ok;
  }

 private:
  std::int64_t n_ = 0;
  Received applied_;
};

struct Wheels {
  bool down = false;
};

struct Gear {
  Wheels wheels;
  bool motors_live = false;
  bool obeys = false;
};

/// The craft with flags of other names: it arms at once, takes off at 1 s, disarms at 3 s, in the air.
struct Strange {
  struct Inputs {
    Optional<Command> command;
  };
  struct Outputs {
    Out<Received> applied;
    Out<Gear> gear;
    Out<State> state;  ///< without a flag for arming
  };
  struct Params {
    Param speak_at{0, "s", 0, 1e9, "says nothing before"};
    Param lift_at{1, "s", 0, 1e9, "takes off"};
  };
  Status read(Tick& tick, const Params& p, Outputs& out) {
    tick.now_ns = 2'500'000 * n_++;
    const double t = tick.now_s();
    out.state.publish({false, false, false, t});
    if (t < p.speak_at) return Status::ok;
    const bool armed = t < 3;
    out.gear.publish({{t < p.lift_at}, armed, armed});
    return Status::ok;
  }
  Status write(const Tick&, const Inputs&, const Params&) { return Status::ok; }

 private:
  std::int64_t n_ = 0;
};

/// A vehicle that rejects a write without a command.
struct Demanding {
  struct Inputs {
    In<Command> command;
  };
  struct Outputs {
    Out<State> status;
    Received applied;  ///< what write received in the tick before
  };
  struct Params {};
  Status read(Tick& tick, const Params&, Outputs& out) {
    tick.now_ns = 2'500'000 * n_++;
    out.status.publish({true, false, true, tick.now_s()});
    out.applied = applied_;
    return Status::ok;
  }
  Status write(const Tick&, const Inputs& in, const Params&) {
    applied_ = {in.command->u_frac, true};
    return Status::ok;
  }

 private:
  std::int64_t n_ = 0;
  Received applied_;
};

/// Integrates 1 per second from its start value at activation: 0.
struct Hoarder {
  struct Inputs {
    In<State> state;
  };
  struct Outputs {
    Command command;
    Probe hoard_ratio;
    Probe activations_ratio;
  };
  struct Params {
    Param refuse_from{1e9, "s", -1, 1e9, "refuses to be activated"};
    Param refuse_until{1e9, "s", -1, 1e9, "until then"};
    Param fail_at{1e9, "s", -1, 1e9, "fails"};
    Param hang_at{1e9, "s", -1, 1e9, "never returns"};
    Param heirloom{0, "", 0, 1, "what it commands at least"};
  };
  Status activate(const Tick&, const Inputs& in, const Params& p, const Outputs&) {
    if (in.state->tick_s >= p.refuse_from && in.state->tick_s < p.refuse_until) return Status::failed;
    hoard_ = 0;
    ++activations_;
    return Status::ok;
  }
  Status step(const Tick& tick, const Inputs&, const Params& p, Outputs& out) {
    while (tick.now_s() >= p.hang_at) asm volatile("");
    hoard_ += tick.dt_s();
    out.command.u_frac = std::clamp(hoard_, p.heirloom.value, 1.0);
    out.hoard_ratio = hoard_;
    out.activations_ratio = activations_;
    return tick.now_s() < p.fail_at ? Status::ok : Status::failed;
  }

 private:
  double hoard_ = 0, activations_ = 0;
};

/// Repeats the vehicle's output, and pauses once.
struct Echo {
  struct Inputs {
    In<State> state;
  };
  struct Outputs {
    Out<State> echo;
  };
  struct Params {
    Param mute_from{1e9, "s", -1, 1e9, "says nothing from here on"};
    Param mute_until{1e9, "s", -1, 1e9, "and speaks again"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    if (tick.now_s() < p.mute_from || tick.now_s() >= p.mute_until) out.echo.publish(*in.state);
    return Status::ok;
  }
};

}  // namespace

FULMAR_PLUGIN("1.0.0", Craft, Echo, Hoarder, Strange, Demanding)
