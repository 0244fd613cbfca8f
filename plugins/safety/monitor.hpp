// SPDX-License-Identifier: BSD-3-Clause
// What has failed, with thresholds, delays and one answer. The README has the table.
#pragma once
#include <array>
#include <cstdio>

#include "fence.hpp"
#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/energy.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "glide_model.hpp"

namespace fulmar::safety {

/// A flag that rises when `bad` has held for `raise_s` and falls when `good` has for `clear_s`; what is
/// neither changes nothing.
class Alarm {
 public:
  bool step(bool bad, bool good, double raise_s, double clear_s, double dt_s) {
    held_s_ = (raised_ ? good : bad) ? held_s_ + dt_s : 0;
    if (held_s_ > 0 && held_s_ >= (raised_ ? clear_s : raise_s)) raised_ = !raised_, held_s_ = 0;
    return raised_;
  }
  bool step(bool bad, double raise_s, double clear_s, double dt_s) {
    return step(bad, !bad, raise_s, clear_s, dt_s);
  }
  bool raised() const { return raised_; }
  void reset() { *this = {}; }

 private:
  double held_s_ = 0;
  bool raised_ = false;
};

struct Monitor {
  static constexpr const char* doc =
      "What has failed - fence, receiver, pitot tube, radio, link, battery, attitude, motor, wind, estimate "
      "- and what "
      "to do about it.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleStatus> status;     // without it nothing is said of battery and link
    Optional<NavigationHealth> health;  // without it, what the state says of itself
    Optional<Rc> rc;                    // without it, what the status says of the radio
    Optional<Actuators> actuators;      // the throttle; without it nothing is said of the motor
  };
  struct Outputs {
    SafetyState safety;
    OutQueue<Notice, 12> notices;
  };
  // The parameters by cause. In a mission they stand side by side, without the groups.
  struct FenceLimits {
    Param fence_margin{15, "m", 0, 1000, "that the turn back leaves to the fence"};
    Param fence_clear{30, "m", 0, 1000, "more than that, for the fence to be forgotten"};
    Param fence_reaction{1.5, "s", 0, 10, "straight on, until the bank is there"};
    Param fence_bank_ratio{0.7, "ratio", 0.2, 1, "of the airframe's largest bank, in the turn back"};
    Param fence_pull{3, "m/s2", 0.5, 20, "of the pull-out at floor and ceiling"};
    Flag keep_fence{true, "the answer to the fence stays when the aircraft is back inside"};
  };
  struct GnssDelays {
    Param gnss_raise{3, "s", 0, 600, "without a position, until it is lost"};
    Param gnss_clear{3, "s", 0, 600, "with one, until it is back"};
    Param wait_time{120, "s", 0, 36000, "circling without a position, until it descends"};
  };
  struct PitotDelays {
    Param pitot_raise{2, "s", 0, 600, "without an airspeed, until it is lost"};
    Param pitot_clear{5, "s", 0, 600, "with one, until it is back"};
  };
  struct RadioDelays {
    Flag radio_required{false, "the radio is lost also if it was never heard"};
    Param radio_timeout{1, "s", 0.05, 600, "without a frame, until it is not there"};
    Param radio_raise{2, "s", 0, 600, "not there, until it is lost"};
    Param radio_clear{2, "s", 0, 600, "there, until it is back"};
    Param land_after{120, "s", 0, 36000, "of the answer home, until the aircraft lands"};
  };
  struct LinkDelays {
    Param link_timeout{1, "s", 0.05, 600, "without a status, until the link is lost"};
    Param link_clear{2, "s", 0, 600, "with one, until it is back"};
  };
  struct BatteryLimits {
    Param battery_low{0.25, "ratio", 0, 1, "of the charge: low"};
    Param battery_empty{0.1, "ratio", 0, 1, "of the charge: empty"};
    Param volt_low{0.83, "ratio", 0, 1, "of the full battery's voltage: low, 3.5 V of a 4.2 V cell"};
    Param volt_empty{0.75, "ratio", 0, 1, "of the full battery's voltage: empty"};
    Param battery_raise{3, "s", 0, 600, "below, until it is said: a climb makes the voltage sag"};
    Param battery_clear{30, "s", 0, 600, "above it by a tenth, until it is taken back"};
  };
  struct AttitudeLimits {
    Param roll_limit{1.13, "rad", 0.2, 3.2, "of an attitude that is excessive"};
    Param pitch_limit{0.7, "rad", 0.2, 1.6, "of an attitude that is excessive, either way"};
    Param attitude_raise{0.3, "s", 0, 10, "beyond, until it is said"};
    Param attitude_clear{1, "s", 0, 60, "below two thirds of it, until it is taken back"};
  };
  struct EngineLimits {
    Param engine_share{0.25, "ratio", -2, 1, "of the thrust that the model expects: less has failed"};
    Param engine_thrust{0.05, "ratio", 0, 2, "of the weight: less thrust than that says nothing"};
    Param engine_missing{0.1, "ratio", 0, 2, "of the weight: less thrust that is missing is sinking air"};
    Param engine_smoothing{1, "s", 0.05, 20, "time constant of thrust and drag"};
    Param engine_raise{2, "s", 0, 600, "of a force that brakes, until it is said; of none, twice as long"};
    Param engine_clear{5, "s", 0, 600, "of more than twice as much, until it is taken back"};
  };
  struct WindLimits {
    Param wind_limit{0.6, "ratio", 0, 5,
                     "wind over cruise airspeed that is excessive: about the stalling speed, on the ground "
                     "nothing holds it then"};
    Param wind_smoothing{5, "s", 0.1, 600, "time constant of the wind"};
    Param wind_raise{10, "s", 0, 600, "above, until it is said"};
    Param wind_clear{30, "s", 0, 600, "below nine tenths of it, until it is taken back"};
  };
  struct EstimatorDelays {
    Param estimator_raise{1, "s", 0, 60, "not valid, until it is said"};
    Param estimator_clear{2, "s", 0, 60, "valid, until it is taken back"};
  };
  struct Params {
    Record<Airframe> airframe{"thrust, drag, limits", required};
    Record<Origin> origin{"of the local frame, for lat and lon"};
    Record<Fence> fence{"corners, floor, ceiling; without it there is none"};
    Record<Places> places{"where to come down; the first is home. Without it, the origin"};
    Choice<SafetyAnswer> asked{SafetyAnswer::none,
                               "the answer as long as nothing is wrong: home, land and wait, for a pilot"};
    Flag landing{false, "while it is true the floor of the fence does not count"};

