// SPDX-License-Identifier: BSD-3-Clause
// Course, height and bank that lead onto a line, an orbit or a curve and along it.
// Source: Beard & McLain, Small Unmanned Aircraft (2012), chapter 10: (10.8) lines, (10.13) orbits; (9.14)
// coordinated turn in wind.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/path/curve.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"
#include "reckoning.hpp"

namespace fulmar::path {

/// Parameters of the approach to lines, orbits and curves, for each component that follows them.
struct FieldParams {
  Param chi_infinity{1.05, "rad", 0.1, 1.57, "approach angle to a line at large distance"};
  Param k_path{0.05, "1/m", 0.001, 1, "gain of the approach to a line, at the reference speed"};
  Param k_orbit{1.5, "ratio", 0.05, 20, "gain of the approach to an orbit, at the reference speed"};
  Param reference_speed{
      17, "m/s", 1, 200,
      "ground speed at which k_path and k_orbit hold; the gains fall with the ground speed"};
  Param lead_time{0.42, "s", 0, 5, "lead time of the bank command before a change of curvature"};
  Param roll_max{0.785, "rad", 0, 1.4, "limit of the bank that is fed forward"};
};

struct VectorField {
  static constexpr const char* doc =
      "Guidance along a line, an orbit or a curve by a vector field of courses.";
  struct Inputs {
    In<VehicleState> state;
    In<Path> path;
  };
  struct Outputs {
    GuidanceCommand command;
    Probe cross_track_m;   // right of a line is positive; outside an orbit is positive
    Probe height_error_m;  // above the path is positive
    OutQueue<Notice, 2> notices;
  };
  struct Params {
    FieldParams field;
    Param reckon_std{50, "m", 0, 1000,
                     "largest standard deviation of the position for path following without a fix"};
    Param reckon_time{
        115, "s", 0, 3600,
        "largest time of path following after the position became invalid, 5 s after the last fix"};
    Param lost_radius{100, "m", 20, 5000, "radius of the circle that is flown after a lost position"};
  };

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out);

  /// Nearest point of the path, and the course that leads onto it.
  struct Aim {
    double path_course = 0, cross = 0, chi_c = 0, height = 0, kappa = 0, climb = 0;
  };
  // `k`: factor of the gains at this ground speed
  static Aim at_line(const Path& path, const VehicleState& s, const FieldParams& p, double k);
  static Aim at_orbit(const Path& path, const VehicleState& s, const FieldParams& p, double k);
  static Aim at_curve(const Path& path, const VehicleState& s, const FieldParams& p, double k);
  static double curvature_ahead(const Path& path, const VehicleState& s, const FieldParams& p,
                                const Aim& aim);
  static double onto_line(const Aim& aim, const FieldParams& p, double k) {
    return aim.path_course -
           p.chi_infinity * (2 / std::numbers::pi) * std::atan(p.k_path * k * aim.cross);  // (10.8)
  }

 private:
  /// The place of the path is unknown: a circle through the air to the right, at the last commanded height
  /// and speed. Straight on while the attitude is unknown too.
  Status wait(const Tick& tick, const VehicleState& state, const Params& p, Outputs& out) {
    constexpr double g = 9.80665;
    const bool circles = state.attitude_valid && state.velocity_valid;
    const double Va = std::max(state.airspeed_mps, 1.0);
    last_.climb_rate_mps = 0;
    if (circles) last_.course_rad = state.course_rad;
    last_.roll_feedforward_rad =
        circles ? std::clamp(std::atan(Va * Va / (g * p.lost_radius)), 0.0, p.field.roll_max.value) : 0;
    out.command = last_;
    out.cross_track_m = 0.0;
    out.height_error_m = 0.0;
    if (!waits_) report(path_messages::position_lost.c_str(), Severity::critical, tick, out);
    waits_ = true;
    return Status::degraded;
  }
  static void report(const char* words, Severity severity, const Tick& tick, Outputs& out) {
    Notice notice;
    notice.severity = severity;
    notice.cause = Cause::gnss_lost;
    notice.text = words;
    out.notices.push(notice, tick.now_ns);
  }

  GuidanceCommand last_;
  Reckoning reckoning_;
  bool commanded_ = false, waits_ = false;
};

/// Bank that turns the ground track at curvature kappa (right positive): chi_dot = Vg kappa = g/Vg tan(phi)
/// cos(chi - psi), B&M (9.14).
inline double bank_for(double kappa, double Vg, double chi_minus_psi, double roll_max) {
  constexpr double g = 9.80665;
  const double crab =
      std::max(std::cos(chi_minus_psi), 0.5);  // beyond 60 deg of crab the formula is not valid
  return std::clamp(std::atan(Vg * Vg * kappa / (g * crab)), -roll_max, roll_max);
}

