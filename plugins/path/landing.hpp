// SPDX-License-Identifier: BSD-3-Clause
// From any place onto a runway: a circle that touches the final approach, the glide slope, the flare, the
// roll. Lines and circles are those of the vector field (Beard & McLain, Small Unmanned Aircraft (2012),
// chapter 10); the flare is the exponential one of Stevens, Lewis & Johnson, Aircraft Control and Simulation
// (2016), 4.6.
#pragma once
#include <numbers>
#include <stdexcept>
#include <string>

#include "decrab.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/sideslip_command.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "landing_notices.hpp"
#include "landing_params.hpp"
#include "plan_file.hpp"
#include "runway_site.hpp"
#include "vector_field.hpp"

namespace fulmar::path {

struct Landing {
  static constexpr const char* doc =
      "Landing: circle onto the final approach, glide slope, flare, roll; go-around outside the limits.";
  struct Inputs {
    In<VehicleState> state;
    Optional<GroundState> ground;    // for the touch-down; without it, from the state
    Optional<VehicleStatus> status;  // the charge of the battery
  };
  struct Outputs {
    GuidanceCommand command;
    LandingProgress progress;
    SideslipCommand sideslip;  // for the rudder: turns the nose to the runway before the touch-down
    Probe height_error_m;      // above the glide slope is positive
    OutQueue<Notice, 4> notices;
  };
  struct Params {
    FieldParams field;
    Record<Runway> runway{"runway with the landing heading, in place of the runway of the plan"};
    Record<PlanFile> plan{"plan of the flight; its runway is used"};
    Record<Origin> origin{"origin of the local frame"};
    Record<Airframe> airframe{"airframe with the limits of the airspeed", required};
    Record<safety::Fence> fence{"geofence for circle, approach and runway; without it no check"};
    Param fence_margin{
        15, "m", 0, 1000,
        "distance of circle and approach from the geofence and its ceiling, as in safety/Monitor"};
    PatternParams pattern;
    Param approach_ratio{1.1, "ratio", 1, 2, "ratio of approach airspeed to the minimum of the airframe"};
    Param wind_share{
        0.5, "ratio", 0, 1,
        "share of the head wind that is added to the airspeed of approach and flare, up to cruise"};
    Param flare_height{3.5, "m", 0.2, 30, "height above the runway at the start of the flare"};
    Param touch_sink{0.4, "m/s", 0.05, 2, "sink rate at the end of the flare"};
    Param decrab{
        0, "rad", 0, 0.4,
        "largest sideslip of the de-crab in the flare; needs the output `sideslip` wired to the inner loops"};
    GoAroundLimits limits;
    Param deceleration{0.8, "m/s2", 0.05, 10,
                       "deceleration of the landing roll, for the check of the runway length"};
    WindLimits wind;
    Param late_sink{0.7, "m/s", 0.05, 3,
                    "largest sink rate of a flare that lasts longer than expected from its height"};
    Param roll_time{60, "s", 5, 3600, "duration of the roll after which the landing counts as ended"};
    Flag go_around{false, "request for a go-around; false permits the next approach"};
  };

