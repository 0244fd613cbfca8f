// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Error statistics of a navigation filter beyond the standard deviations in VehicleState, and the innovation
/// of the receiver's fix: for consistency tests. One message for each fix that is used.
struct FilterCheck {
  std::array<double, 36> correlation_ratio{};                          ///< correlations of the errors of
                                                                       ///< attitude, velocity and position,
                                                                       ///< each north, east, down: rows of
                                                                       ///< the lower triangle without its
                                                                       ///< diagonal, (1,0), (2,0), (2,1),
                                                                       ///< (3,0) ...; single precision in
                                                                       ///< the log
  Vec3<Ned> position_innovation_ratio;                                 ///< position innovation of the fix:
                                                                       ///< measured minus expected, in
                                                                       ///< expected standard deviations
  Vec3<Ned> velocity_innovation_ratio;                                 ///< velocity innovation of the fix,
                                                                       ///< in expected standard deviations
  Vec3<Ned> mean_wind_mps;                                             ///< mean wind; VehicleState has the
                                                                       ///< wind at the aircraft, gusts
                                                                       ///< included
  Vec3<Ned> mean_wind_std_mps{unknown_std, unknown_std, unknown_std};  ///< standard deviation of the mean
                                                                       ///< wind
};

}  // namespace fulmar
