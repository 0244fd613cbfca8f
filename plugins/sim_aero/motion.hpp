// SPDX-License-Identifier: BSD-3-Clause
// The true deflections and the angular acceleration, for identification: in single precision, which halves
// them in a log.
#pragma once
#include "fulmar/eigen.hpp"
#include "fulmar/flight/math/single.hpp"
#include "fulmar/msg/motion_truth.hpp"
#include "fulmar/sim/plant.hpp"

namespace fulmar::sim {

inline MotionTruth motion_truth(const Plant& plant) {
  const Deflections d = plant.deflections();
  MotionTruth m;
  m.aileron_rad = to_single(d.aileron);
  m.elevator_rad = to_single(d.elevator);
  m.rudder_rad = to_single(d.rudder);
  m.flap_rad = to_single(d.flap);
  m.propeller_radps = to_single(plant.propeller_radps(0));
  const Eigen::Vector3d a = plant.angular_acceleration();
  m.angular_acceleration_radps2 = {to_single(a.x()), to_single(a.y()), to_single(a.z())};
  return m;
}

}  // namespace fulmar::sim
