// SPDX-License-Identifier: BSD-3-Clause
// Reports each sensor that fails in flight, and its return, in every mission: fault, action of the aircraft,
// and action for the pilot.
#pragma once
#include <array>
#include <cmath>

#include "fulmar/fitted.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"
#include "reported.hpp"

namespace fulmar::safety {

struct SensorWatch {
  static constexpr const char* doc =
      "Reports of sensors that are silent, stuck, rejected, noisy or biased in flight, of a magnetometer "
      "mounted wrong, of a lost position, and of their return.";
  struct Inputs {
    In<VehicleState> state;
    Optional<NavigationHealth> health;  // without it only the position is monitored
    Optional<GroundState> ground;  // without it the aircraft counts as flying when it is faster than `flying`
  };
  struct Outputs {
    OutQueue<Notice, 12> notices;
  };
  struct Params {
    Param raise{0.3, "s", 0, 600, "time of a silent, stuck or rejected sensor before the report"};
    Param raise_soft{10, "s", 0, 600, "time of a noisy or biased sensor before the report"};
    Param raise_inertial{1, "s", 0, 600,
                         "time of two other sensors rejected at once before the report of the inertial unit"};
    Param clear{3, "s", 0, 600, "time of normal operation before the report of the return"};
    Param pause{30, "s", 0, 3600, "minimum time between two reports of the same sensor"};
    Param flying{7, "m/s", 0, 100, "minimum ground speed of flight, without `ground`"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 1.0), now_s = 1e-9 * static_cast<double>(tick.now_ns);
    const VehicleState& s = *in.state;
    const bool flies =
        in.ground ? in.ground->contact == Contact::air : s.velocity_valid && s.ground_speed_mps > p.flying;
    for (std::size_t i = 0; i < sensors.size() && in.health && !in.health.stale(); ++i) {
      // One receiver gives both: its silence is reported with the position alone. A magnetometer that is
      // mounted wrong is reported with its angle.
      const bool covered = (sensors[i].health == &NavigationHealth::gnss_velocity &&
                            in.health->gnss_position.state == SensorState::silent) ||
                           (sensors[i].health == &NavigationHealth::mag && in.health->mag_turn_rad != 0 &&
                            in.health->mag.state == SensorState::biased);
      watch(sensors[i], (*in.health).*sensors[i].health, reported_[i], flies && !covered, p, now_s, dt, tick,
            out);
    }
    if (in.health && !in.health.stale()) {
      mount(*in.health, p, now_s, dt, tick, out);
      inertial(*in.health, flies, p, now_s, dt, tick, out);
    }
    had_position_ = had_position_ || s.position_valid;
    const Reported::News news = position_.step(flies && had_position_ && !s.position_valid, s.position_valid,
                                               0, p.clear, p.pause, now_s, dt);
    if (news == Reported::News::raised)
      say(Severity::critical, Cause::gnss_lost, safety_messages::position_lost.c_str(), tick, out);
    if (news == Reported::News::cleared)
      say(Severity::info, Cause::gnss_lost, safety_messages::position_valid.c_str(), tick, out);
    return Status::ok;
  }

 private:
  struct [[gnu::visibility("hidden")]] Sensor {
    const char* name;
    SensorHealth NavigationHealth::*health;
    Cause cause;
    Severity severity;
    const MessageText<0>* answer;  // present action of the aircraft, and the pilot
  };
  static constexpr std::array<Sensor, 7> sensors{{
      {"gyro", &NavigationHealth::gyro, Cause::gyro, Severity::critical,
       &safety_messages::attitude_unreliable},
      {"accelerometer", &NavigationHealth::accel, Cause::accelerometer, Severity::critical,
       &safety_messages::attitude_unreliable},
      {"GNSS position", &NavigationHealth::gnss_position, Cause::gnss_lost, Severity::warning,
       &safety_messages::dead_reckoning},
      {"GNSS velocity", &NavigationHealth::gnss_velocity, Cause::gnss_velocity, Severity::warning,
       &safety_messages::velocity_by_position},
      {"magnetometer", &NavigationHealth::mag, Cause::magnetometer, Severity::warning,
       &safety_messages::heading_by_course},
      {"barometer", &NavigationHealth::baro, Cause::barometer, Severity::warning,
       &safety_messages::height_by_gnss},
      {"pitot tube", &NavigationHealth::pitot, Cause::pitot_lost, Severity::warning,
       &safety_messages::airspeed_estimated},
  }};

