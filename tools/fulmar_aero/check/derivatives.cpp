// SPDX-License-Identifier: BSD-3-Clause
// Signs and sizes of the derivatives. The usual range of each comes from sets of small aircraft, computed
// (AVL, XFLR5, VSPAERO) or identified in flight, slightly widened.
#include <array>
#include <cmath>

#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

constexpr double per_degree = 180 / std::numbers::pi;

struct Rule {
  const char* field;
  const char* symbol;
  double Derivatives::*of;
  Derivatives Aerodynamics::*table;
  double low, high;       ///< usual, signed
  Verdict wrong_sign;     ///< verdict for a value of the other sign
  const char* otherwise;  ///< effect of the other sign on the aircraft, and its likely cause
};

using D = Derivatives;
using A = Aerodynamics;
constexpr Verdict fault = Verdict::fault, warning = Verdict::warning;

const std::array<Rule, 17> rules{{
    {"aero.lift.alpha_ratio", "CL_alpha", &D::alpha_ratio, &A::lift, 3, 7, fault,
     "more angle of attack would lift less"},
    {"aero.lift.q_ratio", "CL_q", &D::q_ratio, &A::lift, 2, 18, warning,
     "a tail behind the wing adds lift when the nose goes up"},
    {"aero.lift.elevator_ratio", "CL_de", &D::elevator_ratio, &A::lift, 0.05, 1.2, warning,
     "trailing edge down would lift less: XFLR5's CZde points down, so its sign turns (a canard may have it "
     "so)"},
    {"aero.side.beta_ratio", "CY_beta", &D::beta_ratio, &A::side, -1.2, -0.05, fault,
     "air from the right would push it to the right"},
    {"aero.side.rudder_ratio", "CY_dr", &D::rudder_ratio, &A::side, 0.03, 0.6, warning,
     "trailing edge left pushes the tail to the right: is the sign that of another hinge convention (AVL, "
     "VSPAERO)?"},
    {"aero.roll.beta_ratio", "Cl_beta", &D::beta_ratio, &A::roll, -0.28, -0.005, warning,
     "it rolls into the sideslip, as with negative dihedral"},
    {"aero.roll.p_ratio", "Cl_p", &D::p_ratio, &A::roll, -0.8, -0.15, fault, "rolling would speed itself up"},
    {"aero.roll.r_ratio", "Cl_r", &D::r_ratio, &A::roll, 0.01, 0.5, warning,
     "the outer wing of a yaw has more lift, not less"},
    {"aero.roll.aileron_ratio", "Cl_da", &D::aileron_ratio, &A::roll, 0.05, 1.3, fault,
     "positive aileron rolls right, and this one rolls left: turn the sign of the whole column, and "
     "`reversed` of the servo if need be"},
    {"aero.pitch.alpha_ratio", "Cm_alpha", &D::alpha_ratio, &A::pitch, -3, -0.1, fault,
     "the aircraft is statically unstable in pitch: is the sign wrong, or the centre of gravity behind the "
     "neutral point?"},
    {"aero.pitch.q_ratio", "Cm_q", &D::q_ratio, &A::pitch, -45, -3, fault, "pitching would speed itself up"},
    {"aero.pitch.elevator_ratio", "Cm_de", &D::elevator_ratio, &A::pitch, -2.8, -0.15, fault,
     "positive elevator is trailing edge down and takes the nose down, and this one takes it up: turn the "
     "sign of the whole column"},
    {"aero.yaw.beta_ratio", "Cn_beta", &D::beta_ratio, &A::yaw, 0.02, 0.3, fault,
     "the nose turns away from the wind: is the sign that of another axis (VSPAERO's CMz for CMn), or the "
     "fin too small?"},
    {"aero.yaw.r_ratio", "Cn_r", &D::r_ratio, &A::yaw, -0.4, -0.004, fault, "yawing would speed itself up"},
    {"aero.yaw.rudder_ratio", "Cn_dr", &D::rudder_ratio, &A::yaw, -0.25, -0.015, fault,
     "positive rudder is trailing edge left and takes the nose left, and this one takes it right: turn the "
     "sign of the whole column"},
    {"aero.yaw.p_ratio", "Cn_p", &D::p_ratio, &A::yaw, -0.2, 0.15, warning, ""},
    {"aero.parasite_drag_ratio", "CD_p", nullptr, nullptr, 0.008, 0.12, fault,
     "the aircraft would be driven by its drag"},
}};

