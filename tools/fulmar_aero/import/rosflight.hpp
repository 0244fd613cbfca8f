// SPDX-License-Identifier: BSD-3-Clause
// Sets that are already in the form of Beard & McLain: ROSflight's parameter files, the JSON of the Skywalker
// X8 (C_L_0, C_l_p, ...), and the linear part of JSBSim's XML.
#pragma once
#include "tools/fulmar_aero/import/aircraft.hpp"
#include "tools/fulmar_aero/import/lines.hpp"

namespace fulmar::aero::imports {

bool is_rosflight(const Lines& lines);
bool is_coefficient_json(const Lines& lines);
bool is_jsbsim(const Lines& lines);

/// `mend`: columns with an impossible sign are reversed, each with a note; else they stay for the check.
/// Throws core::Error.
Aircraft rosflight_aircraft(const Lines& lines, bool mend);
Aircraft json_aircraft(const Lines& lines);
Aircraft jsbsim_aircraft(const Lines& lines);

}  // namespace fulmar::aero::imports
