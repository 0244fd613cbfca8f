// SPDX-License-Identifier: BSD-3-Clause
// The shipped outer law until a time in flight, then a fault: for tests of the loss of a controller.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

#include "plugins/control_slc/outer.hpp"

using namespace fulmar;

namespace {

enum class Fault : std::uint8_t { none, nan, throws, segfault, abort, hang, leak, overrun };

void busy(std::chrono::milliseconds time) {
  for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
  }
}

struct BadOuter {
  using Inputs = slc::Outer::Inputs;
  using Outputs = slc::Outer::Outputs;
  struct Params {
    Record<Airframe> airframe{"the aircraft"};
    Choice<Fault> fault{Fault::none, "what goes wrong"};
    Param at{1e9, "s", 0, 1e9, "when"};
  };

  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    gains_.common.airframe.value = *p.airframe;
    gains_.common.airframe.is_given = true;
    return law_.activate(tick, in, gains_, last);
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const Status status = law_.step(tick, in, gains_, out);
    if (tick.now_s() < p.at) return status;
    switch (p.fault) {
      case Fault::nan: out.attitude.roll_rad = std::numeric_limits<double>::quiet_NaN(); break;
      case Fault::throws: throw std::runtime_error("lost");
      case Fault::segfault: raise(SIGSEGV); break;
      case Fault::abort: std::abort();
      case Fault::hang:
        for (;;) asm volatile("");
      case Fault::leak: kept_.emplace_back(10'000'000, 'x'); break;
      case Fault::overrun: busy(std::chrono::milliseconds(3)); break;
      case Fault::none: break;
    }
    return status;
  }

 private:
  slc::Outer law_;
  slc::Outer::Params gains_;
  std::vector<std::vector<char>> kept_;
};

}  // namespace

FULMAR_PLUGIN("1.0.0", BadOuter)
