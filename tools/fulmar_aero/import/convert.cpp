// SPDX-License-Identifier: BSD-3-Clause
// Merges several files to one aircraft: priorities, contradictions, and the values that the model of the
// simulator needs at angle of attack 0.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "tools/fulmar_aero/import/aircraft.hpp"
#include "tools/fulmar_aero/import/lines.hpp"
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

struct Chosen {
  const Input* input = nullptr;
  Analysis analysis;
};

std::string short_name(const Input& input) { return std::filesystem::path(input.file).filename().string(); }

double lift_wanted(const Analysis& a, double mass) {
  const double flow = 0.5 * a.density_kgm3 * a.airspeed_mps * a.airspeed_mps * a.area_m2.x;
  return mass > 0 && flow > 0 ? mass * 9.80665 / flow : 0;
}

/// The point of a sweep: nearest to the requested one, to level flight, or to zero pitching moment.
Analysis chosen_of(const Input& input, const ImportOptions& options, double mass,
                   std::vector<std::string>& notes) {
  if (input.analyses.size() == 1) return input.analyses[0];
  const auto distance = [&](const Analysis& a) {
    if (options.alpha_rad > -10) return std::abs(a.alpha_rad.x - options.alpha_rad);
    const double wanted = lift_wanted(a, mass);
    return wanted > 0 && wanted < 1.4 ? std::abs(a.base[lift].x - wanted) : std::abs(a.base[pitch].x);
  };
  const Analysis* best = nullptr;
  for (const Analysis& a : input.analyses)
    if (!best || distance(a) < distance(*best)) best = &a;
  notes.push_back(fulmar::located(
      short_name(input),
      aero_messages::analysis_chosen(input.analyses.size(), degrees(best->alpha_rad.x, 1),
                                     options.alpha_rad > -10 ? "--alpha" : "level flight without elevator")));
  return *best;
}

/// Converts to other reference lengths: forces by area, moments by length, rates by length.
void rescale(Analysis& a, const Analysis& to) {
  const double S = a.area_m2.x / to.area_m2.x;
  const double b = a.span_m.x / to.span_m.x, c = a.chord_m.x / to.chord_m.x;
  const auto column = [&](Column& of, double rate) {
    for (std::size_t i = 0; i < forces; ++i)
      of[i].x *= S * rate * (i == pitch ? c : i == roll || i == yaw ? b : 1);
  };
  column(a.base, 1);
  column(a.slope[alpha], 1);
  column(a.slope[beta], 1);
  column(a.slope[p], b);
  column(a.slope[q], c);
  column(a.slope[r], b);
  for (Control& control : a.controls) column(control.of, 1);
  a.area_m2 = to.area_m2;
  a.chord_m = to.chord_m;
  a.span_m = to.span_m;
}

void refuse_another_aircraft(const Chosen& first, const Chosen& other) {
  const auto far = [&](const Value& a, const Value& b, const char* what, const char* unit) {
    if (std::abs(a.x - b.x) <= 0.25 * std::abs(a.x)) return;
    throw core::Error(located(other.input->file,
                              aero_messages::reference_mismatch(what, figures(b.x, 5), unit, b.from,
                                                                figures(a.x, 5), unit, first.input->file)));
  };
  far(first.analysis.area_m2, other.analysis.area_m2, "area", " m2");
  far(first.analysis.span_m, other.analysis.span_m, "span", " m");
  far(first.analysis.chord_m, other.analysis.chord_m, "chord", " m");
}

/// Logs of several groups of controls must be of the same flight.
void refuse_another_trim(const Chosen& first, const Chosen& other) {
  if (!first.analysis.weak_lateral || !other.analysis.weak_lateral) return;
  const double da = std::abs(first.analysis.alpha_rad.x - other.analysis.alpha_rad.x);
  const double dv = std::abs(first.analysis.airspeed_mps - other.analysis.airspeed_mps);
  if (da < 1e-3 && dv < 0.01 * first.analysis.airspeed_mps) return;
  throw core::Error(located(
      other.input->file, aero_messages::trim_mismatch(degrees(other.analysis.alpha_rad.x),
                                                      figures(other.analysis.airspeed_mps, 4),
                                                      first.input->file, degrees(first.analysis.alpha_rad.x),
                                                      figures(first.analysis.airspeed_mps, 4))));
}

