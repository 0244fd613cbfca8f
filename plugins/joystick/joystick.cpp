// SPDX-License-Identifier: BSD-3-Clause
// A joystick or the keys of a terminal as the transmitter of a simulated aircraft.
#include "joystick.hpp"

#include "keyboard.hpp"

using namespace fulmar::hand;

FULMAR_PLUGIN("1.0.0", Joystick, Keyboard)
