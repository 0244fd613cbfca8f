// SPDX-License-Identifier: BSD-3-Clause
// Checks that the servos can follow their commands, by a model of throw, limits and rate.
#pragma once
#include <array>
#include <string_view>

#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/sim/servo.hpp"
#include "waveform.hpp"

namespace fulmar::signal {

inline constexpr std::array<std::array<std::string_view, 2>, 3> servo_limited{
    {{"the aileron servo is at its stop: the response is not linear",
      "the aileron servo is at its rate limit: the response is not linear"},
     {"the elevator servo is at its stop: the response is not linear",
      "the elevator servo is at its rate limit: the response is not linear"},
     {"the rudder servo is at its stop: the response is not linear",
      "the rudder servo is at its rate limit: the response is not linear"}}};
inline constexpr std::string_view signal_beyond_throw = "the signal is larger than the throw of its servo";
inline constexpr std::string_view signal_beyond_rate = "the signal is faster than the rate of its servo";

/// Reason why the servo cannot follow a signal of this size, before it begins; "" when it can.
inline std::string_view servo_trouble(const Surface& s, const SignalParams& p, double size) {
  const double low = std::max(-s.limit_rad, s.min_rad), high = std::min(s.limit_rad, s.max_rad);
  if (s.trim_rad - std::abs(size) < low || s.trim_rad + std::abs(size) > high) return signal_beyond_throw;
  const double top_hz = std::max<double>(p.frequency, p.shape == Shape::sine ? 0.0 : p.frequency_end.value);
  const double fastest = 2 * std::numbers::pi * top_hz * std::abs(size);
  // An edge takes servo time: a fifth of the shortest level at most is accepted.
  const double edge_s = 2 * std::abs(size) / s.rate_limit_radps;
  const auto slow = [&](double level_s) { return edge_s > 0.2 * level_s; };
  bool beyond = false;
  switch (p.shape) {
    case Shape::none: break;
    case Shape::step: beyond = slow(p.duration); break;
    case Shape::doublet: beyond = slow(p.duration / 2); break;
    case Shape::square: beyond = slow(0.5 / p.frequency); break;
    case Shape::d3211: beyond = slow(p.duration / 7); break;
    case Shape::sine:
    case Shape::chirp:
    case Shape::multisine: beyond = fastest > s.rate_limit_radps; break;
  }
  return beyond ? signal_beyond_rate : std::string_view{};
}

class ServoWatch {
 public:
  /// `asked`: commands before any limit is applied. Returns a report, once until all servos have followed for
  /// a while.
  std::string_view step(const Airframe& a, const Actuators& asked, double dt_s) {
    const std::array<const Surface*, 3> surfaces{&a.aileron, &a.elevator, &a.rudder};
    const std::array<double, 3> commands{asked.aileron_rad, asked.elevator_rad, asked.rudder_rad};
    if (!begun_) begin(surfaces, commands);
    limited_ = false;
    std::string_view report;
    for (std::size_t i = 0; i < 3; ++i) {
      const double before = servos_[i].angle();
      servos_[i].advance(commands[i], dt_s);
      const bool stopped = commands[i] < servos_[i].min() || commands[i] > servos_[i].max();
      const double moved = std::abs(servos_[i].angle() - before);
      const bool slow = dt_s > 0 && moved > 0.999 * surfaces[i]->rate_limit_radps * dt_s;
      limited_ = limited_ || stopped || slow;
      if ((stopped || slow) && level_s_ > report_s && !reported_) {
        report = servo_limited[i][stopped ? 0 : 1];
        reported_ = true;
      }
    }
    level_s_ += limited_ ? dt_s : -level_s_ * std::min(dt_s / memory_s, 1.0);
    if (level_s_ < 0.1 * report_s) reported_ = false;
    return report;
  }
  bool limited() const { return limited_; }

 private:
  static constexpr double report_s = 0.15, memory_s = 1;  // time at a limit; time that it is remembered

  void begin(const std::array<const Surface*, 3>& surfaces, const std::array<double, 3>& commands) {
    for (std::size_t i = 0; i < 3; ++i) {
      servos_[i] = sim::Servo(*surfaces[i]);
      servos_[i].set(commands[i]);
    }
    begun_ = true;
  }

  std::array<sim::Servo, 3> servos_{sim::Servo(Surface{}), sim::Servo(Surface{}), sim::Servo(Surface{})};
  double level_s_ = 0;
  bool begun_ = false, limited_ = false, reported_ = false;
};

}  // namespace fulmar::signal
