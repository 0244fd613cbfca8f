// SPDX-License-Identifier: BSD-3-Clause
// The controllers of ROSplane 2.0 (controller_successive_loop.cpp, controller_total_energy.cpp,
// controller_state_machine.cpp at ba7e114), written from their formulas, with the gains of its anaconda.yaml,
// as the reference for Fulmar's laws. Beard & McLain, Small Unmanned Aircraft (2012), chapter 6. Formulas,
// faults: README.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::rosplane {

enum class Law : std::uint8_t { successive_loops, total_energy };
enum class Zone : std::uint8_t { take_off, climb, altitude_hold };

/// I += Ts/2 (e + e_prev); reverted when the output is limited, in either direction, so that a saturated loop
/// cannot unwind. `mended`: only growth into the limit is reverted.
struct Integrator {
  double I = 0, e_prev = 0;

  void add(double e, double Ts) {
    I += Ts / 2 * (e + e_prev);
    e_prev = e;
  }
  /// sat( u0 + ki I, min, max ); the integration of this step is reverted when the output is limited.
  double output(double u0, double ki, double e, double min, double max, double Ts, bool mended) {
    const double before = I;
    add(e, Ts);
    const double u = u0 + ki * I, held = std::clamp(u, min, max);
    const bool unwinds = mended && (u - held) * ki * (I - before) < 0;
    if (std::abs(u - held) > 1e-4 && !unwinds) I = before;
    return held;
  }
};

struct Controller {  // fills the roles `outer` and `inner` at once
  static constexpr const char* doc =
      "ROSplane's controllers, successive loops and total energy, with their state machine.";
  struct Inputs {
    In<VehicleState> state;
    In<GuidanceCommand> command;
  };
  struct Outputs {
    AttitudeCommand attitude;
    Actuators actuators;
    Probe zone_ratio;  // 0 take-off, 1 climb, 2 altitude hold
  };
  struct Params {
    Choice<Law> law{Law::successive_loops, "how height and airspeed are held"};
    Flag mended{false,
                "yaw damper, anti-windup, limits of throttle and pitch, and trim as they were meant to be"};

