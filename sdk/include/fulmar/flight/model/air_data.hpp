// SPDX-License-Identifier: BSD-3-Clause
// Arguments of aerodynamic forces: the flow past the aircraft and its deflections.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fulmar/flight/model/rigid_body.hpp"

namespace fulmar {

/// Deflections, rad: signs as in `Actuators`, flaps as in `Flaps`.
template <class S>
struct DeflectionsOf {
  S aileron = 0, elevator = 0, rudder = 0, flap = 0;
};
using Deflections = DeflectionsOf<double>;

/// Airspeed, angle of attack and sideslip of an air-relative velocity in body axes. Beard & McLain (2.8).
template <class S>
struct AirDataOf {
  explicit AirDataOf(const Eigen::Vector3<S>& v_r) : Va(plain::norm<S>(v_r)) {
    using std::sqrt, std::atan2, std::asin;
    in_plane = sqrt(v_r.x() * v_r.x() + v_r.z() * v_r.z());
    if (in_plane > 0) {
      cos_alpha = v_r.x() / in_plane;
      sin_alpha = v_r.z() / in_plane;
      alpha = atan2(v_r.z(), v_r.x());
    }
    if (Va > 0) beta = asin(std::clamp(S(v_r.y() / Va), S(-1.0), S(1.0)));
  }
  S Va;
  S in_plane;  ///< speed in the plane of symmetry
  S alpha = 0, beta = 0, cos_alpha = 1, sin_alpha = 0;
};
using AirData = AirDataOf<double>;

}  // namespace fulmar
