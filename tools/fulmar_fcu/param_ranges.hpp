// SPDX-License-Identifier: BSD-3-Clause
// Valid ranges of parameters whose wrong value the firmware accepts without a report, and which may cost an
// aircraft. ROSflight firmware 2.0, param.cpp and rc.cpp: a channel that is not received counts as a lost
// radio, SBUS has 16 of them; -1 maps a switch to none.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace fulmar::fcu {

struct ParamRange {
  std::string_view name;
  std::int64_t least, most;
};

inline constexpr std::array param_ranges{
    ParamRange{"RC_NUM_CHN", 4, 16},       ParamRange{"RC_TYPE", 0, 1},
    ParamRange{"RC_X_CHN", 0, 15},         ParamRange{"RC_Y_CHN", 0, 15},
    ParamRange{"RC_Z_CHN", 0, 15},         ParamRange{"RC_F_CHN", 0, 15},
    ParamRange{"RC_F_AXIS", 0, 2},         ParamRange{"RC_ATT_OVRD_CHN", -1, 15},
    ParamRange{"RC_THR_OVRD_CHN", -1, 15}, ParamRange{"RC_ATT_CTRL_CHN", -1, 15},
    ParamRange{"RC_ARM_CHN", -1, 15},      ParamRange{"SWITCH_5_DIR", -1, 1},
    ParamRange{"SWITCH_6_DIR", -1, 1},     ParamRange{"SWITCH_7_DIR", -1, 1},
    ParamRange{"SWITCH_8_DIR", -1, 1},     ParamRange{"TAKE_MIN_THR", 0, 1},
    ParamRange{"FIXED_WING", 0, 1},        ParamRange{"REV_AILERON", 0, 1},
    ParamRange{"REV_ELEVATOR", 0, 1},      ParamRange{"REV_RUDDER", 0, 1},
    ParamRange{"ARM_SPIN_MOTORS", 0, 1},   ParamRange{"OFFBOARD_TIMEOUT", 20, 10000},
};

}  // namespace fulmar::fcu
