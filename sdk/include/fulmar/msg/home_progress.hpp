// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// How far the way back has been flown.
struct HomeProgress {
  bool there = false;     ///< on the circle at home, at the return height
  bool final = false;     ///< the last piece of a glide, into the wind
  double distance_m = 0;  ///< level, to home, or to the place of the glide
  double reach_m = 0;     ///< how far a glide goes from here towards that place, over the ground
  double ground_m = 0;    ///< height of that place above the origin
};

}  // namespace fulmar
