// SPDX-License-Identifier: BSD-3-Clause
// Moves one surface after the other, on the ground, with the commands of a flight: OFFBOARD_CONTROL, mode 0,
// throttle always 0. Servos follow while disarmed, motors do not. The firmware passes commands on at frames
// of the radio only, and the pilot may have control of the outputs.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/mixer.hpp"

namespace fulmar::fcu {

struct Surface {
  int command = row_aileron;
  const char* name = "";
  const char* positive = "";  ///< visible effect of a positive command
};
const std::vector<Surface>& surfaces();

struct Moved {
  int output = 0;
  // reported by the controller, 0 to 1; the farthest value from rest of each half
  double rest = -1, first = -1, then = -1;
};

/// Takes control of the outputs with neutral commands. Throws Error when the pilot keeps them, or without
/// radio frames.
void take_outputs(Client& client);
/// Moves a surface to +size and -size and back within `period_ns`. Throws Error when the controller is armed,
/// when the pilot takes over, or when an output does not follow.
std::vector<Moved> move_surface(Client& client, const Mixer& mixer, int command, double size,
                                std::int64_t period_ns);

}  // namespace fulmar::fcu