void report_differences(const Chosen& first, const Chosen& other, std::vector<std::string>& notes) {
  if (std::abs(first.analysis.alpha_rad.x - other.analysis.alpha_rad.x) > 0.02) {
    notes.push_back(short_name(*other.input) + " is at alpha " + degrees(other.analysis.alpha_rad.x, 1) +
                    ", and " + short_name(*first.input) + " at " + degrees(first.analysis.alpha_rad.x, 1));
  }
  std::string differ;
  for (std::size_t by = 0; by < bys; ++by)
    for (std::size_t force = 0; force < forces; ++force) {
      const Value &a = first.analysis.slope[by][force], &b = other.analysis.slope[by][force];
      if (!a.known || !b.known) continue;
      if (std::abs(a.x - b.x) <= 0.05 * std::abs(a.x) + 0.003) continue;
      differ += std::string(differ.empty() ? "" : ", ") + force_symbol(Force(force)) + "_" +
                by_symbol(By(by)) + " " + figures(a.x) + " and " + figures(b.x);
    }
  if (!differ.empty())
    notes.push_back(
        aero_messages::derivatives_differ(short_name(*first.input), short_name(*other.input), differ));
}

/// Adds controls unless their role exists: of two files the first one counts.
void take_controls(const Chosen& from, std::vector<Control>& all, std::vector<const Input*>& owners,
                   std::vector<std::string>& notes) {
  const std::size_t before = all.size();
  for (const Control& control : from.analysis.controls) {
    const Role role = role_of(control);
    bool taken = false;
    for (std::size_t i = 0; i < before && !taken; ++i) {
      if (owners[i] == from.input || role_of(all[i]) != role) continue;
      if (role == Role::mixed && all[i].name != control.name) continue;
      taken = true;
      const Force main = role == Role::elevator ? pitch
                         : role == Role::rudder ? yaw
                         : role == Role::flap   ? lift
                                                : roll;
      const double a = std::abs(all[i].of[main].x), b = std::abs(control.of[main].x);
      if (std::abs(a - b) > 0.02 * a + 1e-4)
        notes.push_back(std::string(force_symbol(main)) + " of " +
                        (control.name.empty() ? "a control" : control.name) + " is " + figures(a) + " in " +
                        short_name(*owners[i]) + " and " + figures(b) + " in " + short_name(*from.input) +
                        "; the first is taken");
    }
    if (taken) continue;
    all.push_back(control);
    owners.push_back(from.input);
  }
}

void set_body(const std::vector<Input>& inputs, const ImportOptions& options, Aircraft& out, Body& body) {
  std::string from;
  for (const Input& input : inputs) {
    const Body& own = input.body;
    if (!own.mass_kg.known) continue;
    if (!body.mass_kg.known) {
      body = own;
      from = short_name(input);
      continue;
    }
    if (!body.xx.known && own.xx.known) {
      body.xx = own.xx;
      body.yy = own.yy;
      body.zz = own.zz;
      body.xz = own.xz;
    }
    if (!body.has_cg && own.has_cg) {
      body.cg_m = own.cg_m;
      body.has_cg = true;
    }
    if (std::abs(own.mass_kg.x - body.mass_kg.x) > 0.01 * body.mass_kg.x)
      out.warnings.push_back("the mass is " + figures(body.mass_kg.x, 4) + " kg in " + from + " and " +
                             figures(own.mass_kg.x, 4) + " kg in " + short_name(input) +
                             "; the first is taken");
  }
  if (options.mass_kg > 0) body.mass_kg = {options.mass_kg, "--mass"};
  if (options.inertia[0] > 0) {
    body.xx = {options.inertia[0], "--inertia"};
    body.yy = {options.inertia[1], "--inertia"};
    body.zz = {options.inertia[2], "--inertia"};
    body.xz = {options.inertia[3], "--inertia"};
  }
  out.mass_kg = body.mass_kg;
  out.xx = body.xx;
  out.yy = body.yy;
  out.zz = body.zz;
  out.xz = body.xz;
}

