// SPDX-License-Identifier: BSD-3-Clause
// Terms that a symmetric aircraft does not have, and drag that is counted twice.
#include <array>
#include <cmath>

#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

using D = Derivatives;

struct Term {
  const char* name;
  double D::*of;
};
constexpr std::array<Term, 5> lateral_terms{{{"beta_ratio", &D::beta_ratio},
                                             {"p_ratio", &D::p_ratio},
                                             {"r_ratio", &D::r_ratio},
                                             {"aileron_ratio", &D::aileron_ratio},
                                             {"rudder_ratio", &D::rudder_ratio}}};
constexpr std::array<Term, 4> longitudinal_terms{{{"zero_ratio", &D::zero_ratio},
                                                  {"alpha_ratio", &D::alpha_ratio},
                                                  {"q_ratio", &D::q_ratio},
                                                  {"elevator_ratio", &D::elevator_ratio}}};

/// Lift, drag and pitch by lateral quantities; side force, roll and yaw by angle of attack and elevator.
template <std::size_t N>
void check_cross(Findings& f, const char* table, const D& of, const std::array<Term, N>& terms, double most,
                 const MessageText<1>& why) {
  for (const Term& term : terms) {
    f.looked_at();
    const double value = of.*(term.of);
    if (std::abs(value) > most)
      f.warn(std::string("aero.") + table + "." + term.name, value, why(figures(value)));
  }
}

/// A quadratic drag term makes a linear one a residue of a fit.
void check_drag_of_sideslip(Findings& f) {
  f.looked_at(4);
  const Aerodynamics& aero = f.file().airframe.aero;
  const double linear = aero.drag.beta_ratio, square = aero.drag_squared.beta_ratio;
  if (linear != 0 && square > 0) {
    const double least = -linear / (2 * square);
    f.warn("aero.drag.beta_ratio", linear,
           aero_messages::sideslip_drag_asymmetric(figures(linear), figures(square), degrees(least, 1)));
  }
  const std::pair<const char*, double> squares[] = {{"beta_ratio", square},
                                                    {"aileron_ratio", aero.drag_squared.aileron_ratio},
                                                    {"elevator_ratio", aero.drag_squared.elevator_ratio},
                                                    {"rudder_ratio", aero.drag_squared.rudder_ratio}};
  for (const auto& [name, value] : squares)
    if (value < 0)
      f.fault(std::string("aero.drag_squared.") + name, value,
              aero_messages::squared_drag_negative(figures(value)));
}

void check_drag(Findings& f) {
  const Airframe& a = f.file().airframe;
  const Aerodynamics& aero = a.aero;
  f.looked_at(3);
  if (aero.parasite_drag_ratio > 0 && aero.drag.zero_ratio > 0)
    f.warn("aero.drag.zero_ratio", aero.drag.zero_ratio,
           aero_messages::parasite_drag_doubled(figures(aero.parasite_drag_ratio)));
  if (aero.drag.alpha_ratio != 0 && has_induced_drag(a.wing))
    f.warn("aero.drag.alpha_ratio", aero.drag.alpha_ratio, aero_messages::induced_drag_doubled());
  const double change = std::abs(aero.drag.elevator_ratio) * a.elevator.limit_rad;
  const double left = aero.parasite_drag_ratio + std::max(aero.drag.zero_ratio, 0.0);
  if (change > left && left > 0)
    f.fault("aero.drag.elevator_ratio", aero.drag.elevator_ratio,
            aero_messages::elevator_drag_excessive(figures(change), figures(left)));
  if (aero.drag.q_ratio != 0 && std::abs(aero.drag.q_ratio) > 1)
    f.warn("aero.drag.q_ratio", aero.drag.q_ratio,
           aero_messages::pitch_rate_drag_unusual(figures(aero.drag.q_ratio)));
}

void check_adverse_yaw(Findings& f) {
  f.looked_at();
  const Aerodynamics& aero = f.file().airframe.aero;
  if (aero.roll.aileron_ratio == 0) return;
  const double part = aero.yaw.aileron_ratio / aero.roll.aileron_ratio;
  f.figure("adverse_yaw_ratio", part, "aileron yaw to roll", figures(part));
  if (part < -0.15)
    f.warn("aero.yaw.aileron_ratio", aero.yaw.aileron_ratio,
           aero_messages::adverse_yaw_high(figures(aero.yaw.aileron_ratio), figures(part)));
  else if (part > 0.02)
    f.warn("aero.yaw.aileron_ratio", aero.yaw.aileron_ratio,
           aero_messages::proverse_yaw(figures(aero.yaw.aileron_ratio), figures(part)));
}

void check_rudder_pair(Findings& f) {
  f.looked_at();
  const Aerodynamics& aero = f.file().airframe.aero;
  if (aero.side.rudder_ratio * aero.yaw.rudder_ratio <= 0) return;
  f.warn("aero.side.rudder_ratio", aero.side.rudder_ratio,
         aero_messages::rudder_signs_equal(figures(aero.side.rudder_ratio), figures(aero.yaw.rudder_ratio)));
}

}  // namespace

void check_symmetry(Findings& f) {
  const Aerodynamics& aero = f.file().airframe.aero;
  const auto& cross = aero_messages::cross_derivative_nonzero;
  check_cross(f, "lift", aero.lift, lateral_terms, 0.02 * std::max(1.0, aero.lift.alpha_ratio), cross);
  check_cross(f, "pitch", aero.pitch, lateral_terms, 0.02, cross);
  Derivatives drag = aero.drag;
  if (aero.drag_squared.beta_ratio > 0) drag.beta_ratio = 0;  // reported with the square
  check_cross(f, "drag", drag, lateral_terms, 1e-3, aero_messages::drag_sided);
  for (const auto& [table, of] : {std::pair{"side", &aero.side}, {"roll", &aero.roll}, {"yaw", &aero.yaw}})
    check_cross(f, table, *of, longitudinal_terms, 0.01, aero_messages::turning_bias);
  check_drag_of_sideslip(f);
  check_drag(f);
  check_adverse_yaw(f);
  check_rudder_pair(f);
}

}  // namespace fulmar::aero
