// SPDX-License-Identifier: BSD-3-Clause
// A touch-down by what it does to the motion: wheels push upward within hundredths of a second, and the sink
// ends. A gust pushes more slowly, and the aircraft goes on to rise or to sink after it.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/filters.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct TouchParams {
  Param touch_push{2.5, "m/s2", 0.2, 50, "upward acceleration within 0.1 s that a touch-down has at least"};
  Param touch_gusts{5, "ratio", 1, 50, "the same, over the standard deviation of it in the last seconds"};
  Param touch_still{0.3, "m/s", 0.02, 2, "climb or sink rate below which the sink has ended"};
  Param touch_confirm{0.1, "s", 0, 2, "that it has ended for, after a push"};
  Param touch_quiet{1.2, "s", 0.1, 20, "that it has ended for, without a push"};
};

/// Evidence of a touch-down of an aircraft in the air, 1: enough. Fed at each tick.
class TouchDown {
 public:
  void reset() { *this = {}; }

  double step(const VehicleState& s, const TouchParams& p, double dt) {
    const Eigen::Vector3d f_n = eigen(s.attitude) * eigen(s.specific_force_mps2);
    const double up = fast_.step(-f_n.z() - isa::g0, 0.015, dt);
    const double push = up - slow_.step(up, 0.12, dt);
    const double usual = std::sqrt(std::max(usual_.value(), 0.0));
    const bool pushed = push > std::max<double>(p.touch_push, p.touch_gusts * usual);
    // What a push itself adds to the usual is small: it is short.
    usual_.step(std::min(push * push, 4.0), 3.0, dt);
    const double sink = sink_.step(-s.climb_rate_mps, 0.8, dt);
    if (pushed && sink > least_sink_mps) {
      since_push_s_ = 0;
      sink_mps_ = std::max(sink_mps_, sink);
    } else {
      since_push_s_ += dt;
    }
    const bool still = std::abs(s.climb_rate_mps) < p.touch_still;
    still_s_ = still ? still_s_ + dt : 0;
    if (!still || std::abs(s.climb_rate_mps) > quiet_mps)
      quiet_s_ = 0;
    else if (quiet_s_ > 0 || sink > least_sink_mps)
      quiet_s_ += dt;
    const double by_push = since_push_s_ < lasts_s ? still_s_ / std::max<double>(p.touch_confirm, 1e-3) : 0;
    return std::min(std::max(by_push, quiet_s_ / p.touch_quiet), 1.0);
  }

  /// Mean sink rate before the touch-down, m/s.
  double sink_mps() const { return since_push_s_ < lasts_s ? sink_mps_ : sink_.value(); }

 private:
  static constexpr double least_sink_mps = 0.1;  ///< of the last second: who climbs touches nothing
  static constexpr double quiet_mps = 0.12;
  static constexpr double lasts_s = 0.6;  ///< after it a push says nothing
  LowPass fast_, slow_, usual_, sink_;
  double since_push_s_ = 1e9, still_s_ = 0, quiet_s_ = 0, sink_mps_ = 0;
};

}  // namespace fulmar::safety
