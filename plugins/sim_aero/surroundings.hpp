// SPDX-License-Identifier: BSD-3-Clause
// Environment in addition to the steady wind: turbulence by height, gusts, thermals, the slope of the ground.
// README.md has the equations.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/thermals.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/sim/gust.hpp"
#include "fulmar/sim/weather.hpp"

namespace fulmar::sim {

struct AirParams {
  Choice<TurbulenceHeight> turbulence_height{
      TurbulenceHeight::fixed,
      "height of the turbulence model; fixed: 50 m; actual: height of the aircraft, MIL-F-8785C", setup};
  Param turbulence_wind{
      0, "m/s", 0, 50, "wind at 20 ft of actual turbulence below 1000 ft; 0: by its strength", setup};
  Record<Thermals> thermals{"columns of rising air"};
  Vector<Body> gust{{0, 0, 0}, "m/s", -50, 50, "peak air velocity of the discrete gust, 1 - cos"};
  Param gust_length{30, "m", 0.1, 1000, "distance through the air from the edge of the gust to its peak"};
  Choice<GustShape> gust_shape{GustShape::pulse, "shape of the gust; pulse: rise and fall; rise: rise alone"};
  Param gust_at{-1, "s", -1, 1e6, "flight time at the start of the gust; below 0: never"};
  Param gust_every{0, "s", 0, 1e5, "period of the gust; 0: once"};
  Flag gust_now{false, "trigger of a gust, by a change to true"};
};

struct GroundParams {
  Param ground_slope{0, "rad", 0, 0.8, "slope of the ground, a plane through the origin", setup};
  Param ground_slope_towards{
      0, "rad", -6.2832, 6.2832, "direction in which the ground rises: from north, clockwise", setup};
  Param ground_friction{1, "", 0, 5, "factor on the friction of gear and ground; wet ground below 1", setup};
  Flag ground_effect{false, "ground effect: less induced drag close to the ground", setup};
};

struct Surroundings {
  AirParams air;
  GroundParams ground;
};

/// Start times of gusts.
class GustClock {
 public:
  void set(const AirParams& p, std::int64_t now_ns) {
    if (p.gust_at != at_s_ || p.gust_every != every_s_) {
      at_s_ = p.gust_at;
      every_s_ = p.gust_every;
      next_ns_ = at_s_ < 0 ? never : std::llround(1e9 * at_s_);
      if (next_ns_ < now_ns) next_ns_ = following(now_ns);
    }
    asked_ = asked_ || (p.gust_now && !now_);
    now_ = p.gust_now;
  }

  /// True when a gust begins at `now_ns`. A gust that is requested before the flight begins with it.
  bool due(std::int64_t now_ns) {
    if (now_ns < next_ns_ && !asked_) return false;
    if (now_ns < 0) return false;
    asked_ = false;
    if (now_ns >= next_ns_) next_ns_ = following(now_ns + 1);
    return true;
  }

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  /// Time of the first gust at `now_ns` or later; a single gust does not repeat.
  std::int64_t following(std::int64_t now_ns) const {
    if (every_s_ <= 0) return never;
    const double n = std::ceil((1e-9 * static_cast<double>(now_ns) - at_s_) / every_s_);
    return std::llround(1e9 * (at_s_ + n * every_s_));
  }

  double at_s_ = -1, every_s_ = 0;
  std::int64_t next_ns_ = never;
  bool asked_ = false, now_ = false;
};

inline GustSpec gust_spec(const AirParams& p) { return {eigen(p.gust.value), p.gust_length, p.gust_shape}; }

}  // namespace fulmar::sim
