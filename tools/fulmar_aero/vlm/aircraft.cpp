// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/vlm/aircraft.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "tools/fulmar_aero/vlm/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// Limit for the change of a control's main moment from a sixth of the panels to all: some two thirds of it
/// remain as an error, which is proportional to the size of the panels.
constexpr double max_power_change = 0.15;
constexpr double steepest = 25 * degree;  // beyond it the lattice is not valid

double lift_needed(const Geometry& g, const MassSum& mass, const Stream& s) {
  return mass.mass_kg * isa::g0 /
         (0.5 * s.density_kgm3 * s.airspeed_mps * s.airspeed_mps * g.reference.area_m2);
}

/// Angle of attack with that lift; NaN when it is beyond the range of the lattice.
double alpha_for(const Vlm& vlm, double CL) {
  double low = -steepest, high = steepest;
  if (vlm.forces({.alpha = high}).CL < CL || vlm.forces({.alpha = low}).CL > CL) return std::nan("");
  for (int i = 0; i < 50; ++i) {
    const double mid = 0.5 * (low + high);
    (vlm.forces({.alpha = mid}).CL < CL ? low : high) = mid;
  }
  return 0.5 * (low + high);
}

double cl_max_at(const Geometry& g, const Strip& s) {
  const auto of = [&](int i) {
    return i < 0 ? 0.8 : g.airfoils[std::size_t(i)].cl_max_ratio;
  };  // a flat plate
  return (1 - s.share) * of(s.airfoil_in) + s.share * of(s.airfoil_out);
}

/// The critical section: the wing stalls when the first of its sections reaches its maximum lift. Phillips &
/// Alley, Predicting Maximum Lift Coefficient for Twisted Wings Using Lifting-Line Theory (2007).
void find_stall(const Geometry& g, const Lattice& lattice, const Vlm& vlm, Aircraft& a) {
  for (double alpha = 0; alpha < steepest; alpha += 0.1 * degree) {
    const Eigen::VectorXd cl = vlm.strip_lift({.alpha = alpha});
    for (std::size_t i = 0; i < lattice.strips.size(); ++i) {
      if (cl[Eigen::Index(i)] < cl_max_at(g, lattice.strips[i])) continue;
      a.airframe.wing.stall_alpha_rad = std::max(alpha, degree);
      a.stalls_first = std::string(g.surfaces[std::size_t(lattice.strips[i].surface)].name.view());
      a.stall_y_m = std::abs(0.5 * (lattice.strips[i].a.y() + lattice.strips[i].b.y()));
      return;
    }
  }
  a.airframe.wing.stall_alpha_rad = steepest;
}

