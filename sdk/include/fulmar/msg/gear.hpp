// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class ContactKind : std::uint8_t {
  wheel,  ///< rolls along the heading, slides across it
  skid    ///< slides alike in every direction
};

/// A place at which the aircraft meets the ground.
struct GearContact {
  Vec3<Body> at_m;  ///< of its foot, loaded, from the centre of gravity
  /// Share of the weight that it bears at rest, which makes its spring: 1 cm under that. 0: it is in the air
  /// at rest, and as stiff as one that bears 0.15.
  double carries_ratio = 0;
  ContactKind kind = ContactKind::wheel;
  double friction_ratio = -1;  ///< of rolling, or of the skid; below 0: the gear's rolling or side friction
};

/// The aircraft stands on its wheels or belly: contact points are at this height below the centre of gravity.
/// With `contacts`, they are the gear, and height, length and track say nothing.
struct Gear {
  double height_m = 0.2;  ///< of the centre of gravity above flat ground, at rest
  double length_m = 0.6;  ///< between the front and the rear contact
  double track_m = 0.4;   ///< between the left and the right contact
  double rolling_friction_ratio = 0.05;
  double side_friction_ratio = 0.6;
  List<GearContact, 12> contacts;  ///< in place of nose wheel, main wheels and tail skid
  List<Vec3<Body>, 12> hull_m;     ///< what breaks when it touches; empty: wing tips, nose and back
};

template <>
inline constexpr std::array<FieldRange, 2> field_ranges<GearContact>{
    {{"carries_ratio", 0, 1}, {"friction_ratio", -1, 10}}};

}  // namespace fulmar
