// SPDX-License-Identifier: BSD-3-Clause
// Stall protection and recovery of an outer law: minimum airspeed by load factor, mass and angle of attack;
// maximum bank by airspeed; maximum pitch by angle of attack. At cruise airspeed it limits the bank alone: it
// demands no airspeed above cruise, and pitch is free. Lift of a turn: Anderson, Introduction to Flight,
// turning flight. Recovery with less angle of attack, wings level and full power: FAA, Airplane Flying
// Handbook, chapter 5.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/energy.hpp"
#include "fulmar/flight/control/takeoff.hpp"
#include "fulmar/flight/control/turn_trim.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/flight/model/max_lift.hpp"

namespace fulmar {

/// Lift over angle of attack by the model of the airframe: a line from zero to maximum lift.
struct WingEnvelope {
  double mass_kg = 0, area_m2 = 1;
  double max_lift = 0;                ///< CL, trimmed; 0: the airframe has no lift model
  double stall_alpha_rad = 0.2618;    ///< angle of attack at maximum lift
  double zero_alpha_rad = -0.05;      ///< angle of attack at zero lift
  double share_per_rad = 1 / 0.3118;  ///< share of the maximum lift per rad

  WingEnvelope() = default;
  explicit WingEnvelope(const Airframe& a) : mass_kg(a.mass_kg), area_m2(a.wing.area_m2) {
    const MostLift most = fulmar::max_lift(a);
    constexpr double step = 0.05;
    const Aerodynamic aero(a);
    const double CL = trimmed_lift(aero, a, 0), slope = (trimmed_lift(aero, a, step) - CL) / step;
    if (!(slope > 0.5 && most.coefficient > 0.1 && most.alpha_rad > step)) return;
    max_lift = most.coefficient;
    stall_alpha_rad = most.alpha_rad;
    zero_alpha_rad = -CL / slope;
    share_per_rad = slope / max_lift;
  }

  /// Share of the maximum lift. Beyond the stall it grows further, as a measure of the excess of the angle of
  /// attack.
  double share(double alpha_rad) const { return share_per_rad * (alpha_rad - zero_alpha_rad); }
  double alpha_of(double share) const { return zero_alpha_rad + share / share_per_rad; }

  /// Slowest level flight, m/s: by the model, but at least the minimum airspeed of the limits over 1.2.
  double stall_mps(const FlightLimits& limits, double density_kgm3) const {
    return std::max(by_limits_mps(limits), by_model_mps(density_kgm3));
  }
  /// The same for the bank: 5 % above the stall speed of the model, but at least 10 % above that of the
  /// limits.
  double bank_stall_mps(const FlightLimits& limits, double density_kgm3) const {
    constexpr double share = 1.05 / 1.1;
    return std::max(by_limits_mps(limits), share * by_model_mps(density_kgm3));
  }

 private:
  static double by_limits_mps(const FlightLimits& limits) { return limits.airspeed_min_mps / 1.2; }
  double by_model_mps(double density_kgm3) const {
    constexpr double g = 9.80665;
    return max_lift > 0 ? std::sqrt(2 * mass_kg * g / (density_kgm3 * area_m2 * max_lift)) : 0;
  }
};

inline constexpr double min_bank_rad = 0.26;

/// Bank limit, rad, of a level turn at airspeed `Va`: lift of 1 / cos(bank) times the weight, at 10 % above
/// the stall speed. Below that speed some bank remains for steering.
inline double bank_carried(double Va, double stall_mps) {
  constexpr double above_stall_ratio = 1.1;
  const double slowest = above_stall_ratio * stall_mps;
  const double cosine = slowest * slowest / std::max(Va * Va, 1e-3);
  return std::max(min_bank_rad, std::acos(std::min(cosine, 1.0)));
}

/// Limits of a law's commands in this step.
struct Envelope {
  double airspeed_min_mps = 0;  ///< minimum airspeed command
  double slowest_mps =
      0;  ///< below it airspeed has priority over height; without the margin for the angle of attack
  double pitch_max_rad = 1.57;  ///< pitch limit near the stall

