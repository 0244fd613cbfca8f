// SPDX-License-Identifier: BSD-3-Clause
// A transmitter that moves its sticks and switches by the time of flight: what flight_test flies.
#include <fulmar/msg/rc.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct ScriptedPilot {
  static constexpr const char* doc = "Sticks and switches by the time of flight.";
  struct Inputs {};
  struct Outputs {
    Rc rc;
  };
  struct Params {
    Param begin{60, "s", 0, 1000, "of the first thing that he does"};
    Param lost{1000, "s", 0, 1000, "of his radio, for 1.5 s"};
  };
  Status step(const Tick& tick, const Inputs&, const Params& p, Outputs& out) {
    // Every ten seconds another level, in its first half a stick to the right and a little back.
    constexpr double down = -1, middle = 0, up = 1;
    constexpr double switches[][3] = {{down, middle, down}, {down, up, down}, {down, up, middle},
                                      {down, up, up},       {up, up, up},     {down, down, down}};
    const double t = tick.now_s() - p.begin;
    Rc rc{.throttle_frac = 0.57, .aux1_frac = down, .aux2_frac = down, .aux3_frac = down, .aux4_frac = down};
    rc.link = true;
    if (t >= 0 && t < 60) {
      const auto& now = switches[static_cast<int>(t / 10)];
      rc.aux1_frac = now[0];
      rc.aux2_frac = now[1];
      rc.aux3_frac = now[2];
      const double within = t - 10 * static_cast<int>(t / 10);
      if (within >= 2 && within < 4) {
        rc.roll_frac = 0.4;
        rc.pitch_frac = 0.15;
      }
    }
    if (tick.now_s() >= p.lost && tick.now_s() < p.lost + 1.5) rc = {};
    out.rc = rc;
    return Status::ok;
  }
};

FULMAR_PLUGIN("1.0.0", ScriptedPilot)
