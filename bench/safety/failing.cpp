// SPDX-License-Identifier: BSD-3-Clause
// Lets the simulated aircraft fail at a time, and for good, whatever phase comes of it: a phase's own `set`
// would end with the phase.
#include "fulmar/msg/fault_request.hpp"
#include "fulmar/plugin.hpp"

using namespace fulmar;

struct Failing {
  static constexpr const char* doc = "Requests one fault of the simulated aircraft at a time.";
  struct Inputs {};
  struct Outputs {
    Out<FaultRequest> fault;
  };
  struct Params {
    Choice<FaultTarget> what{FaultTarget::gyro, "that fails"};
    Choice<FaultKind> kind{FaultKind::none, "how; none: it does not"};
    Param at{60, "s", 0, 1e5, "flight time"};
    Param size{0, "", -1e6, 1e6, "of the fault; 0: what the parameters say"};
    Param lasts{0, "s", 0, 1e5, "of the fault; 0: for good"};
  };
  Status step(const Tick& tick, const Inputs&, const Params& p, Outputs& out) {
    if (asked_ || p.kind.value == FaultKind::none || tick.now_s() < p.at) return Status::ok;
    asked_ = true;
    FaultRequest r;
    r.what = p.what.value, r.kind = p.kind.value, r.size_ratio = p.size, r.for_s = p.lasts;
    out.fault.publish(r, tick.now_ns);
    return Status::ok;
  }

 private:
  bool asked_ = false;
};

FULMAR_PLUGIN("1.0.0", Failing)
