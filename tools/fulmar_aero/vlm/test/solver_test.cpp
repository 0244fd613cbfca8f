// SPDX-License-Identifier: BSD-3-Clause
// The lattice against published values and against AVL 3.32 (Drela & Youngren) on the same panels.
#include <cmath>
#include <memory>
#include <numbers>

#include "tools/fulmar_aero/vlm/test/vlm_kit.hpp"

namespace solver_test {

using namespace fulmar::aero;
using namespace fulmar::aero::test;

namespace {

std::unique_ptr<Geometry> bertin(int chordwise, int spanwise, Spacing spacing) {
  auto g = std::make_unique<Geometry>();
  g->reference = {0.2, 1, 0.2};
  LiftingSurface& wing = add_surface(*g, "wing", true, chordwise, spanwise, spacing,
                                     spacing == Spacing::uniform ? spacing : Spacing::tip);
  add_section(wing, 0, 0, 0, 0.2);
  add_section(wing, 0.5, 0.5, 0, 0.2);
  return g;
}

/// The wing of VortexLattice.jl's tests, with the tip at a height.
std::unique_ptr<Geometry> simple_wing(int chordwise, Spacing chord, Spacing span, double tip_z) {
  auto g = std::make_unique<Geometry>();
  g->reference = {30, 15, 2};
  LiftingSurface& wing = add_surface(*g, "wing", true, chordwise, 12, chord, span);
  wing.incidence_rad = 2 * degree;
  add_section(wing, 0, 0, 0, 2.2);
  add_section(wing, 0.4, 7.5, tip_z, 1.8);
  return g;
}

}  // namespace

TEST_CASE("Bertin and Smith's swept wing: 4 panels per half, and many") {
  const Vlm coarse = solved(*bertin(1, 4, Spacing::uniform), {0, 0, 0});
  // Bertin & Smith, Aerodynamics for Engineers (1979), example 6.2
  CHECK(near(coarse.derivatives({}).alpha.CL, 3.443, 0.001));
  const Vlm fine = solved(*bertin(12, 24, Spacing::cosine), {0, 0, 0});
  CHECK(near(fine.derivatives({}).alpha.CL, 3.189, 0.02));
}

TEST_CASE("the wing Warren 12") {
  Geometry g;
  g.reference = {2.82842712, 2.82842712, 1};
  LiftingSurface& wing = add_surface(g, "wing", true, 12, 20, Spacing::cosine, Spacing::tip);
  add_section(wing, 0, 0, 0, 1.5);
  add_section(wing, 1.9139, 1.41421356, 0, 0.5);
  const SixDerivatives d = solved(g, {0, 0, 0}).derivatives({.alpha = degree});
  CHECK(near(d.alpha.CL, 2.743, 0.01));
  CHECK(near(d.alpha.Cm, -3.10, 0.01));
}

TEST_CASE("the wings of VortexLattice.jl") {
  struct Case {
    int chordwise;
    Spacing chord, span;
    double tip_z, alpha_deg, CL, CD, Cm;
  };
  for (const Case& c : {Case{1, Spacing::uniform, Spacing::uniform, 0, 1, 0.24324, 0.00243, -0.02252},
                        Case{1, Spacing::uniform, Spacing::cosine, 0, 1, 0.23744, 0.00253, -0.02165},
                        Case{1, Spacing::uniform, Spacing::uniform, 0, 8, 0.80348, 0.02651, -0.07399}}) {
    CAPTURE(c.alpha_deg);
    const Six f = solved(*simple_wing(c.chordwise, c.chord, c.span, c.tip_z), {0.5, 0, 0})
                      .forces({.alpha = c.alpha_deg * degree});
    CHECK(near(f.CL, c.CL, 0.01));
    CHECK(near(f.CD, c.CD, 0.01));
    CHECK(near(f.Cm, c.Cm, 0.01));
  }
}

}  // namespace solver_test
