// SPDX-License-Identifier: BSD-3-Clause
// A touch-down by what it does to the motion: wheels push upward within hundredths of a second, a belly
// brakes, and the sink ends. A gust pushes more slowly, and the aircraft sinks on after it.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/filters.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct TouchParams {
  Param touch_push{1.6, "m/s2", 0.2, 50, "upward acceleration within 0.02 s that a touch-down has at least"};
  Param touch_drag{2, "m/s2", 0.2, 50, "deceleration within 0.3 s that a belly has at least on the ground"};
  Param touch_gusts{4.5, "ratio", 1, 50, "the same, over the standard deviation of it in the last seconds"};
  Param touch_off{10, "m", 0.1, 1000,
                  "height above or below the expected ground that doubles what a touch-down has at least"};
  Param touch_still{0.15, "m/s", 0.02, 2,
                    "climb or sink rate below which the sink has ended; or 0.45 of the sink before"};
  Param touch_confirm{0.1, "s", 0, 2, "that it has ended for, after a push"};
  Param touch_quiet{2, "s", 0.1, 20, "that it has ended for, without a push, at the least airspeed"};
  Param touch_support{0.25, "ratio", 0.01, 1, "of the weight that the wing does not carry, for touch_soft"};
  Param touch_soft{0.8, "s", 0.05, 20, "the same on short final and in the flare, where a sink is commanded"};
};

inline constexpr double steepest_ground = 0.035;  ///< slope of a runway

/// The share of the weight that something else than the wing carries: what the wing lifts at this angle of
/// attack, B&M (4.6), against the normal force, relative to what the two are in flight.
class Support {
 public:
  double step(const VehicleState& s, const Airframe& a, double dt) {
    if (!s.airspeed_valid) return 0;
    const double rho = standard_air(s.origin_altitude_m + s.height_m).density_kgm3;
    const double q = 0.5 * rho * s.airspeed_mps * s.airspeed_mps;
    const double lift_mps2 =
        q * a.wing.area_m2 * (a.aero.lift.zero_ratio + a.aero.lift.alpha_ratio * s.alpha_rad) / a.mass_kg;
    const double normal_mps2 = std::max(-s.specific_force_mps2.z, 0.2 * isa::g0);
    const double share = now_.step(lift_mps2 / normal_mps2, 0.15, dt);
    const double usual = usual_.step(share, 6, dt);
    return usual > 0.2 ? 1 - share / usual : 0;
  }

 private:
  LowPass now_, usual_;
};

/// A part of a signal that is new: its fast mean less its slow one, and how much of that is usual.
class Sudden {
 public:
  double step(double u, double fast_s, double slow_s, double dt) {
    const double fast = fast_.step(u, fast_s, dt);
    const double sudden = fast - slow_.step(fast, slow_s, dt);
    // What a touch-down adds to the usual is small: it is short.
    usual_.step(std::min(sudden * sudden, 9.0), 3.0, dt);
    return sudden;
  }
  double usual() const { return std::sqrt(std::max(usual_.value(), 0.0)); }

 private:
  LowPass fast_, slow_, usual_;
};

/// Evidence of a touch-down of an aircraft in the air, 1: enough. Fed at each tick.
class TouchDown {
 public:
  void reset() { *this = {}; }

  /// What is expected of the aircraft now.
  struct Expected {
    double off_m;  ///< from the height of the ground; a large one where that is not known
    double far_m;  ///< the same, from the farther of runway and place of the take-off
    bool slow;     ///< at the least airspeed or below it
    bool sinks;    ///< a sink is asked for until it touches: short final and flare
  };
  double step(const VehicleState& s, const Airframe& a, const Expected& e, const TouchParams& p, double dt) {
    const Eigen::Vector3d f_b = eigen(s.specific_force_mps2), f_n = eigen(s.attitude) * f_b;
    const double unlikely = 1 + e.off_m / p.touch_off;
    const double up_before = up_.usual(), drag_before = drag_.usual();
    const double push = up_.step(-f_n.z() - isa::g0, 0.005, 0.025, dt) / unlikely;
    const double drag = -drag_.step(f_b.x(), 0.04, 0.3, dt) / unlikely;
    // Of what it takes at least: 1 is a touch-down that may as well be a gust, far more can be none.
    const double hit = std::max(push / std::max<double>(p.touch_push, p.touch_gusts * up_before),
                                drag / std::max<double>(p.touch_drag, p.touch_gusts * drag_before));
    const double sink = sink_.step(-s.climb_rate_mps, 0.8, dt);
    if (hit > 1 && sink > least_sink_mps) {
      if (since_hit_s_ > lasts_s) {
        sink_mps_ = sink;
        hit_ = 0;
      }
      hit_ = std::max(hit_, hit);
      since_hit_s_ = 0;
    } else {
      since_hit_s_ += dt;
    }
    // On a slope the aircraft rolls up or down with a part of the sink that it had.
    const double rate = std::abs(s.climb_rate_mps);
    const double left = hit_ > sure_ratio ? 2 * p.touch_still + 0.4 * sink_mps_
                                          : std::max<double>(p.touch_still, 0.45 * sink_mps_);
    const bool still = since_hit_s_ < lasts_s && rate < left;
    still_s_ = still ? still_s_ + dt : 0;
    const bool carried = support_.step(s, a, dt) > p.touch_support;
    // Level flight at the least airspeed is asked for at times, so that there it takes a sink before. Where a
    // sink is asked for, none is evidence by itself: a glide slope or a flare can end in a kiss.
    const bool begins = e.sinks || (e.slow && sink > least_sink_mps);
    quiet_s_ = rate < quiet_mps && (begins || (e.slow && quiet_s_ > 0)) ? quiet_s_ + dt : 0;
    soft_s_ = quiet_s_ > 0 && e.sinks && (carried || soft_s_ > 0) ? soft_s_ + dt : 0;
    // On a slope the aircraft rolls up or down while the ground carries it.
    const bool rolls = rate < quiet_mps + steepest_ground * s.ground_speed_mps;
    slope_s_ = rolls && e.sinks && carried ? slope_s_ + dt : 0;
    // Away from the expected ground a lull is more likely than a soft touch-down.
    const double soft_s = p.touch_soft * (1 + std::max(e.far_m - usual_off_m, 0.0) / lull_m);
    const double quiet = std::max({quiet_s_ / p.touch_quiet, soft_s_ / soft_s, slope_s_ / rolls_s});
    const double confirm_s = p.touch_confirm;
    return std::min(std::max(still_s_ / std::max(confirm_s, 1e-3), quiet), 1.0);
  }

  /// Mean sink rate before the touch-down, m/s.
  double sink_mps() const { return since_hit_s_ < lasts_s ? sink_mps_ : sink_.value(); }

 private:
  static constexpr double least_sink_mps = 0.1;  ///< of the last second: who climbs touches nothing
  static constexpr double quiet_mps = 0.12, usual_off_m = 2, lull_m = 1.5;
  static constexpr double lasts_s = 0.6;  ///< after it a push says nothing
  Sudden up_, drag_;
  Support support_;
  LowPass sink_;
  static constexpr double sure_ratio = 1.7, rolls_s = 3;
  double hit_ = 0, since_hit_s_ = 1e9, still_s_ = 0, quiet_s_ = 0, soft_s_ = 0, slope_s_ = 0, sink_mps_ = 0;
};

}  // namespace fulmar::safety
