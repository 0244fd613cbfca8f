// SPDX-License-Identifier: BSD-3-Clause
// Comparison with small aircraft: distance of each derivative from published sets; lift at zero angle of
// attack that belongs to another angle; and coefficients that equal those of another aircraft.
#include <array>
#include <cmath>

#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// Ranges of sets of small unmanned aircraft, computed with AVL, XFLR5 and VSPAERO or identified in flight:
/// Aerosonde, Anaconda, Skyhunter and Zagi (Beard & McLain; ROSflight's parameter files), UltraStick 25e in
/// flight (University of Minnesota), AVL's examples, and a 4.5 kg aircraft with all three tools.
struct ClassRange {
  const char* symbol;
  double Derivatives::*of;
  Derivatives Aerodynamics::*table;
  double low, high;
};
using ClassD = Derivatives;
using ClassA = Aerodynamics;
constexpr std::array<ClassRange, 11> class_ranges{
    {{"CL_alpha", &ClassD::alpha_ratio, &ClassA::lift, 3.5, 6.3},
     {"Cm_alpha", &ClassD::alpha_ratio, &ClassA::pitch, -2.9, -0.4},
     {"Cm_q", &ClassD::q_ratio, &ClassA::pitch, -38.3, -1.4},
     {"Cm_de", &ClassD::elevator_ratio, &ClassA::pitch, -2.6, -0.33},
     {"CY_beta", &ClassD::beta_ratio, &ClassA::side, -0.98, -0.07},
     {"Cl_beta", &ClassD::beta_ratio, &ClassA::roll, -0.28, -0.03},
     {"Cl_p", &ClassD::p_ratio, &ClassA::roll, -0.72, -0.26},
     {"Cl_da", &ClassD::aileron_ratio, &ClassA::roll, 0.08, 1.16},
     {"Cn_beta", &ClassD::beta_ratio, &ClassA::yaw, -0.0004, 0.25},
     {"Cn_r", &ClassD::r_ratio, &ClassA::yaw, -0.35, -0.004},
     {"Cn_dr", &ClassD::rudder_ratio, &ClassA::yaw, -0.12, -0.03}}};

/// 0 inside; else the distance from the range in widths of the range.
double distance_from(const ClassRange& range, double value) {
  const double width = range.high - range.low;
  return std::max({0.0, (range.low - value) / width, (value - range.high) / width});
}

void report_class(Findings& f) {
  const Airframe& a = f.file().airframe;
  std::string outside;
  int inside = 0;
  for (const ClassRange& range : class_ranges) {
    const double value = f.aero().*(range.table).*(range.of);
    if (range.of == &ClassD::rudder_ratio && !rudder_acts(a)) continue;
    const double distance = distance_from(range, value);
    f.figure(std::string("class_") + range.symbol + "_off_ratio", distance, "", "");
    if (distance == 0) {
      ++inside;
      continue;
    }
    outside += (outside.empty() ? "" : "; ") +
               aero_messages::derivative_outside_class(range.symbol, figures(value), figures(range.low),
                                                       figures(range.high), figures(distance, 2))
                   .line();
  }
  f.figure("", 0, "small aircraft",
           std::to_string(inside) + " derivatives as found in others" +
               (outside.empty() ? "" : ", outside: " + outside));
}

/// -CL_0/CL_alpha. Wings of small aircraft, camber and setting together, have zero lift at -6 to 2 deg.
void check_zero_lift(Findings& f) {
  const Aerodynamics& aero = f.aero();
  if (aero.lift.alpha_ratio <= 0) return;
  const double angle = -aero.lift.zero_ratio / aero.lift.alpha_ratio;
  f.figure("zero_lift_alpha_deg", angle / degree, "", "");
  if (angle > -6 * degree && angle < 4 * degree) return;
  f.warn(
      "aero.lift.zero_ratio", aero.lift.zero_ratio,
      aero_messages::zero_lift_unusual(figures(aero.lift.zero_ratio), degrees(angle, 1),
                                       figures(aero.lift.zero_ratio - 3 * degree * aero.lift.alpha_ratio)));
}

