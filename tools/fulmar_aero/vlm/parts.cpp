// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/vlm/parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fulmar/flight/earth/atmosphere.hpp"

namespace fulmar::aero {
namespace {

using Eigen::Vector3d;

/// A body with its own second moments, the integrals of x^2, y^2, z^2 and x z about its centre.
struct Lump {
  double mass;
  Vector3d at, square;
  double xz = 0;
};

void add_lump(std::vector<Lump>& all, const Lump& one, bool mirror) {
  all.push_back(one);
  if (mirror) {
    all.push_back(one);
    all.back().at.y() *= -1;
  }
}

std::vector<Lump> lumps(const Geometry& g, const Lattice& lattice) {
  std::vector<Lump> all;
  for (std::size_t i = 0; i < g.surfaces.size(); ++i) {
    if (g.surfaces[i].mass_kg == 0) continue;
    double area = 0;
    for (const Strip& s : lattice.strips) area += s.surface == int(i) ? s.chord * s.width : 0;
    for (const Strip& s : lattice.strips) {
      if (s.surface != int(i)) continue;
      const double m = g.surfaces[i].mass_kg * s.chord * s.width / area;
      const Vector3d span = s.b - s.a, middle = 0.5 * (s.a + s.b) - Vector3d(0.5 * s.chord, 0, 0);
      all.push_back(
          {m, middle, m / 12 * Vector3d(s.chord * s.chord, span.y() * span.y(), span.z() * span.z())});
    }
  }
  for (const Body& b : g.bodies)
    if (b.mass_kg > 0)
      add_lump(all,
               {b.mass_kg,
                {b.x_m + 0.5 * b.length_m, b.y_m, b.z_m},
                b.mass_kg / 20 * Vector3d(b.length_m, b.width_m, b.height_m).cwiseAbs2()},
               b.mirror);
  for (const MassPart& m : g.masses) {
    Lump one{m.mass_kg,
             {m.x_m, m.y_m, m.z_m},
             m.mass_kg / 12 * Vector3d(m.length_m, m.width_m, m.height_m).cwiseAbs2()};
    if (m.own.xx_kgm2 + m.own.yy_kgm2 + m.own.zz_kgm2 > 0) {
      const double half = 0.5 * (m.own.xx_kgm2 + m.own.yy_kgm2 + m.own.zz_kgm2);
      one.square = {half - m.own.xx_kgm2, half - m.own.yy_kgm2, half - m.own.zz_kgm2};
      one.xz = m.own.xz_kgm2;
    }
    add_lump(all, one, m.mirror);
  }
  return all;
}

const Airfoil* airfoil_at(const Geometry& g, int i) { return i < 0 ? nullptr : &g.airfoils[std::size_t(i)]; }

}  // namespace

MassSum mass_of(const Geometry& geometry, const Lattice& lattice) {
  const std::vector<Lump> all = lumps(geometry, lattice);
  MassSum sum;
  for (const Lump& one : all) {
    sum.mass_kg += one.mass;
    sum.centre += one.mass * one.at;
  }
  if (sum.mass_kg > 0) sum.centre /= sum.mass_kg;
  Vector3d square = Vector3d::Zero();
  double xz = 0;  // both axes change sign in body axes (x aft, z up), so the product stays
  for (const Lump& one : all) {
    const Vector3d d = one.at - sum.centre;
    square += one.square + one.mass * d.cwiseAbs2();
    xz += one.xz + one.mass * d.x() * d.z();
  }
  sum.inertia = {square.y() + square.z(), square.x() + square.z(), square.x() + square.y(), xz};
  return sum;
}

Stream stream_at(double airspeed_mps, double altitude_m) {
  const Air air = standard_air_of(altitude_m);
  const double T = air.temperature_kelvin;
  return {airspeed_mps, air.density_kgm3, 1.458e-6 * T * std::sqrt(T) / (T + 110.4)};
}

double skin_friction(double reynolds) { return 0.455 / std::pow(std::log10(std::max(reynolds, 1e3)), 2.58); }

double section_drag(const Airfoil* airfoil, double cl, double reynolds) {
  static const Airfoil flat{};
  const Airfoil& a = airfoil ? *airfoil : flat;
  const double t = airfoil ? a.thickness_frac : 0.03;
  // form factor with the thickest place at 0.3 of the chord; both sides, and the surface is longer than the
  // chord
  const double least =
      a.cd_min_ratio > 0
          ? a.cd_min_ratio * (a.reynolds_ratio > 0 ? std::pow(reynolds / a.reynolds_ratio, -0.2) : 1)
          : skin_friction(reynolds) * (1 + 0.6 / 0.3 * t + 100 * std::pow(t, 4)) * (1.977 + 0.52 * t);
  return least + a.cd_rise_ratio * std::pow(cl - a.cl_at_cd_min_ratio, 2);
}

double profile_drag(const Geometry& geometry, const Lattice& lattice, const Eigen::VectorXd& strip_lift,
                    const Stream& stream) {
  double sum = 0;
  for (std::size_t i = 0; i < lattice.strips.size(); ++i) {
    const Strip& s = lattice.strips[i];
    const double cl = strip_lift[Eigen::Index(i)], re = stream.reynolds(s.chord);
    const double cd = (1 - s.share) * section_drag(airfoil_at(geometry, s.airfoil_in), cl, re) +
                      s.share * section_drag(airfoil_at(geometry, s.airfoil_out), cl, re);
    sum += cd * s.chord * s.width;
  }
  return sum / geometry.reference.area_m2;
}

double body_drag(const Geometry& geometry, const Stream& stream) {
  double sum = 0;
  for (const Body& b : geometry.bodies) {
    // wetted area of an ellipsoid: K. Thomsen's formula, within 1.1 %
    const double x = b.length_m / 2, y = b.width_m / 2, z = b.height_m / 2, k = 1.6075;
    const double wet =
        4 * pi * std::pow((std::pow(x * y, k) + std::pow(x * z, k) + std::pow(y * z, k)) / 3, 1 / k);
    const double slender = b.length_m / std::sqrt(b.width_m * b.height_m);
    const double form = 1 + 60 / std::pow(slender, 3) + slender / 400;
    sum += (b.mirror ? 2 : 1) * (skin_friction(stream.reynolds(b.length_m)) * form * wet + b.drag_area_m2);
  }
  return sum / geometry.reference.area_m2;
}

void add_bodies(const Geometry& geometry, SixDerivatives& sum) {
  const ReferenceQuantities& r = geometry.reference;
  for (const Body& b : geometry.bodies) {
    const double width = std::sqrt(b.width_m * b.height_m),
                 volume = pi / 6 * b.length_m * b.width_m * b.height_m;
    if (b.length_m <= 1.01 * width) continue;  // no moment on a sphere
    // apparent masses along and across of an ellipsoid of revolution: Lamb, Hydrodynamics (1932), section 114
    const double e2 = 1 - std::pow(width / b.length_m, 2), e = std::sqrt(e2),
                 log = std::log((1 + e) / (1 - e));
    const double alpha0 = 2 * (1 - e2) / (e2 * e) * (0.5 * log - e),
                 beta0 = 1 / e2 - (1 - e2) / (2 * e2 * e) * log;
    const double more = beta0 / (2 - beta0) - alpha0 / (2 - alpha0);
    const double turning = (b.mirror ? 2 : 1) * 2 * more * volume / r.area_m2;
    sum.alpha.Cm += turning / r.chord_m;
    sum.beta.Cn -= turning / r.span_m;
  }
}

double propeller_normal_force(const PropellerPart& propeller, double radius_m, double radps,
                              const Stream& stream) {
  if (!(radps > 0)) return 0;
  const double V = stream.airspeed_mps;
  return propeller.blades / 4.0 * stream.density_kgm3 * 2 * pi * propeller.blade_chord_m * V * V * V / radps *
         std::asinh(radps * radius_m / V);
}

void add_propeller(const PropellerPart& propeller, double newton_per_rad, const Stream& stream,
                   const ReferenceQuantities& reference, const Eigen::Vector3d& centre, SixDerivatives& sum) {
  const double q = 0.5 * stream.density_kgm3 * stream.airspeed_mps * stream.airspeed_mps;
  const double k = newton_per_rad / (q * reference.area_m2);
  const double ahead = centre.x() - propeller.x_m, c = ahead / reference.chord_m,
               b = ahead / reference.span_m;
  sum.alpha.CL += k;
  sum.alpha.Cm += k * c;
  sum.beta.CY -= k;
  sum.beta.Cn -= k * b;
  // a propeller ahead has a smaller angle when the nose rises
  sum.q.CL -= 2 * k * c;
  sum.q.Cm -= 2 * k * c * c;
  sum.r.CY -= 2 * k * b;
  sum.r.Cn -= 2 * k * b * b;
}

double propeller_speed(const Propulsion& p, double thrust_newton, const Stream& stream) {
  // T / (rho D^4) = CT0 n^2 + CT1 n V/D + CT2 (V/D)^2, Beard & McLain, supplement to chapter 4
  const double D = p.propeller_diameter_m, v = stream.airspeed_mps / D;
  const double a = p.ct0_ratio, b = p.ct1_ratio * v;
  const double c = p.ct2_ratio * v * v - thrust_newton / (stream.density_kgm3 * std::pow(D, 4));
  const double root = b * b - 4 * a * c;
  if (a <= 0 || root < 0) return 0;
  return 2 * pi * std::max(0.0, (-b + std::sqrt(root)) / (2 * a));
}

}  // namespace fulmar::aero
