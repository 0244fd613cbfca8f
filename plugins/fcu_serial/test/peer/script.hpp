// SPDX-License-Identifier: BSD-3-Clause
// Script of the pilot and the hardware in a flight with the peer. Seconds since the first command of the
// host.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "airplane.hpp"
#include "firmware.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/flight/model/trim.hpp"
#include "sensor_failure.hpp"

namespace fulmar::fcu::peer {

inline constexpr double never_s = std::numeric_limits<double>::infinity();

/// From `at` for `lasting`.
struct Span {
  double at = never_s, until = never_s;
  bool holds(double t) const { return t >= at && t < until; }
};

struct Script {
  double arm_at = 2;  ///< with the override switch on, half a second before it goes off
  double disarm_at = never_s;
  Span rc_silent, rc_lost, override, unplugged, mute;
  Span no_fix;       ///< the receiver reports no fix
  Span gnss_silent;  ///< the receiver sends nothing
  double reboot_at = never_s, crash_at = never_s;
  bool mag = true, baro = true, pitot = true;  ///< false: the sensor is missing
  double moved_at = never_s;                   ///< from then on the inertial unit is calibrated otherwise
  Vec moved_accel{}, moved_gyro{};             ///< by so much, m/s2 and rad/s
  bool levels = false;   ///< the pilot, when he has the aircraft in the air, holds its wings level
  bool gesture = false;  ///< he arms by the sticks, and takes over by the last channel
  std::array<double, 3> aux{-1, -1, -1};  ///< with `gesture`: his three other switches
};

/// Applies failures of the sensors to their samples.
inline void fail(const Script& s, double t, Inputs& in) {
  in.mag_works = s.mag;
  in.baro_works = s.baro;
  in.pitot_works = s.pitot;
  in.gnss_works = !s.gnss_silent.holds(t);
  if (s.no_fix.holds(t)) {
    in.gnss.fix_type = 0;
    in.gnss.num_sat = 0;
  }
  for (std::size_t k = 0; k < 3 && t >= s.moved_at; ++k) {
    in.accel[k] += s.moved_accel[k];
    in.gyro[k] += s.moved_gyro[k];
  }
}

/// The transmitter: arm switch on channel 5, override switch on channel 6. In flight the sticks stand where
/// the aircraft flies level, in case that it is handed over.
class Pilot {
 public:
  Pilot(const Script& script, const Airframe& a, double density)
      : script_(script), aileron_(a.aileron.reversed ? -1 : 1), elevator_(a.elevator.reversed ? -1 : 1) {
    const Trim trim = trimmed_flight(a, a.limits.airspeed_cruise_mps, density);
    if (!trim.found) return;
    const auto stick = [](double angle, const Surface& s) {
      return (s.reversed ? -angle : angle) / s.limit_rad;
    };
    trim_ = {stick(trim.deflections.aileron, a.aileron), stick(trim.deflections.elevator, a.elevator),
             stick(trim.deflections.rudder, a.rudder), trim.throttle_frac};
  }

  /// `t` seconds after the first command; negative before it.
  void act(Inputs& in, double t, bool disarm) const {
    const bool armed = t >= script_.arm_at && t < script_.disarm_at && !disarm;
    const bool taken = script_.override.holds(t);
    const bool flies = armed && t >= script_.arm_at + 0.5;
    const auto stick = [&](double v) {
      return static_cast<std::uint16_t>(std::lround(1500 + (flies ? 500 * v : 0)));
    };
    in.rc_us[0] = stick(trim_[0]);
    in.rc_us[1] = stick(trim_[1]);
    in.rc_us[2] = static_cast<std::uint16_t>(flies ? std::lround(1000 + 1000 * trim_[3]) : 1000);
    in.rc_us[3] = stick(trim_[2]);
    const bool his = taken || t < script_.arm_at + (script_.gesture ? gesture_s + 0.5 : 0.5);
    if (script_.gesture) {
      for (std::size_t k = 0; k < 3; ++k)
        in.rc_us[4 + k] = static_cast<std::uint16_t>(std::lround(1500 + 500 * script_.aux[k]));
      if (armed && t < script_.arm_at + gesture_s) {
        in.rc_us[2] = 1000;
        in.rc_us[3] = 2000;
      }
    } else {
      in.rc_us[4] = armed ? 2000 : 1000;
    }
    in.rc_us[script_.gesture ? 7 : 5] = his ? 2000 : 1000;
    in.rc_frames = !script_.rc_silent.holds(t);
    in.rc_lost = script_.rc_lost.holds(t);
  }

