// SPDX-License-Identifier: BSD-3-Clause
// Thrust of the motor from the energy rate of the aircraft.
#pragma once
#include "alarm.hpp"
#include "fulmar/flight/control/energy.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "glide_model.hpp"

namespace fulmar::safety {

struct EngineLimits {
  Param engine_share{0.25, "ratio", -2, 1,
                     "share of the expected thrust below which the motor counts as failed"};
  Param engine_thrust{0.05, "ratio", 0, 2, "share of the weight; no check at a smaller expected thrust"};
  Param engine_missing{0.1, "ratio", 0, 2,
                       "share of the weight; a smaller thrust deficit counts as sinking air"};
  Param engine_smoothing{1, "s", 0.05, 20, "time constant of thrust and drag"};
  Param engine_raise{2, "s", 0, 600,
                     "time with a braking force before the report; twice that without thrust"};
  Param engine_clear{5, "s", 0, 600, "time above twice that share before the report ends"};
  Param weak_share{0.5, "ratio", -2, 1, "share of the expected thrust below which the motor counts as weak"};
  Param weak_raise{8, "s", 0, 600, "time with a weak motor before the report"};
};

inline constexpr double there_volt = 1;  ///< below it there is no battery, or it is not measured

/// Throttle as a share of the full voltage, at the present voltage of the battery.
inline double volt_share(double volt, const Airframe& a) {
  const double full = a.propulsion.battery_volt;
  return volt > there_volt && full > 0 ? std::min(volt / full, 1.0) : 1;
}

/// Share of the throttle that a motor still follows: the throttle for which the model gives the found thrust.
inline double effectiveness(const Airframe& a, double throttle_frac, double thrust_newton, double Va,
                            double rho) {
  double low = 0, high = 1;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (thrust_of(a, middle * throttle_frac, Va, rho) < thrust_newton ? low : high) = middle;
  }
  return low;
}

/// A shortfall of that share of the drag counts as level flight, within the accuracy of model and weather.
inline constexpr double level_ratio = 0.25;

/// True when a throttle holds level flight at some speed from just above the least to cruise.
inline bool holds_level(const Airframe& a, double throttle_frac, double rho) {
  constexpr int steps = 6;
  const double from = 1.1 * a.limits.airspeed_min_mps;
  for (int i = 0; i <= steps; ++i) {
    const double Va = from + (a.limits.airspeed_cruise_mps - from) * i / steps;
    const double drag = turn_trim(a, 0, Va, rho).drag_newton;
    if (thrust_of(a, throttle_frac, Va, rho) > (1 - level_ratio) * drag) return true;
  }
  return false;
}

class Motor {
 public:
  bool failed() const { return failed_.raised(); }
  bool weak() const { return weak_.raised() && !failed_.raised(); }
  double ratio() const { return ratio_; }
  void reset() { *this = {}; }

  /// Force along the flight path from the energy rate, m (g hdot / Va + Vdot), plus drag, over the thrust of
  /// the model for this throttle. The energy rate is from Lambregts (1983), thrust and drag from Beard &
  /// McLain, chapter 4. `throttle_frac` is a share of the voltage of a full battery, `full_frac` the largest
  /// possible one.
  void step(const VehicleState& s, const Airframe& a, double throttle_frac, double full_frac,
            const EngineLimits& e, double dt) {
    const double Va = airspeed(s, a);
    if (Va < 0.7 * a.limits.airspeed_min_mps) return;  // stalled or rolling: the polar does not hold
    const double rho = standard_air(s.origin_altitude_m + s.height_m).density_kgm3, mg = a.mass_kg * isa::g0;
    const double gain = mg * s.climb_rate_mps / Va + a.mass_kg * airspeed_rate(s),
                 drag = turn_trim(a, s.roll_rad, Va, rho).drag_newton, found = gain + drag;
    const double expected = thrust_of(a, throttle_frac, Va, rho);
    const double share = 1 - std::exp(-dt / e.engine_smoothing);
    found_ += share * (found - found_);
    expected_ += share * (expected - expected_);
    gain_ += share * (gain - gain_);
    throttle_ += share * (throttle_frac - throttle_);
    const bool demanded = std::min(expected_, expected) > e.engine_thrust * mg;
    ratio_ = demanded ? found_ / expected_ : 1;
    // Braking as by a stopped propeller counts fully, zero thrust by half: sinking air has the same effect
    // for a while.
    constexpr double sure_ratio = 0.5;
    const double weight = failed_.raised() ? 1 : std::clamp((e.engine_share - ratio_) / sure_ratio, 0.0, 1.0);
    const bool missing = demanded && expected_ - found_ > e.engine_missing * mg;
    const bool little = missing && ratio_ < std::max(e.engine_share, e.weak_share);
    const bool flies =
        little && (gain_ > -level_ratio * drag ||
                   holds_level(a, full_frac * effectiveness(a, throttle_, found_, Va, rho), rho));
    const double shown = 2 * std::max<double>(e.engine_share, 0.1);
    failed_.step(missing && ratio_ < e.engine_share && !flies, demanded && ratio_ > shown, e.engine_raise,
                 e.engine_clear, weight * dt);
    weak_.step(little && flies, demanded && ratio_ > 1.4 * e.weak_share, e.weak_raise, e.engine_clear, dt);
  }

 private:
  static double airspeed(const VehicleState& s, const Airframe& a) {
    if (s.airspeed_valid) return s.airspeed_mps;
    if (!s.wind_valid) return a.limits.airspeed_cruise_mps;
    const Vec3<Ned> v = s.velocity_mps - s.wind_mps;
    return std::sqrt(v.north * v.north + v.east * v.east + v.down * v.down);
  }

  Alarm failed_, weak_;
  double expected_ = 0, found_ = 0;  ///< smoothed, N
  double gain_ = 0;                  ///< gain of energy, as a force; smoothed likewise
  double throttle_ = 0;              ///< smoothed likewise
  double ratio_ = 1;
};

}  // namespace fulmar::safety
