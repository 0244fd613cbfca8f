// SPDX-License-Identifier: BSD-3-Clause
// The way back: home in a straight line and a circle there. Without motor: to a place within reach and onto
// it into the wind. Without a position: a circle.
#pragma once
#include <numbers>

#include "fence.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/earth/wind_triangle.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/home_progress.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "glide_model.hpp"
#include "messages.hpp"
#include "reckoned.hpp"

namespace fulmar::safety {

enum class HomeMode : std::uint8_t { home, glide, wait, descend, level };

struct Home {
  static constexpr const char* doc =
      "Return home and circle there; glide to a place in range with a landing into the wind; return by dead "
      "reckoning and a circle without satellites; or straight on, wings level.";
  struct Inputs {
    In<VehicleState> state;
    Optional<SafetyState>
        safety;  // side of the turn within the fence, floor and ceiling; without it the short way
  };
  struct Outputs {
    GuidanceCommand command;
    HomeProgress progress;
  };
  struct Params {
    Choice<HomeMode> mode{
        HomeMode::home,
        "mode of the return; home: flight home and circle; glide: to a place, without motor; wait: home by "
        "dead reckoning, else a circle; descend: the same without motor; level: straight on"};
    Record<Airframe> airframe{"airframe with airspeeds and glide performance", required};
    Record<Origin> origin{"origin of the local frame, for lat and lon"};
    Record<Places> places{"landing places, home first; without it the origin"};
    Param return_height{70, "m", 0, 10000, "height above home of the way and the circle"};
    Param fence_height{10, "m", 0, 1000, "minimum distance from floor and ceiling of the geofence"};
    Param radius{70, "m", 10, 5000, "radius of the circle at home, enlarged for the wind"};
    Param k_orbit{2, "ratio", 0.1, 20, "gain of the approach to a circle, Beard & McLain (10.13)"};
    Param least_ground_speed{
        6, "m/s", 0, 100, "minimum ground speed on the way home; the airspeed rises against stronger wind"};
    Param least_height{40, "m", 0, 10000, "minimum height above home of the circle without a position"};
    Param reckon_std{
        50, "m", 0, 1000,
        "largest standard deviation of a position for dead reckoning; beyond it a circle at fixed bank"};
    Param wait_bank{0.26, "rad", 0.02, 1, "bank of the circle without a position, to the right"};
    Param glide_margin{1.2, "ratio", 1, 2,
                       "ratio of the minimum glide airspeed to the minimum airspeed of the airframe"};
    Param glide_radius{35, "m", 10, 1000, "radius of the circle above a landing place"};
    Param glide_bank{0.5, "rad", 0.05, 1, "bank of the turn into the wind, within the available height"};
    Param final_height{30, "m", 2, 500,
                       "height above the landing place at the start of the final glide into the wind"};
    Param straight_height{15, "m", 0, 500, "height below which no turn starts"};
  };

  void configure(const Params& p) {
    spots_ = p.places.is_given ? places_of(*p.places, *p.origin) : std::vector<Spot>{};
    if (p.places.is_given && spots_.empty())
      throw std::runtime_error(located("places.places", safety_messages::places_missing()).line());
    if (spots_.empty()) spots_.push_back({});
  }
  void retune(const Params& p) {
    if (p.mode.value != mode_) {
      mode_ = p.mode.value;
      begun_ = false;
    }
  }
  Status activate(const Tick&, const Inputs&, const Params& p, const Applied<Outputs>&) {
    mode_ = p.mode.value;
    begun_ = false;
    return Status::ok;
  }

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    if (!begun_) {
      begin(in, p);
      round_ = in.safety ? in.safety->turn : SafetyTurn::either;
    }
    out.command = {};
    out.progress = {};
    out.progress.distance_m = level_distance(s, target_);
    out.progress.ground_m = target_.up_m;
    switch (mode_) {
      case HomeMode::home: home(in, p, out); break;
      case HomeMode::glide: glide(s, p, out); break;
      case HomeMode::wait: wait(s, p, out); break;
      case HomeMode::descend: descend(s, p, out); break;
      case HomeMode::level: hold(s, p, out.command); break;
    }
    return s.position_valid || (mode_ != HomeMode::home && mode_ != HomeMode::glide) ? Status::ok
                                                                                     : Status::degraded;
  }

