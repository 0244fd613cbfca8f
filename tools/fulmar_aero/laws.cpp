// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/laws.hpp"

#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/turn_trim.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"

namespace fulmar::aero {
namespace {

/// Transfer functions of flight/filters.hpp and flight/pid.hpp at z, for the step T.
struct Sampled {
  Complex back;  ///< 1/z
  double T;

  Complex low_pass(double tau) const {
    const double pole = tau > 0 ? std::exp(-T / tau) : 0;
    return (1 - pole) / (1.0 - pole * back);
  }
  Complex wash_out(double w) const {
    const double x = w * T, decay = std::exp(-x), gain = x > 1e-6 ? (1 - decay) / x : 1 - x / 2;
    return gain * (1.0 - back) / (1.0 - decay * back);
  }
  Complex differentiator(double tau) const { return wash_out(1 / tau) / tau; }
  /// The input of a step counts in that step.
  Complex integral() const { return T / (1.0 - back); }
};

/// d/dVa of the trim of level flight: elevator and angle of attack, rad per m/s.
struct TrimSlope {
  double elevator, alpha;
};
TrimSlope trim_slope(const Airframe& a, const LawPoint& at) {
  const double h = 0.01 * at.Va_mps;
  const TurnTrim fast = turn_trim(a, 0, at.Va_mps + h, at.density_kgpm3),
                 slow = turn_trim(a, 0, at.Va_mps - h, at.density_kgpm3);
  return {(fast.elevator_rad - slow.elevator_rad) / (2 * h), (fast.alpha_rad - slow.alpha_rad) / (2 * h)};
}

/// Course hold and pitch trim, common to both outer laws.
void add_common(const OuterLawNumbers& p, const LawPoint& at, const Sampled& f, OuterResponse& out) {
  const double speed_ratio =
      std::clamp(at.Va_mps / std::max(at.airframe->limits.airspeed_cruise_mps, 1.0), 0.5, 2.0);
  const Complex course_gain =
      f.low_pass(p.roll_smoothing) * speed_ratio * (p.course_kp.value + p.course_ki.value * f.integral());
  out.of_goals(command::roll, goal::course) = course_gain;
  out.of_sensors(command::roll, sensor::course) = -course_gain;
  out.of_sensors(command::pitch, sensor::airspeed) +=
      trim_slope(*at.airframe, at).alpha * f.low_pass(p.airspeed_smoothing);
}

/// Parameters of both outer laws; those without a number affect no loop.
template <class Law>
std::vector<Named<Law>> outer_parameters(std::vector<Named<Law>> own) {
  std::vector<Named<Law>> all{{"course_kp", &Law::course_kp},
                              {"course_ki", &Law::course_ki},
                              {"roll_smoothing", &Law::roll_smoothing},
                              {"airspeed_smoothing", &Law::airspeed_smoothing},
                              {"takeoff_airspeed", &Law::takeoff_airspeed}};
  for (const char* other :
       {"law", "roll_limit", "roll_rate_limit", "pitch_limit", "pitch_rate_limit", "throttle_rate_limit",
        "turn_kff", "takeoff_throttle", "takeoff_pitch", "takeoff_kp", "takeoff_roll_limit",
        "launch_acceleration", "launch_speed", "launch_delay", "stall_guard", "airframe"})
    all.push_back({other, nullptr});
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

}  // namespace

const std::vector<Named<InnerLaw>>& parameters_of(const InnerLaw&) {
  using L = InnerLaw;
  static const std::vector<Named<L>> all{{"roll_kp", &L::roll_kp},
                                         {"roll_ki", &L::roll_ki},
                                         {"roll_kd", &L::roll_kd},
                                         {"roll_kff", &L::roll_kff},
                                         {"roll_from_sideslip", &L::roll_from_sideslip},
                                         {"pitch_kp", &L::pitch_kp},
                                         {"pitch_ki", &L::pitch_ki},
                                         {"pitch_kd", &L::pitch_kd},
                                         {"turn_kff", &L::turn_kff},
                                         {"yaw_kd", &L::yaw_kd},
                                         {"yaw_washout", &L::yaw_washout},
                                         {"command_filter", &L::command_filter},
                                         {"airspeed_smoothing", &L::airspeed_smoothing},
                                         {"scale_limit", &L::scale_limit},
                                         {"quieten", nullptr},
                                         {"airframe", nullptr}};
  return all;
}
const std::vector<Named<SlcLaw>>& parameters_of(const SlcLaw&) {
  using L = SlcLaw;
  static const std::vector<Named<L>> all = outer_parameters<L>({{"altitude_kp", &L::altitude_kp},
                                                                {"altitude_ki", &L::altitude_ki},
                                                                {"altitude_kd", &L::altitude_kd},
                                                                {"airspeed_kp", &L::airspeed_kp},
                                                                {"airspeed_ki", &L::airspeed_ki},
                                                                {"airspeed_kff", &L::airspeed_kff},
                                                                {"climb_kff", &L::climb_kff},
                                                                {"thrust", &L::thrust}});
  return all;
}
const std::vector<Named<TecsLaw>>& parameters_of(const TecsLaw&) {
  using L = TecsLaw;
  static const std::vector<Named<L>> all =
      outer_parameters<L>({{"altitude_gain", &L::altitude_gain},
                           {"airspeed_gain", &L::airspeed_gain},
                           {"climb_acceleration_limit", nullptr},
                           {"acceleration_filter", &L::acceleration_filter},
                           {"airspeed_filter", &L::airspeed_filter},
                           {"speed_weight", &L::speed_weight},
                           {"throttle_damping", &L::throttle_damping},
                           {"throttle_integral", &L::throttle_integral},
                           {"pitch_damping", &L::pitch_damping},
                           {"pitch_integral", &L::pitch_integral},
                           {"airspeed_kff", &L::airspeed_kff},
                           {"thrust", &L::thrust},
                           {"underspeed_band", nullptr}});
  return all;
}

InnerResponse response(const InnerLaw& p, const LawPoint& at, Complex z) {
  const Sampled f{1.0 / z, at.step_s};
  const double ratio = at.airframe->limits.airspeed_cruise_mps / at.Va_mps;
  const double scale = std::clamp(ratio * ratio, 1 / p.scale_limit, p.scale_limit.value);
  const Complex rate = f.differentiator(p.command_filter);
  const Complex roll_gain = scale * (p.roll_kp.value + p.roll_ki.value * f.integral());
  const Complex pitch_gain = scale * (p.pitch_kp.value + p.pitch_ki.value * f.integral());
  InnerResponse out;
  out.of_commands(model::aileron, command::roll) =
      roll_gain + (std::sqrt(scale) * p.roll_kff + scale * p.roll_kd) * rate;
  out.of_sensors(model::aileron, sensor::roll) = -roll_gain;
  out.of_sensors(model::aileron, sensor::p) = -scale * p.roll_kd;
  out.of_sensors(model::aileron, sensor::sideslip) = scale * p.roll_from_sideslip;
  out.of_commands(model::elevator, command::pitch) = -pitch_gain;
  out.of_sensors(model::elevator, sensor::pitch) = pitch_gain;
  out.of_sensors(model::elevator, sensor::q) = scale * p.pitch_kd;
  out.of_sensors(model::elevator, sensor::airspeed) =
      p.turn_kff * trim_slope(*at.airframe, at).elevator * f.low_pass(p.airspeed_smoothing);
  if (at.airframe->rudder.limit_rad > 0) {
    const Complex damper = scale * p.yaw_kd * f.wash_out(p.yaw_washout);
    out.of_sensors(model::rudder, sensor::r) = damper;
    out.of_sensors(model::rudder, sensor::roll) =
        -damper * isa::g0 / at.Va_mps * std::cos(at.pitch_rad);  // r of the turn
  }
  out.of_commands(model::throttle, command::throttle) = 1;
  return out;
}

OuterResponse response(const SlcLaw& p, const LawPoint& at, Complex z) {
  const Sampled f{1.0 / z, at.step_s};
  const double Va = at.Va_mps;
  OuterResponse out;
  add_common(p, at, f, out);
  const double climb_rate = p.altitude_kp * Va;  // demand per height error
  const Complex per_height =
      climb_rate / Va + p.altitude_ki.value * f.integral() + p.altitude_kd * climb_rate;
  out.of_goals(command::pitch, goal::height) = per_height;
  out.of_sensors(command::pitch, sensor::height) = -per_height;
  out.of_sensors(command::pitch, sensor::climb) = -p.altitude_kd;
  out.of_goals(command::throttle, goal::height) = p.climb_kff * climb_rate;
  out.of_sensors(command::throttle, sensor::height) = -p.climb_kff * climb_rate;
  const Complex speed = p.airspeed_kp.value + p.airspeed_ki.value * f.integral();
  out.of_goals(command::throttle, goal::airspeed) = speed + p.airspeed_kff.value;
  out.of_sensors(command::throttle, sensor::airspeed) = -speed;
  return out;
}

OuterResponse response(const TecsLaw& p, const LawPoint& at, Complex z) {
  const Sampled f{1.0 / z, at.step_s};
  const double Va = at.Va_mps, g = isa::g0;
  OuterResponse out;
  add_common(p, at, f, out);
  const double w_h = std::clamp(2 - p.speed_weight, 0.0, 1.0),
               w_V = std::clamp(p.speed_weight.value, 0.0, 1.0);
  const double pole = p.airspeed_filter > 0 ? std::exp(-at.step_s / p.airspeed_filter) : 0;
  const Complex own =
      1.0 / (1.0 - pole * f.back);  // SteadyAirspeed: (1 - pole) of the airspeed, pole T of Vdot
  const Complex measured = f.low_pass(p.acceleration_filter);
  const Complex pitch_pi = p.pitch_damping.value + p.pitch_integral.value * f.integral(),
                throttle_pi = p.throttle_damping.value + p.throttle_integral.value * f.integral();

  // pitch: [demanded climb - w_V demanded steady acceleration] (1 or w_h, and the PI) minus the present
  // values
  const Complex potential = g * p.altitude_gain * (1.0 + w_h * pitch_pi) / (g * Va);
  const Complex kinetic = w_V * Va * p.airspeed_gain * (1.0 + pitch_pi) / (g * Va);
  out.of_goals(command::pitch, goal::height) = potential;
  out.of_sensors(command::pitch, sensor::height) = -potential;
  out.of_sensors(command::pitch, sensor::climb) = -w_h * pitch_pi / Va;
  out.of_goals(command::pitch, goal::airspeed) = -kinetic;
  out.of_sensors(command::pitch, sensor::airspeed) += kinetic * (1 - pole) * own;
  out.of_sensors(command::pitch, sensor::acceleration) =
      kinetic * pole * at.step_s * own + w_V / g * pitch_pi * measured;

  // throttle: the total energy rate
  const double per_rate = at.airframe->mass_kg / (Va * p.thrust);
  const Complex total = per_rate * (1.0 + throttle_pi);
  out.of_goals(command::throttle, goal::height) = total * g * p.altitude_gain.value;
  out.of_sensors(command::throttle, sensor::height) = -total * g * p.altitude_gain.value;
  out.of_sensors(command::throttle, sensor::climb) = -per_rate * throttle_pi * g;
  out.of_goals(command::throttle, goal::airspeed) = total * Va * p.airspeed_gain.value + p.airspeed_kff.value;
  out.of_sensors(command::throttle, sensor::airspeed) = -total * Va * p.airspeed_gain.value;
  out.of_sensors(command::throttle, sensor::acceleration) = -per_rate * throttle_pi * Va * measured;
  return out;
}

}  // namespace fulmar::aero
