// SPDX-License-Identifier: BSD-3-Clause
// The lattice against published values and against AVL 3.32 (Drela & Youngren) on the same panels.
#include <cmath>

#include "tools/fulmar_aero/vlm/test/vlm_kit.hpp"

namespace solver_test {

using namespace fulmar::aero;
using namespace fulmar::aero::test;

namespace {

Drawn bertin(int chordwise, int spanwise, Spacing spacing) {
  Drawn g = drawn({0.2, 1, 0.2});
  LiftingSurface& wing = add_surface(*g, "wing", true, {chordwise, spanwise}, spacing,
                                     spacing == Spacing::uniform ? spacing : Spacing::tip);
  add_section(wing, {0, 0, 0, 0.2});
  add_section(wing, {0.5, 0.5, 0, 0.2});
  return g;
}

/// The wing of VortexLattice.jl's tests, with the tip at a height.
Drawn simple_wing(int chordwise, Spacing chord, Spacing span, double tip_z) {
  Drawn g = drawn({30, 15, 2});
  LiftingSurface& wing = add_surface(*g, "wing", true, {chordwise, 12}, chord, span);
  wing.incidence_rad = 2 * degree;
  add_section(wing, {0, 0, 0, 2.2});
  add_section(wing, {0.4, 7.5, tip_z, 1.8});
  return g;
}

Drawn wing_and_tails() {
  Drawn g = drawn({9, 10, 0.9});
  LiftingSurface& wing = add_surface(*g, "wing", true, {1, 12}, Spacing::uniform, Spacing::uniform);
  wing.incidence_rad = 2 * degree;
  add_section(wing, {0, 0, 0, 1});
  add_section(wing, {0.2, 5, 1, 0.6});
  LiftingSurface& tail = add_surface(*g, "tailplane", true, {1, 6}, Spacing::uniform, Spacing::uniform);
  add_section(tail, {4, 0, 0, 0.7});
  add_section(tail, {4.14, 1.25, 0, 0.42});
  LiftingSurface& fin = add_surface(*g, "fin", false, {1, 5}, Spacing::cosine, Spacing::uniform);
  add_section(fin, {4, 0, 0, 0.7});
  add_section(fin, {4.14, 0, 1, 0.42});
  return g;
}

}  // namespace

TEST_CASE("Bertin and Smith's swept wing: 4 panels per half, and many") {
  // Bertin & Smith, Aerodynamics for Engineers (1979), example 6.2
  CHECK(near(solved(*bertin(1, 4, Spacing::uniform), {0, 0, 0}).derivatives({}).alpha.CL, 3.443, 0.001));
  CHECK(near(solved(*bertin(10, 20, Spacing::cosine), {0, 0, 0}).derivatives({}).alpha.CL, 3.189, 0.02));
}

TEST_CASE("the wing Warren 12: a leading edge swept by 53.54 degrees") {
  Drawn g = drawn({2.82842712, 2.82842712, 1});
  LiftingSurface& wing = add_surface(*g, "wing", true, {10, 16}, Spacing::cosine, Spacing::tip);
  add_section(wing, {0, 0, 0, 1.5});
  add_section(wing, {std::sqrt(2) * std::tan(53.54 * degree), std::sqrt(2), 0, 0.5});
  const SixDerivatives d = solved(*g, {0, 0, 0}).derivatives({.alpha = degree});
  CHECK(near(d.alpha.CL, 2.743, 0.01));  // Margason & Lamar, NASA TN D-6142 (1971)
  CHECK(near(d.alpha.Cm, -3.10, 0.01));
}

TEST_CASE("the cases of VortexLattice.jl: forces near by and far behind") {
  struct Case {
    int chordwise;
    Spacing chord, span;
    double tip_z, alpha_deg, CL, CD, Cm, far_CL, far_CD;
  };
  constexpr Spacing even = Spacing::uniform, cosine = Spacing::cosine;
  for (const Case& c : {Case{1, even, even, 0, 1, 0.24324, 0.00243, -0.02252, 0.24328, 0.00245},
                        Case{1, even, cosine, 0, 1, 0.23744, 0.00253, -0.02165, 0.23749, 0.00243},
                        Case{1, even, even, 0, 8, 0.80348, 0.02651, -0.07399, 0.80721, 0.02696},
                        Case{6, even, even, 0, 1, 0.24454, 0.00247, -0.02091, 0.24458, 0.00248},
                        Case{6, cosine, cosine, 0, 1, 0.23879, 0.00249, -0.01995, 0.23884, 0.00246},
                        Case{1, cosine, even, 3, 1, 0.24787, 0.00246, -0.02395, 0.24656, 0.00245}}) {
    CAPTURE(c.CL);
    const Vlm vlm = solved(*simple_wing(c.chordwise, c.chord, c.span, c.tip_z), {0.5, 0, 0});
    const FlowState state{.alpha = c.alpha_deg * degree};
    const Six f = vlm.forces(state);
    CHECK(near(f.CL, c.CL, 0.0005));
    CHECK(near(f.CD, c.CD, 0.003));
    CHECK(near(f.Cm, c.Cm, 0.001));
    CHECK(near(vlm.far_field(state).CL, c.far_CL, 0.0005));
    CHECK(near(vlm.far_field(state).CD, c.far_CD, 0.003));
  }
  const Vlm whole = solved(*wing_and_tails(), {0.5, 0, 0});
  const Six f = whole.forces({.alpha = 5 * degree});
  CHECK(near(f.CL, 0.60408, 0.001));
  CHECK(near(f.CD, 0.01058, 0.003));
  CHECK(near(f.Cm, -0.02778, 0.01));
  CHECK(near(whole.far_field({.alpha = 5 * degree}).CD, 0.01038, 0.003));
  // AVL's run with components of their own gives the vortices of other surfaces a core
  CHECK(near(f.CL, 0.60562, 0.01));
  CHECK(near(f.CD, 0.01058, 0.01));
  const SixDerivatives d = whole.derivatives({.alpha = 5 * degree});
  CHECK(near(d.alpha.CL, 5.098484, 0.01));
  CHECK(near(d.q.Cm, -21.93362, 0.01));
  CHECK(near(d.q.CL, 7.124317, 0.01));
  CHECK(near(d.p.Cl, -0.592713, 0.01));
}

TEST_CASE("body-axis derivatives of the wing with dihedral") {
  const SixDerivatives d = solved(*simple_wing(1, Spacing::cosine, Spacing::uniform, 3), {0.5, 0, 0})
                               .derivatives({.alpha = degree});
  CHECK(near(d.alpha.CL, 4.517947, 0.0005));
  CHECK(near(d.alpha.Cm, -0.569432, 0.0005));
  CHECK(near(d.beta.CY, -0.502398, 0.001));
  CHECK(near(d.beta.Cl, -0.402014, 0.001));
  CHECK(near(d.beta.Cn, -0.010640, 0.002));
  CHECK(near(d.p.CY, -0.704260, 0.001));
  CHECK(near(d.p.Cl, -0.670618, 0.001));
  CHECK(near(d.p.Cn, -0.021751, 0.002));
  CHECK(near(d.r.CY, 0.149178, 0.001));
  CHECK(near(d.r.Cl, 0.125285, 0.001));
  CHECK(near(d.r.Cn, -0.002532, 0.003));
  CHECK(near(d.q.CL, 4.845972, 0.0005));
  CHECK(near(d.q.Cm, -0.462420, 0.001));
}

TEST_CASE("the aircraft Merlin: all derivatives within 10 % or 0.005 of AVL's, most within 1 %" *
          doctest::test_suite("amounts")) {
  const GeometryFile file = read_geometry_file(FULMAR_SOURCE_DIR "/tools/fulmar_aero/vlm/test/merlin.yaml");
  const Vlm vlm = solved(*file.geometry, {0.085, 0, -0.02});
  const FlowState state{.alpha = 2 * degree};
  const SixDerivatives d = vlm.derivatives(state);
  const double per_degree = 1 / degree;  // AVL has its controls so, its rudder with the other sign
  CHECK(near(d.value.CL, 0.47792, 0.005));
  CHECK(near(d.value.Cm, 0.04134, 0.01));
  CHECK(near(d.value.CD, 0.00977, 0.01));
  CHECK(near(vlm.far_field(state).CD, 0.00965, 0.01));
  CHECK(near(d.alpha.CL, 5.061122, 0.005));
  CHECK(near(d.alpha.Cm, -1.112767, 0.01));
  CHECK(near(d.q.CL, 8.624822, 0.005));
  CHECK(near(d.q.Cm, -14.863306, 0.005));
  CHECK(near(d.beta.CY, -0.235623 + 0.02, 0.01));  // AVL adds its CDp there
  CHECK(near(d.beta.Cl, -0.078765, 0.01));
  CHECK(near(d.beta.Cn, 0.083999, 0.01));
  CHECK(near(d.p.CY, 0.010920, 0.1, 0.005));
  CHECK(near(d.p.Cl, -0.501412, 0.01));
  CHECK(near(d.p.Cn, -0.062816, 0.02));
  CHECK(near(d.r.CY, 0.216736, 0.01));
  CHECK(near(d.r.Cl, 0.114397, 0.01));
  CHECK(near(d.r.Cn, -0.086305, 0.01));
  CHECK(near(d.control[to_elevator].CL, 0.008322 * per_degree, 0.01));
  CHECK(near(d.control[to_elevator].Cm, -0.026837 * per_degree, 0.01));
  CHECK(near(d.control[to_aileron].Cl, 0.005055 * per_degree, 0.01));
  CHECK(near(d.control[to_aileron].CY, 0.000553 * per_degree, 0.1, 0.005));
  CHECK(near(d.control[to_aileron].Cn, -0.000045 * per_degree, 0.1, 0.005));
  CHECK(near(d.control[to_rudder].CY, 0.002692 * per_degree, 0.01));
  CHECK(near(d.control[to_rudder].Cl, 0.000100 * per_degree, 0.1, 0.005));
  CHECK(near(d.control[to_rudder].Cn, -0.001204 * per_degree, 0.01));
  for (const double* cross : {&d.alpha.CY, &d.alpha.Cl, &d.alpha.Cn, &d.beta.CL, &d.beta.Cm, &d.q.CY, &d.p.CL,
                              &d.r.Cm, &d.control[to_elevator].Cn, &d.control[to_aileron].Cm})
    CHECK(std::abs(*cross) < 1e-9);
}

TEST_CASE("derivatives are those of the forces, in a state with everything in it") {
  Drawn g = wing_and_tails();
  ControlSurface c;
  c.drives = Drives::elevons;
  c.from_m = 2;
  c.to_m = 4;
  g->surfaces[0].controls.push_back(c);
  c.drives = Drives::rudder;
  c.from_m = 0;
  c.to_m = 1;
  g->surfaces[2].controls.push_back(c);
  const Vlm vlm(lattice_of(*g), g->reference, {0.5, 0, 0.1}, 3 * degree);
  const FlowState at{
      .alpha = 0.07, .beta = 0.05, .p = 0.03, .q = 0.02, .r = -0.02, .deflection = {0.05, -0.08, 0.1, 0}};
  const SixDerivatives d = vlm.derivatives(at);
  const auto check = [&](const char* over, const Six& exact, double FlowState::*field, int control) {
    CAPTURE(over);
    const double h = 1e-5;
    FlowState more = at, less = at;
    (field ? more.*field : more.deflection[std::size_t(control)]) += h;
    (field ? less.*field : less.deflection[std::size_t(control)]) -= h;
    const Six a = vlm.forces(more), b = vlm.forces(less);
    for (double Six::*x : {&Six::CL, &Six::CD, &Six::CY, &Six::Cl, &Six::Cm, &Six::Cn})
      CHECK(near(exact.*x, (a.*x - b.*x) / (2 * h), 1e-5, 1e-7));
  };
  check("alpha", d.alpha, &FlowState::alpha, 0);
  check("beta", d.beta, &FlowState::beta, 0);
  check("p", d.p, &FlowState::p, 0);
  check("q", d.q, &FlowState::q, 0);
  check("r", d.r, &FlowState::r, 0);
  check("aileron", d.control[to_aileron], nullptr, to_aileron);
  check("elevator", d.control[to_elevator], nullptr, to_elevator);
  check("rudder", d.control[to_rudder], nullptr, to_rudder);
  CHECK(d.control[to_aileron].Cl > 0.05);
  CHECK(d.control[to_elevator].CL > 0.1);
  CHECK(d.control[to_rudder].CY > 0.01);
  CHECK(d.control[to_rudder].Cn < -0.01);
}

TEST_CASE("a wing that is given as two halves is the mirrored one, and one half alone rolls") {
  Drawn one = simple_wing(2, Spacing::cosine, Spacing::uniform, 1);
  Drawn two = drawn(one->reference);
  for (const double side : {-1.0, 1.0}) {
    LiftingSurface& half =
        add_surface(*two, side < 0 ? "left" : "right", false, {2, 12}, Spacing::cosine, Spacing::uniform);
    half.incidence_rad = 2 * degree;
    for (const std::size_t k : {0u, 1u}) {
      WingSection w = one->surfaces[0].sections[side < 0 ? 1 - k : k];  // from left to right
      w.y_m *= side;
      half.sections.push_back(w);
    }
  }
  const FlowState state{.alpha = 0.05, .beta = 0.03, .p = 0.02};
  const Six a = solved(*one, {0.5, 0, 0}).forces(state), b = solved(*two, {0.5, 0, 0}).forces(state);
  for (double Six::*x : {&Six::CL, &Six::CD, &Six::CY, &Six::Cl, &Six::Cm, &Six::Cn})
    CHECK(near(b.*x, a.*x, 1e-9, 1e-12));
  two->surfaces[0] = two->surfaces[1];
  two->surfaces.count = 1;  // the right half
  CHECK(solved(*two, {0.5, 0, 0}).forces({.alpha = 0.05}).Cl < -0.03);
}

TEST_CASE("a long elliptic wing has lift and drag of the lifting line") {
  Drawn g = drawn({1.57079632679 * 10, 20, 0.7853981634});
  LiftingSurface& wing = add_surface(*g, "wing", true, {1, 24}, Spacing::cosine, Spacing::tip);
  for (int i = 0; i <= 12; ++i) {
    const double y = std::sin(i * 15 * degree / 2 * 0.995), chord = std::sqrt(1 - y * y);
    add_section(wing, {-0.25 * chord, 10 * y, 0, chord});
  }
  const Vlm vlm = solved(*g, {0, 0, 0});
  const double AR = 400 / g->reference.area_m2;
  const SixDerivatives d = vlm.derivatives({.alpha = 3 * degree});
  CHECK(near(d.alpha.CL, 2 * pi * AR / (AR + 2), 0.02));
  const auto far = vlm.far_field({.alpha = 3 * degree});
  CHECK(near(far.CL * far.CL / (pi * AR * far.CD), 1, 0.01));
}

TEST_CASE("panels on each other are refused") {
  Drawn g = simple_wing(1, Spacing::uniform, Spacing::uniform, 0);
  g->surfaces.push_back(g->surfaces[0]);
  CHECK_THROWS_WITH(solved(*g, {0, 0, 0}), doctest::Contains("aero.flow_not_solvable"));
}

}  // namespace solver_test