 private:
  static double level_distance(const VehicleState& s, const Spot& to) {
    return std::hypot(to.north_m - s.position_m.north, to.east_m - s.position_m.east);
  }
  static double course_to(const VehicleState& s, const Spot& to) {
    return std::atan2(to.east_m - s.position_m.east, to.north_m - s.position_m.north);
  }
  static double rho(const VehicleState& s) {
    return standard_air(s.origin_altitude_m + s.height_m).density_kgm3;
  }
  static Vec3<Ned> wind(const VehicleState& s) { return s.wind_valid ? s.wind_mps : Vec3<Ned>{}; }

  void begin(const Inputs& in, const Params& p) {
    const VehicleState& s = *in.state;
    begun_ = true;
    final_ = false;
    reckons_ = true;
    into_wind_ = false;
    target_ = spots_[0];
    height_m_ = within_fence(std::max(s.height_m, target_.up_m + p.least_height), in, p);
    course_rad_ = s.course_rad;
    resets_ = s.reset_count;
    if (mode_ == HomeMode::glide) choose(s, p);
  }

  /// Limits a height to floor and ceiling; the ceiling has priority.
  static double within_fence(double height_m, const Inputs& in, const Params& p) {
    if (!in.safety) return height_m;
    return std::min(std::max(height_m, in.safety->floor_m + p.fence_height),
                    in.safety->ceiling_m - p.fence_height);
  }

  /// Chooses the nearest place within reach at this height; else the nearest of all.
  void choose(const VehicleState& s, const Params& p) {
    double best = 1e18;
    for (const Spot& spot : spots_) {
      const double d = level_distance(s, spot);
      const double cost = d + (d > reach(s, spot, p) ? 1e9 : 0);
      if (cost < best) {
        best = cost;
        target_ = spot;
      }
    }
  }
  /// Range over the ground, down to the ground. The height of the first turn is not included.
  double reach(const VehicleState& s, const Spot& to, const Params& p) const {
    const double course = course_to(s, to),
                 w = std::cos(course) * wind(s).north + std::sin(course) * wind(s).east;
    const BestGlide best = best_glide(*p.airframe, rho(s), -w, p.glide_margin);
    const WindTriangle way = fly_course(course, best.airspeed_mps, wind(s));
    return way.feasible ? std::max(s.height_m - to.up_m, 0.0) / best.sink_mps * way.ground_speed_mps : 0;
  }

  /// Beard & McLain (10.13): towards the centre from afar, a tangent near the circle. Bank feed-forward on
  /// the circle by (9.14).
  void orbit(const VehicleState& s, const Spot& centre, double R, const Params& p, GuidanceCommand& c) const {
    const double d = level_distance(s, centre);
    const double azimuth = d > 1e-3 ? course_to(s, centre) + std::numbers::pi : s.course_rad;
    c.course_rad = wrap_pi(azimuth + side_ * (std::numbers::pi / 2 + std::atan(p.k_orbit * (d - R) / R)));
    const double near = std::clamp(1.5 - std::abs(d - R) / R, 0.0, 1.0);
    c.roll_feedforward_rad =
        near * bank_for_curvature(side_ / R, s.ground_speed_mps, angle_difference(s.course_rad, s.yaw_rad));
  }