/// CD = CD_p + CL^2 / (pi e AR) by least squares over the speed range.
void fit_polar(const Geometry& g, const Lattice& lattice, const Vlm& vlm, Aircraft& a) {
  const double AR = g.reference.span_m * g.reference.span_m / g.reference.area_m2;
  const double to = 0.85 * a.airframe.wing.stall_alpha_rad;
  const double fastest = std::max(g.limits.airspeed_max_mps, 1.1 * a.stream.airspeed_mps);
  const double least = lift_needed(g, a.mass, a.stream) * std::pow(a.stream.airspeed_mps / fastest, 2);
  const double from = std::min(alpha_for(vlm, least), a.alpha_rad - degree);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (int i = 0; i < 12; ++i) {
    const FlowState s{.alpha = from + (to - from) * i / 11};
    const double CL = vlm.forces(s).CL,
                 CD = vlm.far_field(s).CD + profile_drag(g, lattice, vlm.strip_lift(s), a.stream);
    n += 1;
    x += CL * CL;
    y += CD;
    xx += CL * CL * CL * CL;
    xy += CL * CL * CD;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  a.airframe.wing.oswald_ratio = g.oswald_ratio > 0 ? g.oswald_ratio : 1 / (pi * AR * slope);
  a.airframe.aero.parasite_drag_ratio = (y - slope * x) / n + a.body_drag;
}

Derivatives column(const SixDerivatives& d, double Six::*c) {
  Derivatives out;
  out.zero_ratio = d.value.*c;
  out.alpha_ratio = d.alpha.*c;
  out.beta_ratio = d.beta.*c;
  out.p_ratio = d.p.*c;
  out.q_ratio = d.q.*c;
  out.r_ratio = d.r.*c;
  out.aileron_ratio = d.control[to_aileron].*c;
  out.elevator_ratio = d.control[to_elevator].*c;
  out.rudder_ratio = d.control[to_rudder].*c;
  out.flap_ratio = d.control[to_flap].*c;
  for (double* x :
       {&out.zero_ratio, &out.alpha_ratio, &out.beta_ratio, &out.p_ratio, &out.q_ratio, &out.r_ratio,
        &out.aileron_ratio, &out.elevator_ratio, &out.rudder_ratio, &out.flap_ratio})
    if (std::abs(*x) < 5e-6) *x = 0;  // rounding error in a symmetric aircraft
  return out;
}

/// Values at alpha 0, as in the model: C(alpha) = C_0 + C_alpha alpha through the point of cruise.
void put_coefficients(Aircraft& a) {
  Aerodynamics& out = a.airframe.aero;
  out.lift = column(a.whole, &Six::CL);
  out.side = column(a.whole, &Six::CY);
  out.roll = column(a.whole, &Six::Cl);
  out.pitch = column(a.whole, &Six::Cm);
  out.yaw = column(a.whole, &Six::Cn);
  for (Derivatives* d : {&out.lift, &out.side, &out.roll, &out.pitch, &out.yaw})
    d->zero_ratio -= d->alpha_ratio * a.alpha_rad;
  // the polar gives the drag over alpha, the lattice that of a deflection
  out.drag.elevator_ratio = a.whole.control[to_elevator].CD;
  out.drag.flap_ratio = a.whole.control[to_flap].CD;
}

/// Signs by the effect of a control, as in `import`: an elevator ahead of the centre of gravity goes up where
/// one behind it goes down. With elevons and a V-tail a column is two surfaces, and stays.
std::string turn_controls(const Geometry& g, SixDerivatives& whole) {
  struct Sense {
    int control;
    double Six::*moment;
    double right;  ///< its sign
    const MessageText<0>& words;
  };
  constexpr std::array<Sense, 2> senses{{{to_elevator, &Six::Cm, -1, aero_messages::elevator_leading_up},
                                         {to_rudder, &Six::Cn, -1, aero_messages::rudder_leading_right}}};
  std::string turned;
  if (g.mixer != Mixer::conventional) return turned;
  for (const Sense& sense : senses) {
    Six& column = whole.control[std::size_t(sense.control)];
    if (column.*(sense.moment) * sense.right >= 0) continue;
    for (double Six::*const c : {&Six::CL, &Six::CD, &Six::CY, &Six::Cl, &Six::Cm, &Six::Cn})
      column.*c = -(column.*c);
    turned += std::string(turned.empty() ? "" : "; ") + sense.words.c_str();
  }
  return turned.empty() ? turned : fulmar::located(turned, aero_messages::servo_reversal_needed()).line();
}

SixDerivatives with_parts(const Geometry& g, const Aircraft& a, const SixDerivatives& lattice) {
  SixDerivatives whole = lattice;
  add_bodies(g, whole);
  for (const PropellerPart& p : g.propellers)
    add_propeller(
        p, propeller_normal_force(p, 0.5 * g.propulsion.propeller_diameter_m, a.propeller_radps, a.stream),
        a.stream, g.reference, a.mass.centre, whole);
  return whole;
}

void refuse_what_is_missing(const GeometryFile& file, const MassSum& mass, const Lattice& lattice) {
  const Geometry& g = *file.geometry;
  const auto refuse = [&](const char* list, const std::string& sentence) {
    throw core::Error(located(file.where(list, 1u << 20), sentence));
  };
  if (!(mass.mass_kg > 0)) refuse("surfaces", aero_messages::mass_missing());
  if (!lattice.has[to_elevator]) refuse("surfaces", aero_messages::elevator_control_missing());
  if (!lattice.has[to_aileron]) refuse("surfaces", aero_messages::aileron_control_missing());
  if (!g.propellers.empty() && !(g.propulsion.ct0_ratio > 0))
    refuse("propellers", aero_messages::propeller_thrust_missing());
}

/// Checks the convergence: a vortex close to a control point of another surface, or too few panels. The power
/// of a control converges slowest, with the size of its panels: a panel that the hinge divides turns by the
/// part behind it.
void doubt(const SixDerivatives& few, Aircraft& a) {
  const SixDerivatives& all = a.lattice;
  const double lift = few.alpha.CL / all.alpha.CL,
               margin = few.alpha.Cm / few.alpha.CL - all.alpha.Cm / all.alpha.CL;
  if (std::abs(lift - 1) >= 0.05 || std::abs(margin) >= 0.05)
    a.doubt = aero_messages::lattice_not_converged(figures(few.alpha.CL), figures(all.alpha.CL),
                                                   fixed(-few.alpha.Cm / few.alpha.CL, 3),
                                                   fixed(-all.alpha.Cm / all.alpha.CL, 3))
                  .line();
  struct Power {
    const char* name;
    double few, all;
  };
  for (const Power& p : {Power{"Cm_elevator", few.control[to_elevator].Cm, all.control[to_elevator].Cm},
                         Power{"Cl_aileron", few.control[to_aileron].Cl, all.control[to_aileron].Cl},
                         Power{"Cn_rudder", few.control[to_rudder].Cn, all.control[to_rudder].Cn}}) {
    if (std::abs(p.few - p.all) <= max_power_change * std::abs(p.all)) continue;
    a.doubt += std::string(a.doubt.empty() ? "" : "; ") +
               aero_messages::control_not_converged(p.name, figures(p.few), figures(p.all)).line();
  }
}

Vlm solved(const GeometryFile& file, const Lattice& lattice, const Eigen::Vector3d& about, double wake_rad) {
  try {
    return Vlm(lattice, file.geometry->reference, about, wake_rad);
  } catch (const core::Error& fault) {
    throw core::Error(located(file.where("surfaces", 1u << 20), fault.diagnostic));
  }
}

void lift_fault(const GeometryFile& file, double CL, const Aircraft& a, const Vlm& vlm) {
  constexpr double step = 5 * degree;
  const auto lift = [&](double alpha) { return vlm.forces({.alpha = alpha}).CL; };
  const double slope = (lift(step) - lift(-step)) / (2 * step), far = lift(steepest);
  const bool of_wings = slope > 1 && slope < 9 && far > lift(step) && lift(-steepest) < lift(-step);
  throw core::Error(
      located(file.where("limits", 1u << 20),
              aero_messages::cruise_lift_unreachable(
                  core::number_text(a.stream.airspeed_mps), figures(a.mass.mass_kg), figures(CL),
                  of_wings ? aero_messages::cruise_condition_unsuitable().line()
                           : aero_messages::lift_not_of_wings(figures(slope), figures(far)).line())));
}

}  // namespace