    Param airborne_raise{1.5, "s", 0, 60, "off the ground, until it flies: a landing may bounce"};

    FenceLimits fencing;
    GnssDelays gnss;
    PitotDelays pitot;
    RadioDelays radio;
    LinkDelays link;
    BatteryLimits battery;
    AttitudeLimits attitude;
    EngineLimits engine;
    WindLimits wind;
    EstimatorDelays estimator;
  };

  void configure(const Params& p);
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  static bool is_airborne(const Inputs& in, const Params& p);
  void take_off(bool airborne, const Params& p, double dt);
  void fence(const VehicleState& s, const Params& p, double dt);
  void sensors(const Tick& tick, const Inputs& in, const Params& p, double dt);
  void radio_and_link(const Tick& tick, const Inputs& in, const Params& p, double dt);
  void battery(const Inputs& in, const Params& p, double dt);
  void motor(const Inputs& in, const Params& p, double dt);
  void wind(const VehicleState& s, const Params& p, double dt);
  SafetyAnswer answer(const Params& p, double dt);
  void tell(const Tick& tick, Outputs& out);

  static constexpr double there_volt = 1;  ///< below it there is no battery, or none that is measured
  struct Alarms {
    Alarm fence, gnss, pitot, radio, link, low, empty, attitude, engine, wind, estimator;
  };
  Polygon polygon_;
  double floor_m_ = -not_given, ceiling_m_ = not_given;
  std::vector<Spot> places_;
  Alarms alarms_;
  SafetyState now_, told_;
  bool above_floor_ = false;  ///< it has been: before, a take-off
  bool kept_fence_ = false;
  bool radio_heard_ = false, airspeed_heard_ = false, position_heard_ = false;
  double thrust_expected_ = 0, thrust_found_ = 0;  ///< smoothed, N
  double aloft_s_ = 0;
  Vec3<Ned> wind_;
  bool wind_known_ = false;
};

