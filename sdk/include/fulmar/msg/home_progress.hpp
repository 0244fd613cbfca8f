// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Progress of the return.
struct HomeProgress {
  bool there = false;     ///< on the circle at home, at the return height
  bool final = false;     ///< last piece of a glide, into the wind
  double distance_m = 0;  ///< horizontal distance to home, or to the landing place of the glide
  double reach_m = 0;     ///< range of a glide from here towards that place, over the ground
  double ground_m = 0;    ///< height of that place above the origin
};

}  // namespace fulmar
