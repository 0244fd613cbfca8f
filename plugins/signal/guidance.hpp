// SPDX-License-Identifier: BSD-3-Clause
// A signal on the course, height or airspeed of guidance.
#pragma once
#include "excitation.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/guidance_command.hpp"

namespace fulmar::signal {

struct Guidance {
  static constexpr const char* doc =
      "Step, doublet, sweep or multisine on course, height or airspeed, between guide and outer law.";
  enum class Channel : std::uint8_t { course, height, airspeed };

  struct Inputs {
    In<GuidanceCommand> command;
    SignalInputs signal;
  };
  struct Outputs {
    GuidanceCommand command;
    Probe course_excitation_rad;  // signal added, within the limits
    Probe height_excitation_m;
    Probe airspeed_excitation_mps;
    Reported reported;
  };
  struct Params {
    SignalParams signal;
    Choice<Channel> channel{Channel::height, "channel of the signal"};
    Param course_size{0.262, "rad", -1.05, 1.05, "amplitude of the signal on the course"};
    Param height_size{5, "m", -50, 50, "amplitude of the signal on the height"};
    Param airspeed_size{1.5, "m/s", -10, 10, "amplitude of the signal on the airspeed"};
    BoundParams bounds;
  };

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last) {
    excitation_.take_over(last.has(last->command));
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const Channel channel = p.channel;
    const double size = channel == Channel::course   ? p.course_size
                        : channel == Channel::height ? p.height_size
                                                     : p.airspeed_size;
    const bool lost = channel == Channel::course && in.command->lateral == LateralMode::acceleration;
    const Status status =
        excitation_.step(tick, in.signal, p.signal, p.bounds, static_cast<std::size_t>(channel), size,
                         lost ? signal_messages::aborted_by_acceleration.c_str() : "", out.reported);
    const GuidanceCommand& asked = *in.command;
    const FlightLimits& limits = p.bounds.airframe->limits;
    out.command = asked;
    if (excitation_[0] != 0) out.command.course_rad = wrap_pi(asked.course_rad + excitation_[0]);
    out.command.height_m = asked.height_m + excitation_[1];
    out.command.airspeed_mps =
        added(asked.airspeed_mps, excitation_[2], limits.airspeed_min_mps, limits.airspeed_max_mps);
    out.course_excitation_rad = excitation_[0];
    out.height_excitation_m = excitation_[1];
    out.airspeed_excitation_mps = out.command.airspeed_mps - asked.airspeed_mps;
    return status;
  }

 private:
  Excitation<3> excitation_;
};

}  // namespace fulmar::signal
