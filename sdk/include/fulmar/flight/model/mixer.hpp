// SPDX-License-Identifier: BSD-3-Clause
// Aileron, elevator and rudder, and the servos that move the surfaces. Beard & McLain, section 4.2: elevons,
// delta_e = (right + left) / 2, delta_a = (left - right) / 2; ruddervators alike with the rudder. Servo
// angles use the fields of `Deflections`: left and right elevon those of aileron and elevator, left and right
// ruddervator those of elevator and rudder.
#pragma once
#include <algorithm>

#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Stops of the servo of a surface.
struct Stops {
  double min = 0, max = 0;
  bool reach(double angle) const { return angle >= min && angle <= max; }
};
/// Stops in rad: `min_rad` and `max_rad` if the airframe has them, otherwise -limit and +limit.
inline Stops stops(const Surface& s) {
  constexpr double unsaid = 9;  // rad
  return {s.min_rad < -unsaid ? -s.limit_rad : s.min_rad, s.max_rad > unsaid ? s.limit_rad : s.max_rad};
}

/// Servo angles, rad, that give these deflections; flaps pass unchanged. Not limited to the stops.
inline Deflections to_servos(Mixer mixer, Deflections d) {
  if (mixer == Mixer::elevons) {
    const double elevator = d.elevator, aileron = d.aileron;
    d.aileron = elevator + aileron;
    d.elevator = elevator - aileron;
  } else if (mixer == Mixer::v_tail) {
    const double elevator = d.elevator, rudder = d.rudder;
    d.elevator = elevator + rudder;
    d.rudder = elevator - rudder;
  }
  return d;
}

/// Inverse of `to_servos`.
inline Deflections from_servos(Mixer mixer, Deflections servos) {
  if (mixer == Mixer::elevons) {
    const double left = servos.aileron, right = servos.elevator;
    servos.elevator = 0.5 * (left + right);
    servos.aileron = 0.5 * (left - right);
  } else if (mixer == Mixer::v_tail) {
    const double left = servos.elevator, right = servos.rudder;
    servos.elevator = 0.5 * (left + right);
    servos.rudder = 0.5 * (left - right);
  }
  return servos;
}

/// Servo beyond its stops; none if all are within.
enum class Beyond : unsigned char { none, aileron, elevator, rudder };
/// The first of the elevator, aileron and rudder servos that these deflections, rad, drive beyond its stops.
inline Beyond beyond_stops(const Airframe& a, const Deflections& d) {
  const Deflections servos = to_servos(a.mixer, d);
  if (!stops(a.elevator).reach(servos.elevator)) return Beyond::elevator;
  if (!stops(a.aileron).reach(servos.aileron)) return Beyond::aileron;
  if (!stops(a.rudder).reach(servos.rudder)) return Beyond::rudder;
  return Beyond::none;
}

}  // namespace fulmar
