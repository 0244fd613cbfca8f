// SPDX-License-Identifier: BSD-3-Clause
// Path from a command to the servos of a real aircraft: the delay of the link, a flight controller that
// accepts commands at frames of its radio only, and pulses of finite resolution. ROSflight firmware 2.0:
// frames at 111 Hz, pulses of 1000 to 2000 us.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/plugin.hpp"
#include "sensors.hpp"

namespace fulmar::sim {

struct ActuationParams {
  Param mux_rate{
      0,
      "Hz",
      0,
      2000,
      "rate of the radio frames at which commands move the outputs; 111 on ROSflight hardware; 0: at once",
      setup};
  Param pwm_resolution{0, "s", 0, 1e-4, "resolution of the servo pulses of 1 to 2 ms; 0: none", setup};
  Param link_latency{0, "s", 0, 0.1, "delay of the commands to the outputs", setup};
};

struct ActuationSpec {
  double mux_hz = 0;              ///< 0: no delay by the multiplexer
  double pulse_resolution_s = 0;  ///< resolution of a pulse of 1..2 ms; 0: none
  double latency_s = 0;
};

inline ActuationSpec spec_of(const ActuationParams& p) {
  return {p.mux_rate, p.pwm_resolution, p.link_latency};
}

class Actuation {
 public:
  Actuation() = default;
  Actuation(const ActuationSpec& spec, const Airframe& a, std::int64_t first_ns)
      : mux_(spec.mux_hz > 0 ? spec.mux_hz : 1, first_ns),
        muxed_(spec.mux_hz > 0),
        step_(spec.pulse_resolution_s / pulse_span_s),
        latency_ns_(std::llround(1e9 * spec.latency_s)),
        aileron_(a.aileron.limit_rad),
        elevator_(a.elevator.limit_rad),
        rudder_(a.rudder.limit_rad) {}

  /// Accepts a command at its time.
  void put(const Actuators& command, std::int64_t now_ns) {
    if (count_ == way_.size()) drop();  // full: the oldest command takes effect
    way_[(first_ + count_++) % way_.size()] = {now_ns + latency_ns_, command};
  }
  /// Commands that reach the servos and the motor at this time. Times must not decrease.
  const Actuators& at(std::int64_t now_ns) {
    while (count_ > 0 && way_[first_].at_ns <= now_ns) drop();
    if (!muxed_ || mux_(now_ns)) applied_ = pulses(arrived_);
    return applied_;
  }

 private:
  static constexpr double pulse_span_s = 1e-3;
  struct Item {
    std::int64_t at_ns = 0;
    Actuators command;
  };
  void drop() {
    arrived_ = way_[first_].command;
    first_ = (first_ + 1) % way_.size();
    --count_;
  }
  Actuators pulses(const Actuators& c) const {
    if (step_ <= 0) return c;
    const auto round = [&](double fraction) { return std::round(fraction / step_) * step_; };
    const auto servo = [&](double angle, double limit) {
      return limit > 0 ? (2 * round(0.5 + 0.5 * angle / limit) - 1) * limit : angle;
    };
    return {round(c.throttle_frac), servo(c.aileron_rad, aileron_), servo(c.elevator_rad, elevator_),
            servo(c.rudder_rad, rudder_)};
  }

  Due mux_;
  bool muxed_ = false;
  double step_ = 0;
  std::int64_t latency_ns_ = 0;
  double aileron_ = 0, elevator_ = 0, rudder_ = 0;
  std::array<Item, 256> way_{};  ///< 0.1 s at 2000 Hz
  std::size_t first_ = 0, count_ = 0;
  Actuators arrived_, applied_;
};

}  // namespace fulmar::sim
