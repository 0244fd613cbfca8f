// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// What a navigation filter believes of its own errors beyond the deviations in VehicleState, and what the
/// receiver's fix showed of it: for consistency tests. One with each fix that was used.
struct FilterCheck {
  /// Of the errors of attitude, velocity and position, each north, east, down: the rows of the lower triangle
  /// without its diagonal, (1,0), (2,0), (2,1), (3,0) ... In single precision, which halves them in a log.
  std::array<double, 36> correlation_ratio{};
  Vec3<Ned> position_innovation_ratio;  ///< of the fix: measured minus expected, in expected deviations
  Vec3<Ned> velocity_innovation_ratio;
  Vec3<Ned> mean_wind_mps;  ///< VehicleState has the air at the aircraft, gusts included
  Vec3<Ned> mean_wind_std_mps{unknown_std, unknown_std, unknown_std};
};

}  // namespace fulmar
