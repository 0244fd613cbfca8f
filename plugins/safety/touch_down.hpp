// SPDX-License-Identifier: BSD-3-Clause
// Detects a touch-down by one likelihood ratio that grows with time (CUSUM, Page 1954): each tick adds the
// ratio of the likelihoods of its measurements on the ground and in the air. The densities in the air are
// estimated in flight.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct TouchParams {
  Param touch_odds{1e5, "ratio", 10, 1e12, "likelihood ratio of ground to air that counts as a touch-down"};
  Param touch_off{4, "m", 0.1, 1000, "standard deviation of the estimated height above the ground"};
  Param touch_still{0.1, "m/s", 0.02, 2, "standard deviation of the climb rate on a level runway"};
};

inline constexpr double steepest_ground = 0.035;  ///< slope of a runway

/// New part of a signal over its standard deviation in the last seconds: its fast mean minus its slow one.
class Sudden {
 public:
  Sudden(double fast_s, double slow_s, double least) : fast_s_(fast_s), slow_s_(slow_s), least_(least) {}
  double step(double u, double dt) {
    const double fast = fast_.step(u, fast_s_, dt);
    const double sudden = fast - slow_.step(fast, slow_s_, dt);
    const double before = usual();
    // A touch-down is short, so it adds little to the usual level.
    usual_.step(std::min(sudden * sudden, 9.0), 3.0, dt);
    return sudden / before;
  }
  double usual() const { return std::max(std::sqrt(std::max(usual_.value(), 0.0)), least_); }

 private:
  // least: lower bound of the standard deviation, in the unit of the signal, for calm air
  double fast_s_, slow_s_, least_;
  LowPass fast_, slow_, usual_;
};

/// Evidence of a touch-down of an aircraft in the air, 1: enough. Updated at each tick.
///
/// | feature                | density in the air           | density on the ground         | new each |
/// |------------------------|------------------------------|-------------------------------|----------|
/// | sudden push up, back   | normal, as in the last 3 s;  | the same; 1 of 50 is 4 times  | 0.01 s   |
/// | or to a side           | 1 of 1e5 is 4 times wider    | wider: wheels or a belly hit  |          |
/// | climb rate             | normal: sink of the last 3 s | half a level runway, half a   | 0.4 s    |
/// |                        | as wide as gusts make it     | slope                         |          |
/// | height over the ground | any                          | normal, `touch_off`           | once     |
///
/// The logarithms of the ratios are added. A negative sum is reset to 0: earlier flight is no evidence
/// against a touch-down now.
class TouchDown {
 public:
  void reset() { *this = {}; }

  /// Expected state of the aircraft.
  struct Expected {
    double off_m;  ///< height above the ground; a large one where the ground is unknown
    bool slow;     ///< at the least airspeed or below it
    bool sinks;    ///< a sink is commanded until the touch-down: short final and flare
    bool closed;   ///< the throttle has been closed for a second: the motor brakes no more
  };
  double step(const VehicleState& s, const Expected& e, const TouchParams& p, double dt) {
    const double sink = sink_.step(-s.climb_rate_mps, 0.8, dt);
    const double pushed = pushes(s, e, dt), ended = sink_ends(s, e, p, dt);
    // With a temporary command of level flight the end of a sink is no evidence.
    const bool sinks = e.sinks || (e.slow && usual_sink_.value() > min_sink_mps);
    // An aircraft that climbs does not touch the ground.
    log_ratio_ += (sink > min_sink_mps ? pushed : std::min(pushed, 0.0)) * dt / new_push_s;
    log_ratio_ += (sinks ? ended : std::min(ended, 0.0)) * dt / new_rate_s;
    if (log_ratio_ <= 0) {
      log_ratio_ = 0;
      sink_mps_ = sink;
    }
    const double off = e.off_m / p.touch_off;
    return std::min(log_ratio_ / (std::log(p.touch_odds) + std::min(0.5 * off * off, unknown_ground)), 1.0);
  }

  /// Mean sink rate before the touch-down, m/s, at the begin of the evidence.
  double sink_mps() const { return sink_mps_; }

 private:
  /// Logarithm of the ratio of the two densities of the three pushes, ground to air.
  double pushes(const VehicleState& s, const Expected& e, double dt) {
    const Eigen::Vector3d f_b = eigen(s.specific_force_mps2), f_n = eigen(s.attitude) * f_b;
    gust_.step(-f_n.z(), dt);
    const double up = std::max(up_.step(-f_n.z(), dt), 0.0);
    const double kick = back_.step(-f_b.x(), dt), brake = brake_.step(-f_b.x(), dt);
    const double back = std::max({kick, e.closed ? brake : 0, 0.0});
    const double side = side_.step(f_b.y(), dt);
    const double square = std::min(up * up + back * back + side * side, 200.0);
    // Ratio of the wide normal density to the narrow one.
    const double ratio = std::exp(0.5 * square * (1 - 1 / (wider * wider))) / (wider * wider * wider);
    return std::log((1 - hit_share + hit_share * ratio) / (1 - gust_share + gust_share * ratio));
  }

  /// Logarithm of the same ratio for the climb rate.
  double sink_ends(const VehicleState& s, const Expected& e, const TouchParams& p, double dt) {
    const double rate = s.climb_rate_mps, sloped = p.touch_still + steepest_ground * s.ground_speed_mps;
    const double ground = 0.5 * normal(rate, p.touch_still) + 0.5 * normal(rate, sloped);
    const double usual = usual_sink_.step(-rate, 3, dt);
    const double air = normal(rate + std::max(usual, e.sinks ? asked_mps : 0), gust_s * gust_.usual());
    return std::clamp(std::log(ground / std::max(air, 1e-9)), -max_rate, max_rate);
  }
  static double normal(double x, double deviation) {
    const double z = x / deviation;
    return std::exp(-0.5 * z * z) / (std::sqrt(2 * std::numbers::pi) * deviation);
  }

  static constexpr double wider = 4, hit_share = 0.02, gust_share = 1e-5, new_push_s = 0.01;
  static constexpr double asked_mps = 0.4;     ///< least commanded sink of a flare
  static constexpr double min_sink_mps = 0.1;  ///< mean of the last second or seconds
  static constexpr double gust_s = 0.8;        ///< duration of the acceleration by a gust
  static constexpr double max_rate = 3, new_rate_s = 0.4;
  // logarithm of the ratio: unknown ground makes a touch-down less likely
  static constexpr double unknown_ground = 20;
  Sudden up_{0.005, 0.025, 0.36}, back_{0.005, 0.025, 0.2}, brake_{0.02, 0.1, 0.2}, side_{0.01, 0.06, 0.1},
      gust_{0.1, 0.5, 0.2};
  LowPass sink_, usual_sink_;
  double log_ratio_ = 0, sink_mps_ = 0;
};

}  // namespace fulmar::safety
