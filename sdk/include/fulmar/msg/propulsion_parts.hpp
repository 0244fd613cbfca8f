// SPDX-License-Identifier: BSD-3-Clause
// Places of propellers, and their battery.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Turns : std::uint8_t {
  right,  ///< clockwise, seen from behind: the reaction rolls the aircraft left
  left
};

/// Place of one of several equal propellers.
struct PropellerPlace {
  Vec3<Body> at_m;               ///< position of its disc, from the centre of gravity
  double tilt_rad = 0;           ///< tilt of its axis, up
  double toe_rad = 0;            ///< toe angle of its axis, to the right
  Turns turns = Turns::right;    ///< direction of rotation
  double differential_frac = 0;  ///< share of full throttle that full rudder adds or removes: nose left is
                                 ///< more on the right
};

template <>
inline constexpr std::array<FieldRange, 3> field_ranges<PropellerPlace>{
    {{"tilt_rad", -3.2, 3.2}, {"toe_rad", -3.2, 3.2}, {"differential_frac", 0, 1}}};

/// Voltage of a battery without load over the used part of its capacity.
struct BatteryCurve {
  List<double, 16> used_frac;  ///< used share of the capacity, rising; constant voltage beyond its ends
  List<double, 16> open_volt;  ///< open-circuit voltage at each point
};

/// Losses of a battery under load and over time. Its full voltage is that of the propulsion. By default it
/// has no losses.
struct Battery {
  double capacity_ah = 0;     ///< capacity; 0: unlimited
  double resistance_ohm = 0;  ///< resistance of its cells and cables, shared by all motors
  double empty_volt = 0;      ///< open-circuit voltage of the empty battery; 0: as when full
  BatteryCurve curve;         ///< voltage curve in place of the line from full to empty; its first voltage
                              ///< is that of the full battery
};

template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Battery>{
    {{"capacity_ah", 0, 1e5}, {"resistance_ohm", 0, 1e3}, {"empty_volt", 0, 1e5}}};

}  // namespace fulmar
