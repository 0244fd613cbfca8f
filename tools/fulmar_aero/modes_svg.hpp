// SPDX-License-Identifier: BSD-3-Clause
// A picture of modes in the complex plane, as SVG: the same modes give the same bytes.
#pragma once
#include <string>
#include <vector>

#include "fulmar/flight/model/modes.hpp"

namespace fulmar::aero {

struct ModesAtSpeed {
  double airspeed_mps = 0;
  std::vector<Mode> modes;
};

/// All modes on the left, those near the origin on the right. Only the upper half plane: the lower one is its
/// mirror image.
std::string modes_svg(const std::string& title, const std::vector<ModesAtSpeed>& sweep);

}  // namespace fulmar::aero