    Param alt_toz{5, "m", 0, 100, "ceiling of the take-off zone"};
    Param alt_hz{20, "m", 0.1, 200, "half width of the hold zone, and limit of the height error"};
    Param max_takeoff_throttle{1, "ratio", 0, 1, "limit of the throttle in take-off"};
    Param takeoff_airspeed{25, "m/s", 0, 100, "airspeed wanted in take-off, successive loops"};
    Param cmd_takeoff_pitch{0.2617994, "rad", 0, 1, "pitch in take-off"};
    Param max_roll{0.7853982, "rad", 0, 1.5, "limit of the roll command"};
    Param max_pitch{0.3490659, "rad", 0, 1.5, "limit of the pitch command"};
    Param c_kp{2, "rad/rad", 0, 20, "roll per course error"};
    Param c_ki{0.0025, "1/s", 0, 20, "the same, per integrated error"};
    Param r_kp{0.55, "rad/rad", 0, 20, "aileron per roll error"};
    Param r_kd{0.2, "s", 0, 20, "aileron against roll rate"};
    Param max_a{0.8, "rad", 0, 1.5, "limit of the aileron"};
    Param p_kp{4.25, "rad/rad", 0, 20, "nose-up elevator per pitch error"};
    Param p_kd{0.6, "s", 0, 20, "nose-up elevator against pitch rate"};
    Param max_e{0.61, "rad", 0, 1.5, "limit of the elevator"};
    Param trim_e{0.075, "rad", -1, 1, "nose-up elevator"};
    Param a_kp{0.015, "rad/m", 0, 20, "pitch per height error"};
    Param a_ki{0.001, "rad/(m s)", 0, 20, "the same, per integrated error"};
    Param a_t_kp{0.1, "1/(m/s)", 0, 20, "throttle per airspeed error"};
    Param a_t_ki{0.02, "1/m", 0, 20, "the same, per integrated error"};
    Param max_t{1, "ratio", 0, 1, "limit of the throttle"};
    Param trim_t{0.5, "ratio", 0, 1, "throttle"};
    Param max_r{0.523, "rad", 0, 1.5, "limit of the rudder"};
    Param y_pwo{0.6349, "rad/s", 0, 20, "wash-out pole of the yaw damper"};
    Param y_kr{0.85137, "s", 0, 20, "rudder against yaw rate"};
    Param e_kp{0.5, "ratio", 0, 20, "throttle per total energy error"};
    Param e_ki{0.01, "1/s", 0, 20, "the same, per integrated error"};
    Param l_kp{0.5, "rad", 0, 20, "pitch per energy balance error"};
    Param l_ki{0.005, "rad/s", 0, 20, "the same, per integrated error"};
    Param mass{4.5, "kg", 0.01, 1000, "of the energies; it cancels"};
    Param gravity{9.8, "m/s2", 1, 20, "of the energies"};
    Param max_alt_error{5, "m", 0.1, 200, "limit of the height error in the potential energy"};
    Param minimum_alt_for_integration{0.5, "m", 0, 100, "below it the total energy is not integrated"};
    Param elevator_trim{0.1212, "rad", -1, 1, "elevator of level flight, in place of trim_e when mended"};
  };

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>&) {
    *this = {};  // ROSplane does not set these
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    const GuidanceCommand& c = *in.command;
    const double Ts = std::clamp(tick.dt_s(), 0.001, 0.1);
    const bool hold = zone_ == Zone::altitude_hold, take_off = zone_ == Zone::take_off;
    out.attitude.roll_rad = hold ? course_to_roll(s, c, p, Ts) : 0;
    const auto [theta_c, delta_t] = p.law == Law::total_energy ? energy(s, c, p, Ts) : loops(s, c, p, Ts);
    out.attitude.pitch_rad = theta_c;
    out.attitude.throttle_frac = std::clamp(delta_t, 0.0, 1.0);  // as by the motor

    out.actuators.throttle_frac = out.attitude.throttle_frac;
    out.actuators.aileron_rad = std::clamp(
        p.r_kp * (out.attitude.roll_rad - s.roll_rad) - p.r_kd * s.rate_radps.x, -p.max_a, +p.max_a);
    const double trim_e = p.mended ? -p.elevator_trim : p.trim_e;
    out.actuators.elevator_rad =
        -std::clamp(trim_e + p.p_kp * (theta_c - s.pitch_rad) - p.p_kd * s.rate_radps.y, -p.max_e, +p.max_e);
    out.actuators.rudder_rad = take_off ? 0 : yaw_damper(s.rate_radps.z, p, Ts);
    out.zone_ratio = static_cast<double>(zone_);
    next_zone(s.height_m, c.height_m, p);
    return Status::ok;
  }

 private:
  struct PitchThrottle {
    double theta_c, delta_t;
  };

  double course_to_roll(const VehicleState& s, const GuidanceCommand& c, const Params& p, double Ts) {
    const double e = wrap_pi(c.course_rad - s.course_rad);
    return course_.output(p.c_kp * e + c.roll_feedforward_rad, p.c_ki, e, -p.max_roll, p.max_roll, Ts,
                          p.mended);
  }

  PitchThrottle loops(const VehicleState& s, const GuidanceCommand& c, const Params& p, double Ts) {
    if (zone_ == Zone::take_off)
      return {p.cmd_takeoff_pitch,
              std::min<double>(airspeed_to_throttle(p.takeoff_airspeed - s.airspeed_mps, p, Ts),
                               p.max_takeoff_throttle)};
    const double e = std::clamp(c.height_m - s.height_m, -p.alt_hz, +p.alt_hz);
    if (std::abs(e) >= p.alt_hz - 0.01) altitude_ = {};
    const double theta_c = altitude_.output(p.a_kp * e, std::abs(e) < p.alt_hz - 0.01 ? p.a_ki.value : 0, e,
                                            -p.max_pitch, p.max_pitch, Ts, p.mended);
    return {theta_c, airspeed_to_throttle(c.airspeed_mps - s.airspeed_mps, p, Ts)};
  }

  double airspeed_to_throttle(double e, const Params& p, double Ts) {
    return airspeed_.output(p.trim_t + p.a_t_kp * e, p.a_t_ki, e, 0, p.max_t, Ts, p.mended);
  }

  PitchThrottle energy(const VehicleState& s, const GuidanceCommand& c, const Params& p, double Ts) {
    const double zone = zone_ == Zone::climb ? p.alt_hz / 2 : p.alt_hz.value;
    double h_c = c.height_m;
    if (zone_ != Zone::take_off) h_c = s.height_m + std::clamp(h_c - s.height_m, -zone, zone);
    const double Va = s.airspeed_mps, Va_c = c.airspeed_mps;
    const double K_err = 0.5 * p.mass * (Va_c * Va_c - Va * Va), K_ref = 0.5 * p.mass * Va_c * Va_c;
    const double U_err =
        p.mass * p.gravity * std::clamp(h_c - s.height_m, -p.max_alt_error, +p.max_alt_error);
    // ROSplane divides by zero here, and sends 0 for a value that is not finite
    if (!(K_ref > 0)) return {0, p.trim_t};
    const double E = (K_err + U_err) / K_ref, L = (U_err - K_err) / K_ref;

    double delta_t, theta_c;
    if (p.mended) {
      delta_t = total_.output(p.trim_t + p.e_kp * E, p.e_ki, E, 0, p.max_t, Ts, true);
      theta_c = balance_.output(p.l_kp * L, p.l_ki, L, -p.max_pitch, p.max_pitch, Ts, true);
    } else {
      total_.add(E, Ts);
      balance_.add(L, Ts);
      delta_t = std::clamp<double>(p.e_kp * E + p.e_ki * total_.I, 0, p.max_t) + p.trim_t;
      theta_c = std::clamp<double>(p.l_kp * L + p.l_ki * balance_.I, -p.max_roll, p.max_roll);
    }
    if (s.height_m < p.minimum_alt_for_integration) total_.I = 0;
    if (zone_ != Zone::take_off) return {theta_c, delta_t};
    return {p.cmd_takeoff_pitch, std::clamp<double>(delta_t, 0, p.max_takeoff_throttle)};
  }

  /// Intended law: delta_r = -y_kr s / (s + y_pwo) r. In ROSplane the stored value already has the opposite
  /// sign, and the pole contains the gain. Sign of the rudder here: positive is nose left.
  double yaw_damper(double r, const Params& p, double Ts) {
    const double d = 2 + Ts * p.y_pwo, b = 2 * p.y_kr / d;
    const double pole = (2 - Ts * p.y_pwo) / d;
    const double u =
        p.mended ? -pole * delta_r_ + b * (r - r_prev_) : p.y_kr * pole * delta_r_ + b * (r - r_prev_);
    r_prev_ = r;
    delta_r_ = -std::clamp<double>(u, -p.max_r, p.max_r);
    return -delta_r_;
  }

  void next_zone(double h, double h_c, const Params& p) {
    switch (zone_) {
      case Zone::take_off:
        if (h >= p.alt_toz) enter(Zone::climb, p);
        break;
      case Zone::climb:
        if (h >= h_c - p.alt_hz) {
          airspeed_ = {};
          altitude_ = {};
          enter(Zone::altitude_hold, p);
        } else if (h <= p.alt_toz) {
          airspeed_ = {};
          altitude_ = {};
          enter(Zone::take_off, p);
        }
        break;
      case Zone::altitude_hold:
        if (h <= p.alt_toz) {
          course_ = {};
          enter(Zone::take_off, p);
        }
        break;
    }
  }
  void enter(Zone zone, const Params& p) {
    zone_ = zone;
    if (p.law == Law::total_energy) {
      total_ = {};
      balance_ = {};
    }
  }

  Zone zone_ = Zone::take_off;
  Integrator course_, altitude_, airspeed_, total_, balance_;
  double delta_r_ = 0, r_prev_ = 0;  ///< delta_r as stored in ROSplane: positive is nose right
};

}  // namespace fulmar::rosplane
