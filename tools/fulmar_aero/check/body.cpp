// SPDX-License-Identifier: BSD-3-Clause
// Mass, inertia and wing: consistency, in SI units.
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

struct UnitOfInertia {
  const char* name;
  double factor;
};
constexpr std::array<UnitOfInertia, 5> inertia_units{
    {{"kg cm^2", 1e-4}, {"g cm^2", 1e-7}, {"kg mm^2", 1e-6}, {"lb in^2", 2.9264e-4}, {"slug ft^2", 1.35582}}};

/// Radius of gyration over span: 0.08 to 0.2 in real aircraft; 0.289 for a rod.
constexpr double min_gyration = 0.04, max_gyration = 0.26;

bool plausible(double inertia, const Airframe& a) {
  const double part = std::sqrt(inertia / a.mass_kg) / a.wing.span_m;
  return part >= min_gyration && part <= max_gyration;
}

void check_gyration(Findings& f, const char* field, double inertia) {
  f.looked_at();
  const Airframe& a = f.file().airframe;
  if (plausible(inertia, a)) return;
  const double radius = std::sqrt(inertia / a.mass_kg);
  std::string hint;
  for (const UnitOfInertia& unit : inertia_units)
    if (plausible(inertia * unit.factor, a)) {
      hint = aero_messages::inertia_unit_suspect(unit.name, figures(inertia * unit.factor)).line();
      break;
    }
  const double part = radius / a.wing.span_m;
  const auto sentence = aero_messages::gyration_radius_unusual(figures(radius), figures(part), hint);
  if (part < min_gyration / 4 || part > 4 * max_gyration)
    f.fault(field, inertia, sentence);
  else
    f.warn(field, inertia, sentence);
}

/// Each principal moment is at most the sum of the two others: Goldstein, Classical Mechanics, section 5.3.
void check_triangle(Findings& f) {
  f.looked_at();
  const Inertia& i = f.file().airframe.inertia;
  const double middle = 0.5 * (i.xx_kgm2 + i.zz_kgm2), half = 0.5 * (i.xx_kgm2 - i.zz_kgm2);
  const double spread = std::hypot(half, i.xz_kgm2);
  std::array<double, 3> principal{middle - spread, i.yy_kgm2, middle + spread};
  std::sort(principal.begin(), principal.end());
  if (principal[0] <= 0)
    return f.fault("inertia.xz_kgm2", i.xz_kgm2,
                   aero_messages::inertia_not_definite(figures(principal[0]),
                                                       figures(std::sqrt(i.xx_kgm2 * i.zz_kgm2))));
  if (principal[2] <= principal[0] + principal[1]) return;
  f.warn("inertia", principal[2],
         aero_messages::inertia_moments_impossible(figures(principal[0]), figures(principal[1]),
                                                   figures(principal[2]), figures(i.xz_kgm2),
                                                   figures(i.xx_kgm2), figures(i.yy_kgm2)));
}

void check_wing(Findings& f) {
  f.looked_at(3);
  const Airframe& a = f.file().airframe;
  const double S = a.wing.area_m2, b = a.wing.span_m, c = a.wing.chord_m;
  if (const double part = c * b / S; part < 0.7 || part > 1.5)
    f.fault("wing.chord_m", c, aero_messages::wing_dimensions_inconsistent(figures(part)));
  if (const double AR = b * b / S; AR < 2 || AR > 40)
    f.warn("wing.span_m", b, aero_messages::aspect_ratio_unusual(figures(AR)));
  if ((a.wing.oswald_ratio > 1.1 && has_induced_drag(a.wing)) || a.wing.oswald_ratio < 0.4)
    f.warn("wing.oswald_ratio", a.wing.oswald_ratio,
           aero_messages::oswald_factor_unusual(figures(a.wing.oswald_ratio)));
}

void check_loading(Findings& f) {
  f.looked_at();
  const Airframe& a = f.file().airframe;
  const double loading = a.mass_kg / a.wing.area_m2;
  f.figure("wing_loading_kgpm2", loading, "wing loading", figures(loading) + " kg/m2");
  if (loading >= 0.5 && loading <= 150) return;
  f.fault("mass_kg", a.mass_kg,
          aero_messages::wing_loading_unusual(figures(loading), loading > 150
                                                                    ? aero_messages::mass_unit_suspect()
                                                                    : aero_messages::area_unit_suspect()));
}

}  // namespace

void check_body(Findings& f) {
  const Inertia& i = f.file().airframe.inertia;
  check_loading(f);
  check_wing(f);
  check_gyration(f, "inertia.xx_kgm2", i.xx_kgm2);
  check_gyration(f, "inertia.yy_kgm2", i.yy_kgm2);
  check_gyration(f, "inertia.zz_kgm2", i.zz_kgm2);
  check_triangle(f);
}

}  // namespace fulmar::aero
