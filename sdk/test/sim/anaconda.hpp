// SPDX-License-Identifier: BSD-3-Clause
// The Anaconda of configs/, for tests of the plant.
#pragma once
#include "sdk/test/flight/airframe_file.hpp"

namespace fulmar::sim {

inline const Airframe& anaconda() {
  static const Airframe airframe = test::airframe_file("anaconda");
  return airframe;
}

}  // namespace fulmar::sim