Aircraft aircraft_of(const GeometryFile& file, double density) {
  const Geometry& g = *file.geometry;
  Aircraft a;
  const Lattice lattice = lattice_of(g, density);
  a.panels = lattice.panels.size();
  a.mass = mass_of(g, lattice);
  refuse_what_is_missing(file, a.mass, lattice);
  a.stream = stream_at(g.limits.airspeed_cruise_mps, g.altitude_m);
  const double CL = lift_needed(g, a.mass, a.stream);
  // the wake's angle from a few panels: its effect is small, and it then lies along the stream
  const Vlm few = solved(file, lattice_of(g, 0.4 * density), a.mass.centre, 0);
  const double wake = alpha_for(few, CL);
  if (std::isnan(wake)) lift_fault(file, CL, a, few);
  const Vlm vlm = solved(file, lattice, a.mass.centre, wake);
  a.alpha_rad = alpha_for(vlm, CL);
  if (std::isnan(a.alpha_rad)) lift_fault(file, CL, a, vlm);
  const FlowState cruise{.alpha = a.alpha_rad};
  a.lattice = vlm.derivatives(cruise);
  doubt(few.derivatives(cruise), a);
  a.far = vlm.far_field(cruise);
  const double AR = g.reference.span_m * g.reference.span_m / g.reference.area_m2;
  a.e_far = a.far.CL * a.far.CL / (pi * AR * a.far.CD);
  a.skin_drag = profile_drag(g, lattice, vlm.strip_lift(cruise), a.stream);
  a.body_drag = body_drag(g, a.stream);

  Airframe& out = a.airframe;
  out.name = g.name;
  out.mass_kg = a.mass.mass_kg;
  out.inertia = a.mass.inertia;
  out.wing = {g.reference.area_m2, g.reference.span_m, g.reference.chord_m};
  out.propulsion = g.propulsion;
  out.aileron = g.aileron;
  out.elevator = g.elevator;
  out.rudder = g.rudder;
  out.flap = g.flap;
  out.mixer = g.mixer;
  out.limits = g.limits;
  out.gear = g.gear;
  find_stall(g, lattice, vlm, a);
  fit_polar(g, lattice, vlm, a);
  if (!g.propellers.empty()) {
    const double q = 0.5 * a.stream.density_kgm3 * a.stream.airspeed_mps * a.stream.airspeed_mps;
    const double drag = q * g.reference.area_m2 * (a.far.CD + a.skin_drag + a.body_drag);
    const double number = std::max<double>(1, double(g.propulsion.propellers.size()));
    a.propeller_radps = propeller_speed(g.propulsion, drag / number, a.stream);
  }
  a.whole = with_parts(g, a, a.lattice);
  a.whole.beta.CY -= out.aero.parasite_drag_ratio;  // it acts along the stream
  a.turned = turn_controls(g, a.whole);
  put_coefficients(a);
  return a;
}

std::vector<Convergence> convergence_of(const GeometryFile& file, const Aircraft& aircraft) {
  const Geometry& g = *file.geometry;
  std::vector<Convergence> out;
  for (const double density : {0.5, 0.75, 1.0, 1.4}) {
    const Lattice lattice = lattice_of(g, density);
    const Vlm vlm(lattice, g.reference, aircraft.mass.centre, aircraft.alpha_rad);
    out.push_back({density, lattice.panels.size(),
                   with_parts(g, aircraft, vlm.derivatives({.alpha = aircraft.alpha_rad}))});
    turn_controls(g, out.back().whole);
  }
  return out;
}

}  // namespace fulmar::aero
