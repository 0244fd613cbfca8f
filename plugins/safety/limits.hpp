// SPDX-License-Identifier: BSD-3-Clause
// The monitor's parameters by cause. In a mission they stand side by side, without the groups.
#pragma once
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct FenceLimits {
  Param fence_margin{15, "m", 0, 1000, "that the turn back leaves to the fence"};
  Param fence_clear{30, "m", 0, 1000, "more than that, for the fence to be forgotten"};
  Param fence_reaction{1.5, "s", 0, 10, "straight on, until the bank is there"};
  Param fence_bank_ratio{0.7, "ratio", 0.2, 1, "of the airframe's largest bank, in the turn back"};
  Param fence_pull{3, "m/s2", 0.5, 20, "of the pull-out at floor and ceiling"};
  Flag keep_fence{true, "the answer to the fence stays when the aircraft is back inside"};
};

struct GnssDelays {
  Param gnss_raise{3, "s", 0, 600, "without a position, until it is lost"};
  Param gnss_clear{3, "s", 0, 600, "with one, until it is back"};
  Param wait_time{120, "s", 0, 36000,
                  "circling without a position, until it descends; sooner near the fence"};
  Param reckon_std{50, "m", 0, 1000, "a position is reckoned on up to this deviation, as by safety/Home"};
  Param committed_height{12, "m", 0, 200, "above home: a landing that is lower ends without a position, too"};
};

struct PitotDelays {
  Param pitot_raise{2, "s", 0, 600, "without an airspeed, until it is lost"};
  Param pitot_clear{5, "s", 0, 600, "with one, until it is back"};
};

struct RadioDelays {
  Flag radio_required{false, "the radio is lost also if it was never heard"};
  Param radio_timeout{1, "s", 0.05, 600, "without a frame, until it is not there"};
  Param radio_raise{2, "s", 0, 600, "not there, until it is lost"};
  Param radio_clear{2, "s", 0, 600, "there, until it is back"};
  Param land_after{120, "s", 0, 36000, "of the answer home, until the aircraft lands"};
};

struct LinkDelays {
  Param link_timeout{1, "s", 0.05, 600, "without a status, until the link is lost"};
  Param link_clear{2, "s", 0, 600, "with one, until it is back"};
};

struct BatteryLimits {
  Param battery_low{0.25, "ratio", 0, 1, "of the charge: low"};
  Param battery_empty{0.1, "ratio", 0, 1, "of the charge: empty"};
  Param volt_low{0.83, "ratio", 0, 1, "of the full battery's voltage: low, 3.5 V of a 4.2 V cell"};
  Param volt_empty{0.75, "ratio", 0, 1, "of the full battery's voltage: empty"};
  Param battery_raise{3, "s", 0, 600, "below, until it is said: a climb makes the voltage sag"};
  Param battery_clear{30, "s", 0, 600, "above it by a tenth, until it is taken back"};
};

struct AttitudeLimits {
  Param roll_limit{1.13, "rad", 0.2, 3.2, "of an attitude that is excessive"};
  Param pitch_limit{0.7, "rad", 0.2, 1.6, "of an attitude that is excessive, either way"};
  Param attitude_raise{0.3, "s", 0, 10, "beyond, until it is said"};
  Param attitude_clear{1, "s", 0, 60, "below two thirds of it, until it is taken back"};
};

struct WindLimits {
  Param wind_limit{0.6, "ratio", 0, 5,
                   "wind over cruise airspeed that is excessive: about the stalling speed, on the ground "
                   "nothing holds it then"};
  Param wind_smoothing{5, "s", 0.1, 600, "time constant of the wind"};
  Param wind_raise{10, "s", 0, 600, "above, until it is said"};
  Param wind_clear{30, "s", 0, 600, "below nine tenths of it, until it is taken back"};
};

struct EstimatorDelays {
  Param estimator_raise{1, "s", 0, 60, "not valid, until it is said"};
  Param estimator_clear{2, "s", 0, 60, "valid, until it is taken back"};
};

}  // namespace fulmar::safety