void move_to_gravity(Analysis& a, const Body& body, const Input& input, Aircraft& out) {
  if (!body.has_cg || !a.has_reference) return;
  const double dx = body.cg_m[0] - a.reference_m[0], dz = body.cg_m[2] - a.reference_m[2];
  if (std::hypot(dx, dz) < 1e-4 * a.chord_m.x) return;
  move_reference(a, dx, dz);
  const double part = std::hypot(dx, dz) / a.chord_m.x;
  if (part > 0.5)
    out.warnings.push_back(fulmar::located(
        short_name(input), aero_messages::reference_moved_far(figures(dx), figures(dz), figures(part))));
  else
    out.notes.push_back(
        fulmar::located(short_name(input), aero_messages::reference_moved(figures(dx), figures(dz))));
}

/// CD_p + CL^2/(pi e AR) = CD
double parasite_of(double CD, double CL, const Aircraft& a) {
  const double AR = a.span_m.x * a.span_m.x / a.area_m2.x;
  return CD - CL * CL / (std::numbers::pi * a.oswald.x * AR);
}

/// A potential flow's parasite drag is only rounding.
constexpr double no_friction = 0.002, assumed_friction = 0.03;
/// Both sides of a smooth plate at a Reynolds number of a million: a lower bound.
constexpr double min_friction = 0.008;

constexpr double polar_reach = 3 * degree;

const PolarPoint* nearest_point(const std::vector<PolarPoint>& polar, double alpha) {
  const PolarPoint* best = nullptr;
  for (const PolarPoint& point : polar)
    if (!best || std::abs(point.alpha_rad - alpha) < std::abs(best->alpha_rad - alpha)) best = &point;
  return best;
}

void set_drag(const Analysis& a, const std::vector<Input>& inputs, const ImportOptions& options,
              Aircraft& out) {
  out.converted_parasite = parasite_of(a.base[drag].x, a.base[lift].x, out);
  const std::string share = " - CL^2/(pi e AR)";
  out.parasite = {out.converted_parasite, a.base[drag].from + share};
  for (const Input& input : inputs) {
    const bool wins = !options.drag_from.empty() && input.file == options.drag_from;
    if (out.parasite.x >= no_friction && !wins) continue;
    double CD = 0, CL = 0;
    std::string from;
    if (const PolarPoint* const point = nearest_point(input.polar, a.alpha_rad.x)) {
      CD = point->CD.x;
      CL = point->CL;
      from = point->CD.from;
      if (const double far = std::abs(point->alpha_rad - a.alpha_rad.x); CL != 0 && far > polar_reach)
        out.warnings.push_back(short_name(input) + ": its nearest point is " + degrees(far, 1) +
                               " from the angle that was analysed: is it of another sweep, or cut off?");
    } else if (wins && !input.analyses.empty()) {
      const Analysis& other = input.analyses[0];
      CD = other.base[drag].x;
      CL = other.base[lift].x;
      from = other.base[drag].from;
    } else {
      continue;
    }
    if (const double left = parasite_of(CD, CL, out); left >= no_friction) {
      out.parasite = {left, from + share};
      out.notes.push_back("drag is taken from " + short_name(input));
    }
  }
  if (options.parasite_drag > 0) out.parasite = {options.parasite_drag, "--parasite-drag"};
  if (out.parasite.x >= no_friction && out.parasite.x < min_friction)
    out.warnings.push_back(aero_messages::friction_small(figures(out.parasite.x), out.parasite.from));
  if (out.parasite.x >= no_friction) return;
  out.warnings.push_back(aero_messages::friction_missing(figures(out.parasite.x), figures(assumed_friction)));
  out.parasite = {assumed_friction, "assumption: the files have no friction (they leave " +
                                        figures(out.converted_parasite) +
                                        "); small aircraft have 0.02 to 0.05"};
}

