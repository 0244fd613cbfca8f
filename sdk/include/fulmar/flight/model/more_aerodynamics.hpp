// SPDX-License-Identifier: BSD-3-Clause
// Optional terms of an airframe besides its derivatives: drag over squares, pitching moment of separated
// flow, tables, flaps.
#pragma once
#include <cmath>
#include <numbers>

#include "fulmar/flight/math/tables.hpp"
#include "fulmar/flight/model/air_data.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// True if a coefficient depends on the flaps.
inline bool has_flaps(const Aerodynamics& a) {
  for (const Derivatives* c : {&a.lift, &a.drag, &a.side, &a.roll, &a.pitch, &a.yaw})
    if (c->flap_ratio != 0) return true;
  return false;
}

/// True if the airframe has any of the terms of this header.
inline bool has_more(const Aerodynamics& a) {
  const DragSquared& d = a.drag_squared;
  return d.beta_ratio != 0 || d.aileron_ratio != 0 || d.elevator_ratio != 0 || d.rudder_ratio != 0 ||
         a.pitch_stalled_ratio != 0 || !a.tables.empty() || has_flaps(a);
}

/// Area of the propeller disc, m2.
inline double propeller_disc(const Propulsion& p) {
  const double D = p.propeller_diameter_m;
  return p.disc.area_m2 > 0 ? p.disc.area_m2 : std::numbers::pi / 4 * D * D;
}

/// Arguments of the tables, in the order of TableVariable. `sound_mps`: speed of sound.
template <class S>
TablePoint<S> table_point(const AirDataOf<S>& air, const DeflectionsOf<S>& d, double sound_mps) {
  return {S(0.0), air.alpha, air.beta, S(air.Va / sound_mps), d.aileron, d.elevator, d.rudder};
}

/// CD of the squares of sideslip and deflections, rad.
template <class S>
S squared_drag(const DragSquared& of, const S& beta, const DeflectionsOf<S>& d) {
  return of.beta_ratio * beta * beta + of.aileron_ratio * d.aileron * d.aileron +
         of.elevator_ratio * d.elevator * d.elevator + of.rudder_ratio * d.rudder * d.rudder;
}

/// The sum with the derivatives' Cm0 + Cm_alpha ((1 - sigma) alpha + sigma sin(alpha)) is (1 - sigma) (Cm0 +
/// Cm_alpha alpha) + sigma Cm_fp sign(alpha) sin^2(alpha): the blending of Beard & McLain (4.9) for the
/// moment. Source: Gryte, Hann, Alam, Rohac, Johansen & Fossen, "Aerodynamic modeling of the Skywalker X8
/// Fixed-Wing Unmanned Aerial Vehicle", ICUAS 2018.
template <class S>
S stalled_pitch(const Aerodynamics& a, const AirDataOf<S>& air, const S& sigma) {
  using std::copysign;
  const S plate = copysign(S(air.sin_alpha * air.sin_alpha), air.alpha);
  return sigma * (a.pitch_stalled_ratio * plate - a.pitch.zero_ratio - a.pitch.alpha_ratio * air.sin_alpha);
}

}  // namespace fulmar