  void home(const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    const FlightLimits& limits = p.airframe->limits;
    if (!s.position_valid) return wait(s, p, out);
    GuidanceCommand& c = out.command;
    const double R = radius(s, p);
    orbit(s, target_, R, p, c);
    turn_round(s, c);
    c.height_m = within_fence(target_.up_m + p.return_height, in, p);
    const double fast = airspeed_for_ground_speed(c.course_rad, p.least_ground_speed, wind(s));
    const bool behind =
        fly_course(c.course_rad, limits.airspeed_cruise_mps, wind(s)).ground_speed_mps < p.least_ground_speed;
    c.airspeed_mps = behind ? std::clamp(fast, limits.airspeed_cruise_mps, limits.airspeed_max_mps)
                            : limits.airspeed_cruise_mps;
    if (in.safety && in.safety->engine_weak) within_thrust(s, p, c);
    into_the_wind(s, p, c);
    out.progress.there =
        std::abs(out.progress.distance_m - R) < 0.5 * R && std::abs(s.height_m - c.height_m) < 10;
  }

  /// With a weak motor the climb is limited so that a safe airspeed remains. Below it height is exchanged for
  /// speed.
  static void within_thrust(const VehicleState& s, const Params& p, GuidanceCommand& c) {
    constexpr double height_per_speed_s = 3;
    const double Va = s.airspeed_valid ? s.airspeed_mps : p.airframe->limits.airspeed_cruise_mps;
    const double spare = Va - p.glide_margin * p.airframe->limits.airspeed_min_mps;
    c.height_m = std::min(c.height_m, s.height_m + height_per_speed_s * spare);
  }

  /// When the largest airspeed gives no progress over the ground, the nose points into the wind at that
  /// speed.
  void into_the_wind(const VehicleState& s, const Params& p, GuidanceCommand& c) {
    const double most = p.airframe->limits.airspeed_max_mps, speed = std::hypot(wind(s).north, wind(s).east);
    into_wind_ = s.attitude_valid && speed > (into_wind_ ? 0.9 : 0.95) * most;
    if (!into_wind_) return;
    const double upwind = std::atan2(-wind(s).east, -wind(s).north);
    constexpr double bank_per_rad = 1.0;
    const double max_bank = 0.7 * p.airframe->limits.roll_max_rad;
    const double bank = std::clamp(bank_per_rad * angle_difference(upwind, s.yaw_rad), -max_bank, max_bank);
    c.airspeed_mps = most;
    c.course_rad = s.course_rad;
    c.lateral = LateralMode::acceleration;
    c.roll_feedforward_rad = bank;
    c.lateral_acceleration_mps2 = isa::g0 * std::tan(bank);
  }

  /// Radius that can be flown also with tail wind, at 0.7 of the largest bank.
  static double radius(const VehicleState& s, const Params& p) {
    const FlightLimits& limits = p.airframe->limits;
    const double fastest = limits.airspeed_cruise_mps + std::hypot(wind(s).north, wind(s).east);
    return std::max<double>(p.radius, fastest * fastest / (isa::g0 * std::tan(0.7 * limits.roll_max_rad)));
  }

  /// Commands the long way round until the course wanted lies ahead on that side.
  void turn_round(const VehicleState& s, GuidanceCommand& c) {
    if (round_ == SafetyTurn::either) return;
    constexpr double ahead_rad = 1.8;
    const double side = round_ == SafetyTurn::right ? 1 : -1;
    const double left = wrap_2pi(side * (c.course_rad - s.course_rad));
    if (left < ahead_rad || left > 2 * std::numbers::pi - 0.3) {
      round_ = SafetyTurn::either;
      return;
    }
    c.course_rad = wrap_pi(s.course_rad + side * ahead_rad);
    c.roll_feedforward_rad = 0;
  }

  /// Flies home and circles there while the dead-reckoned position is good enough. Beyond that it circles
  /// through the air by bank alone: a course needs a velocity.
  void wait(const VehicleState& s, const Params& p, Outputs& out) {
    if (s.reset_count != resets_) {
      height_m_ -= s.reset_position_m.down;
      resets_ = s.reset_count;
    }
    hold(s, p, out.command);
    reckons_ = s.position_valid || (reckons_ && located(s, p.reckon_std));
    if (reckons_) return orbit(s, target_, gentle_radius(s, p), p, out.command);
    out.command.lateral = LateralMode::acceleration;
    out.command.roll_feedforward_rad = p.wait_bank;
    out.command.lateral_acceleration_mps2 = isa::g0 * std::tan(p.wait_bank);
  }

