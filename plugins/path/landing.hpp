// SPDX-License-Identifier: BSD-3-Clause
// From anywhere onto a runway: a circle that touches the final approach, the glide slope, the flare, the
// roll. Lines and circles are those of the vector field (Beard & McLain, Small Unmanned Aircraft (2012),
// chapter 10); the flare is the exponential one of Stevens, Lewis & Johnson, Aircraft Control and Simulation
// (2016), 4.6.
#pragma once
#include <stdexcept>
#include <string>

#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/runway.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "vector_field.hpp"

namespace fulmar::path {

struct Landing {
  static constexpr const char* doc =
      "Lands: a circle onto the final approach, glide slope, flare, roll; goes around when it is off.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleStatus> status;  // of the touch-down; without it, what the state says of it
  };
  struct Outputs {
    GuidanceCommand command;
    LandingProgress progress;
    Probe height_error_m;  // above the glide slope is positive
  };
  struct Params {
    FieldParams field;
    Record<Runway> runway{"the strip; heading is the one that is landed in", required};
    Record<Airframe> airframe{"limits of the airspeed", required};
    Param glide_slope{0.07, "rad", 0.02, 0.3,
                      "of the approach; what touches down with a late flare is its sink"};
    Param aim{50, "m", 0, 500, "from the threshold to where the glide slope meets the runway"};
    Param final_length{400, "m", 50, 10000, "of the final approach, from its circle to the threshold"};
    Param circle_radius{70, "m", 10, 2000, "of the circle that leads onto it"};
    Choice<Turn> circle{Turn::left, "how that circle is flown"};
    Param approach_ratio{1.1, "ratio", 1, 2, "approach airspeed over the airframe's minimum"};
    Param flare_height{3.5, "m", 0.2, 30, "above the runway, where the flare begins"};
    Param touch_sink{0.4, "m/s", 0.05, 2, "sink rate that the flare ends with"};
    Param decision_height{12, "m", 1, 100, "above the runway, down to where it may go around"};
    Param cross_limit{8, "m", 0.5, 100, "farther from the centre line below twice that height: go around"};
    Param height_limit{6, "m", 0.5, 100, "farther from the glide slope below twice that height: go around"};
    Param deceleration{0.8, "m/s2", 0.05, 10, "of the roll, by which the runway has to be long enough"};
    Flag go_around{false, "climb away now; false lets it come again"};
  };

