// SPDX-License-Identifier: BSD-3-Clause
// Reports, in every mission, failures of the aircraft and its air data: a motor, a battery, a bank or pitch
// that does not follow its command, wind beyond the limit.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "battery.hpp"
#include "fulmar/fitted.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/notice.hpp"
#include "messages.hpp"
#include "motor.hpp"
#include "reported.hpp"

namespace fulmar::safety {

struct AircraftWatch {
  static constexpr const char* doc =
      "Reports of a motor without thrust, a low battery, wind beyond the limit, and a bank or pitch error "
      "that does not decrease.";
  struct Inputs {
    In<VehicleState> state;
    Optional<Actuators> actuators;       // without it the motor is not checked
    Optional<AttitudeCommand> attitude;  // without it bank and pitch are not checked
    Optional<VehicleStatus> status;      // source of the commands; without it the battery is not checked
    Optional<GroundState> ground;  // without it the aircraft counts as flying when it is faster than `flying`
  };
  struct Outputs {
    OutQueue<Notice, 12> notices;
  };
  struct Params {
    Record<Airframe> airframe{"airframe with thrust, drag and limits", required};
    Flag monitored{false, "switch for reports of motor, battery and wind by a Monitor instead"};
    Param bank_error{0.26, "rad", 0.01, 3, "bank error that does not decrease, for a report"};
    Param pitch_error{0.21, "rad", 0.01, 3, "pitch error that does not decrease, for a report"};
    Param follow_raise{1, "s", 0, 60, "duration of such an error before the report"};
    Param follow_clear{3, "s", 0, 60,
                       "duration of less than half of that error before the report of its end"};
    Param pause{30, "s", 0, 3600, "minimum time between two reports of the same cause"};
    Param flying{7, "m/s", 0, 100, "minimum ground speed of flight, without `ground`"};
    BatteryLimits battery;
    EngineLimits engine;
    WindLimits wind;
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const VehicleState& s = *in.state;
    const bool flies =
        in.ground ? in.ground->contact == Contact::air : s.velocity_valid && s.ground_speed_mps > p.flying;
    const bool obeyed = flies && (!in.status || in.status->in_control) && s.attitude_valid;
    follow(in, p, obeyed, dt);
    if (!p.monitored && flies) {
      if (in.status) battery_.step(*in.status, p.airframe->propulsion.battery_volt, p.battery, dt);
      motor(in, p, obeyed, dt);
      wind(s, p, dt);
    }
    report(in, p, dt, tick, out);
    return Status::ok;
  }

 private:
  /// One report each.
  static constexpr std::array lines{Cause::bank,          Cause::pitch,         Cause::engine_failed,
                                    Cause::engine_weak,   Cause::battery_empty, Cause::battery_low,
                                    Cause::wind_excessive};

  /// Detects an angle that stays away from its command or oscillates around it. A turn that has begun reduces
  /// the error; a gust ends within a second.
  class Follows {
   public:
    bool lost() const { return lost_.raised(); }
    double error_rad() const { return error_rad_; }
    void reset() { *this = {}; }
    void step(double error_rad, double rate_radps, double most_rad, const Params& p, double dt) {
      constexpr double closing_radps = 0.1,
                       spun_rad = 1.75;  // spun_rad: no command changes by that much in a step
      error_rad_ = std::abs(error_rad);
      const bool off = error_rad_ > most_rad;
      const bool closes = error_rad * rate_radps > error_rad_ * closing_radps && error_rad_ < spun_rad;
      stays_s_ = off && !closes ? stays_s_ + dt : 0;
      swings_s_ = std::clamp(off ? swings_s_ + dt : swings_s_ - dt, 0.0, 2 * swing_s);
      const bool bad = (stays_s_ > 0 && stays_s_ >= p.follow_raise) || swings_s_ > swing_s;
      lost_.step(bad, error_rad_ < 0.5 * most_rad, 0, p.follow_clear, dt);
    }

   private:
    static constexpr double swing_s = 2;  ///< time off the command minus time on it
    Alarm lost_;
    double error_rad_ = 0, stays_s_ = 0, swings_s_ = 0;
  };

