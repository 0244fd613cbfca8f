// SPDX-License-Identifier: BSD-3-Clause
// A signal on the roll, pitch or throttle of an outer law.
#pragma once
#include "excitation.hpp"
#include "fulmar/msg/attitude_command.hpp"

namespace fulmar::signal {

struct Attitude {
  static constexpr const char* doc =
      "Step, doublet, sweep or multisine on roll, pitch or throttle, between outer and inner law.";
  enum class Channel : std::uint8_t { roll, pitch, throttle };

  struct Inputs {
    In<AttitudeCommand> attitude;
    SignalInputs signal;
  };
  struct Outputs {
    AttitudeCommand attitude;
    Probe roll_excitation_rad;  // signal added, within the limits
    Probe pitch_excitation_rad;
    Probe throttle_excitation_frac;
    Reported reported;
  };
  struct Params {
    SignalParams signal;
    Choice<Channel> channel{Channel::pitch, "channel of the signal"};
    Param size{0.0873, "rad", -0.6, 0.6, "amplitude of the signal on roll or pitch"};
    Param throttle_size{0.1, "ratio", -0.5, 0.5, "amplitude of the signal on the throttle"};
    BoundParams bounds;
  };

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last) {
    excitation_.take_over(last.has(last->attitude));
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const Channel channel = p.channel;
    const double size = channel == Channel::throttle ? p.throttle_size : p.size;
    const Status status = excitation_.step(tick, in.signal, p.signal, p.bounds,
                                           static_cast<std::size_t>(channel), size, "", out.reported);
    const AttitudeCommand& asked = *in.attitude;
    const FlightLimits& limits = p.bounds.airframe->limits;
    out.attitude.roll_rad = added(asked.roll_rad, excitation_[0], -limits.roll_max_rad, limits.roll_max_rad);
    out.attitude.pitch_rad =
        added(asked.pitch_rad, excitation_[1], limits.pitch_min_rad, limits.pitch_max_rad);
    out.attitude.throttle_frac = added(asked.throttle_frac, excitation_[2], 0, 1);
    out.roll_excitation_rad = out.attitude.roll_rad - asked.roll_rad;
    out.pitch_excitation_rad = out.attitude.pitch_rad - asked.pitch_rad;
    out.throttle_excitation_frac = out.attitude.throttle_frac - asked.throttle_frac;
    return status;
  }

 private:
  Excitation<3> excitation_;
};

}  // namespace fulmar::signal