  /// Airspeed to hold for a commanded airspeed.
  double airspeed(double commanded_mps, const FlightLimits& limits) const {
    return std::clamp(commanded_mps, airspeed_min_mps, limits.airspeed_max_mps);
  }
  /// 0 at the slowest airspeed and above; 1 at the fraction `band` below it.
  double underspeed(double airspeed_mps, double band) const {
    const double full = slowest_mps * (1 - band);
    return std::clamp((slowest_mps - airspeed_mps) / (slowest_mps - full), 0.0, 1.0);
  }
};

/// Stall protection of one outer law: minimum airspeed, maximum pitch and bank, stall detection and recovery.
/// Call `step` once a tick; angles in rad, airspeeds true, in m/s.
class EnvelopeGuard {
 public:
  void configure(const Airframe& a) {
    wing_ = WingEnvelope(a);
    configured_ = true;
  }
  bool configured() const { return configured_; }

  /// After a switch of components, a reset of the state, or on the ground: clears all memory.
  void reset() {
    lift_.reset();
    gust_.reset();
    gusty_.reset();
    learnt_ = false;
    above_s_ = below_s_ = unloaded_s_ = falls_s_ = peak_ = 0;
    stalled_ = regains_ = false;
  }

  double bank_max(double Va, const FlightLimits& limits, double density_kgm3) const {
    if (regains_) return min_bank_rad;
    return bank_carried(Va, wing_.bank_stall_mps(limits, density_kgm3));
  }

  /// `bank_rad` and `climb_rate_mps` are commands. `guarded` is false in a flare, which reduces the speed on
  /// purpose.
  Envelope step(const VehicleState& state, const FlightLimits& limits, double density_kgm3, double bank_rad,
                double climb_rate_mps, bool guarded, double dt_s) {
    Envelope e;
    const double stall = wing_.stall_mps(limits, density_kgm3), load = load_factor(bank_rad);
    const double least = std::max(limits.airspeed_min_mps, above_stall * stall);
    V_ = state.airspeed_valid ? std::max(state.airspeed_mps, 0.5 * limits.airspeed_min_mps)
                              : limits.airspeed_cruise_mps;
    climb_rad_ = std::asin(std::clamp(state.climb_rate_mps / V_, -1.0, 1.0));
    alpha_ = alpha(state);
    lift(state, density_kgm3, dt_s);
    // At cruise airspeed, the path has priority over the stall margin in turns.
    const double most = std::min(std::max(least, limits.airspeed_cruise_mps), limits.airspeed_max_mps);
    e.slowest_mps = std::min(least * std::sqrt(load), most);
    e.airspeed_min_mps = e.slowest_mps;
    const bool seen = sees_alpha(state);
    if (state.airspeed_valid) e.pitch_max_rad = pitch_ceiling(state, limits, e.slowest_mps);
    if (!guarded) {
      reset();
      return e;
    }
    if (seen) {
      const double gusts = for_gusts(state, stall * std::sqrt(load), dt_s);
      const double min_mps = std::max(for_alpha(e, load, stall, limits, dt_s), gusts);
      e.airspeed_min_mps = std::clamp(min_mps, e.slowest_mps, most);
    }
    if (state.airspeed_valid && state.velocity_valid)
      e.pitch_max_rad = std::min(e.pitch_max_rad, pitch_max(state, limits, e.slowest_mps));
    look(state, e.slowest_mps, stall * std::sqrt(load), climb_rate_mps, seen, dt_s);
    return e;
  }

  bool stalled() const { return stalled_; }
  double alpha_rad() const { return alpha_; }
  /// Pitch command of the recovery: six tenths of the maximum lift above the present flight path.
  double recovery_pitch(const FlightLimits& limits) const {
    constexpr double share = 0.6;
    return std::clamp(climb_rad_ + wing_.alpha_of(share), limits.pitch_min_rad, limits.pitch_max_rad);
  }