  /// He weaves by up to 15 deg of bank and keeps a height, through the levels of control_manual: as angles,
  /// or as surfaces and rates by looking at the aircraft.
  void weave(Inputs& in, const RigidBody& x, double t, double height_m, bool angles) const {
    const Euler e = euler_from(x.q_nb);
    const double bank_rad = 0.26 * std::sin(0.35 * t);
    const double nose_rad = 0.05 + std::clamp(0.01 * (height_m + x.p_n.z()) + 0.05 * x.v_n.z(), -0.12, 0.12);
    const double roll = angles ? bank_rad : 0.8 * (bank_rad - e.roll_rad) - 0.1 * x.omega_b.x();
    const double pitch = angles ? nose_rad : 0.8 * (nose_rad - e.pitch_rad) - 0.1 * x.omega_b.y();
    in.rc_us[0] = pulse_us(aileron_ * roll);
    in.rc_us[1] = pulse_us(-elevator_ * pitch);
    in.rc_us[2] = static_cast<std::uint16_t>(
        1550 + std::lround(std::clamp(20 * (height_m + x.p_n.z()), -150.0, 300.0)));
    in.rc_us[3] = 1500;
  }

  /// He turns to where the wind comes from, sinks at 1.8 m/s, flares, and closes the throttle over the
  /// ground.
  void land(Inputs& in, const RigidBody& x, double airspeed_mps, double into_wind_rad) const {
    const double height_m = -x.p_n.z(), wanted_mps = std::min(1.8, 0.3 + 0.2 * std::max(height_m, 0.0));
    const double nose_rad = 0.05 + std::clamp(0.08 * (x.v_n.z() - wanted_mps), -0.15, 0.12);
    const Euler e = euler_from(x.q_nb);
    const bool rolls = height_m < 0.4;
    const double off_rad = std::remainder(into_wind_rad - e.yaw_rad, 2 * std::numbers::pi);
    const double bank_rad = height_m > 12 ? std::clamp(0.8 * off_rad, -0.4, 0.4) : 0;
    in.rc_us[0] = pulse_us(trim_[0] + aileron_ * (0.8 * (bank_rad - e.roll_rad) - 0.1 * x.omega_b.x()));
    in.rc_us[1] =
        pulse_us(rolls ? 0 : trim_[1] + elevator_ * (1.2 * (e.pitch_rad - nose_rad) + 0.15 * x.omega_b.y()));
    in.rc_us[2] = static_cast<std::uint16_t>(
        height_m < 2 ? 1000 : 1000 + std::lround(std::clamp(350 + 80 * (15 - airspeed_mps), 0.0, 900.0)));
    in.rc_us[3] = 1500;
  }

  /// Wings level, the nose a little up, 60 % throttle: by looking at the aircraft. With a `height_m` above 0
  /// he takes off, climbs to it and stays there.
  void hold_level(Inputs& in, const RigidBody& x, double height_m = 0) const {
    const double below_m = height_m > 0 ? height_m + x.p_n.z() : 0;
    const double nose_rad = 0.05 + std::clamp(0.01 * below_m + 0.05 * x.v_n.z(), -0.12, 0.12);
    const Euler e = euler_from(x.q_nb);
    in.rc_us[0] = pulse_us(trim_[0] - aileron_ * (0.8 * e.roll_rad + 0.1 * x.omega_b.x()));
    in.rc_us[1] = pulse_us(trim_[1] + elevator_ * (0.8 * (e.pitch_rad - nose_rad) + 0.1 * x.omega_b.y()));
    in.rc_us[2] = static_cast<std::uint16_t>(1600 + std::lround(std::clamp(20 * below_m, -150.0, 390.0)));
  }

 private:
  static constexpr double gesture_s = 1.3;  ///< the firmware takes a second of it
  static std::uint16_t pulse_us(double stick) {
    return static_cast<std::uint16_t>(std::lround(1500 + 500 * std::clamp(stick, -1.0, 1.0)));
  }
  Script script_;
  double aileron_, elevator_;  ///< which way the stick moves the surface
  std::array<double, 4> trim_{};
};

}  // namespace fulmar::fcu::peer
