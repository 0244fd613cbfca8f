// SPDX-License-Identifier: BSD-3-Clause
// Coefficients of an airframe from a drawing.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/vlm/parts.hpp"

namespace fulmar::aero {

struct Aircraft {
  Airframe airframe;
  MassSum mass;
  Stream stream;
  std::size_t panels = 0;
  double alpha_rad = 0;    ///< of level flight in cruise, the point of the derivatives
  SixDerivatives lattice;  ///< of the surfaces alone
  SixDerivatives whole;    ///< with bodies and propellers
  double skin_drag = 0, body_drag = 0;
  Vlm::FarField far;           ///< in cruise
  double e_far = 0;            ///< of the wake: CL^2 / (pi AR CD)
  double propeller_radps = 0;  ///< in cruise; 0: not computed
  std::string stalls_first;    ///< the surface
  double stall_y_m = 0;
  std::string turned;  ///< a sentence for each control whose sign was reversed
  std::string doubt;   ///< a sentence when fewer panels give another result
};

/// Throws core::Error with file:line without level flight or mass.
Aircraft aircraft_of(const GeometryFile& file, double density = 1);

/// Derivatives with other numbers of panels: `whole` of each density.
struct Convergence {
  double density = 1;
  std::size_t panels = 0;
  SixDerivatives whole;
};
std::vector<Convergence> convergence_of(const GeometryFile& file, const Aircraft& aircraft);

/// The airframe as YAML, each figure with its source, and the trims of steady flight.
std::string airframe_yaml(const GeometryFile& file, const Aircraft& aircraft);

}  // namespace fulmar::aero
