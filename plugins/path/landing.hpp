// SPDX-License-Identifier: BSD-3-Clause
// From anywhere onto a runway: a circle that touches the final approach, the glide slope, the flare, the
// roll. Lines and circles are those of the vector field (Beard & McLain, Small Unmanned Aircraft (2012),
// chapter 10); the flare is the exponential one of Stevens, Lewis & Johnson, Aircraft Control and Simulation
// (2016), 4.6.
#pragma once
#include <numbers>
#include <stdexcept>
#include <string>

#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/fence.hpp"
#include "fulmar/flight/geodesy.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/runway.hpp"
#include "fulmar/msg/sideslip_command.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "plan_file.hpp"
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
    SideslipCommand sideslip;  // for the rudder: turns the nose to the runway before it touches
    Probe height_error_m;      // above the glide slope is positive
  };
  struct Params {
    FieldParams field;
    Record<Runway> runway{"the strip; heading is the one that is landed in; in place of the plan's"};
    Record<PlanFile> plan{"the flight's, of which the runway counts"};
    Record<Origin> origin{"of the local frame"};
    Record<Airframe> airframe{"limits of the airspeed", required};
    Record<safety::Fence> fence{
        "in which circle, approach and runway have to lie; without it none is looked at"};
    Param fence_margin{15, "m", 0, 1000, "that they leave to the fence and its ceiling, as safety/Monitor's"};
    Param glide_slope{0.07, "rad", 0.02, 0.3,
                      "of the approach; what touches down with a late flare is its sink"};
    Param aim{50, "m", 0, 500, "from the threshold to where the glide slope meets the runway"};
    Param final_length{400, "m", 50, 10000, "of the final approach, from its circle to the threshold"};
    Param circle_radius{70, "m", 10, 2000, "of the circle that leads onto it"};
    Choice<Turn> circle{Turn::left, "how that circle is flown"};
    Param approach_ratio{1.1, "ratio", 1, 2, "approach airspeed over the airframe's minimum"};
    Param wind_share{0.5, "ratio", 0, 1,
                     "of the head wind that approach and flare are faster by, up to the cruise airspeed"};
    Param flare_height{3.5, "m", 0.2, 30, "above the runway, where the flare begins"};
    Param touch_sink{0.4, "m/s", 0.05, 2, "sink rate that the flare ends with"};
    Param decrab{0, "rad", 0, 0.4,
                 "most sideslip by which the flare turns the nose to the runway; needs the output `sideslip` "
                 "wired to the inner loops"};
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
    runway_ = p.runway.given() ? *p.runway : p.plan->runway;
    const std::string of = p.runway.given() ? "runway" : "plan.runway";
    const auto known = [](double a, double b, double c) {
      return (a != unknown_std) + (b != unknown_std) + (c != unknown_std);
    };
    const int local = known(runway_.north_m, runway_.east_m, runway_.up_m),
              geodetic = known(runway_.lat_deg, runway_.lon_deg, runway_.alt_msl_m);
    if (runway_.length_m <= 0 && local + geodetic > 0) throw std::runtime_error(of + ": needs a length");
    if (runway_.length_m <= 0)
      throw std::runtime_error(
          std::string(p.plan.given() ? "plan" : "runway") +
          ": there is no runway to land on; give one here or in the plan, as {north, east, "
          "up, heading, length} or {lat, lon, alt_msl, heading, length}");
    if (local + geodetic != 3 || (local != 0 && geodetic != 0))
      throw std::runtime_error(of + ": needs either north, east, up or lat, lon, alt_msl");
    located_ = local == 3;
    if (p.origin.given()) put(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
    if (runway_.length_m < needed)
      throw std::runtime_error(of + ".length: " + std::to_string(std::lround(runway_.length_m)) +
                               " m is too short; aim, flare and roll take " +
                               std::to_string(std::lround(needed)) + " m in still air");
    slope_that_sinks(p);
    if (p.fence.is_given && located_) within_fence(p);
  }

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>&) {
    progress_.stage = LandingStage::join;
    settled_s_ = slip_rad_ = 0;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    if (!located_ && s.origin_valid) put(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
    if (!located_) return wait(s, p, out);
    locate(s, p);
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    decide(in, p, dt);
    fly(s, p, dt);
    out.command = command_;
    out.progress = progress_;
    out.sideslip.sideslip_rad = slip_rad_;
    out.height_error_m = progress_.stage == LandingStage::approach ? s.height_m - slope_height(p) : 0.0;
    const bool known = s.position_valid && s.height_valid && s.attitude_valid;
    return known ? Status::ok : Status::degraded;
  }

 private:
  /// A geodetic runway, once the origin is known.
  void put(double lat_deg, double lon_deg, double alt_m) {
    if (located_) return;
    const Eigen::Vector3d p_n =
        LocalFrame(lat_deg, lon_deg, alt_m).to_ned(runway_.lat_deg, runway_.lon_deg, runway_.alt_msl_m);
    runway_.north_m = p_n.x(), runway_.east_m = p_n.y(), runway_.up_m = -p_n.z();
    located_ = true;
  }
  /// Refuses a fence that the way onto the runway, or along it again, leaves or comes too near to.
  void within_fence(const Params& p) const {
    safety::Polygon fence;
    fence.set(*p.fence, *p.origin);
    const Path orbit = circle(p);
    const double c = std::cos(runway_.heading_rad), s = std::sin(runway_.heading_rad);
    const auto look = [&](const char* what, double north_m, double east_m) {
      const double room = fence.room_m(north_m, east_m);
      if (room >= p.fence_margin) return;
      const auto m = [](double x) { return std::to_string(std::lround(x)) + " m"; };
      throw std::runtime_error("fence.corners: " + std::string(what) + ", " + m(north_m) + " north, " +
                               m(east_m) + " east, " +
                               (room < 0 ? "lies " + m(-room) + " outside of the fence"
                                         : "leaves " + m(room) + " to the fence, of " + m(p.fence_margin)) +
                               "; move the fence, or set final_length, circle_radius, circle");
    };
    constexpr int points = 72;
    for (int i = 0; i < points; ++i) {
      const double a = 2 * std::numbers::pi * i / points;
      look("the circle onto the final approach", orbit.origin_m.north + p.circle_radius * std::cos(a),
           orbit.origin_m.east + p.circle_radius * std::sin(a));
    }
    for (int i = 0; i <= points; ++i) {
      const double along = -p.final_length + (p.final_length + runway_.length_m) * i / points;
      look(along < 0 ? "the final approach" : "the runway", runway_.north_m + along * c,
           runway_.east_m + along * s);
    }
    if (fix_height(p) + p.fence_margin > p.fence->ceiling_m)
      throw std::runtime_error("fence.ceiling_m: the circle onto the final approach is " +
                               std::to_string(std::lround(fix_height(p))) + " m high, the ceiling " +
                               std::to_string(std::lround(p.fence->ceiling_m)) + " m");
  }
  /// Above the slope for good it would go around for ever. With a head wind it takes less.
  static void slope_that_sinks(const Params& p) {
    const FlightLimits& limits = p.airframe->limits;
    const double V = std::min(p.approach_ratio * limits.airspeed_min_mps, limits.airspeed_cruise_mps);
    const double sink = V * std::sin(p.glide_slope), most = limits.sink_rate_max_mps;
    if (sink <= most) return;
    const auto number = [](double x) { return std::to_string(x).substr(0, 5); };
    throw std::runtime_error("glide_slope: " + number(p.glide_slope) + " rad at the " + number(V) +
                             " m/s of the approach sinks by " + number(sink) +
                             " m/s in still air, and the airframe's limits.sink_rate_max is " + number(most) +
                             " m/s; at most " + number(std::asin(most / V)) + " rad");
  }

  /// Nobody knows where the runway is: straight on.
  Status wait(const VehicleState& s, const Params& p, Outputs& out) {
    command_ = {};
    command_.course_rad = s.course_rad;
    command_.height_m = s.height_m;
    command_.airspeed_mps = p.airframe->limits.airspeed_cruise_mps;
    out.command = command_;
    out.progress = progress_;
    out.sideslip = {};
    out.height_error_m = 0.0;
    return Status::degraded;
  }
  static double k(const VehicleState& s, const Params& p) {
    return p.field.reference_speed / std::max(s.ground_speed_mps, 0.3 * p.field.reference_speed);
  }
  double runway_height(const Params&) const { return runway_.up_m; }
  double fix_height(const Params& p) const {
    return runway_height(p) + std::tan(p.glide_slope) * (p.final_length + p.aim);
  }
  double slope_height(const Params& p) const {
    return runway_height(p) + std::tan(p.glide_slope) * progress_.along_m;
  }

  /// The centre line as a path, from the point where the slope meets it, down by the slope.
  Path final_approach(const Params& p) const {
    const Runway& r = runway_;
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
    const Runway& r = runway_;
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
    const double cosine = std::cos(runway_.heading_rad), sine = std::sin(runway_.heading_rad);
    progress_.along_m = -(n * cosine + e * sine);
    progress_.cross_m = cosine * e - sine * n;
    progress_.height_m = s.height_m - runway_height(p);
  }

  void decide(const Inputs& in, const Params& p, double dt) {
    const VehicleState& s = *in.state;
    LandingStage& stage = progress_.stage;
    const double course_error = angle_difference(runway_.heading_rad, s.course_rad);
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
        if (p.decision_height > progress_.height_m && in.status && in.status->on_ground)
          stage = LandingStage::roll_out, rolled_s_ = 0;  // the height was wrong
        else if (p.go_around || missed(s, p))
          stage = LandingStage::go_around, ++progress_.go_arounds;
        else if (progress_.height_m < p.flare_height)
          stage = LandingStage::flare, flare_height_m_ = s.height_m, settled_s_ = 0;
        break;
      case LandingStage::flare:
        if (touched(in, dt)) stage = LandingStage::roll_out, rolled_s_ = 0;
        break;
      case LandingStage::roll_out:
        rolled_s_ += dt;
        // Along the runway: a wind that is strong enough rolls it back.
        if (rolled_s_ > 1 && s.ground_speed_mps * std::cos(course_error) < 1) stage = LandingStage::stopped;
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
  /// The vehicle says so; or, as not every vehicle can, it was asked to be much lower for a while and does
  /// not sink. The height is off by metres, so it says little.
  bool touched(const Inputs& in, double dt) {
    constexpr double asked_m = 1, still_mps = 0.15, for_s = 2;
    if (in.status && in.status->on_ground) return true;
    const VehicleState& s = *in.state;
    const bool still = s.height_m - flare_height_m_ > asked_m && std::abs(s.climb_rate_mps) < still_mps;
    settled_s_ = still ? settled_s_ + dt : 0;
    return settled_s_ > for_s;
  }

  /// What approach and flare are faster by: a steady wind's share, so that there is some ground speed.
  double faster_mps(const VehicleState& s, const Params& p) const {
    if (!s.wind_valid) return 0;
    const double head =
        -(s.wind_mps.north * std::cos(runway_.heading_rad) + s.wind_mps.east * std::sin(runway_.heading_rad));
    return p.wind_share * std::max(head, 0.0);
  }
  double capped(double airspeed_mps, const Params& p) const {
    return std::min(airspeed_mps, p.airframe->limits.airspeed_cruise_mps);
  }

  /// From the flare on the nose is turned to the runway, as far as `decrab` goes; what is left of the error
  /// after a second is taken up once more, so the rudder need not be known well.
  void turn_nose(const VehicleState& s, const Params& p, double dt) {
    constexpr double within_s = 1, blown_m = 2, steer_m = 15, steer_rad = 0.2, gain = 4, most_rad = 0.35;
    const bool low = progress_.stage == LandingStage::flare || progress_.stage == LandingStage::roll_out;
    const Airframe& a = *p.airframe;
    const bool steered = a.rudder.limit_rad > 0 && a.aero.yaw.rudder_ratio != 0;
    if (!low || !steered || p.decrab <= 0 || !s.attitude_valid) {
      slip_rad_ = 0;
      return;
    }
    const double off = angle_difference(s.yaw_rad, runway_.heading_rad);
    if (progress_.stage ==
        LandingStage::roll_out) {  // back to the centre line, by what is left of the rudder
      const double towards = std::clamp(progress_.cross_m / steer_m, -steer_rad, steer_rad);
      slip_rad_ = std::clamp(gain * (off + towards), -most_rad, most_rad);
      return;
    }
    // The bank may not suffice for slip and gust: whoever is blown off the line flies less of the slip.
    const double leeward_m = std::max(slip_rad_ > 0 ? -progress_.cross_m : progress_.cross_m, 0.0);
    const double most = p.decrab * std::max(1 - leeward_m / blown_m, 0.0);
    slip_rad_ = std::clamp(slip_rad_ + off * dt / within_s, -most, most);
  }
  /// Bank that takes the side force of that sideslip, rudder included: m g sin(phi) = q S CY, B&M (4.18) and
  /// (4.5).
  double slip_bank(const VehicleState& s, const Params& p) const {
    const Airframe& a = *p.airframe;
    const Derivatives &Y = a.aero.side, &N = a.aero.yaw;
    const double rudder = N.rudder_ratio != 0 ? -N.beta_ratio / N.rudder_ratio : 0;
    const double q =
        0.5 * standard_air(s.origin_altitude_m + s.height_m).density_kgm3 * s.airspeed_mps * s.airspeed_mps;
    const double side = q * a.wing.area_m2 * (Y.beta_ratio + Y.rudder_ratio * rudder) * slip_rad_;
    return std::asin(std::clamp(-side / (a.mass_kg * isa::g0), -0.17, 0.17));
  }

  void fly(const VehicleState& s, const Params& p, double dt) {
    const FlightLimits& limits = p.airframe->limits;
    turn_nose(s, p, dt);
    const double faster = faster_mps(s, p);
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
    command_.airspeed_mps = capped(p.approach_ratio * limits.airspeed_min_mps + faster, p);
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
        command_.airspeed_mps = capped(limits.airspeed_min_mps + faster, p);
        command_.roll_feedforward_rad += slip_bank(s, p);
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

  Runway runway_;  ///< in the local frame, if `located_`
  bool located_ = false;
  GuidanceCommand command_;
  LandingProgress progress_;
  double settled_s_ = 0, rolled_s_ = 0, flare_height_m_ = 0;
  double slip_rad_ = 0;                  ///< asked for
  static constexpr double lead_m = 1.5;  ///< of the flare's height before the aircraft
};

}  // namespace fulmar::path
