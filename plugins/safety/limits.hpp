// SPDX-License-Identifier: BSD-3-Clause
// The monitor's parameters by cause. In a mission they are in one list, without the groups.
#pragma once
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct FenceLimits {
  Param fence_margin{15, "m", 0, 1000, "distance from the geofence in the turn back"};
  Param fence_clear{30, "m", 0, 1000, "distance beyond fence_margin at which the geofence answer ends"};
  Param fence_reaction{1.5, "s", 0, 10, "time of straight flight before the bank is reached"};
  Param fence_bank_ratio{0.7, "ratio", 0.2, 1, "share of the bank limit of the airframe in the turn back"};
  Param fence_pull{3, "m/s2", 0.5, 20, "acceleration of the pull-out at floor and ceiling"};
  Flag keep_fence{true, "hold of the geofence answer after the return inside"};
};

struct GnssDelays {
  Param gnss_raise{3, "s", 0, 600, "time without a position before it counts as lost"};
  Param gnss_clear{3, "s", 0, 600, "time with a position before it counts as restored"};
  Param wait_time{120, "s", 0, 36000,
                  "duration of the circle without a position before the descent; shorter near the geofence"};
  Param reckon_std{50, "m", 0, 1000,
                   "largest standard deviation of a position for dead reckoning, as in safety/Home"};
  Param committed_height{12, "m", 0, 200,
                         "height above home below which a landing continues without a position"};
};

struct PitotDelays {
  Param pitot_raise{2, "s", 0, 600, "time without an airspeed before it counts as lost"};
  Param pitot_clear{5, "s", 0, 600, "time with an airspeed before it counts as restored"};
};

struct RadioDelays {
  Flag radio_required{false, "report of a lost radio even without a first frame"};
  Param radio_timeout{1, "s", 0.05, 600, "largest age of a radio frame before the radio counts as absent"};
  Param radio_raise{2, "s", 0, 600, "time with an absent radio before it counts as lost"};
  Param radio_clear{2, "s", 0, 600, "time with a radio before it counts as restored"};
  Param land_after{120, "s", 0, 36000, "duration of the answer home before the landing"};
};

struct LinkDelays {
  Param link_timeout{1, "s", 0.05, 600, "largest age of a status before the link counts as lost"};
  Param link_clear{2, "s", 0, 600, "time with a status before the link counts as restored"};
};

struct BatteryLimits {
  Param battery_low{0.25, "ratio", 0, 1, "share of the charge of a low battery"};
  Param battery_empty{0.1, "ratio", 0, 1, "share of the charge of an empty battery"};
  Param volt_low{0.83, "ratio", 0, 1, "share of the full voltage of a low battery: 3.5 V of a 4.2 V cell"};
  Param volt_empty{0.75, "ratio", 0, 1, "share of the full voltage of an empty battery"};
  Param battery_raise{3, "s", 0, 600,
                      "time below a limit before its report: longer than the voltage drop in a climb"};
  Param battery_clear{30, "s", 0, 600, "time at a tenth above the limit before the report ends"};
};

struct AttitudeLimits {
  Param roll_limit{1.13, "rad", 0.2, 3.2,
                   "limit of the roll angle, either way, before it counts as excessive"};
  Param pitch_limit{0.7, "rad", 0.2, 1.6,
                    "limit of the pitch angle, either way, before it counts as excessive"};
  Param attitude_raise{0.3, "s", 0, 10, "time beyond a limit before the report"};
  Param attitude_clear{1, "s", 0, 60, "time below two thirds of the limit before the report ends"};
};

struct WindLimits {
  Param wind_limit{0.6, "ratio", 0, 5,
                   "ratio of wind to cruise airspeed that counts as excessive: about the stall airspeed"};
  Param wind_smoothing{5, "s", 0.1, 600, "time constant of the wind"};
  Param wind_raise{10, "s", 0, 600, "time above the limit before the report"};
  Param wind_clear{30, "s", 0, 600, "time below nine tenths of the limit before the report ends"};
};

struct EstimatorDelays {
  Param estimator_raise{1, "s", 0, 60, "time with an invalid estimate before the report"};
  Param estimator_clear{2, "s", 0, 60, "time with a valid estimate before the report ends"};
};

}  // namespace fulmar::safety
