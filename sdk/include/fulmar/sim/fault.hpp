// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "fulmar/msg/fault_request.hpp"

namespace fulmar::sim {

/// One fault. Its kind determines which sizes are used.
struct Fault {
  FaultKind kind = FaultKind::none;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of the sensor; scalars in x
  double scale = 1;                                ///< wrong
  double noise = 1;                                ///< noisy
  double time_s = 1;                               ///< slow, jumping, empty
  double share = 1;                                ///< slow surfaces, weak
  double rate = 0;                                 ///< growing, melting; 1/s
  double ramp_s = 0;
  std::int64_t since_ns = 0;
  double growth = 1;  ///< present share of its size, 0 to 1
};

}  // namespace fulmar::sim
