// SPDX-License-Identifier: BSD-3-Clause
// The laboratory's messages, and its vehicle: a cart that counts its ticks. Part of lab.cpp.
#pragma once
#include <unistd.h>

#include <string>
#include <thread>

#include "fulmar/plugin.hpp"

namespace {

using namespace fulmar;

struct Signal {
  double x_m = 0;  ///< tick number
  double tick_s = 0;
};

struct Command {
  double u_frac = 0;
  double seen_m = 0;     ///< x of the signal that the command was computed from
  std::uint32_t by = 0;  ///< number of the component that computed it
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
    Out<Stance> stance;  ///< flags that a mission must name
    Probe distance_m;    ///< only on request
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

}  // namespace