double value_of(const Rule& rule, const Aerodynamics& aero) {
  return rule.of ? aero.*(rule.table).*(rule.of) : aero.parasite_drag_ratio;
}

bool usual(const Rule& rule, double value) { return value >= rule.low && value <= rule.high; }

bool by_angle(const Rule& rule) {
  return rule.of == &D::alpha_ratio || rule.of == &D::beta_ratio || rule.of == &D::aileron_ratio ||
         rule.of == &D::elevator_ratio || rule.of == &D::rudder_ratio;
}

/// ": is it per degree? ...", or "" when no common mistake explains the size.
std::string likely_mistake(const Rule& rule, const Airframe& a, double value) {
  if (by_angle(rule) && usual(rule, value * per_degree))
    return aero_messages::derivative_per_degree(figures(value * per_degree)).line();
  if (by_angle(rule) && usual(rule, value / per_degree))
    return aero_messages::derivative_converted_twice(figures(value / per_degree)).line();
  const double b = a.wing.span_m, c = a.wing.chord_m;
  if (rule.of == &D::q_ratio && usual(rule, value * b / c))
    return aero_messages::rate_by_span(figures(value * b / c)).line();
  if (rule.of == &D::q_ratio && usual(rule, value * 2))
    return aero_messages::pitch_rate_doubled(figures(2 * value)).line();
  const bool across = rule.of == &D::p_ratio || rule.of == &D::r_ratio;
  if (across && usual(rule, value * 2)) return aero_messages::roll_rate_doubled(figures(2 * value)).line();
  return "";
}

bool of_control(const Rule& rule) {
  return rule.of == &D::aileron_ratio || rule.of == &D::elevator_ratio || rule.of == &D::rudder_ratio;
}

/// Far outside of the values of real aircraft: by a factor of five, or 1.5 when degrees explain it. A
/// stability derivative whose other sign is only doubtful may be small: the dihedral effect of an Anaconda is
/// -0.002.
bool absurd(const Rule& rule, double value, bool explained) {
  const double most = std::max(std::abs(rule.low), std::abs(rule.high));
  const double least = rule.low * rule.high > 0 ? std::min(std::abs(rule.low), std::abs(rule.high)) : 0;
  const double times = explained ? 1.5 : 5;
  const bool may_be_small = rule.wrong_sign == warning && !of_control(rule);
  return std::abs(value) > times * most || (!may_be_small && std::abs(value) < least / times);
}

std::string no_rudder(const Airframe& a) {
  if (a.rudder.limit_rad > 0) return aero_messages::rudder_ineffective().line();
  return aero_messages::rudder_missing().line();
}

void missing(Findings& f, const Rule& rule) {
  if (rule.of == &D::rudder_ratio)
    f.warn(rule.field, 0, aero_messages::rudder_derivative_zero(rule.symbol, no_rudder(f.file().airframe)));
  else if (rule.wrong_sign == warning || rule.of == &D::beta_ratio)
    f.warn(rule.field, 0, aero_messages::derivative_omitted(rule.symbol));
  else
    f.fault(rule.field, 0, aero_messages::coefficient_zero(rule.symbol));
}

void check_one(Findings& f, const Rule& rule) {
  const Airframe& a = f.file().airframe;
  const double value = value_of(rule, f.aero());
  f.looked_at();
  if (usual(rule, value)) return;
  const bool sided = rule.low * rule.high > 0;
  if (value == 0 && sided) return missing(f, rule);
  if (sided && value * rule.low < 0) {
    const auto sentence = aero_messages::derivative_sign_wrong(
        rule.symbol, figures(value), rule.low > 0 ? "positive" : "negative", rule.otherwise);
    return rule.wrong_sign == fault ? f.fault(rule.field, value, sentence)
                                    : f.warn(rule.field, value, sentence);
  }
  const std::string mistake = likely_mistake(rule, a, value);
  const auto sentence = aero_messages::derivative_unusual(rule.symbol, figures(value), figures(rule.low),
                                                          figures(rule.high), mistake);
  const bool degrees = by_angle(rule) && !mistake.empty();
  return absurd(rule, value, degrees) ? f.fault(rule.field, value, sentence)
                                      : f.warn(rule.field, value, sentence);
}

}  // namespace

void check_derivatives(Findings& f) {
  for (const Rule& rule : rules) check_one(f, rule);
}

}  // namespace fulmar::aero