inline void Monitor::configure(const Params& p) {
  polygon_ = {};
  places_ = p.places.is_given ? places_of(*p.places, *p.origin) : std::vector<Spot>{};
  if (p.places.is_given && places_.empty())
    throw std::runtime_error("places.places: there are none; the first is home");
  if (places_.empty()) places_.push_back({});
  if (p.fence.is_given) {
    polygon_.set(*p.fence, *p.origin);
    floor_m_ = now_.floor_m = p.fence->floor_m, ceiling_m_ = now_.ceiling_m = p.fence->ceiling_m;
    const double room = polygon_.room_m(places_[0].north_m, places_[0].east_m);
    if (room < p.fencing.fence_margin)
      throw std::runtime_error("fence.corners: home, " + std::to_string(std::lround(places_[0].north_m)) +
                               " m north, " + std::to_string(std::lround(places_[0].east_m)) +
                               (room < 0 ? " m east, lies outside of the fence"
                                         : " m east, lies nearer to the fence than fence_margin"));
  }
  const BatteryLimits& b = p.battery;
  if (b.battery_empty > b.battery_low || b.volt_empty > b.volt_low)
    throw std::runtime_error("battery_empty, volt_empty: above battery_low, volt_low");
}

/// Off the ground, as far as the vehicle or the state knows.
inline bool Monitor::is_airborne(const Inputs& in, const Params& p) {
  if (in.status) return in.status->armed && !in.status->on_ground;
  return in.state->height_m > 3 && in.state->ground_speed_mps > 0.5 * p.airframe->limits.airspeed_min_mps;
}

/// A wheel that leaves the ground for a moment is no flight; with each flight what concerns it begins anew.
inline void Monitor::take_off(bool airborne, const Params& p, double dt) {
  aloft_s_ = airborne ? aloft_s_ + dt : 0;
  const bool before = now_.airborne;
  now_.airborne = airborne && (before || aloft_s_ > p.airborne_raise);
  if (!now_.airborne || before) return;
  above_floor_ = kept_fence_ = false;
  alarms_.fence.reset(), alarms_.engine.reset(), alarms_.attitude.reset();
  thrust_expected_ = thrust_found_ = now_.waiting_s = now_.returning_s = 0, now_.thrust_ratio = 1;
}

inline Status Monitor::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
  const VehicleState& s = *in.state;
  take_off(is_airborne(in, p), p, dt);
  sensors(tick, in, p, dt);
  radio_and_link(tick, in, p, dt);
  battery(in, p, dt);
  wind(s, p, dt);
  if (now_.airborne) {
    fence(s, p, dt);
    motor(in, p, dt);
  }
  now_.fence = alarms_.fence.raised();
  now_.gnss_lost = alarms_.gnss.raised(), now_.pitot_lost = alarms_.pitot.raised();
  now_.radio_lost = alarms_.radio.raised(), now_.link_lost = alarms_.link.raised();
  now_.battery_low = alarms_.low.raised(), now_.battery_empty = alarms_.empty.raised();
  now_.attitude_excessive = alarms_.attitude.raised(), now_.engine_failed = alarms_.engine.raised();
  now_.wind_excessive = alarms_.wind.raised(), now_.estimator_failed = alarms_.estimator.raised();
  now_.answer = answer(p, dt);
  out.safety = now_;
  tell(tick, out);
  return Status::ok;
}

