// SPDX-License-Identifier: BSD-3-Clause
// Parts outside the lattice: sections, masses, skin, bodies, propellers.
#include "tools/fulmar_aero/vlm/parts.hpp"

#include <cmath>

#include "tools/fulmar_aero/vlm/test/vlm_kit.hpp"

namespace parts_test {

using namespace fulmar::aero;
using namespace fulmar::aero::test;
using fulmar::Inertia;

namespace {

/// So long that its middle is a section in plane flow.
Drawn long_wing(const char* naca, Airfoil airfoil = {}) {
  Drawn g = drawn({400, 400, 1});
  airfoil.name = "section";
  airfoil.naca = naca;
  g->airfoils.push_back(airfoil);
  LiftingSurface& wing = add_surface(*g, "wing", true, {20, 6}, Spacing::cosine, Spacing::tip);
  add_section(wing, {-0.25, 0, 0, 1});
  add_section(wing, {-0.25, 200, 0, 1});
  for (WingSection& w : wing.sections) w.airfoil = "section";
  return g;
}

double lift(const Geometry& g, double alpha) { return solved(g, {0, 0, 0}).forces({.alpha = alpha}).CL; }

}  // namespace

TEST_CASE("the mean line of NACA 2412, its angle of no lift, and a section that is known by that angle") {
  Drawn g = long_wing("2412");
  CHECK(camber_slope(g->airfoils[0], 0) == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(std::abs(camber_slope(g->airfoils[0], 0.4)) < 1e-12);
  CHECK(camber_slope(g->airfoils[0], 1) == doctest::Approx(-0.04 / 0.6).epsilon(1e-12));
  const double none =
      -2.077 * degree;  // thin airfoil theory, Anderson, Fundamentals of Aerodynamics, section 4.8
  CHECK(std::abs(lift(*g, none)) < 0.003);
  CHECK(near(lift(*g, none + 0.05), 2 * pi * 0.05, 0.02));
  Airfoil known;
  known.alpha_zero_rad = none;
  CHECK(std::abs(lift(*long_wing("", known), none)) < 1e-6);
  Airfoil line;
  for (const double x : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    line.camber_x_frac.push_back(x);
    line.camber_z_frac.push_back(x < 0.4 ? 0.125 * (0.8 * x - x * x) : 0.02 / 0.36 * (0.2 + 0.8 * x - x * x));
  }
  CHECK(std::abs(lift(*long_wing("", line), none)) < 0.02);
}

TEST_CASE("a quarter-chord flap turns as much as thin airfoils say") {
  Drawn g = long_wing("0009");
  ControlSurface flap;
  flap.drives = Drives::flap;
  flap.to_m = 200;
  flap.hinge_frac = 0.75;
  g->surfaces[0].controls.push_back(flap);
  const SixDerivatives d = solved(*g, {0, 0, 0}).derivatives({});
  const double angle = std::acos(1 - 2 * 0.75);  // Glauert (1926), section 10.3
  CHECK(near(d.control[to_flap].CL / d.alpha.CL, 1 - (angle - std::sin(angle)) / pi, 0.04));
}

TEST_CASE("masses: points, boxes, a sheet, an ellipsoid, and what is given") {
  Drawn g = drawn({1, 1, 1});
  const auto part = [&](double m, double x, double y, double z) -> MassPart& {
    MassPart p;
    p.mass_kg = m;
    p.x_m = x;
    p.y_m = y;
    p.z_m = z;
    g->masses.push_back(p);
    return g->masses[g->masses.size() - 1];
  };
  part(1, -1, 0, -0.1);
  part(3, 1, 0, 0.3);
  MassSum sum = mass_of(*g, {});
  CHECK(sum.mass_kg == 4);
  CHECK(sum.centre.x() == doctest::Approx(0.5).epsilon(1e-12));
  CHECK(sum.centre.z() == doctest::Approx(0.2).epsilon(1e-12));
  // reduced mass 3/4 kg at distances 2 and 0.4: the aft one is higher, which in body axes is behind and up
  CHECK(sum.inertia.xx_kgm2 == doctest::Approx(0.75 * 0.16).epsilon(1e-12));
  CHECK(sum.inertia.zz_kgm2 == doctest::Approx(0.75 * 4).epsilon(1e-12));
  CHECK(sum.inertia.yy_kgm2 == doctest::Approx(0.75 * 4.16).epsilon(1e-12));
  CHECK(sum.inertia.xz_kgm2 == doctest::Approx(0.75 * 0.8).epsilon(1e-12));

  g->masses.clear();
  MassPart& box = part(12, 0, 0.5, 0);
  box.length_m = 1;
  box.width_m = 2;
  box.height_m = 3;
  box.mirror = true;
  sum = mass_of(*g, {});
  CHECK(sum.mass_kg == 24);
  CHECK(std::abs(sum.centre.y()) < 1e-12);
  CHECK(sum.inertia.xx_kgm2 == doctest::Approx(2 * (4 + 9 + 12 * 0.25)).epsilon(1e-12));
  CHECK(sum.inertia.yy_kgm2 == doctest::Approx(2 * (1 + 9.0)).epsilon(1e-12));

  g->masses.clear();
  part(5, 0.1, 0, 0.2).own = Inertia{0.25, 0.38, 0.61, 0.05};
  sum = mass_of(*g, {});
  CHECK(sum.inertia.xx_kgm2 == doctest::Approx(0.25).epsilon(1e-12));
  CHECK(sum.inertia.yy_kgm2 == doctest::Approx(0.38).epsilon(1e-12));
  CHECK(sum.inertia.zz_kgm2 == doctest::Approx(0.61).epsilon(1e-12));
  CHECK(sum.inertia.xz_kgm2 == doctest::Approx(0.05).epsilon(1e-12));

  g->masses.clear();
  LiftingSurface& wing = add_surface(*g, "wing", true, {1, 10}, Spacing::cosine, Spacing::cosine);
  wing.mass_kg = 2;
  add_section(wing, {1, 0, 0, 0.5});
  add_section(wing, {1, 3, 0, 0.5});
  sum = mass_of(*g, lattice_of(*g));  // a plate of 6 m by 0.5 m
  CHECK(sum.mass_kg == doctest::Approx(2).epsilon(1e-12));
  CHECK(sum.centre.x() == doctest::Approx(1.25).epsilon(1e-12));
  CHECK(sum.inertia.xx_kgm2 == doctest::Approx(2 * 36 / 12.0).epsilon(1e-9));
  CHECK(sum.inertia.yy_kgm2 == doctest::Approx(2 * 0.25 / 12).epsilon(1e-9));

  g->surfaces.clear();
  Body body;
  body.length_m = 2;
  body.width_m = 0.4;
  body.height_m = 0.6;
  body.mass_kg = 10;
  g->bodies.push_back(body);
  sum = mass_of(*g, {});
  CHECK(sum.centre.x() == doctest::Approx(1).epsilon(1e-12));
  CHECK(sum.inertia.xx_kgm2 == doctest::Approx(10 * (0.2 * 0.2 + 0.3 * 0.3) / 5).epsilon(1e-12));
  CHECK(sum.inertia.yy_kgm2 == doctest::Approx(10 * (1 + 0.3 * 0.3) / 5).epsilon(1e-12));
}

TEST_CASE("skin friction, and a section's polar at another Reynolds number") {
  CHECK(near(skin_friction(1e7), 0.00300, 0.01));  // Schlichting, Boundary-Layer Theory (1979), table 21.1
  CHECK(near(skin_friction(1e6), 0.00447, 0.01));
  const Stream sea = stream_at(20, 0);
  CHECK(near(sea.viscosity_pas, 1.7894e-5, 1e-3));  // ISO 2533
  CHECK(near(sea.reynolds(0.25), 342300, 1e-3));
  CHECK(near(stream_at(20, 5000).viscosity_pas, 1.628e-5, 2e-3));
  Airfoil a;
  a.cd_min_ratio = 0.01;
  a.cl_at_cd_min_ratio = 0.3;
  a.cd_rise_ratio = 0.02;
  a.reynolds_ratio = 2e5;
  CHECK(section_drag(&a, 0.3, 2e5) == doctest::Approx(0.01).epsilon(1e-12));
  CHECK(section_drag(&a, -0.2, 2e5) == doctest::Approx(0.015).epsilon(1e-12));
  CHECK(near(section_drag(&a, 0.3, 6.4e6), 0.005, 1e-9));  // 32 times the Reynolds number
  // a plate of both sides, by hand: 2 * 0.00447 and 3 % of thickness
  CHECK(near(section_drag(nullptr, 0, 1e6), 2 * 0.00447, 0.07));
}

TEST_CASE("a wing has the drag of its sections, a body that of its skin") {
  Airfoil a;
  a.cd_min_ratio = 0.012;
  a.cd_rise_ratio = 0;
  Drawn g = long_wing("0009", a);
  const Lattice lattice = lattice_of(*g);
  CHECK(near(profile_drag(*g, lattice, Eigen::VectorXd::Zero(long(lattice.strips.size())), stream_at(15, 0)),
             0.012, 1e-6));
  g->reference.area_m2 = 0.4;
  Body body;
  body.length_m = 1;
  body.width_m = body.height_m = 0.1;
  g->bodies.push_back(body);
  const double once = body_drag(*g, stream_at(15, 0));
  // prolate of 10 to 1: wetted 2 pi b^2 (1 + a / (b e) asin e) = 0.2487 m^2; form 1.085
  CHECK(near(once, skin_friction(stream_at(15, 0).reynolds(1)) * 1.085 * 0.24869 / 0.4, 0.012));
  g->bodies[0].drag_area_m2 = 0.004;
  CHECK(near(body_drag(*g, stream_at(15, 0)) - once, 0.01, 1e-9));
  g->bodies[0].mirror = true;
  CHECK(near(body_drag(*g, stream_at(15, 0)), 2 * (once + 0.01), 1e-9));
}

TEST_CASE("a body turns across the stream: ten times as long as wide") {
  Drawn g = drawn({0.4, 1.8, 0.22});
  Body body;
  body.length_m = 1;
  body.width_m = body.height_m = 1 / 9.97;
  g->bodies.push_back(body);
  SixDerivatives d;
  add_bodies(*g, d);
  const double volume = pi / 6 / (9.97 * 9.97);
  CHECK(near(d.alpha.Cm, 2 * (0.960 - 0.021) * volume / (0.4 * 0.22), 0.002));  // Lamb's table, Munk (1924)
  CHECK(near(d.beta.Cn, -2 * (0.960 - 0.021) * volume / (0.4 * 1.8), 0.002));
  g->bodies[0].length_m = 0.1;  // a ball
  SixDerivatives ball;
  add_bodies(*g, ball);
  CHECK(ball.alpha.Cm == 0);
}

TEST_CASE("a propeller in oblique flow: blade elements summed by hand") {
  const Stream s = stream_at(15, 0);
  PropellerPart p;
  p.blades = 3;
  p.blade_chord_m = 0.02;
  p.x_m = -0.4;
  const double R = 0.165, omega = 450, h = 1e-6;
  // an element's tangential force over a little more tangential speed, the blade at zero lift, over azimuth
  // and radius
  double sum = 0;
  for (int i = 0; i < 2000; ++i) {
    const double r = (i + 0.5) * R / 2000;
    const auto tangential = [&](double u) {
      const double across = omega * r + u, W = std::hypot(across, s.airspeed_mps);
      const double angle = std::atan(s.airspeed_mps / (omega * r)) - std::atan(s.airspeed_mps / across);
      return 0.5 * s.density_kgm3 * p.blade_chord_m * 2 * pi * angle * W * s.airspeed_mps;  // L sin(phi)
    };
    sum += 0.5 * p.blades * s.airspeed_mps * (tangential(h) - tangential(-h)) / (2 * h) * R / 2000;
  }
  const double normal = propeller_normal_force(p, R, omega, s);
  CHECK(near(normal, sum, 0.01));
  SixDerivatives d;
  add_propeller(p, normal, s, {0.4, 1.8, 0.22}, {0.1, 0, 0}, d);
  const double k = normal / (0.5 * s.density_kgm3 * 225 * 0.4);
  CHECK(near(d.alpha.CL, k, 1e-9));
  CHECK(near(d.alpha.Cm, k * 0.5 / 0.22, 1e-9));  // ahead of the centre of gravity: the nose goes on up
  CHECK(near(d.beta.CY, -k, 1e-9));
  CHECK(near(d.beta.Cn, -k * 0.5 / 1.8, 1e-9));
  CHECK(near(d.q.Cm, -2 * k * 0.25 / (0.22 * 0.22), 1e-9));
  CHECK(near(d.r.Cn, -2 * k * 0.25 / (1.8 * 1.8), 1e-9));
  CHECK(propeller_normal_force(p, R, 0, s) == 0);
}

TEST_CASE("the speed at which a propeller has a thrust") {
  fulmar::Propulsion p;
  p.propeller_diameter_m = 0.3;
  p.ct0_ratio = 0.1;
  p.ct1_ratio = -0.05;
  p.ct2_ratio = -0.1;
  const Stream s = stream_at(12, 0);
  const double omega = propeller_speed(p, 3, s), n = omega / (2 * pi), J = 12 / (n * 0.3);
  CHECK(near(s.density_kgm3 * n * n * std::pow(0.3, 4) * (0.1 - 0.05 * J - 0.1 * J * J), 3, 1e-9));
  CHECK(propeller_speed({}, 3, s) == 0);
}

}  // namespace parts_test