inline VectorField::Aim VectorField::at_line(const Path& path, const VehicleState& s, const FieldParams& p,
                                             double k) {
  const double n = s.position_m.north - path.origin_m.north, e = s.position_m.east - path.origin_m.east;
  const Vec3<Ned>& q = path.direction_ratio;
  const double level = std::hypot(q.north, q.east);
  const double q_n = level > 1e-6 ? q.north / level : std::cos(s.course_rad),
               q_e = level > 1e-6 ? q.east / level : std::sin(s.course_rad);
  Aim aim;
  aim.climb = level > 1e-6 ? -q.down / level : 0;
  aim.path_course = std::atan2(q_e, q_n);
  aim.cross = q_n * e - q_e * n;
  aim.chi_c = onto_line(aim, p, k);
  aim.height = -path.origin_m.down + aim.climb * (n * q_n + e * q_e);  // (10.5), at the projection
  return aim;
}

inline VectorField::Aim VectorField::at_orbit(const Path& path, const VehicleState& s, const FieldParams& p,
                                              double k) {
  constexpr double pi = std::numbers::pi;
  const double n = s.position_m.north - path.origin_m.north, e = s.position_m.east - path.origin_m.east;
  const double side = path.turn == Turn::right ? 1 : -1, R = std::max(path.radius_m, 1.0);
  const double d = std::hypot(n, e),
               azimuth = d > 1e-6 ? std::atan2(e, n) : wrap_pi(s.course_rad - side * pi / 2);
  Aim aim;
  aim.cross = d - R;
  aim.kappa = side / R;
  aim.path_course = azimuth + side * pi / 2;
  aim.chi_c = aim.path_course + side * std::atan(p.k_orbit * k * aim.cross / R);  // (10.13)
  aim.climb = path.climb_ratio;
  aim.height = -path.origin_m.down + aim.climb * side * R * wrap_pi(azimuth - path.start_rad);
  return aim;
}

/// Follows the tangent at the nearest point. The bank is that of the point that the aircraft reaches after
/// the time to roll.
inline VectorField::Aim VectorField::at_curve(const Path& path, const VehicleState& s, const FieldParams& p,
                                              double k) {
  const Curve curve = curve_of(path);
  const double u = curve.closest(s.position_m.north, s.position_m.east);
  const Vec3<Ned> at = curve.point(u);
  const double n = s.position_m.north - at.north, e = s.position_m.east - at.east;
  Aim aim;
  aim.path_course = curve.course_rad(u);
  aim.cross = std::cos(aim.path_course) * e - std::sin(aim.path_course) * n;
  aim.chi_c = onto_line(aim, p, k);
  aim.climb = curve.climb_ratio(u);
  aim.height = -at.down;
  const double ahead = s.ground_speed_mps * p.lead_time / std::max(curve.speed(u), 1.0);
  aim.kappa = curve.curvature(std::min(u + ahead, 1.0));
  return aim;
}

/// Curvature for the bank feed-forward. That of the next piece is commanded early by the time to roll. Far
/// from the path it is not used.
inline double VectorField::curvature_ahead(const Path& path, const VehicleState& s, const FieldParams& p,
                                           const Aim& aim) {
  const bool on_path = std::abs(aim.cross) < 0.5 * std::max(path.radius_m, 20.0) &&
                       std::abs(angle_difference(aim.path_course, s.course_rad)) < std::numbers::pi / 2;
  if (on_path)
    return path.remaining_m < s.ground_speed_mps * p.lead_time ? path.next_curvature_ratio : aim.kappa;
  if (path.is_curve || path.kind == PathKind::line) return 0;
  return aim.kappa * std::clamp(1.5 - std::abs(aim.cross) / path.radius_m, 0.0, 1.0);
}

inline Status VectorField::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const VehicleState& state = *in.state;
  const Path& path = *in.path;
  if (!reckoning_.located(state, tick.now_ns, p.reckon_std, p.reckon_time) && commanded_)
    return wait(tick, state, p, out);
  if (waits_) report(path_messages::position_back.c_str(), Severity::info, tick, out);
  waits_ = false;
  const double Vg = state.ground_speed_mps, chi = state.course_rad;
  // The same time constant at any speed.
  const double k = p.field.reference_speed / std::max(Vg, 0.3 * p.field.reference_speed);
  const Aim aim = path.is_curve                 ? at_curve(path, state, p.field, k)
                  : path.kind == PathKind::line ? at_line(path, state, p.field, k)
                                                : at_orbit(path, state, p.field, k);
  const double kappa = curvature_ahead(path, state, p.field, aim);
  out.command.course_rad = wrap_pi(aim.chi_c);
  out.command.height_m = aim.height;
  out.command.climb_rate_mps = aim.climb * Vg * std::cos(chi - aim.path_course);
  out.command.airspeed_mps = path.airspeed_mps;
  out.command.roll_feedforward_rad =
      bank_for(kappa, Vg, angle_difference(chi, state.yaw_rad), p.field.roll_max);
  out.cross_track_m = aim.cross;
  out.height_error_m = state.height_m - aim.height;
  last_ = out.command;
  commanded_ = true;
  return state.position_valid ? Status::ok : Status::degraded;
}

}  // namespace fulmar::path