inline void Monitor::fence(const VehicleState& s, const Params& p, double dt) {
  const FenceLimits& f = p.fencing;
  now_.fence_margin_m = now_.height_margin_m = not_given;
  now_.turn = SafetyTurn::either;
  if (!polygon_.given()) return;
  const bool known = s.position_valid && s.velocity_valid;
  if (known) {
    TurnBack t;
    t.north_m = s.position_m.north, t.east_m = s.position_m.east;
    t.v_north_mps = s.velocity_mps.north, t.v_east_mps = s.velocity_mps.east;
    if (s.wind_valid) t.w_north_mps = s.wind_mps.north, t.w_east_mps = s.wind_mps.east;
    t.roll_rad = f.fence_bank_ratio * p.airframe->limits.roll_max_rad;
    t.reaction_s = f.fence_reaction;
    const WayBack way = way_back(polygon_, t, places_[0], f.fence_margin + f.fence_clear);
    now_.fence_margin_m = way.room_m;
    // Where the course to home is about behind, the short way is soon the other one.
    now_.turn = way.room_m > f.fence_margin + f.fence_clear ? SafetyTurn::either
                : way.side > 0                              ? SafetyTurn::right
                                                            : SafetyTurn::left;
  }
  if (s.height_valid) {
    above_floor_ = above_floor_ || s.height_m > floor_m_ + f.fence_margin;
    const double floor = above_floor_ && !p.landing ? floor_m_ : -not_given;
    now_.height_margin_m = room_of_height(s.height_m, s.velocity_valid ? s.climb_rate_mps : 0, floor,
                                          ceiling_m_, f.fence_pull, f.fence_reaction);
  }
  if (!known && !s.height_valid) return;
  // Height turns sooner than the track: a part of the margin will do, and no wind carries it out.
  const double height = now_.height_margin_m, level = now_.fence_margin_m;
  const bool bad = level < f.fence_margin || height < 0;
  const bool good = level > f.fence_margin + f.fence_clear && height > 0.2 * f.fence_clear;
  if (alarms_.attitude.raised()) return;  // its velocity is not that of a turn back
  alarms_.fence.step(bad, good, 0, 2, dt);
}

inline void Monitor::sensors(const Tick&, const Inputs& in, const Params& p, double dt) {
  const VehicleState& s = *in.state;
  const auto gone = [](const SensorHealth& h) {
    return h.state == SensorState::silent || h.state == SensorState::stuck || h.state == SensorState::refused;
  };
  const bool healthy = !in.health || in.health.stale() || !gone(in.health->gnss_position);
  position_heard_ = position_heard_ || s.position_valid;
  alarms_.gnss.step(position_heard_ && !(s.position_valid && healthy), p.gnss.gnss_raise, p.gnss.gnss_clear,
                    dt);
  now_.waiting_s = alarms_.gnss.raised() && now_.airborne ? now_.waiting_s + dt : 0;

  const bool tube = !in.health || in.health.stale() || in.health->pitot.state == SensorState::ok ||
                    in.health->pitot.state == SensorState::noisy;
  const bool measured = s.airspeed_valid && tube;
  airspeed_heard_ = airspeed_heard_ || (measured && now_.airborne);
  alarms_.pitot.step(airspeed_heard_ && !measured, p.pitot.pitot_raise, p.pitot.pitot_clear, dt);

  const bool valid = s.attitude_valid && s.height_valid && (s.velocity_valid || alarms_.gnss.raised());
  alarms_.estimator.step(now_.airborne && !valid, p.estimator.estimator_raise, p.estimator.estimator_clear,
                         dt);
  const AttitudeLimits& a = p.attitude;
  const double roll = std::abs(s.roll_rad), pitch = std::abs(s.pitch_rad);
  if (s.attitude_valid)
    alarms_.attitude.step(roll > a.roll_limit || pitch > a.pitch_limit,
                          roll < 0.67 * a.roll_limit && pitch < 0.67 * a.pitch_limit, a.attitude_raise,
                          a.attitude_clear, dt);
}