  static const MessageText<0>* word(SensorState state) {
    switch (state) {
      case SensorState::silent: return &safety_messages::silent;
      case SensorState::stuck: return &safety_messages::stuck;
      case SensorState::noisy: return &safety_messages::noisy;
      case SensorState::refused: return &safety_messages::rejected;
      case SensorState::biased: return &safety_messages::biased;
      default: return &safety_messages::in_order;
    }
  }

  static void watch(const Sensor& sensor, const SensorHealth& h, std::array<Reported, 2>& reported,
                    bool flies, const Params& p, double now_s, double dt, const Tick& tick, Outputs& out) {
    const bool hard =
        h.state == SensorState::silent || h.state == SensorState::stuck || h.state == SensorState::refused;
    const bool soft = h.state == SensorState::noisy || h.state == SensorState::biased;
    const bool good = h.state == SensorState::ok;
    const std::array<bool, 2> bad{hard, soft};
    const std::array<double, 2> raise{p.raise, p.raise_soft};
    for (std::size_t i = 0; i < bad.size(); ++i) {
      const Reported::News news =
          reported[i].step(flies && bad[i], good || (i == 0 && soft), raise[i], p.clear, p.pause, now_s, dt);
      Text<96> text;
      if (news == Reported::News::raised) {
        text = fitted<96>(safety_messages::sensor_failed, sensor.name, word(h.state)->c_str(),
                          sensor.answer->c_str());
        say(sensor.severity, sensor.cause, text, tick, out);
      } else if (news == Reported::News::cleared) {
        text = fitted<96>(safety_messages::sensor_back, sensor.name,
                          Fixed{reported[i].since_s(now_s) - p.clear, 0});
        say(Severity::info, sensor.cause, text, tick, out);
      }
    }
  }

  /// Found in the run already: at once, so that the pilot can stop there.
  void mount(const NavigationHealth& h, const Params& p, double now_s, double dt, const Tick& tick,
             Outputs& out) {
    constexpr double degree = 57.29577951308232;
    const bool turned = h.mag_turn_rad != 0;
    const Reported::News news = mount_.step(turned, !turned, 0, p.clear, p.pause, now_s, dt);
    Text<96> text;
    if (news == Reported::News::raised) {
      text = fitted<96>(safety_messages::magnetometer_turned, Fixed{degree * std::abs(h.mag_turn_rad), 0});
      say(Severity::warning, Cause::magnetometer, text, tick, out);
    } else if (news == Reported::News::cleared) {
      text =
          fitted<96>(safety_messages::sensor_back, "magnetometer", Fixed{mount_.since_s(now_s) - p.clear, 0});
      say(Severity::info, Cause::magnetometer, text, tick, out);
    }
  }

  /// Receiver, magnetometer, barometer and pitot are independent, but all are compared with the inertial
  /// unit. Two of them rejected at once indicate a fault of the inertial unit.
  void inertial(const NavigationHealth& h, bool flies, const Params& p, double now_s, double dt,
                const Tick& tick, Outputs& out) {
    const auto rejected = [](const SensorHealth& s) { return s.state == SensorState::refused; };
    const int n = (rejected(h.gnss_position) || rejected(h.gnss_velocity) ? 1 : 0) +
                  (rejected(h.mag) ? 1 : 0) + (rejected(h.baro) ? 1 : 0) + (rejected(h.pitot) ? 1 : 0);
    const Reported::News news =
        inertial_.step(flies && n >= 2, n == 0, p.raise_inertial, p.clear, p.pause, now_s, dt);
    if (news == Reported::News::raised)
      say(Severity::critical, Cause::inertial, safety_messages::inertial_wrong.c_str(), tick, out);
    if (news == Reported::News::cleared)
      say(Severity::info, Cause::inertial, safety_messages::inertial_back.c_str(), tick, out);
  }

  static void say(Severity severity, Cause cause, const Text<96>& text, const Tick& tick, Outputs& out) {
    Notice notice;
    notice.cause = cause;
    notice.severity = severity;
    notice.text = text;
    out.notices.push(notice, tick.now_ns);
  }

  std::array<std::array<Reported, 2>, sensors.size()> reported_;
  Reported position_, inertial_, mount_;
  bool had_position_ = false;
};

}  // namespace fulmar::safety
