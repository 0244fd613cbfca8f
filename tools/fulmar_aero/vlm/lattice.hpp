// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as panels, each with a horseshoe vortex. Katz & Plotkin, Low-Speed Aerodynamics (2001),
// section 12.3; Drela, Flight Vehicle Aerodynamics (2014), section 6.5.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "tools/fulmar_aero/vlm/geometry.hpp"

namespace fulmar::aero {

/// Columns of the coefficient set: aileron rolls right, elevator trailing edge down, rudder trailing edge
/// left, flap trailing edge down. Beard & McLain, section 4.2.
enum Control : std::size_t { to_aileron, to_elevator, to_rudder, to_flap, controls };

/// Geometry axes: x aft, y right, z up; metres.
struct Panel {
  Eigen::Vector3d a, b;  ///< ends of the bound vortex; positive circulation from a to b lifts along `normal`
  Eigen::Vector3d centre;                        ///< of the bound vortex, point of action of the force
  Eigen::Vector3d control;                       ///< point with zero normal velocity
  Eigen::Vector3d normal;                        ///< with twist and camber; panels themselves lie along x
  std::array<Eigen::Vector3d, controls> turned;  ///< d normal / d control, 1/rad
  double edge_a = 0, edge_b = 0;                 ///< x of the trailing edge behind a and b
  int strip = 0, surface = 0;
};

/// Panels behind each other.
struct Strip {
  Eigen::Vector3d a, b, mid;    ///< trailing edge; mid: behind the control points
  double chord = 0, width = 0;  ///< width across x
  int surface = 0;
  double share = 0;                       ///< of the second section's airfoil
  int airfoil_in = -1, airfoil_out = -1;  ///< of Geometry::airfoils; -1: flat
};

struct Lattice {
  std::vector<Panel> panels;
  std::vector<Strip> strips;
  std::array<bool, controls> has{};  ///< surfaces that exist
};

/// `density`: factor of the number of panels in both directions.
Lattice lattice_of(const Geometry& geometry, double density = 1);

}  // namespace fulmar::aero
