// SPDX-License-Identifier: BSD-3-Clause
// The true deflections and the angular acceleration, for identification.
#pragma once
#include "fulmar/eigen.hpp"
#include "fulmar/msg/motion_truth.hpp"
#include "fulmar/sim/plant.hpp"

namespace fulmar::sim {

inline MotionTruth motion_truth(const Plant& plant) {
  const Deflections d = plant.deflections();
  MotionTruth m;
  m.aileron_rad = d.aileron;
  m.elevator_rad = d.elevator;
  m.rudder_rad = d.rudder;
  m.flap_rad = d.flap;
  m.propeller_radps = plant.propeller_radps(0);
  m.angular_acceleration_radps2 = from_eigen<Body>(plant.angular_acceleration());
  return m;
}

}  // namespace fulmar::sim
