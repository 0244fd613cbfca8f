// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Origin of the local frame. A parameter `Record<Origin> origin` is filled from the mission's `origin:`.
struct Origin {
  double lat_deg = 0;
  double lon_deg = 0;
  double alt_msl_m = 0;
  bool given = false;  ///< false: the first good fixes decide
};

}  // namespace fulmar