void set_slopes(const Analysis& a, Aircraft& out) {
  const auto take = [&](Force force, By by, Term term) { out.c[force][term] = a.slope[by][force]; };
  for (const Force force : {lift, pitch}) {
    take(force, alpha, t_alpha);
    take(force, q, t_q);
  }
  if (a.slope[q][drag].known) out.c[drag][t_q] = a.slope[q][drag];
  for (const Force force : {side, roll, yaw}) {
    take(force, beta, t_beta);
    take(force, p, t_p);
    take(force, r, t_r);
  }
}

void set_controls(const ControlColumns& columns, Aircraft& out) {
  constexpr std::array<Term, 4> term{t_aileron, t_elevator, t_rudder, t_flap};
  for (std::size_t role = 0; role < 4; ++role) {
    if (!columns.known[role]) continue;
    const bool symmetric = role == std::size_t(Role::elevator) || role == std::size_t(Role::flap);
    for (const Force force : {lift, drag, side, roll, pitch, yaw}) {
      const bool longitudinal = force == lift || force == drag || force == pitch;
      if (longitudinal == symmetric) out.c[force][term[role]] = columns.of[role][force];
    }
  }
  out.elevons = columns.elevons;
  out.v_tail = columns.v_tail;
  for (const std::string& note : columns.notes) out.notes.push_back(note);
}

/// Extrapolates from the analysed angle of attack and deflections to 0.
void set_zero(const Analysis& a, Aircraft& out) {
  for (const Force force : {lift, pitch}) {
    double zero = a.base[force].x - a.slope[alpha][force].x * a.alpha_rad.x;
    bool deflected = false;
    for (const Control& control : a.controls) {
      zero -= control.of[force].x * control.at_rad;
      deflected = deflected || control.at_rad != 0;
    }
    out.c[force][t_zero] = {zero, a.base[force].from + " - " + force_symbol(force) + "_alpha " +
                                      degrees(a.alpha_rad.x) + (deflected ? " - deflections" : "")};
  }
  for (const Force force : {side, roll, yaw})
    if (std::abs(a.base[force].x) > 1e-3)
      out.notes.push_back(std::string(force_symbol(force)) + " is " + figures(a.base[force].x) +
                          " in the analysis (" + a.base[force].from +
                          "); a symmetric aircraft has 0, and 0 is taken");
}

/// Coefficients that a symmetric aircraft does not have show the convergence of the analysis.
void report_convergence(const Analysis& a, const Input& input, Aircraft& out) {
  double most = 0;
  std::string which;
  const auto look = [&](By by, Force force) {
    const Value& value = a.slope[by][force];
    if (!value.known || std::abs(value.x) <= most) return;
    most = std::abs(value.x);
    which = std::string(force_symbol(force)) + "_" + by_symbol(by) + " (" + value.from + ")";
  };
  look(beta, lift);
  look(beta, pitch);
  for (const Force force : {side, roll, yaw}) look(alpha, force);
  if (most > 0.05)
    out.warnings.push_back(
        fulmar::located(short_name(input), aero_messages::analysis_not_converged(which, figures(most))));
}

void set_modes(const std::vector<Input>& inputs, Aircraft& out) {
  for (const Input& input : inputs) {
    if (out.cruise_mps == 0 && input.airspeed_mps > 0) out.cruise_mps = input.airspeed_mps;
    if (input.modes.empty() || !out.modes.empty()) continue;
    out.modes = input.modes;
  }
  for (const Input& input : inputs) {  // a .eig without a speed gets that of the .run
    if (out.modes.empty() || out.modes.airspeed_mps > 0 || input.modes.airspeed_mps <= 0) continue;
    out.modes.airspeed_mps = input.modes.airspeed_mps;
    out.modes.density_kgm3 = input.modes.density_kgm3;
  }
}

