// SPDX-License-Identifier: BSD-3-Clause
// Where propellers stand, and the battery that drives them.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Turns : std::uint8_t {
  right,  ///< clockwise, seen from behind: the aircraft is rolled left
  left
};

/// Where one of several like propellers stands.
struct PropellerPlace {
  Vec3<Body> at_m;      ///< of its disc, from the centre of gravity
  double tilt_rad = 0;  ///< of its axis, up
  double toe_rad = 0;   ///< of its axis, to the right
  Turns turns = Turns::right;
  /// Part of full throttle that full rudder takes from it or gives to it: nose left is more on the right.
  double differential_frac = 0;
};

template <>
inline constexpr std::array<FieldRange, 3> field_ranges<PropellerPlace>{
    {{"tilt_rad", -3.2, 3.2}, {"toe_rad", -3.2, 3.2}, {"differential_frac", 0, 1}}};

/// Voltage of a battery without load over the used part of its capacity.
struct BatteryCurve {
  List<double, 16> used_frac;  ///< rising; its ends hold beyond them
  List<double, 16> open_volt;  ///< as many
};

/// What a battery loses under load and over time. Its voltage when full is the propulsion's. By itself it
/// loses nothing.
struct Battery {
  double capacity_ah = 0;     ///< 0: without end
  double resistance_ohm = 0;  ///< of its cells and cables; shared by all motors
  double empty_volt = 0;      ///< without load, when its capacity is used; 0: as when full
  BatteryCurve curve;  ///< in place of the line from full to empty; its first voltage is that of the full one
};

template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Battery>{
    {{"capacity_ah", 0, 1e5}, {"resistance_ohm", 0, 1e3}, {"empty_volt", 0, 1e5}}};

}  // namespace fulmar