  /// True after a stall, or after an uncommanded loss of height, until the height command is near. Meanwhile
  /// pitch holds the airspeed, at full power.
  bool regains(const VehicleState& s, double height_error_m, double climb_rate_mps, double dt_s) {
    constexpr double fall_mps = 3, falls_s = 0.5, held_mps = 1, below_m = 5, ahead_s = 2;
    const double sink = std::min(climb_rate_mps, 0.0) - s.climb_rate_mps;
    const double left_m = height_error_m - ahead_s * std::max(s.climb_rate_mps, 0.0);
    if (!s.height_valid || (!stalled_ && sink < held_mps && left_m < below_m)) regains_ = false;
    // A sink at a switch ends without help.
    falls_s_ = sink > fall_mps && height_error_m > below_m ? falls_s_ + dt_s : 0;
    if (stalled_ || falls_s_ > falls_s) regains_ = s.height_valid;
    return regains_ && s.airspeed_valid && s.velocity_valid;
  }
  /// Pitch command while regaining height: excess airspeed becomes height, missing airspeed comes from
  /// height. The lift from the accelerometer limits it: at most nine tenths of the maximum lift, and not so
  /// little that the aircraft falls. `pitch_rad` is the last command.
  double regaining_pitch(const VehicleState& s, const Envelope& e, double pitch_rad, double dt_s) const {
    constexpr double above_slowest = 1.1, max_share = 0.9, min_share = 0.3;
    constexpr double error_gain = 0.05, rate_gain = 0.1;  // 0.7 rad/s, damping 0.7
    const double error = s.airspeed_mps - above_slowest * e.slowest_mps;
    const double rate = error_gain * error + rate_gain * airspeed_rate(s);
    const double least = s.pitch_rad + (min_share - lift_.value()) / wing_.share_per_rad;
    const double most = s.pitch_rad + (max_share - used()) / wing_.share_per_rad;
    return std::min({std::max(pitch_rad + rate * dt_s, least), most, e.pitch_max_rad});
  }

 private:
  static constexpr double above_stall = 1.15;

  static bool sees_alpha(const VehicleState& s) {
    return s.airspeed_valid && s.wind_valid && s.velocity_valid && !s.airspeed_from_model;
  }
  /// Angle of attack: the estimate if wind and airspeed are valid, otherwise pitch minus flight path angle.
  double alpha(const VehicleState& s) const {
    if (!s.velocity_valid) return wing_.zero_alpha_rad;
    if (sees_alpha(s)) return s.alpha_rad;
    return (s.pitch_rad - climb_rad_) / std::max(std::cos(s.roll_rad), 0.5);
  }

  /// Share of the maximum lift, from the accelerometer: it does not depend on vertical air.
  void lift(const VehicleState& s, double density_kgm3, double dt_s) {
    constexpr double smoothed_s = 0.1, remembered_s = 0.3;
    const double most = 0.5 * density_kgm3 * V_ * V_ * wing_.area_m2 * wing_.max_lift;
    lift_.step(most > 0 ? -s.specific_force_mps2.z * wing_.mass_kg / most : 1, smoothed_s, dt_s);
    peak_ = std::max(lift_.value(), decay_.of(dt_s / remembered_s) * peak_);
  }
  /// Share of the maximum lift on which flight path and accelerometer agree. In sinking air the angle over
  /// the flight path is large, but not that of the wing. Beyond the stall the lift is small too: the largest
  /// recent value counts. The mass may be 20 % above that of the airframe.
  double used() const { return std::min(wing_.share(alpha_), 1.2 * peak_); }

  /// Minimum airspeed in gusts, which reduce the airspeed faster than an engine increases it: near the stall
  /// speed plus four times the standard deviation of the gusts.
  double for_gusts(const VehicleState& s, double stall_mps, double dt_s) {
    constexpr double follows_s = 3, averaged_s = 20, times = 4, of_stall = 0.95;
    const double gust = s.airspeed_mps - gust_.step(s.airspeed_mps, airspeed_rate(s), follows_s, dt_s);
    return of_stall * stall_mps + times * std::sqrt(gusty_.step(gust * gust, averaged_s, dt_s));
  }

