// SPDX-License-Identifier: BSD-3-Clause
// Lets the simulated aircraft fail at a time, and once more later, for good, whatever phase comes of it: a
// phase's own `set` would end with the phase. Status and state come through it to those who are to see them
// fail.
#include "fulmar/msg/fault_request.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/plugin.hpp"

using namespace fulmar;

struct Failing {
  static constexpr const char* doc =
      "Requests a fault of the simulated aircraft at a time, and another one later.";
  struct Inputs {
    Optional<VehicleStatus> status;
    Optional<VehicleState> state;
  };
  struct Outputs {
    Out<FaultRequest> fault;
    Out<VehicleStatus> status;  // unchanged, while the link works
    Out<VehicleState> state;    // unchanged, except for its validity flags
  };
  struct Params {
    Choice<FaultTarget> what{FaultTarget::gyro, "that fails"};
    Choice<FaultKind> kind{FaultKind::none, "how; none: it does not"};
    Param at{60, "s", 0, 1e5, "flight time"};
    Param size{0, "", -1e6, 1e6, "of the fault; 0: what the parameters say"};
    Param lasts{0, "s", 0, 1e5, "of the fault; 0: for good"};
    Choice<FaultTarget> then_what{FaultTarget::gyro, "that fails as well"};
    Choice<FaultKind> then_kind{FaultKind::none, "how; none: it does not"};
    Param then_at{60, "s", 0, 1e5, "flight time; with `below`, since the first"};
    Param below{0, "m", 0, 1000, "the first comes below this height, after 40 m; 0: at its time"};
    Param silent_at{1e5, "s", 0, 1e5, "flight time: from then on there is no status"};
    Param silent_for{1e5, "s", 0, 1e5, "of that"};
    Param invalid_at{1e5, "s", 0, 1e5, "flight time: from then on no attitude is valid"};
    Param invalid_for{1e5, "s", 0, 1e5, "of that"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const auto within = [&](double at_s, double for_s) {
      return tick.now_s() >= at_s && tick.now_s() < at_s + for_s;
    };
    if (in.status && !within(p.silent_at, p.silent_for)) out.status.publish(*in.status, tick.now_ns);
    if (in.state) {
      VehicleState s = *in.state;
      s.attitude_valid = s.attitude_valid && !within(p.invalid_at, p.invalid_for);
      out.state.publish(s, tick.now_ns);
    }
    if (in.state) high_ = high_ || in.state->height_m > 40;
    if (first_s_ > 1e4 && in.state && high_ && in.state->height_m < p.below) first_s_ = tick.now_s();
    const double first_s = p.below > 0 ? first_s_ : p.at.value,
                 then_s = p.then_at + (p.below > 0 ? first_s_ : 0);
    FaultRequest r;
    const auto due = [&](bool& asked, FaultKind kind, double at_s) {
      if (asked || kind == FaultKind::none || tick.now_s() < at_s) return false;
      return asked = true;
    };
    if (due(asked_, p.kind.value, first_s)) {
      r.what = p.what.value;
      r.kind = p.kind.value;
      r.size_ratio = p.size;
      r.for_s = p.lasts;
    } else if (due(then_asked_, p.then_kind.value, then_s)) {
      r.what = p.then_what.value;
      r.kind = p.then_kind.value;
    } else
      return Status::ok;
    out.fault.publish(r, tick.now_ns);
    return Status::ok;
  }

 private:
  bool asked_ = false, then_asked_ = false, high_ = false;
  double first_s_ = 1e5;
};

FULMAR_PLUGIN("1.0.0", Failing)
