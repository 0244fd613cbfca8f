// SPDX-License-Identifier: BSD-3-Clause
// Views of the lattice: the places of its panels, and the lift distribution over the span.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/vlm/aircraft.hpp"

namespace fulmar::aero {

/// One strip of a surface, at its middle.
struct LoadStation {
  double y_m = 0, chord_m = 0;
  double cl_cruise_ratio = 0;  ///< lift coefficient of the section in level cruise
  double cl_stall_ratio = 0;   ///< the same at the angle of attack at which the first section stalls
  double cl_max_ratio = 0;     ///< of its airfoils
};
/// A surface that is not a fin, from the left tip to the right one.
struct SurfaceLoad {
  std::string name;
  std::vector<LoadStation> stations;
};
std::vector<SurfaceLoad> span_loads(const GeometryFile& file, const Aircraft& aircraft);

/// Lines of the drawing from above, each as points (x aft, y right, m): outlines of surfaces, or of the
/// lattice the bound vortices and the sides of the strips.
struct PlaneLine {
  std::vector<Eigen::Vector2d> places;
};
std::vector<PlaneLine> outlines(const Geometry& geometry);
std::vector<PlaneLine> lattice_lines(const Geometry& geometry);

}  // namespace fulmar::aero