  void configure(const Params& p) {
    const double V = p.airframe->limits.airspeed_min_mps;
    const double flare =
        p.flare_height / std::tan(p.pattern.glide_slope) + 2 * V;  // along the slope, and two seconds
    const double needed = p.pattern.aim + flare + 0.5 * V * V / p.deceleration;
    height_off_m_ = 0;
    const std::string of = p.runway.given() ? "runway" : "plan.runway";
    site_.take(p.runway.given() ? *p.runway : p.plan->runway, of, p.plan.given() && !p.runway.given());
    if (p.origin.given()) site_.put(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
    if (site_.runway().length_m < needed)
      throw std::runtime_error(
          located(of + ".length",
                  path_messages::runway_too_short(std::lround(site_.runway().length_m), std::lround(needed)))
              .line());
    check_slope(p.airframe->limits, p.approach_ratio, p.pattern.glide_slope);
    if (p.fence.is_given && site_.located())
      site_.within_fence(*p.fence, *p.origin, p.fence_margin, pattern_of(p.pattern));
  }

  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>&) {
    progress_.stage = LandingStage::join;
    progress_.reason = LandingReason::none;
    settled_s_ = height_off_m_ = refused_s_ = 0;
    decrab_ = {};
    broken_off_ = false;
    head_.reset();
    cross_.reset();
    notices_ = {};
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& s = *in.state;
    if (s.origin_valid) site_.put(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
    if (!site_.located()) return wait(s, p, out);
    locate(s, p);
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    if (s.reset_count != resets_) height_off_m_ = 0;
    resets_ = s.reset_count;
    feel_wind(s, p, dt);
    const LandingProgress before = progress_;
    decide(in, p, dt);
    notices_.report(before, progress_, {flare_s_, rolled_s_, p.roll_time}, tick.now_ns, out.notices);
    fly(s, p, dt);
    out.command = command_;
    out.progress = progress_;
    out.sideslip.sideslip_rad = decrab_.slip_rad();
    out.height_error_m = progress_.stage == LandingStage::approach ? s.height_m - slope_height(p) : 0.0;
    const bool known = s.position_valid && s.height_valid && s.attitude_valid;
    return known ? Status::ok : Status::degraded;
  }

 private:
  /// The place of the runway is unknown: flies straight on.
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
  double runway_height() const { return site_.runway().up_m + height_off_m_; }
  double fix_height(const Params& p) const { return site_.fix_height(pattern_of(p.pattern)) + height_off_m_; }
  double slope_height(const Params& p) const {
    return runway_height() + std::tan(p.pattern.glide_slope) * progress_.along_m;
  }
  Path final_approach(const Params& p) const {
    Path path = site_.final_approach(pattern_of(p.pattern));
    path.origin_m.down -= height_off_m_;
    return path;
  }

  void locate(const VehicleState& s, const Params& p) {
    const Path line = final_approach(p);
    const double n = s.position_m.north - line.origin_m.north, e = s.position_m.east - line.origin_m.east;
    const double cosine = std::cos(site_.runway().heading_rad), sine = std::sin(site_.runway().heading_rad);
    progress_.along_m = -(n * cosine + e * sine);
    progress_.cross_m = cosine * e - sine * n;
    progress_.height_m = s.height_m - runway_height();
    progress_.runway_rad = site_.runway().heading_rad;
    progress_.beyond_threshold_m = p.pattern.aim - progress_.along_m;
  }

  /// Wind along and across the runway, and the length of a landing in it.
  void feel_wind(const VehicleState& s, const Params& p, double dt) {
    const double c = std::cos(site_.runway().heading_rad), e = std::sin(site_.runway().heading_rad);
    const Vec3<Ned> w = s.wind_valid ? s.wind_mps : Vec3<Ned>{};
    constexpr double gusts_s = 5;  // a lull of one step must not start an approach
    progress_.head_wind_mps = head_.step(-(w.north * c + w.east * e), gusts_s, dt);
    progress_.cross_wind_mps = cross_.step(w.east * c - w.north * e, gusts_s, dt);
    const double V = capped(p.airframe->limits.airspeed_min_mps + faster_mps(s, p), p);
    const double over_ground = std::max(V - progress_.head_wind_mps, 1.0);
    const double flare_s = (p.flare_height / std::tan(p.pattern.glide_slope)) / V + 2;
    progress_.needed_m =
        p.pattern.aim + flare_s * over_ground + 0.5 * over_ground * over_ground / p.deceleration;
  }
  static bool by_wind(LandingReason why) {
    return why == LandingReason::crosswind || why == LandingReason::runway_short;
  }
  LandingReason refused_by_wind(const Params& p) const {
    const double V = p.approach_ratio * p.airframe->limits.airspeed_min_mps;
    if (std::abs(progress_.cross_wind_mps) > p.wind.crosswind_limit * V) return LandingReason::crosswind;
    return progress_.needed_m > site_.runway().length_m ? LandingReason::runway_short : LandingReason::none;
  }

  void decide(const Inputs& in, const Params& p, double dt) {
    const VehicleState& s = *in.state;
    LandingStage& stage = progress_.stage;
    const double course_error = angle_difference(site_.runway().heading_rad, s.course_rad);
    const bool touches = in.ground && in.ground->contact == Contact::ground;
    switch (stage) {
      case LandingStage::join:
        refused_s_ =
            progress_.reason == LandingReason::none ? 0 : refused_s_ + (by_wind(progress_.reason) ? dt : 0);
        if (onto_final(s, course_error, p)) begin_approach(in, p);
        break;
      case LandingStage::approach:
        if (p.limits.decision_height > progress_.height_m && touches)
          roll();  // the height was wrong
        else if (const LandingReason why = missed(s, p); why != LandingReason::none)
          go_around(why);
        else if (progress_.height_m < p.flare_height)
          flare(s);
        break;
      case LandingStage::flare:
        flare_s_ += dt;
        if (touches || settled(in, dt))
          roll();
        else if (p.go_around)
          go_around(LandingReason::commanded);
        else if (too_long(s, p))
          break_flare_off();
        break;
      case LandingStage::roll_out:
        rolled_s_ += dt;
        // a bounce, or a false touch-down
        if (rolled_s_ < 4 && in.ground && in.ground->contact == Contact::air) {
          flare(s);
          break;
        }
        // Along the runway: a strong wind rolls it back.
        if ((rolled_s_ > 1 && s.ground_speed_mps * std::cos(course_error) < 1) || rolled_s_ > p.roll_time)
          stage = LandingStage::stopped;
        break;
      case LandingStage::go_around:
        if (s.height_m > fix_height(p) - 2) stage = LandingStage::join;
        break;
      case LandingStage::stopped: break;
    }
  }

  bool onto_final(const VehicleState& s, double course_error, const Params& p) const {
    const double past_fix = p.pattern.final_length + p.pattern.aim - progress_.along_m;
    const bool onto = std::abs(past_fix) < 0.5 * p.pattern.circle_radius &&
                      std::abs(progress_.cross_m) < 20 && std::abs(course_error) < 0.35;
    return onto && std::abs(s.height_m - fix_height(p)) < p.limits.height_limit && !p.go_around;
  }
  void begin_approach(const Inputs& in, const Params& p) {
    constexpr double low_frac = 0.2;
    progress_.reason = refused_by_wind(p);
    const bool low = in.status && in.status->battery_frac < low_frac;  // an unknown battery is not low
    if (progress_.reason == LandingReason::none || p.wind.wind == WindAnswer::warn || low ||
        refused_s_ > p.wind.wind_wait)
      progress_.stage = LandingStage::approach;
  }
  void flare(const VehicleState& s) {
    progress_.stage = LandingStage::flare;
    flare_height_m_ = s.height_m;
    settled_s_ = flare_s_ = 0;
  }
  void roll() {
    progress_.stage = LandingStage::roll_out;
    rolled_s_ = 0;
  }
  void go_around(LandingReason why) {
    progress_.stage = LandingStage::go_around;
    progress_.reason = why;
    ++progress_.go_arounds;
  }
  /// An aircraft in flight below the height of the runway shows the error of that height.
  void break_flare_off() {
    height_off_m_ += std::min(progress_.height_m, 0.0);
    broken_off_ = true;
    go_around(LandingReason::flare_long);
  }

  /// Before the decision height: reason why this approach cannot end on the runway.
  LandingReason missed(const VehicleState& s, const Params& p) const {
    if (p.go_around) return LandingReason::commanded;
    if (progress_.height_m < p.limits.decision_height) return LandingReason::none;
    if (!s.position_valid || !s.height_valid) return LandingReason::position;
    if (progress_.height_m > 2 * p.limits.decision_height) return LandingReason::none;
    if (std::abs(progress_.cross_m) > p.limits.cross_limit) return LandingReason::cross_track;
    return std::abs(s.height_m - slope_height(p)) > p.limits.height_limit ? LandingReason::height
                                                                          : LandingReason::none;
  }
  /// Duration of a flare, s, whose sink decreases with its height, B&M-like: dh/dt = -(t + (s - t) h / h0).
  double expected_flare_s(double slope_sink, const Params& p) const {
    const double ratio = std::max(slope_sink / p.touch_sink, 1.01);
    return p.flare_height / p.touch_sink * std::log(ratio) / (ratio - 1);
  }
  /// In the flare: true without a touch-down when the remaining runway is the stopping distance. Once: the
  /// next flare lands.
  bool too_long(const VehicleState& s, const Params& p) const {
    const double left = site_.runway().length_m - p.pattern.aim + progress_.along_m;
    const double stop = 0.5 * s.ground_speed_mps * s.ground_speed_mps / p.deceleration;
    return !broken_off_ && s.position_valid && flare_s_ > 5 && left < stop;
  }
  /// Without a ground state: true when a much lower height was commanded for a while and the aircraft does
  /// not sink. The height may be wrong by metres, so it is no evidence.
  bool settled(const Inputs& in, double dt) {
    constexpr double asked_m = 1, still_mps = 0.15, for_s = 2;
    if (in.ground) return false;
    const VehicleState& s = *in.state;
    const bool still = s.height_m - flare_height_m_ > asked_m && std::abs(s.climb_rate_mps) < still_mps;
    settled_s_ = still ? settled_s_ + dt : 0;
    return settled_s_ > for_s;
  }

  /// Increase of the airspeed in approach and flare: a share of the steady wind, which keeps some ground
  /// speed.
  double faster_mps(const VehicleState& s, const Params& p) const {
    if (!s.wind_valid) return 0;
    return p.wind_share * std::max(progress_.head_wind_mps, 0.0);
  }
  double capped(double airspeed_mps, const Params& p) const {
    return std::min(airspeed_mps, p.airframe->limits.airspeed_cruise_mps);
  }

  void fly(const VehicleState& s, const Params& p, double dt) {
    const FlightLimits& limits = p.airframe->limits;
    decrab_.step(progress_, s, *p.airframe, p.decrab, dt);
    const double faster = faster_mps(s, p);
    if (progress_.stage == LandingStage::join) {
      const Path path = site_.circle(pattern_of(p.pattern));
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
        // From the sink of the slope to that of the touch-down, with the height.
        const double slope_sink = std::max(-command_.climb_rate_mps, p.touch_sink.value);
        const double left = std::clamp(progress_.height_m / p.flare_height, 0.0, 1.0);
        const double late_s = std::max(flare_s_ - 1.3 * expected_flare_s(slope_sink, p), 0.0);
        const double sink = p.touch_sink + left * (slope_sink - p.touch_sink);
        constexpr double firmer_mps2 = 0.15;
        command_.climb_rate_mps =
            -std::max(sink, std::min<double>(p.touch_sink + firmer_mps2 * late_s, p.late_sink));
        // A height that decreases at this rate, not the rate alone: without an error the law does not
        // integrate and keeps its trim.
        flare_height_m_ = std::clamp(flare_height_m_ + command_.climb_rate_mps * dt, s.height_m - lead_m,
                                     s.height_m + lead_m);
        command_.height_m = flare_height_m_;
        command_.airspeed_mps = capped(limits.airspeed_min_mps + faster, p);
        command_.roll_feedforward_rad += decrab_.bank_rad(s, *p.airframe);
        break;
      }
      case LandingStage::go_around:
        command_.height_m = fix_height(p);
        command_.climb_rate_mps = 0;
        command_.airspeed_mps = limits.airspeed_cruise_mps;
        break;
      case LandingStage::roll_out:
      case LandingStage::stopped:
        command_.height_m = runway_height();
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

  RunwaySite site_;
  GuidanceCommand command_;
  LandingProgress progress_;
  double refused_s_ = 0;  ///< time on the circle since the first approach that was rejected for wind
  double settled_s_ = 0, rolled_s_ = 0, flare_s_ = 0, flare_height_m_ = 0;
  double height_off_m_ = 0;   ///< of the runway below the given height, from an earlier flare
  bool broken_off_ = false;   ///< the one flare that lasted too long has occurred
  LowPass head_, cross_;      ///< wind, m/s
  std::uint32_t resets_ = 0;  ///< last counter of resets of the state
  LandingNotices notices_;
  Decrab decrab_;
  static constexpr double lead_m = 1.5;  ///< lead of the flare's height
};

}  // namespace fulmar::path