  /// Minimum airspeed from the angle of attack. V^2 CL / (n CL_max) is the square of the slowest level flight
  /// at the present weight: it includes unknown mass, centre of gravity and ice. Vertical air changes the
  /// angle of attack: the estimate is updated only in slow flight, and decays otherwise.
  double for_alpha(const Envelope& e, double load, double stall_mps, const FlightLimits& limits,
                   double dt_s) {
    constexpr double learns_s = 1.5, forgets_s = 10, near_ratio = 1.25, max_ratio = 1.4;
    const double nominal = stall_mps * stall_mps;
    if (!learnt_) {
      learnt_ = true;
      stall_squared_.reset_to(nominal);
    }
    const bool near = V_ * V_ * load < near_ratio * near_ratio * e.slowest_mps * e.slowest_mps;
    const double seen = near ? V_ * V_ * std::clamp(used(), 0.0, 2.0) / load : nominal;
    const double squared = load * stall_squared_.step(seen, near ? learns_s : forgets_s, dt_s);
    if (above_stall * above_stall * squared <= e.slowest_mps * e.slowest_mps) return e.slowest_mps;
    const double most = std::min(max_ratio * e.slowest_mps, limits.airspeed_max_mps);
    return std::max(e.slowest_mps, std::min(above_stall * std::sqrt(squared), most));
  }

  /// At most nine tenths of the maximum lift above the flight path, if the lift in use is near that, and the
  /// aircraft is slower than cruise or falls. At least the lower pitch limit, and half of it in fast flight:
  /// the flight path may be that of the air.
  double pitch_max(const VehicleState& s, const FlightLimits& limits, double slowest_mps) const {
    constexpr double share = 0.9, free_rad = 0.6, free_share = 0.65, full_share = 0.85, slow_ratio = 0.9;
    constexpr double held_mps = 2, fall_mps = 4;
    const double flies = 1 - smoothly(-s.climb_rate_mps, held_mps, fall_mps);
    const double cruise = limits.airspeed_cruise_mps;
    const double slack = free_rad * std::max(smoothly(used(), full_share, free_share),
                                             flies * smoothly(V_, slow_ratio * cruise, cruise));
    const double lowest =
        limits.pitch_min_rad * (1 - 0.5 * smoothly(V_, 1.2 * slowest_mps, 1.5 * slowest_mps));
    return std::max(lowest, climb_rad_ + wing_.alpha_of(share) * std::cos(s.roll_rad) + slack);
  }

  /// Stall detection: angle of attack beyond that of the maximum lift, slow flight, and an uncommanded sink
  /// with upward lift, unlike in a downdraft. Without wind or airspeed the angle is less accurate, which
  /// needs a larger angle for longer. Well above the stall speed, sinking air is the likely cause, which
  /// needs longer too. If the nose drops and removes all lift, it is no stall.
  void look(const VehicleState& s, double slowest_mps, double stall_mps, double climb_rate_mps, bool seen,
            double dt_s) {
    constexpr double left_share = 0.8, left_s = 0.2, unloaded_s = 0.1, fast_ratio = 1.35, sink_mps = 1,
                     carries = 0.1, near_ratio = 1.2;
    const double beyond_rad = seen ? 0.02 : 0.07, for_s = seen && V_ < near_ratio * stall_mps ? 0.3 : 1;
    const bool slow = !s.airspeed_valid || regains_ || V_ < fast_ratio * slowest_mps;
    const bool unloaded = lift_.value() < carries && V_ > stall_mps;
    const bool sinks = s.climb_rate_mps < std::min(climb_rate_mps, 0.0) - sink_mps;
    const bool above =
        s.velocity_valid && slow && sinks && !unloaded && alpha_ > wing_.stall_alpha_rad + beyond_rad;
    above_s_ = std::clamp(above ? above_s_ + dt_s : above_s_ - dt_s, 0.0, for_s);
    const bool left = !s.velocity_valid || wing_.share(alpha_) < left_share;
    below_s_ = left ? below_s_ + dt_s : 0;
    unloaded_s_ = unloaded ? unloaded_s_ + dt_s : 0;
    if (above_s_ >= for_s)
      stalled_ = true;
    else if (below_s_ >= left_s || unloaded_s_ >= unloaded_s)
      stalled_ = false;
  }

  WingEnvelope wing_;
  LowPass stall_squared_, lift_, gusty_;
  SteadyAirspeed gust_;
  double V_ = 0, climb_rad_ = 0, alpha_ = 0, above_s_ = 0, below_s_ = 0, unloaded_s_ = 0, falls_s_ = 0,
         peak_ = 0;
  Decay decay_;
  bool configured_ = false, learnt_ = false, stalled_ = false, regains_ = false;
};

}  // namespace fulmar