/// Published sets that are often copied. Aerosonde: Beard & McLain (2012), appendix E, as in rosflight_sim;
/// Skyhunter: rosflight_ros_pkgs until August 2024.
struct KnownAircraft {
  const char* name;
  double area_m2, span_m;
  Aerodynamics aero;
};
KnownAircraft aerosonde() {
  KnownAircraft k{"Aerosonde", 0.55, 2.8956, {}};
  k.aero.lift = {0.23, 5.61, 0, 0, 7.95, 0, 0, 0.13, 0, 0};
  k.aero.drag = {0, 0, 0, 0, 0, 0, 0, 0.0135, 0, 0};
  k.aero.side = {0, 0, -0.98, 0, 0, 0, 0.075, 0, 0.19, 0};
  k.aero.roll = {0, 0, -0.13, -0.51, 0, 0.25, 0.17, 0, 0.0024, 0};
  k.aero.pitch = {0.0135, -2.74, 0, 0, -38.21, 0, 0, -0.99, 0, 0};
  k.aero.yaw = {0, 0, 0.073, 0.069, 0, -0.095, -0.011, 0, -0.069, 0};
  return k;
}
KnownAircraft skyhunter() {
  KnownAircraft k{"Skyhunter", 0.4296, 1.795, {}};
  k.aero.lift = {0.31351, 5.1069, 0, 0, 8.7092, 0, 0, 0, 0, 0};
  k.aero.side = {0, 0, -0.3681, 0.07, 0, 0, 0, 0, 0, 0};
  k.aero.roll = {0, 0, -0.079, -0.5077, 0, 0.1871, 0, 0, 0, 0};
  k.aero.pitch = {0.02626, -1.2761, 0, 0, -17.8301, 0, 0, 0, 0, 0};
  k.aero.yaw = {0, 0, 0.1301, -0.0364, 0, -0.1541, 0, 0, 0, 0};
  return k;
}

struct Same {
  int same = 0, all = 0;  ///< of those that are not 0
};
Same compared(const Aerodynamics& own, const Aerodynamics& known) {
  constexpr std::array<Derivatives Aerodynamics::*, 6> tables{&ClassA::lift, &ClassA::drag,  &ClassA::side,
                                                              &ClassA::roll, &ClassA::pitch, &ClassA::yaw};
  constexpr std::array<double Derivatives::*, 9> terms{
      &ClassD::zero_ratio,    &ClassD::alpha_ratio,    &ClassD::beta_ratio,
      &ClassD::p_ratio,       &ClassD::q_ratio,        &ClassD::r_ratio,
      &ClassD::aileron_ratio, &ClassD::elevator_ratio, &ClassD::rudder_ratio};
  Same count;
  for (const auto table : tables)
    for (const auto term : terms) {
      const double value = own.*table.*term;
      if (value == 0) continue;
      ++count.all;
      count.same += std::abs(value - known.*table.*term) < 1e-9;
    }
  return count;
}

void check_copies(Findings& f, const KnownAircraft& known, int least) {
  const Airframe& a = f.file().airframe;
  const auto near = [](double x, double y) { return std::abs(x - y) < 0.01 * y; };
  if (near(a.wing.area_m2, known.area_m2) && near(a.wing.span_m, known.span_m))
    return;  // it is that aircraft
  const Same count = compared(a.aero, known.aero);
  if (count.same < least) return;
  f.warn("aero.lift.alpha_ratio", a.aero.lift.alpha_ratio,
         aero_messages::coefficients_copied(count.same, count.all, known.name));
  if (known.aero.pitch.zero_ratio != 0 && near(a.aero.pitch.zero_ratio, 10 * known.aero.pitch.zero_ratio))
    f.warn("aero.pitch.zero_ratio", a.aero.pitch.zero_ratio,
           aero_messages::pitch_coefficient_digit(figures(a.aero.pitch.zero_ratio), known.name,
                                                  figures(known.aero.pitch.zero_ratio)));
}

}  // namespace

void check_class(Findings& f) {
  report_class(f);
  check_zero_lift(f);
  check_copies(f, aerosonde(), 8);
  check_copies(f, skyhunter(), 8);
}

}  // namespace fulmar::aero
