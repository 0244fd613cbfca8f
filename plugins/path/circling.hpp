// SPDX-License-Identifier: BSD-3-Clause
// The orbit at the end of the plan, around a single waypoint, or with an empty plan.
#pragma once
#include <cmath>
#include <numbers>

#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::path {

/// The circle, arrival on it, and the angle flown around it.
class Circling {
 public:
  void begin(const RouteOrbit& orbit) {
    orbit_ = orbit;
    swept_rad_ = 0;
    on_orbit_ = false;
  }
  /// Called at the end of a leg that touches the circle.
  void enter(const VehicleState& state) {
    on_orbit_ = true;
    azimuth_rad_ = azimuth(state);
  }
  /// The circle moves or changes its size; the angle flown on it counts.
  void change(const RouteOrbit& orbit) { orbit_ = orbit; }
  void resize(double radius_m) { orbit_.radius_m = radius_m; }

  const RouteOrbit& orbit() const { return orbit_; }
  /// True at the first time that the aircraft is near enough to be on the circle.
  bool arrives(const VehicleState& state) {
    if (on_orbit_ || !(miss_m(state) < 0.1 * orbit_.radius_m)) return false;
    on_orbit_ = true;
    return true;
  }
  double miss_m(const VehicleState& state) const {
    const double n = state.position_m.north - orbit_.north_m, e = state.position_m.east - orbit_.east_m;
    return std::abs(std::hypot(n, e) - orbit_.radius_m);
  }
  /// On the circle: adds the angle since the last step.
  void advance(const VehicleState& state) {
    const double azimuth_now = azimuth(state);
    if (on_orbit_) swept_rad_ += sign_of(orbit_.turn) * wrap_pi(azimuth_now - azimuth_rad_);
    azimuth_rad_ = azimuth_now;
  }
  /// True for a complete circle, which is then subtracted.
  bool complete() {
    if (!(swept_rad_ > 2 * std::numbers::pi)) return false;
    swept_rad_ -= 2 * std::numbers::pi;
    return true;
  }
  void put_into(Path& path) const {
    path.turn = orbit_.turn;
    path.origin_m = {orbit_.north_m, orbit_.east_m, -orbit_.height_m};
    path.radius_m = orbit_.radius_m;
    path.next_curvature_ratio = sign_of(orbit_.turn) / orbit_.radius_m;
  }

 private:
  double azimuth(const VehicleState& state) const {
    return std::atan2(state.position_m.east - orbit_.east_m, state.position_m.north - orbit_.north_m);
  }

  RouteOrbit orbit_;
  double swept_rad_ = 0, azimuth_rad_ = 0;
  bool on_orbit_ = false;
};

}  // namespace fulmar::path
