// SPDX-License-Identifier: BSD-3-Clause
// Parts that are not in the lattice: mass, skin, fuselage, propeller.
#pragma once
#include <Eigen/Core>

#include "tools/fulmar_aero/vlm/lattice.hpp"
#include "tools/fulmar_aero/vlm/solver.hpp"

namespace fulmar::aero {

struct MassSum {
  double mass_kg = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of gravity, axes of the drawing, m
  Inertia inertia{0, 0, 0, 0};                       ///< about it, body axes
};
/// Points, boxes, sheets and ellipsoids. Goldstein, Classical Mechanics (2002), section 5.3.
MassSum mass_of(const Geometry& geometry, const Lattice& lattice);

/// Air in cruise.
struct Stream {
  double airspeed_mps = 0, density_kgm3 = 0, viscosity_pas = 0;
  double reynolds(double length_m) const { return density_kgm3 * airspeed_mps * length_m / viscosity_pas; }
};
/// Standard atmosphere; viscosity by Sutherland's law as in ISO 2533.
Stream stream_at(double airspeed_mps, double altitude_m);

/// Friction of a turbulent plate on one side: 0.455 / (log10 Re)^2.58. Raymer, Aircraft Design (2018),
/// (12.27).
double skin_friction(double reynolds);

/// Drag of the wetted surfaces, relative to the reference area. Sections: by their polars, or by (12.27) with
/// the form factor (12.30). Bodies: with (12.31).
double section_drag(const Airfoil* airfoil, double cl, double reynolds);
double profile_drag(const Geometry& geometry, const Lattice& lattice, const Eigen::VectorXd& strip_lift,
                    const Stream& stream);
double body_drag(const Geometry& geometry, const Stream& stream);

/// Moment of an ellipsoid in the stream of an ideal fluid, the same about any point. Munk, NACA Report 184
/// (1924).
void add_bodies(const Geometry& geometry, SixDerivatives& sum);

/// Side force of a propeller in cross flow. For blades of constant chord, lift slope 2 pi and light load the
/// force per angle is B/4 rho a c V^3 / Omega asinh(Omega R / V). Its leading term is that of Ribner, NACA
/// Report 820 (1945). `radps`: speed of the propeller.
double propeller_normal_force(const PropellerPart& propeller, double radius_m, double radps,
                              const Stream& stream);
void add_propeller(const PropellerPart& propeller, double newton_per_rad, const Stream& stream,
                   const ReferenceQuantities& reference, const Eigen::Vector3d& centre, SixDerivatives& sum);

/// Speed at which the propeller has that thrust; 0 for none.
double propeller_speed(const Propulsion& propulsion, double thrust_newton, const Stream& stream);

}  // namespace fulmar::aero