inline void Monitor::radio_and_link(const Tick& tick, const Inputs& in, const Params& p, double dt) {
  const RadioDelays& r = p.radio;
  double age = not_given;
  if (in.rc && in.rc->link) age = 1e-9 * static_cast<double>(tick.now_ns - in.rc.valid_at_ns());
  if (in.status) age = std::min(age, in.status->rc_age_s);
  const bool there = age < r.radio_timeout;
  radio_heard_ = radio_heard_ || there;
  alarms_.radio.step((radio_heard_ || r.radio_required) && !there, there, r.radio_raise, r.radio_clear, dt);

  const double silent = in.status ? 1e-9 * static_cast<double>(tick.now_ns - in.status.valid_at_ns()) : 0;
  alarms_.link.step(silent > p.link.link_timeout, 0, p.link.link_clear, dt);
}

inline void Monitor::battery(const Inputs& in, const Params& p, double dt) {
  const BatteryLimits& b = p.battery;
  if (!in.status) return;
  const double full = p.airframe->propulsion.battery_volt;
  const double volt = in.status->battery_volt > there_volt || alarms_.low.raised()
                          ? in.status->battery_volt / std::max(full, there_volt)
                          : 1;
  const double charge = in.status->battery_frac;
  const auto below = [&](double share, double of_volt) { return charge < share || volt < of_volt; };
  const auto watch = [&](Alarm& a, double share, double of_volt) {
    a.step(below(share, of_volt), !below(share + 0.1, of_volt + 0.1), b.battery_raise, b.battery_clear, dt);
  };
  watch(alarms_.low, b.battery_low, b.volt_low);
  watch(alarms_.empty, b.battery_empty, b.volt_empty);
}

/// Force along the flight path from the rate of energy, m (g hdot / Va + Vdot), plus drag, over the thrust
/// that the model has for this throttle. Lambregts (1983) has the rate, Beard & McLain, chapter 4, thrust and
/// drag.
inline void Monitor::motor(const Inputs& in, const Params& p, double dt) {
  const EngineLimits& e = p.engine;
  const VehicleState& s = *in.state;
  if (!in.actuators || !s.attitude_valid || !s.velocity_valid) return;
  const Airframe& a = *p.airframe;
  const Vec3<Ned> v = s.wind_valid ? s.velocity_mps - s.wind_mps : s.velocity_mps;
  const double through_air = std::sqrt(v.north * v.north + v.east * v.east + v.down * v.down);
  const double Va = s.airspeed_valid ? s.airspeed_mps
                    : s.wind_valid   ? through_air
                                     : a.limits.airspeed_cruise_mps;
  if (Va < 0.7 * a.limits.airspeed_min_mps) return;  // stalled, or rolling: the polar says nothing
  const double rho = standard_air(s.origin_altitude_m + s.height_m).density_kgm3, mg = a.mass_kg * isa::g0;
  const double drag = turn_trim(a, s.roll_rad, Va, rho).drag_newton;
  const double found = mg * s.climb_rate_mps / Va + a.mass_kg * airspeed_rate(s) + drag;
  const double full = a.propulsion.battery_volt;
  const double volt = in.status && in.status->battery_volt > there_volt && full > 0
                          ? std::min(in.status->battery_volt / full, 1.0)
                          : 1;  // the throttle is a share of what the battery has
  const double expected = thrust_of(a, volt * std::clamp(in.actuators->throttle_frac, 0.0, 1.0), Va, rho);
  const double share = 1 - std::exp(-dt / e.engine_smoothing);
  thrust_found_ += share * (found - thrust_found_);
  thrust_expected_ += share * (expected - thrust_expected_);
  const bool demanded = std::min(thrust_expected_, expected) > e.engine_thrust * mg;
  now_.thrust_ratio = demanded ? thrust_found_ / thrust_expected_ : 1;
  // Brakes as a stopped propeller does: counts whole. No thrust: by half. Sinking air does that for a while.
  constexpr double sure_ratio = 0.5;
  const double weight =
      alarms_.engine.raised() ? 1 : std::clamp((e.engine_share - now_.thrust_ratio) / sure_ratio, 0.0, 1.0);
  const bool missing = thrust_expected_ - thrust_found_ > e.engine_missing * mg;
  alarms_.engine.step(demanded && missing && now_.thrust_ratio < e.engine_share,
                      demanded && now_.thrust_ratio > 2 * std::max<double>(e.engine_share, 0.1),
                      e.engine_raise, e.engine_clear, weight * dt);
}

