// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "fulmar/msg/fault_request.hpp"

namespace fulmar::sim {

/// One fault. Which of its sizes count depends on its kind.
struct Fault {
  FaultKind kind = FaultKind::none;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of the sensor; scalars are in x
  double scale = 1;                                ///< wrong
  double noise = 1;                                ///< noisy
  double time_s = 1;                               ///< slow, jumping, empty
  double share = 1;                                ///< slow surfaces, weak
  double rate = 0;                                 ///< growing, melting; 1/s
  double ramp_s = 0;
  std::int64_t since_ns = 0;
  double growth = 1;  ///< how much of its size there is by now: 0 to 1
};

}  // namespace fulmar::sim
