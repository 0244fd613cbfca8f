// SPDX-License-Identifier: BSD-3-Clause
// The local frame of the truth, in which all errors are taken.
#pragma once
#include <cmath>
#include <limits>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::score {

class TruthFrame {
 public:
  void note(const VehicleState& truth) {
    if (!truth.origin_valid || same_origin(truth)) return;
    lat_deg_ = truth.origin_latitude_deg;
    lon_deg_ = truth.origin_longitude_deg;
    alt_m_ = truth.origin_altitude_m;
    frame_ = LocalFrame(lat_deg_, lon_deg_, alt_m_);
  }
  bool known() const { return std::isfinite(lat_deg_); }
  bool same_origin(const VehicleState& s) const {
    return s.origin_latitude_deg == lat_deg_ && s.origin_longitude_deg == lon_deg_ &&
           s.origin_altitude_m == alt_m_;
  }
  Vec3<Ned> at(double lat_deg, double lon_deg, double alt_m) const {
    return from_eigen<Ned>(frame_.to_ned(lat_deg, lon_deg, alt_m));
  }

 private:
  LocalFrame frame_;
  double lat_deg_ = std::numeric_limits<double>::infinity(), lon_deg_ = 0, alt_m_ = 0;
};

}  // namespace fulmar::score
