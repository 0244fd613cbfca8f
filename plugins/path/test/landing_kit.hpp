// SPDX-License-Identifier: BSD-3-Clause
// A runway and an aircraft on its way there, for the tests of the landing.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>
#include <numbers>

#include "plugins/path/landing.hpp"

namespace landing_kit {

using namespace fulmar;
using path::Landing;

inline constexpr double deg = std::numbers::pi / 180;

/// A runway to the east, 20 m high, whose slope meets it 50 m behind the threshold.
struct Strip {
  Bench<Landing> bench;
  VehicleState s;
  explicit Strip(double length_m = 400) {
    Runway& r = bench.params.runway.value;
    r.north_m = 100;
    r.east_m = -200;
    r.up_m = 20;
    r.heading_rad = 90 * deg;
    r.length_m = length_m;
    FlightLimits& limits = bench.params.airframe.value.limits;
    limits.airspeed_min_mps = 12;
    limits.airspeed_cruise_mps = 17;
    bench.params.runway.is_given = true;
    bench.configure();
    s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
    s.ground_speed_mps = s.airspeed_mps = 14;
    s.course_rad = s.yaw_rad = 90 * deg;
  }
  /// `along_m` before the point where the slope meets the runway, `right_m` of its centre line.
  const LandingProgress& at(double along_m, double right_m, double above_m, double seconds = 0.01) {
    s.position_m = {100 - right_m, -150 - along_m, -(20 + above_m)};
    s.height_m = 20 + above_m;
    bench.set(bench.in.state, s);
    for (double t = 0; t < seconds; t += 0.01) bench.step(0.01);
    return bench.out.progress;
  }
  double slope(double along_m) const { return std::tan(0.07) * along_m; }
  /// On the glide slope, as far out as that.
  void approach() { REQUIRE(at(450, 0, slope(450)).stage == LandingStage::approach); }
};

}  // namespace landing_kit