  /// Bank of the waiting circle with tail wind; a dead-reckoned home needs no tighter one.
  static double gentle_radius(const VehicleState& s, const Params& p) {
    const double fastest = p.airframe->limits.airspeed_cruise_mps + std::hypot(wind(s).north, wind(s).east);
    return std::max(radius(s, p), 0.7 * fastest * fastest / (isa::g0 * std::tan(p.wait_bank)));
  }

  /// The ground is assumed to be as high as at home. Near it the wings are level.
  void descend(const VehicleState& s, const Params& p, Outputs& out) {
    wait(s, p, out);
    GuidanceCommand& c = out.command;
    c.height_m = target_.up_m;
    c.airspeed_mps = best_glide(*p.airframe, rho(s), 0, p.glide_margin).airspeed_mps;
    if (!reckons_ || s.height_m - target_.up_m > p.straight_height) return;
    c.lateral = LateralMode::acceleration;
    c.roll_feedforward_rad = 0;
    c.lateral_acceleration_mps2 = 0;
  }

  void hold(const VehicleState& s, const Params& p, GuidanceCommand& c) const {
    c.course_rad = s.course_rad;
    c.height_m = height_m_;
    c.airspeed_mps = p.airframe->limits.airspeed_cruise_mps;
  }

  /// The height of the command is that of the ground, for a law that holds height: pitch controls the
  /// airspeed.
  void glide(const VehicleState& s, const Params& p, Outputs& out) {
    const Vec3<Ned> w = wind(s);
    const double speed = std::hypot(w.north, w.east);
    const double upwind = speed > 1 ? std::atan2(-w.east, -w.north) : final_ ? course_rad_ : s.course_rad;
    const double height = s.height_m - target_.up_m;
    out.progress.reach_m = reach(s, target_, p);
    GuidanceCommand& c = out.command;
    c.height_m = target_.up_m;
    const BestGlide best = best_glide(*p.airframe, rho(s), 0, p.glide_margin);
    c.airspeed_mps = best.airspeed_mps;

    // Turn into the wind and its loss of height.
    const double turn = std::abs(angle_difference(upwind, s.course_rad));
    const double radius = best.airspeed_mps * best.airspeed_mps / (isa::g0 * std::tan(p.glide_bank));
    const double cost =
        sink_rate(*p.airframe, best.airspeed_mps, p.glide_bank, rho(s)) * turn * radius / best.airspeed_mps;
    if (!final_ && (height < p.final_height + cost || !s.position_valid)) {
      final_ = true;
      course_rad_ = height < p.straight_height ? s.course_rad : upwind;
    }
    out.progress.final = final_;
    if (final_) {
      c.course_rad = course_rad_;
      return;
    }
    // The circle is downwind of the place by the length of the last leg.
    const double way = std::max(best.airspeed_mps - speed, 0.0) * p.final_height / best.sink_mps;
    const Spot key{target_.north_m - way * std::cos(upwind), target_.east_m - way * std::sin(upwind), 0};
    if (speed > 1)
      orbit(s, key, p.glide_radius, p, c);
    else
      orbit(s, target_, p.glide_radius, p, c);
    // Against the wind a slightly higher airspeed gives more range.
    const double head = -(std::cos(c.course_rad) * w.north + std::sin(c.course_rad) * w.east);
    c.airspeed_mps = best_glide(*p.airframe, rho(s), head, p.glide_margin).airspeed_mps;
  }

  std::vector<Spot> spots_{{}};
  Spot target_;
  HomeMode mode_ = HomeMode::home;
  SafetyTurn round_ = SafetyTurn::either;
  bool begun_ = false, final_ = false, reckons_ = true, into_wind_ = false;
  double height_m_ = 0, course_rad_ = 0;
  std::uint32_t resets_ = 0;
  static constexpr double side_ = 1;  ///< circles to the right
};

}  // namespace fulmar::safety
