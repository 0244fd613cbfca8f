// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class ContactKind : std::uint8_t {
  wheel,  ///< rolls along the heading, slides across it
  skid    ///< slides in every direction
};

/// Contact point of the aircraft with the ground.
struct GearContact {
  Vec3<Body> at_m;                        ///< position of its foot under load, from the centre of gravity
  double carries_ratio = 0;               ///< share of the weight at rest, which sets its stiffness:
                                          ///< deflection 1 cm under that load; 0: in the air at rest, with
                                          ///< the stiffness of 0.15
  ContactKind kind = ContactKind::wheel;  ///< kind of the contact
  double friction_ratio = -1;             ///< friction of rolling, or of the skid; below 0: rolling or side
                                          ///< friction of the gear
};

/// Contact points of wheels or belly, at this height below the centre of gravity. With `contacts`, these are
/// the gear, and height, length and track are not used.
struct Gear {
  double height_m = 0.2;                 ///< height of the centre of gravity above flat ground, at rest
  double length_m = 0.6;                 ///< distance between the front and the rear contact
  double track_m = 0.4;                  ///< distance between the left and the right contact
  double rolling_friction_ratio = 0.05;  ///< friction of rolling
  double side_friction_ratio = 0.6;      ///< friction across the heading
  List<GearContact, 12> contacts;        ///< contact points in place of nose wheel, main wheels and tail
                                         ///< skid
  List<Vec3<Body>, 12> hull_m;           ///< points that break on contact; empty: wing tips, nose and back
};

template <>
inline constexpr std::array<FieldRange, 2> field_ranges<GearContact>{
    {{"carries_ratio", 0, 1}, {"friction_ratio", -1, 10}}};

}  // namespace fulmar
