// SPDX-License-Identifier: BSD-3-Clause
// A signal on a surface or the throttle, between the law and the vehicle.
#pragma once
#include "excitation.hpp"
#include "fulmar/msg/actuators.hpp"
#include "servo_watch.hpp"

namespace fulmar::signal {

struct Surfaces {
  static constexpr const char* doc =
      "Step, doublet, sweep or multisine on a surface or the throttle, between inner law and vehicle.";
  enum class Channel : std::uint8_t { aileron, elevator, rudder, throttle };

  struct Inputs {
    In<Actuators> actuators;
    SignalInputs signal;
  };
  struct Outputs {
    Actuators actuators;
    Probe aileron_excitation_rad;  // signal added, within the throws
    Probe elevator_excitation_rad;
    Probe rudder_excitation_rad;
    Probe throttle_excitation_frac;
    Probe limited_ratio;  // 1: a servo is saturated or at its rate limit, for any command
    Reported reported;
  };
  struct Params {
    SignalParams signal;
    Choice<Channel> channel{Channel::elevator, "channel of the signal"};
    Param size{0.0524, "rad", -0.35, 0.35, "amplitude of the signal on a surface"};
    Param throttle_size{0.1, "ratio", -0.5, 0.5, "amplitude of the signal on the throttle"};
    BoundParams bounds;
  };

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last) {
    excitation_.take_over(last.has(last->actuators));
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const Channel channel = p.channel;
    const double size = channel == Channel::throttle ? p.throttle_size : p.size;
    const Status status = excitation_.step(tick, in.signal, p.signal, p.bounds,
                                           static_cast<std::size_t>(channel), size, "", out.reported);
    const Actuators& asked = *in.actuators;
    const Airframe& a = *p.bounds.airframe;
    out.actuators.aileron_rad = within_throw(a.aileron, asked.aileron_rad, excitation_[0]);
    out.actuators.elevator_rad = within_throw(a.elevator, asked.elevator_rad, excitation_[1]);
    out.actuators.rudder_rad = within_throw(a.rudder, asked.rudder_rad, excitation_[2]);
    out.actuators.throttle_frac = added(asked.throttle_frac, excitation_[3], 0, 1);
    out.aileron_excitation_rad = out.actuators.aileron_rad - asked.aileron_rad;
    out.elevator_excitation_rad = out.actuators.elevator_rad - asked.elevator_rad;
    out.rudder_excitation_rad = out.actuators.rudder_rad - asked.rudder_rad;
    out.throttle_excitation_frac = out.actuators.throttle_frac - asked.throttle_frac;
    watch(tick, p, size, asked, out);
    return status;
  }

 private:
  /// Checks the limits of the servos: for the signal before it begins, and for every command.
  void watch(const Tick& tick, const Params& p, double size, const Actuators& asked, Outputs& out) {
    const Airframe& a = *p.bounds.airframe;
    const std::array<const Surface*, 3> surfaces{&a.aileron, &a.elevator, &a.rudder};
    const auto channel = static_cast<std::size_t>(p.channel.value);
    if (excitation_.began() && channel < surfaces.size())
      report(servo_trouble(*surfaces[channel], p.signal, size), tick, out);
    Actuators wanted = asked;
    wanted.aileron_rad += excitation_[0];
    wanted.elevator_rad += excitation_[1];
    wanted.rudder_rad += excitation_[2];
    report(servos_.step(a, wanted, tick.dt_s()), tick, out);
    out.limited_ratio = servos_.limited() ? 1.0 : 0.0;
  }
  static void report(std::string_view what, const Tick& tick, Outputs& out) {
    if (!what.empty()) out.reported.notices.push({Text<96>(what), Severity::warning}, tick.now_ns);
  }
  static double within_throw(const Surface& s, double value, double by) {
    return added(value, by, std::max(-s.limit_rad, s.min_rad), std::min(s.limit_rad, s.max_rad));
  }

  Excitation<4> excitation_;
  ServoWatch servos_;
};

}  // namespace fulmar::signal
