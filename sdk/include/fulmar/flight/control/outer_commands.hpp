// SPDX-License-Identifier: BSD-3-Clause
// The part of an outer loop that is independent of height and speed control: course hold, take-off law,
// waiting on the ground, and bumpless commands at a change of law, phase or controller.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/envelope.hpp"
#include "fulmar/flight/control/lateral.hpp"
#include "fulmar/flight/control/takeoff.hpp"
#include "fulmar/msg/controller_internals.hpp"
#include "fulmar/msg/guidance_command.hpp"

namespace fulmar {

/// Gains and rate limits of OuterCommands.
struct OuterTuning {
  CourseTuning course;
  TakeoffTuning takeoff;
  double pitch_rate_max_radps = 1;
  double throttle_rate_max_hz = 2;  ///< full range per second
};

/// Fast enough for effective surfaces and significant errors.
inline bool flying(const VehicleState& state, const FlightLimits& limits) {
  return !standing(state) && (!state.airspeed_valid || state.airspeed_mps > 0.6 * limits.airspeed_min_mps);
}

/// Action of an outer law in this step: engine off on the ground, take-off run, guidance, wings level without
/// a valid state, or roll-out.
enum class OuterAction : std::uint8_t { wait, take_off, hold, level, roll_out };

/// Roll, pitch and throttle commands of an outer law, bumpless over changes of law, phase and controller.
/// Roll and pitch in rad, throttle 0 to 1.
class OuterCommands {
 public:
  /// At a new law, phase or controller: continues from `last`. Commands of the take-off law contain no trim
  /// and are not taken up.
  void start(OuterLaw law, const VehicleState& state, const AttitudeCommand& last) {
    taking_up_ = !(started_ && law_ == OuterLaw::takeoff);
    law_ = law;
    last_ = last;
    started_ = true;
    course_.reset_to(last.roll_rad);
    pitch_.reset_to(last.pitch_rad);
    throttle_.reset_to(last.throttle_frac);
    if (law == OuterLaw::takeoff) run_.begin(state);
  }

  /// The same after a switch. `last` is null if no command was applied: the pilot flew, or the host started
  /// in the air. Then the commands start at the attitude of the aircraft, within the limits of the law, and
  /// at cruise throttle. Zeros are a valid command: a glide with wings level. Returns true if integrals have
  /// a command to take up.
  bool take_over(OuterLaw law, const VehicleState& state, const AttitudeCommand* last,
                 const OuterTuning& tuning, const FlightLimits& limits) {
    AttitudeCommand from = last ? *last : AttitudeCommand{};
    if (!last && flying(state, limits)) {
      from.throttle_frac = limits.throttle_cruise_frac;
      if (state.attitude_valid) {
        from.roll_rad = std::clamp(state.roll_rad, -tuning.course.roll_max_rad, tuning.course.roll_max_rad);
        from.pitch_rad = std::clamp(state.pitch_rad, limits.pitch_min_rad, limits.pitch_max_rad);
      }
    }
    start(law, state, from);
    levelling_ = false;
    taking_up_ = taking_up_ && last;
    return last != nullptr;
  }

  /// Action of this step; restarts the law after a change without a switch. `sense` false: the command is not
  /// finite, and the action is level.
  OuterAction begin(OuterLaw law, const VehicleState& state, bool sense = true) {
    if (!started_) {  // no component flew before: no command to continue from
      law_ = law;
      started_ = true;
      run_.begin(state);
    }
    if (law != law_) start(law, state, last_);
    if (law == OuterLaw::takeoff) return OuterAction::take_off;
    if (law == OuterLaw::roll_out) return OuterAction::roll_out;
    if (standing(state)) return OuterAction::wait;
    if (!state.attitude_valid || !state.height_valid || !sense) return OuterAction::level;
    if (levelling_) {  // valid again: continue from the present attitude, so that no surface steps
      levelling_ = false;
      start(law, state, {state.roll_rad, state.pitch_rad, last_.throttle_frac});
    }
    return OuterAction::hold;
  }

  AttitudeCommand take_off(const VehicleState& state, const OuterTuning& tuning, const FlightLimits& limits,
                           double dt_s) {
    const AttitudeCommand wanted = run_.step(state, tuning.takeoff, limits, dt_s);
    // Hand launch: the motor stops at once, also after a command with power.
    if (tuning.takeoff.launch_mps2 > 0 && !run_.launched()) throttle_.reset_to(0);
    return finish(course_.shape(wanted.roll_rad, tuning.course, dt_s), wanted.pitch_rad, wanted.throttle_frac,
                  tuning, dt_s);
  }

  /// Not flying: engine off, level.
  AttitudeCommand wait() {
    start(law_, {}, {});
    taking_up_ = false;
    return last_;
  }