inline void Monitor::wind(const VehicleState& s, const Params& p, double dt) {
  const WindLimits& w = p.wind;
  if (s.wind_valid) {
    const double share = wind_known_ ? 1 - std::exp(-dt / w.wind_smoothing) : 1;
    wind_ = wind_ + share * (s.wind_mps - wind_);
    wind_known_ = true;
    now_.wind_ratio = std::hypot(wind_.north, wind_.east) / p.airframe->limits.airspeed_cruise_mps;
  }
  const bool known = s.wind_valid && now_.airborne;
  alarms_.wind.step(known && now_.wind_ratio > w.wind_limit, known && now_.wind_ratio < 0.9 * w.wind_limit,
                    w.wind_raise, w.wind_clear, dt);
}

inline SafetyAnswer Monitor::answer(const Params& p, double dt) {
  if (!now_.airborne) return SafetyAnswer::none;
  if (now_.engine_failed || now_.battery_empty) return SafetyAnswer::glide;
  if (now_.attitude_excessive || now_.estimator_failed) return SafetyAnswer::level;
  if (now_.gnss_lost)
    return now_.waiting_s > p.gnss.wait_time || now_.battery_low ? SafetyAnswer::descend : SafetyAnswer::wait;
  kept_fence_ = p.fencing.keep_fence && (kept_fence_ || now_.fence);
  const bool returns = now_.radio_lost || now_.link_lost || now_.fence || kept_fence_;
  now_.returning_s = returns ? now_.returning_s + dt : 0;
  if (now_.battery_low || now_.pitot_lost || now_.wind_excessive) return SafetyAnswer::land;
  if (!returns) return p.asked;
  return now_.returning_s > p.radio.land_after ? SafetyAnswer::land : SafetyAnswer::home;
}

/// One line for each cause that came or went.
inline void Monitor::tell(const Tick& tick, Outputs& out) {
  static constexpr std::array<const char*, 7> words{
      "go on",           "wings level",     "glide",      "descend in a circle",
      "circle and wait", "return and land", "return home"};
  const auto say = [&](bool SafetyState::*flag, const char* raised, const char* cleared,
                       const char* format = "", double value = 0) {
    if (now_.*flag == told_.*flag) return;
    Notice notice;
    notice.severity = now_.*flag ? Severity::warning : Severity::info;
    char why[40] = "", text[96];
    if (now_.*flag && *format) std::snprintf(why, sizeof why, format, value);
    std::snprintf(text, sizeof text, "%s%s%s%s", now_.*flag ? raised : cleared, why,
                  now_.airborne ? ": " : "",
                  now_.airborne ? words[static_cast<std::size_t>(now_.answer)] : "");
    notice.text = text;
    out.notices.push(notice, tick.now_ns);
  };
  using S = SafetyState;
  say(&S::engine_failed, "the motor gives no thrust", "the motor gives thrust again",
      ", %.2f of what it should", now_.thrust_ratio);
  say(&S::battery_empty, "the battery is empty", "the battery is not empty any more");
  say(&S::attitude_excessive, "the attitude is excessive", "the attitude is in order again");
  say(&S::estimator_failed, "the estimate is not valid", "the estimate is valid again");
  say(&S::gnss_lost, "no position", "the position is back");
  say(&S::battery_low, "the battery is low", "the battery is not low any more");
  say(&S::pitot_lost, "no airspeed", "the airspeed is back");
  say(&S::wind_excessive, "the wind is too strong", "the wind has dropped", ", %.2f of the cruise speed",
      now_.wind_ratio);
  say(&S::radio_lost, "the radio is lost", "the radio is back");
  say(&S::link_lost, "the vehicle's status does not come", "the vehicle's status comes again");
  say(&S::fence, "the fence is near", "well inside the fence again", ", %.0f m",
      std::min(now_.fence_margin_m, now_.height_margin_m));
  told_ = now_;
}

}  // namespace fulmar::safety