std::vector<Chosen> all_chosen(const std::vector<Input>& inputs, const ImportOptions& options, double mass,
                               Aircraft& out) {
  std::vector<Chosen> all;
  for (const Input& input : inputs) {
    for (const std::string& note : input.notes) out.notes.push_back(short_name(input) + ": " + note);
    for (const std::string& one : input.doubts) out.warnings.push_back(short_name(input) + ": " + one);
    if (!input.unused.empty()) out.notes.push_back(short_name(input) + ": not used, " + input.unused);
    if (!input.analyses.empty()) all.push_back({&input, chosen_of(input, options, mass, out.notes)});
  }
  if (!all.empty()) return all;
  std::string files;
  for (const Input& input : inputs)
    files += "\n  " + input.file + ": " + input.what + (input.unused.empty() ? "" : ", " + input.unused);
  throw core::Error(aero_messages::derivatives_missing(files));
}

void divide_by_gains(std::vector<Control>& controls, const std::vector<Input>& inputs,
                     std::vector<std::string>& notes) {
  for (const Input& input : inputs)
    for (const auto& [name, gain] : input.gains)
      for (Control& control : controls) {
        if (control.name != name || !(gain > 0) || std::abs(gain - 1) < 1e-6) continue;
        for (Value& value : control.of) {
          value.x /= gain;
          value.from += ", by its gain " + figures(gain);
        }
        notes.push_back(name + ": divided by its gain " + figures(gain) +
                        ", to be per radian of its surfaces");
      }
}

}  // namespace

Aircraft aircraft_of(const std::vector<Input>& inputs, const ImportOptions& options) {
  Aircraft out;
  Body body;
  set_body(inputs, options, out, body);
  std::vector<Chosen> all = all_chosen(inputs, options, body.mass_kg.x, out);
  Chosen& first = all[0];
  for (const Input& input : inputs) {
    out.sources.push_back(input.what + ": " + short_name(input));
    if (out.name.empty() && !input.title.empty()) out.name = input.title;
  }
  if (!options.name.empty()) out.name = options.name;
  for (std::size_t i = 1; i < all.size(); ++i) {
    refuse_another_aircraft(first, all[i]);
    refuse_another_trim(first, all[i]);
    rescale(all[i].analysis, first.analysis);
    report_differences(first, all[i], out.notes);
  }
  out.area_m2 = first.analysis.area_m2;
  out.chord_m = first.analysis.chord_m;
  out.span_m = first.analysis.span_m;
  for (Chosen& one : all) move_to_gravity(one.analysis, body, *one.input, out);
  std::vector<Control> controls;
  std::vector<const Input*> owners;
  for (const Chosen& one : all)
    if (one.input->file == options.controls_from) take_controls(one, controls, owners, out.notes);
  for (const Chosen& one : all)
    if (one.input->file != options.controls_from) take_controls(one, controls, owners, out.notes);
  divide_by_gains(controls, inputs, out.notes);
  set_slopes(first.analysis, out);
  set_zero(first.analysis, out);
  if (!controls.empty()) set_controls(control_columns(controls), out);
  set_drag(first.analysis, inputs, options, out);
  for (const Chosen& one : all) report_convergence(one.analysis, *one.input, out);
  set_modes(inputs, out);
  if (first.analysis.density_kgm3 > 0) out.density_kgm3 = first.analysis.density_kgm3;
  if (out.cruise_mps == 0) out.cruise_mps = first.analysis.airspeed_mps;
  if (first.analysis.weak_lateral) out.notes.push_back(aero_messages::lateral_derivatives_uncertain());
  return out;
}

}  // namespace fulmar::aero::imports