  /// On the ground after a landing: engine off, wings level. The command is the pitch on the wheels: a pitch
  /// loop against the ground would saturate the elevator, and press the nose into the ground.
  AttitudeCommand roll_out(const VehicleState& state, const OuterTuning& tuning, const FlightLimits& limits,
                           double dt_s) {
    constexpr double press_rad = 0.02;  // while fast enough to lift off again
    const double fast = state.airspeed_valid ? smoothly(state.airspeed_mps, 0.8 * limits.airspeed_min_mps,
                                                        1.1 * limits.airspeed_min_mps)
                                             : 0;
    const double pitch_rad = state.attitude_valid ? state.pitch_rad - press_rad * fast : 0;
    pitch_.reset_to(pitch_rad);
    return finish(course_.shape(0, tuning.course, dt_s), pitch_rad, 0, tuning, dt_s);
  }

  /// Invalid state in flight: wings level, trim of level flight at cruise speed.
  AttitudeCommand level(double pitch_rad, double throttle_frac, const OuterTuning& tuning, double dt_s) {
    levelling_ = true;
    return finish(course_.shape(0, tuning.course, dt_s), pitch_rad, throttle_frac, tuning, dt_s);
  }

  /// Recovery from a stall and the climb after it. The next `hold` continues from here, as after a switch.
  AttitudeCommand recover(double roll_rad, double pitch_rad, double throttle_frac, const OuterTuning& tuning,
                          double dt_s) {
    finish(roll_rad, pitch_rad, throttle_frac, tuning, dt_s);
    taking_up_ = true;
    return last_;
  }

  double wings_level(const OuterTuning& tuning, double dt_s) { return course_.shape(0, tuning.course, dt_s); }

  /// Roll command of course hold, or of a lateral acceleration, shaped. Without a valid velocity: wings
  /// level.
  double roll(const VehicleState& state, const GuidanceCommand& command, const OuterTuning& tuning,
              double dt_s) {
    if (command.lateral == LateralMode::acceleration)
      return course_.accelerate(command.lateral_acceleration_mps2, tuning.course, dt_s);
    if (!state.velocity_valid) return course_.shape(0, tuning.course, dt_s);
    return course_.step(state, command.course_rad, command.roll_feedforward_rad, tuning.course, dt_s);
  }

  /// Pitch and throttle with their rate limits; `roll_rad` is already shaped.
  AttitudeCommand finish(double roll_rad, double pitch_rad, double throttle_frac, const OuterTuning& tuning,
                         double dt_s) {
    taking_up_ = false;
    last_.roll_rad = roll_rad;
    last_.pitch_rad = pitch_.step(pitch_rad, tuning.pitch_rate_max_radps, dt_s);
    last_.throttle_frac =
        std::clamp(throttle_.step(throttle_frac, tuning.throttle_rate_max_hz, dt_s), 0.0, 1.0);
    return last_;
  }

  /// True if the next `hold` is the first after a switch: integrals then take up `last()`.
  bool taking_up() const { return taking_up_; }
  const AttitudeCommand& last() const { return last_; }
  OuterLaw law() const { return law_; }
  bool roll_saturated() const { return law_ == OuterLaw::hold && course_.saturated(); }
  double course_error_rad() const { return law_ == OuterLaw::hold ? course_.error_rad() : run_.error_rad(); }

 private:
  CourseHold course_;
  TakeoffRun run_;
  RateLimiter pitch_, throttle_;
  AttitudeCommand last_;
  OuterLaw law_ = OuterLaw::hold;
  bool started_ = false, taking_up_ = false, levelling_ = false;
};

/// Pitch limits in force: of the airframe, of the user, and near the stall.
struct PitchLimits {
  PitchLimits(const Envelope& within, const FlightLimits& limits, double pitch_limit_rad)
      : max(std::min({limits.pitch_max_rad, pitch_limit_rad, within.pitch_max_rad})),
        min(std::min(max, std::max(limits.pitch_min_rad, -pitch_limit_rad))) {}
  double max, min;
};

/// Airspeed for divisions: the measured one, but at least half the minimum; cruise if invalid.
inline double scheduling_airspeed(const VehicleState& state, const FlightLimits& limits) {
  return state.airspeed_valid ? std::max(state.airspeed_mps, 0.5 * limits.airspeed_min_mps)
                              : limits.airspeed_cruise_mps;
}

/// True if all inputs of an outer law are valid; otherwise it is degraded.
inline bool enough_known(const VehicleState& state) {
  return state.attitude_valid && state.velocity_valid && state.height_valid && state.airspeed_valid;
}

}  // namespace fulmar
