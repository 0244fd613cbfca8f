// SPDX-License-Identifier: BSD-3-Clause
// Geometries that other solvers' figures are known of.
#pragma once
#include <doctest/doctest.h>

#include <cmath>

#include "tools/fulmar_aero/vlm/solver.hpp"

namespace fulmar::aero::test {

inline constexpr double degree = 0.017453292519943295;

inline bool near(double value, double expected, double part, double least = 0) {
  const bool ok = std::abs(value - expected) <= std::max(part * std::abs(expected), least);
  if (!ok) MESSAGE(value << " for " << expected);
  return ok;
}

using Drawn = std::unique_ptr<Geometry>;
inline Drawn drawn(const ReferenceQuantities& reference) {
  Drawn g = std::make_unique<Geometry>();
  g->reference = reference;
  return g;
}

inline LiftingSurface& add_surface(Geometry& g, const char* name, bool mirror, std::array<int, 2> panels,
                                   Spacing chord_spacing, Spacing span_spacing) {
  LiftingSurface s;
  s.name = name;
  s.mirror = mirror;
  s.chordwise = panels[0];
  s.spanwise = panels[1];
  s.chord_spacing = chord_spacing;
  s.span_spacing = span_spacing;
  g.surfaces.push_back(s);
  return g.surfaces[g.surfaces.size() - 1];
}

/// x, y, z of the leading edge, and the chord.
inline void add_section(LiftingSurface& s, std::array<double, 4> at) {
  WingSection w;
  w.x_m = at[0];
  w.y_m = at[1];
  w.z_m = at[2];
  w.chord_m = at[3];
  s.sections.push_back(w);
}

/// As AVL has it: the wake along x.
inline Vlm solved(const Geometry& g, const Eigen::Vector3d& about) {
  return {lattice_of(g), g.reference, about};
}

}  // namespace fulmar::aero::test
