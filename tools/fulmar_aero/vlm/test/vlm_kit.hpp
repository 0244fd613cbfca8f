// SPDX-License-Identifier: BSD-3-Clause
// Geometries that other solvers' figures are known of.
#pragma once
#include <doctest/doctest.h>

#include "tools/fulmar_aero/vlm/solver.hpp"

namespace fulmar::aero::test {

inline constexpr double degree = 0.017453292519943295;

inline bool near(double value, double expected, double part, double least = 0) {
  const bool ok = std::abs(value - expected) <= std::max(part * std::abs(expected), least);
  if (!ok) MESSAGE(value << " for " << expected);
  return ok;
}

inline LiftingSurface& add_surface(Geometry& g, const char* name, bool mirror, int chordwise, int spanwise,
                                   Spacing chord_spacing, Spacing span_spacing) {
  LiftingSurface s;
  s.name = name;
  s.mirror = mirror;
  s.chordwise = chordwise;
  s.spanwise = spanwise;
  s.chord_spacing = chord_spacing;
  s.span_spacing = span_spacing;
  g.surfaces.push_back(s);
  return g.surfaces[g.surfaces.size() - 1];
}

inline void add_section(LiftingSurface& s, double x, double y, double z, double chord,
                        const char* airfoil = "") {
  WingSection w;
  w.x_m = x;
  w.y_m = y;
  w.z_m = z;
  w.chord_m = chord;
  w.airfoil = airfoil;
  s.sections.push_back(w);
}

/// As AVL has it: the wake along x, no core between surfaces.
inline Vlm solved(const Geometry& g, const Eigen::Vector3d& about, double core = 0) {
  return {lattice_of(g), g.reference, about, {.wake_alpha = 0, .core = core}};
}

}  // namespace fulmar::aero::test
