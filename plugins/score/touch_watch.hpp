// SPDX-License-Identifier: BSD-3-Clause
// Touch-downs: detected by the simulator's contact, the estimated ground state or the landing's stage, by the
// first that is connected and reports one.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "score_messages.hpp"

namespace fulmar::score {

/// Along-track and cross-track coordinates of a runway, relative to the aircraft.
struct RunwayAxes {
  bool given = false;
  double heading_rad = 0, along_m = 0, cross_m = 0;  // of the point `north_m`, `east_m`
  double north_m = 0, east_m = 0;

  double along(double north, double east) const {
    return along_m + (north - north_m) * std::cos(heading_rad) + (east - east_m) * std::sin(heading_rad);
  }
  double cross(double north, double east) const {
    return cross_m + (east - east_m) * std::cos(heading_rad) - (north - north_m) * std::sin(heading_rad);
  }
};

/// Data of one touch-down and its roll.
struct Landed {
  TouchDown figures;
  bool any = false, stopped = false;

  void begin(const TouchDown& at, const RunwayAxes& runway) {
    figures = at;
    any = true;
    stopped = false;
    if (!runway.given) return;
    figures.beyond_threshold_m = runway.along(at.north_m, at.east_m);
    figures.cross_m = runway.cross(at.north_m, at.east_m);
    figures.cross_max_m = std::abs(figures.cross_m);
  }

  void roll(const VehicleState& s, const RunwayAxes& runway) {
    if (!any || stopped || !s.position_valid) return;
    const double north = s.position_m.north, east = s.position_m.east;
    figures.run_out_m = std::hypot(north - figures.north_m, east - figures.east_m);
    if (runway.given)
      figures.cross_max_m = std::max(figures.cross_max_m, std::abs(runway.cross(north, east)));
    stopped = s.ground_speed_mps < 0.5;
  }
};

class TouchWatch {
 public:
  /// Samples of the inputs; null for a port without one.
  struct Seen {
    const VehicleState *state = nullptr, *truth = nullptr;
    const ContactTruth* contact = nullptr;
    const GroundState* ground = nullptr;
    const LandingProgress* landing = nullptr;
  };

  /// Returns true at a touch-down.
  bool step(const Seen& in, std::int64_t now_ns) {
    const VehicleState& s = *in.state;
    if (in.landing) place(*in.landing, s);
    const bool by_contact = contact_came(in.contact), by_ground = ground_came(in.ground),
               by_stage = stage_came(in.landing);
    lift(in, s);
    const bool down = flying_ && (by_contact || by_ground || by_stage);
    if (down) {
      estimated_.begin(estimate(s, in.ground, by_ground, now_ns), runway_);
      if (by_contact) true_.begin(truth(*in.contact), runway_);
      flying_ = false;
      height_m_ = s.height_m;
      return true;
    }
    if (!flying_ && by_ground && estimated_.any) estimated_.figures.sink_mps = in.ground->touch_sink_mps;
    if (!flying_) estimated_.roll(s, runway_);
    if (!flying_ && in.truth) true_.roll(*in.truth, runway_);
    return false;
  }

  bool flying() const { return flying_; }
  const Landed& estimated() const { return estimated_; }
  const Landed& truth() const { return true_; }

 private:
  static constexpr double lifted_m = 3;

  void place(const LandingProgress& l, const VehicleState& s) {
    runway_ = {true, l.runway_rad, l.beyond_threshold_m, l.cross_m, s.position_m.north, s.position_m.east};
  }

  bool contact_came(const ContactTruth* contact) {
    if (!contact || contact->touched_s == touched_s_) return false;
    touched_s_ = contact->touched_s;
    return touched_s_ >= 0 && !contact->crashed;
  }

  bool ground_came(const GroundState* ground) {
    if (!ground) return false;
    const std::optional<std::uint32_t> before = std::exchange(touch_downs_, ground->touch_downs);
    return before && ground->touch_downs > *before;
  }

  bool stage_came(const LandingProgress* landing) {
    if (!landing) return false;
    const std::optional<LandingStage> before = std::exchange(stage_, landing->stage);
    const bool comes_in = stage_ == LandingStage::join || stage_ == LandingStage::approach;
    if (before != stage_ && (comes_in || (!before && stage_ == LandingStage::flare))) flying_ = true;
    return stage_ == LandingStage::roll_out && before != stage_;
  }

  /// Detects the lift-off by the ground state, the simulator's contact, or a height 3 m above the place of
  /// rest. After a touch-down it detects the next flight.
  void lift(const Seen& in, const VehicleState& s) {
    if (!begun_) height_m_ = s.height_m;
    begun_ = true;
    const bool higher = s.height_m > height_m_ + lifted_m;
    const bool known = in.ground && in.ground->contact != Contact::unknown;
    const bool in_air = known        ? in.ground->contact == Contact::air
                        : in.contact ? !in.contact->touching
                                     : higher;
    if (in_air && (higher || !estimated_.any)) flying_ = true;
  }

  static TouchDown estimate(const VehicleState& s, const GroundState* ground, bool by_ground,
                            std::int64_t now_ns) {
    TouchDown t;
    t.at_s = 1e-9 * static_cast<double>(now_ns);
    if (s.position_valid) {
      t.north_m = s.position_m.north;
      t.east_m = s.position_m.east;
    }
    t.sink_mps = by_ground ? ground->touch_sink_mps : -s.climb_rate_mps;
    t.ground_speed_mps = s.ground_speed_mps;
    t.roll_rad = s.roll_rad;
    t.pitch_rad = s.pitch_rad;
    t.crab_rad = angle_difference(s.yaw_rad, s.course_rad);
    return t;
  }

  static TouchDown truth(const ContactTruth& c) {
    TouchDown t;
    t.at_s = c.touched_s;
    t.north_m = c.position_m.north;
    t.east_m = c.position_m.east;
    t.sink_mps = c.sink_mps;
    t.ground_speed_mps = c.ground_speed_mps;
    t.roll_rad = c.roll_rad;
    t.pitch_rad = c.pitch_rad;
    t.crab_rad = angle_difference(c.yaw_rad, c.course_rad);
    return t;
  }

  RunwayAxes runway_;
  Landed estimated_, true_;
  bool begun_ = false, flying_ = false;
  double height_m_ = 0, touched_s_ = -1;
  std::optional<std::uint32_t> touch_downs_;
  std::optional<LandingStage> stage_;
};

}  // namespace fulmar::score
