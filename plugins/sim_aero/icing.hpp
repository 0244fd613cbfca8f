// SPDX-License-Identifier: BSD-3-Clause
// Ice on wing and tail, by the linear model of the University of Illinois: with ice of the severity eta a
// coefficient C is (1 + eta k_C) C (Bragg, Hutchison, Merret, Oltman & Pokhariyal, "Effect of Ice Accretion
// on Aircraft Flight Dynamics", AIAA 2000-0360). README.md explains the defaults of the parameters.
#pragma once
#include <algorithm>

#include "fault_params.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::sim {

/// The aircraft with a share `ice` of the full ice.
inline Airframe iced(const Airframe& clean, double ice, const BodyFaultParams& p) {
  const auto factor = [&](double of_all) { return 1 + ice * (of_all - 1); };
  const double lift = factor(p.icing_lift), control = factor(p.icing_control);
  Airframe a = clean;
  a.wing.stall_alpha_rad *= factor(p.icing_stall);
  a.aero.parasite_drag_ratio *= factor(p.icing_drag);
  a.aero.lift.alpha_ratio *= lift;
  for (Derivatives* c : {&a.aero.lift, &a.aero.side, &a.aero.roll, &a.aero.pitch, &a.aero.yaw}) {
    c->aileron_ratio *= control;
    c->elevator_ratio *= control;
    c->rudder_ratio *= control;
    c->flap_ratio *= control;
  }
  return a;
}

class Icing {
 public:
  /// Returns true when the amount of ice has changed.
  bool advance(double rate, double dt) {
    if (rate == 0) return false;
    const double before = ice_;
    ice_ = std::clamp(ice_ + rate * dt, 0.0, 1.0);
    return ice_ != before;
  }
  double ice() const { return ice_; }

 private:
  double ice_ = 0;
};

}  // namespace fulmar::sim