  void configure(const Params& p) {
    const double V = p.airframe->limits.airspeed_min_mps;
    const double flare =
        p.flare_height / std::tan(p.glide_slope) + 2 * V;  // the slope's way, and two seconds
    const double needed = p.aim + flare + 0.5 * V * V / p.deceleration;
    if (p.runway->length_m < needed)
      throw std::runtime_error("runway.length: " + std::to_string(std::lround(p.runway->length_m)) +
                               " m is too short; aim, flare and roll take " +
                               std::to_string(std::lround(needed)) + " m in still air");
  }

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>&) {
    progress_.stage = LandingStage::join;
    settled_s_ = 0;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    locate(s, p);
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    decide(in, p, dt);
    fly(s, p, dt);
    out.command = command_;
    out.progress = progress_;
    out.height_error_m = progress_.stage == LandingStage::approach ? s.height_m - slope_height(p) : 0.0;
    const bool known = s.position_valid && s.height_valid && s.attitude_valid;
    return known ? Status::ok : Status::degraded;
  }

 private:
  static double k(const VehicleState& s, const Params& p) {
    return p.field.reference_speed / std::max(s.ground_speed_mps, 0.3 * p.field.reference_speed);
  }
  double runway_height(const Params& p) const { return p.runway->up_m; }
  double fix_height(const Params& p) const {
    return runway_height(p) + std::tan(p.glide_slope) * (p.final_length + p.aim);
  }
  double slope_height(const Params& p) const {
    return runway_height(p) + std::tan(p.glide_slope) * progress_.along_m;
  }

  /// The centre line as a path, from the point where the slope meets it, down by the slope.
  static Path final_approach(const Params& p) {
    const Runway& r = *p.runway;
    const double c = std::cos(r.heading_rad), s = std::sin(r.heading_rad);
    Path path;
    path.kind = PathKind::line;
    path.origin_m = {r.north_m + p.aim * c, r.east_m + p.aim * s, -r.up_m};
    path.direction_ratio = {c * std::cos(p.glide_slope), s * std::cos(p.glide_slope),
                            std::sin(p.glide_slope)};
    return path;
  }
  /// Touches the centre line where the final approach begins.
  Path circle(const Params& p) const {
    const Runway& r = *p.runway;
    const double c = std::cos(r.heading_rad), s = std::sin(r.heading_rad);
    const double side = p.circle == Turn::right ? 1 : -1, R = p.circle_radius;
    Path path;
    path.kind = PathKind::orbit;
    path.turn = p.circle;
    path.radius_m = R;
    path.origin_m = {r.north_m - p.final_length * c - side * R * s,
                     r.east_m - p.final_length * s + side * R * c, -fix_height(p)};
    return path;
  }

  void locate(const VehicleState& s, const Params& p) {
    const Path line = final_approach(p);
    const double n = s.position_m.north - line.origin_m.north, e = s.position_m.east - line.origin_m.east;
    const double cosine = std::cos(p.runway->heading_rad), sine = std::sin(p.runway->heading_rad);
    progress_.along_m = -(n * cosine + e * sine);
    progress_.cross_m = cosine * e - sine * n;
    progress_.height_m = s.height_m - runway_height(p);
  }

  void decide(const Inputs& in, const Params& p, double dt) {
    const VehicleState& s = *in.state;
    LandingStage& stage = progress_.stage;
    const double course_error = angle_difference(p.runway->heading_rad, s.course_rad);
    switch (stage) {
      case LandingStage::join: {
        const double past_fix = p.final_length + p.aim - progress_.along_m;
        const bool onto = std::abs(past_fix) < 0.5 * p.circle_radius && std::abs(progress_.cross_m) < 20 &&
                          std::abs(course_error) < 0.35;
        if (onto && std::abs(s.height_m - fix_height(p)) < p.height_limit && !p.go_around)
          stage = LandingStage::approach;
        break;
      }
      case LandingStage::approach:
        if (p.go_around || missed(s, p))
          stage = LandingStage::go_around, ++progress_.go_arounds;
        else if (progress_.height_m < p.flare_height)
          stage = LandingStage::flare, flare_height_m_ = s.height_m;
        break;
      case LandingStage::flare:
        if (touched(in, dt)) stage = LandingStage::roll_out, rolled_s_ = 0;
        break;
      case LandingStage::roll_out:
        rolled_s_ += dt;
        if (rolled_s_ > 1 && s.ground_speed_mps < 1) stage = LandingStage::stopped;
        break;
      case LandingStage::go_around:
        if (s.height_m > fix_height(p) - 2) stage = LandingStage::join;
        break;
      case LandingStage::stopped: break;
    }
  }
  /// Before the decision height: can this approach still end on the runway?
  bool missed(const VehicleState& s, const Params& p) const {
    if (progress_.height_m < p.decision_height) return false;
    if (!s.position_valid || !s.height_valid) return true;
    return progress_.height_m < 2 * p.decision_height &&
           (std::abs(progress_.cross_m) > p.cross_limit ||
            std::abs(s.height_m - slope_height(p)) > p.height_limit);
  }
  /// The vehicle says so, or it does not sink any more where the ground must be.
  bool touched(const Inputs& in, double dt) {
    constexpr double low_m = 2, still_mps = 0.15, for_s = 1;
    if (in.status && in.status->on_ground) return true;
    const bool still = progress_.height_m < low_m && std::abs(in.state->climb_rate_mps) < still_mps;
    settled_s_ = still ? settled_s_ + dt : 0;
    return settled_s_ > for_s;
  }

  void fly(const VehicleState& s, const Params& p, double dt) {
    const FlightLimits& limits = p.airframe->limits;
    const double approach_mps = p.approach_ratio * limits.airspeed_min_mps;
    if (progress_.stage == LandingStage::join) {
      const Path path = circle(p);
      const VectorField::Aim aim = VectorField::at_orbit(path, s, p.field, k(s, p));
      follow(aim, path, s, p);
      command_.height_m = fix_height(p);
      command_.climb_rate_mps = 0;
      command_.airspeed_mps = limits.airspeed_cruise_mps;
      return;
    }
    const Path path = final_approach(p);
    const VectorField::Aim aim = VectorField::at_line(path, s, p.field, k(s, p));
    follow(aim, path, s, p);
    command_.airspeed_mps = approach_mps;
    switch (progress_.stage) {
      case LandingStage::flare: {
        // From the sink of the slope to that of the touch-down as the height goes.
        const double slope_sink = std::max(-command_.climb_rate_mps, p.touch_sink.value);
        const double left = std::clamp(progress_.height_m / p.flare_height, 0.0, 1.0);
        command_.climb_rate_mps = -(p.touch_sink + left * (slope_sink - p.touch_sink));
        // A height that sinks so, not the rate alone: a law without an error learns nothing and keeps its
        // trim's.
        flare_height_m_ = std::clamp(flare_height_m_ + command_.climb_rate_mps * dt, s.height_m - lead_m,
                                     s.height_m + lead_m);
        command_.height_m = flare_height_m_;
        command_.airspeed_mps = limits.airspeed_min_mps;
        break;
      }
      case LandingStage::go_around:
        command_.height_m = fix_height(p);
        command_.climb_rate_mps = 0;
        command_.airspeed_mps = limits.airspeed_cruise_mps;
        break;
      case LandingStage::roll_out:
      case LandingStage::stopped:
        command_.height_m = runway_height(p);
        command_.climb_rate_mps = 0;
        break;
      default: break;
    }
  }
  void follow(const VectorField::Aim& aim, const Path& path, const VehicleState& s, const Params& p) {
    const double kappa = VectorField::curvature_ahead(path, s, p.field, aim);
    command_.course_rad = wrap_pi(aim.chi_c);
    command_.height_m = aim.height;
    command_.climb_rate_mps = aim.climb * s.ground_speed_mps * std::cos(s.course_rad - aim.path_course);
    command_.roll_feedforward_rad =
        bank_for(kappa, s.ground_speed_mps, angle_difference(s.course_rad, s.yaw_rad), p.field.roll_max);
  }

  GuidanceCommand command_;
  LandingProgress progress_;
  double settled_s_ = 0, rolled_s_ = 0, flare_height_m_ = 0;
  static constexpr double lead_m = 1.5;  ///< of the flare's height before the aircraft
};

}  // namespace fulmar::path
