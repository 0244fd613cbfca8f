// SPDX-License-Identifier: BSD-3-Clause
// Course, height and airspeed from the sticks, which are rates of the command.
#pragma once
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fulmar/flight/control/outer_commands.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "pilot.hpp"

namespace fulmar::manual {

struct Guide {
  static constexpr const char* doc =
      "Course, height and airspeed commands: each axis from the sticks, held, or from the path.";
  /// Source of a command: the pilot's stick; another guide; the last command; or the present motion. With the
  /// present motion as the command there is no error to control, and the command holds it when the pilot lets
  /// go.
  enum class Axis : std::uint8_t { sticks, automatic, hold, flown };

  struct Inputs {
    In<VehicleState> state;
    Optional<Rc> rc;
    Optional<GuidanceCommand> automatic;  // from a guide that follows the path
  };
  struct Outputs {
    GuidanceCommand command;
    Probe course_lead_rad;  // command minus present course
    Probe height_lead_m;
  };
  struct Params {
    StickParams sticks;
    Choice<Axis> course{Axis::sticks, "source of the course command; sticks: the roll stick"};
    Choice<Axis> height{Axis::sticks, "source of the height command; sticks: the pitch stick"};
    Choice<Axis> airspeed{Axis::sticks, "source of the airspeed command; sticks: the throttle stick"};
    Param course_rate{0.5, "rad/s", 0, 3, "course rate at full roll stick"};
    Param climb_rate{3.0, "m/s", 0, 50, "climb rate at full pitch stick, within the limits of the airframe"};
    Param airspeed_rate{1.0, "m/s2", 0, 20,
                        "rate of the airspeed command at full or closed throttle stick; 0 at its centre"};
    Param throttle_dead_zone{0.15, "ratio", 0, 0.5, "dead zone of the throttle stick around its centre"};
    Param course_lead{0.8, "rad", 0.05, 3, "largest lead of the course command over the course flown"};
    Param height_lead{15, "m", 1, 1000, "largest lead of the height command over the height flown"};
    Param height_min{20, "m", -1000, 20000, "lower limit of the height command from the sticks"};
    Param height_max{120, "m", -1000, 20000, "upper limit of the height command from the sticks"};
    Record<Airframe> airframe{"airframe with the limits of airspeed, climb and bank", required};
  };

  void configure(const Params& p) {
    if (p.height_min >= p.height_max)
      throw std::runtime_error("height_min: " + std::to_string(p.height_min) +
                               " m is not below height_max, " + std::to_string(p.height_max) + " m");
  }

  Status activate(const Tick&, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    command_ = last.has(last->command) ? last->command : flown(*in.state, p.airframe->limits);
    lever_counts_ = false;
    begun_ = true;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const VehicleState& state = *in.state;
    if (!begun_) {
      command_ = flown(state, p.airframe->limits);
      begun_ = true;
    }
    const GuidanceCommand* automatic = in.automatic && !in.automatic.stale() ? &*in.automatic : nullptr;
    const Sticks hand = sticks(in.rc, tick, p.sticks);
    const GuidanceCommand now = flown(state, p.airframe->limits);
    const bool courses = course(hand, state, p, automatic, now, dt);
    const bool heights = height(hand, state, p, automatic, now, dt);
    const bool speeds = airspeed(hand, p, automatic, now, dt);
    out.command = command_;
    out.course_lead_rad = angle_difference(command_.course_rad, state.course_rad);
    out.height_lead_m = command_.height_m - state.height_m;
    return courses && heights && speeds ? Status::ok : Status::degraded;
  }

 private:
  static GuidanceCommand flown(const VehicleState& state, const FlightLimits& limits) {
    GuidanceCommand c;
    c.course_rad = state.course_rad;
    c.height_m = state.height_m;
    c.airspeed_mps = state.airspeed_valid ? state.airspeed_mps : limits.airspeed_cruise_mps;
    return c;
  }

  /// True when the source of an axis that no other guide commands is present.
  static bool held(Axis axis, const Sticks& hand) {
    return axis == Axis::hold || (axis != Axis::automatic && hand.there);
  }