  void follow(const Inputs& in, const Params& p, bool obeyed, double dt) {
    if (!obeyed || !in.attitude) {
      bank_.reset();
      pitch_.reset();
      return;
    }
    const VehicleState& s = *in.state;
    // Rates of the Euler angles, Beard & McLain (3.3).
    const Vec3<Body>& w = s.rate_radps;
    const double sin_roll = std::sin(s.roll_rad), cos_roll = std::cos(s.roll_rad);
    const double turn_radps = (sin_roll * w.y + cos_roll * w.z) / std::max(std::cos(s.pitch_rad), 0.1);
    const double bank_rate = w.x + turn_radps * std::sin(s.pitch_rad);
    bank_.step(wrap_pi(in.attitude->roll_rad - s.roll_rad), bank_rate, p.bank_error, p, dt);
    const double pitch_rate = cos_roll * w.y - sin_roll * w.z;
    pitch_.step(in.attitude->pitch_rad - s.pitch_rad, pitch_rate, p.pitch_error, p, dt);
  }

  void motor(const Inputs& in, const Params& p, bool obeyed, double dt) {
    if (!obeyed) return motor_.reset();
    if (!in.actuators || !in.state->velocity_valid) return;
    const double volt = in.status ? volt_share(in.status->battery_volt, *p.airframe) : 1;
    const double throttle = volt * std::clamp(in.actuators->throttle_frac, 0.0, 1.0);
    motor_.step(*in.state, *p.airframe, throttle, volt, p.engine, dt);
  }

  void wind(const VehicleState& s, const Params& p, double dt) {
    if (s.wind_valid) {
      const double share = wind_known_ ? 1 - std::exp(-dt / p.wind.wind_smoothing) : 1;
      wind_ = wind_ + share * (s.wind_mps - wind_);
      wind_known_ = true;
    }
    const double ratio = std::hypot(wind_.north, wind_.east) / p.airframe->limits.airspeed_cruise_mps;
    windy_.step(s.wind_valid && ratio > p.wind.wind_limit, s.wind_valid && ratio < 0.9 * p.wind.wind_limit,
                p.wind.wind_raise, p.wind.wind_clear, dt);
  }

  static std::size_t index_of(Cause cause) {
    return static_cast<std::size_t>(std::find(lines.begin(), lines.end(), cause) - lines.begin());
  }

  void report(const Inputs& in, const Params& p, double dt, const Tick& tick, Outputs& out) {
    constexpr double degrees = 180 / std::numbers::pi;
    const double volt = in.status ? in.status->battery_volt : 0;
    const auto line = [&](Cause cause, bool now, Severity severity, const auto& wrong, Fixed figure,
                          const MessageText<0>& right) {
      const Reported::News news = reported_[index_of(cause)].step(now, !now, 0, 0, p.pause, tick.now_s(), dt);
      if (news == Reported::News::none) return;
      Notice notice;
      notice.cause = cause;
      notice.severity = now ? severity : Severity::info;
      if (!now)
        notice.text = right.c_str();
      else if constexpr (requires { wrong.c_str(); })
        notice.text = wrong.c_str();
      else
        notice.text = fitted<96>(wrong, figure);
      out.notices.push(notice, tick.now_ns);
    };
    namespace m = safety_messages;
    line(Cause::bank, bank_.lost(), Severity::critical, m::bank_off, Fixed{degrees * bank_.error_rad(), 0},
         m::bank_follows);
    line(Cause::pitch, pitch_.lost(), Severity::critical, m::pitch_off,
         Fixed{degrees * pitch_.error_rad(), 0}, m::pitch_follows);
    if (p.monitored) return;
    line(Cause::engine_failed, motor_.failed(), Severity::critical, m::engine_failed, {}, m::motor_back);
    if (!motor_.failed())
      line(Cause::engine_weak, motor_.weak(), Severity::warning, m::engine_weak,
           Fixed{100 * std::clamp(motor_.ratio(), 0.0, 1.0), 0}, m::thrust_back);
    line(Cause::battery_empty, battery_.empty(), Severity::critical, m::battery_empty, Fixed{volt, 1},
         m::battery_charged);
    line(Cause::battery_low, battery_.low(), Severity::warning, m::battery_low, Fixed{volt, 1},
         m::battery_high);
    line(Cause::wind_excessive, windy_.raised(), Severity::warning, m::wind_excessive,
         Fixed{std::hypot(wind_.north, wind_.east), 0}, m::wind_back);
  }

  Follows bank_, pitch_;
  Alarm windy_;
  Battery battery_;
  Motor motor_;
  Vec3<Ned> wind_;
  bool wind_known_ = false;
  std::array<Reported, lines.size()> reported_;
};

}  // namespace fulmar::safety