  /// Updates each axis; false when its source is missing and the command stays.
  bool course(const Sticks& hand, const VehicleState& state, const Params& p,
              const GuidanceCommand* automatic, const GuidanceCommand& now, double dt) {
    const Axis axis = p.course;
    if (axis == Axis::automatic && automatic) {
      command_.course_rad = automatic->course_rad;
      command_.roll_feedforward_rad = automatic->roll_feedforward_rad;
      command_.lateral = automatic->lateral;
      command_.lateral_acceleration_mps2 = automatic->lateral_acceleration_mps2;
      return true;
    }
    command_.lateral = LateralMode::course;
    command_.lateral_acceleration_mps2 = command_.roll_feedforward_rad = 0;
    if (axis == Axis::flown && hand.there && state.velocity_valid) command_.course_rad = now.course_rad;
    if (axis != Axis::sticks) return held(axis, hand);
    if (!hand.there || !state.velocity_valid) return false;
    const double rate = hand.roll * p.course_rate;
    const double lead = angle_difference(command_.course_rad + rate * dt, state.course_rad);
    if (rate != 0)
      command_.course_rad =
          wrap_pi(state.course_rad + std::clamp<double>(lead, -p.course_lead, p.course_lead));
    const double limit = p.airframe->limits.roll_max_rad;
    command_.roll_feedforward_rad =
        std::clamp(std::atan(rate * state.ground_speed_mps / 9.80665), -limit, limit);  // B&M (9.14)
    return true;
  }

  bool height(const Sticks& hand, const VehicleState& state, const Params& p,
              const GuidanceCommand* automatic, const GuidanceCommand& now, double dt) {
    const Axis axis = p.height;
    if (axis == Axis::automatic && automatic) {
      command_.height_m = automatic->height_m;
      command_.climb_rate_mps = automatic->climb_rate_mps;
      return true;
    }
    command_.climb_rate_mps = 0;
    if (axis == Axis::flown && hand.there && state.height_valid) command_.height_m = now.height_m;
    if (axis != Axis::sticks) return held(axis, hand);
    if (!hand.there || !state.height_valid) return false;
    const FlightLimits& limits = p.airframe->limits;
    const double rate =
        std::clamp(hand.pitch * p.climb_rate, -limits.sink_rate_max_mps, limits.climb_rate_max_mps);
    // Outside of floor and ceiling, after a take-off for example, only the way back is allowed.
    const double floor = std::min<double>(p.height_min, command_.height_m),
                 ceiling = std::max({floor, p.height_max.value, command_.height_m});
    const double before = command_.height_m;
    command_.height_m = std::clamp(before + rate * dt, floor, ceiling);
    if (rate != 0)
      command_.height_m =
          std::clamp(command_.height_m, state.height_m - p.height_lead, state.height_m + p.height_lead);
    if (command_.height_m != before) command_.climb_rate_mps = rate;
    return true;
  }

  bool airspeed(const Sticks& hand, const Params& p, const GuidanceCommand* automatic,
                const GuidanceCommand& now, double dt) {
    const Axis axis = p.airspeed;
    const FlightLimits& limits = p.airframe->limits;
    if (axis == Axis::automatic && automatic) {
      command_.airspeed_mps = automatic->airspeed_mps;
      return true;
    }
    if (axis == Axis::flown && hand.there) command_.airspeed_mps = now.airspeed_mps;
    if (axis == Axis::sticks && hand.there) {
      const double lever =
          shaped(std::clamp(2 * hand.throttle - 1, -1.0, 1.0), p.throttle_dead_zone, p.sticks.expo);
      // A lever left in its position for the motor would change the speed at once.
      if (lever == 0) lever_counts_ = true;
      if (lever_counts_) command_.airspeed_mps += lever * p.airspeed_rate * dt;
    }
    command_.airspeed_mps =
        std::clamp(command_.airspeed_mps, limits.airspeed_min_mps, limits.airspeed_max_mps);
    return held(axis, hand);
  }

  GuidanceCommand command_;
  bool begun_ = false;
  bool lever_counts_ = false;  ///< the throttle stick has been in its middle since the hand-over
};

}  // namespace fulmar::manual
