// SPDX-License-Identifier: BSD-3-Clause
// Detects failures with thresholds and delays, and gives one answer. The README has the table.
#pragma once
#include "battery.hpp"
#include "fence.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "gate.hpp"
#include "limits.hpp"
#include "motor.hpp"
#include "reckoned.hpp"
#include "words.hpp"

namespace fulmar::safety {

struct Monitor {
  static constexpr const char* doc =
      "Failures of geofence, receiver, pitot, radio, link, battery, attitude, motor, wind and estimate; the "
      "answer to them; the reasons against a take-off.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleStatus> status;     // without it battery and link are not monitored
    Optional<NavigationHealth> health;  // without it, the validity flags of the state
    Optional<Rc> rc;                    // without it, the radio flag of the status
    Optional<Actuators> actuators;      // its throttle; without it the motor is not monitored
    Optional<GroundState> ground;       // air or ground; without it, status and speed
  };
  struct Outputs {
    SafetyState safety;
    OutQueue<Notice, 12> notices;
  };
  struct Params {
    Record<Airframe> airframe{"airframe with thrust, drag and limits", required};
    Record<Origin> origin{"origin of the local frame, for lat and lon"};
    Record<Fence> fence{"geofence with corners, floor and ceiling; without it no check"};
    Record<Places> places{"landing places, home first; without it the origin"};
    Choice<SafetyAnswer> asked{SafetyAnswer::none,
                               "answer on request without a failure: home, land or wait, for a pilot"};
    Flag landing{false, "switch for a landing: the floor of the geofence does not count"};

    Param airborne_raise{1.5, "s", 0, 60, "time off the ground that counts as flight: longer than a bounce"};

    FenceLimits fencing;
    GnssDelays gnss;
    PitotDelays pitot;
    RadioDelays radio;
    LinkDelays link;
    BatteryLimits battery;
    AttitudeLimits attitude;
    EngineLimits engine;
    WindLimits wind;
    GateLimits gate;
    EstimatorDelays estimator;
  };

  void configure(const Params& p);
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  bool is_airborne(const Inputs& in, const Params& p) const;
  void take_off(bool airborne, const Params& p, double dt);
  void fence(const VehicleState& s, const Params& p, double dt);
  void sensors(const Tick& tick, const Inputs& in, const Params& p, double dt);
  void radio_and_link(const Tick& tick, const Inputs& in, const Params& p, double dt);
  void battery(const Inputs& in, const Params& p, double dt);
  void motor(const Inputs& in, const Params& p, double dt);
  void wind(const VehicleState& s, const Params& p, double dt);
  bool leaves_by_drift(const VehicleState& s, const Params& p) const;
  void gate(const Inputs& in, const Params& p, double dt);
  SafetyAnswer answer(const VehicleState& s, const Params& p, double dt);
  SafetyAnswer wanted(const VehicleState& s, const Params& p, double dt);
  void flags();
  Reports::Facts facts(const Inputs& in, const Params& p) const;
  static bool gone(const SensorHealth& h) {
    return h.state == SensorState::silent || h.state == SensorState::stuck || h.state == SensorState::refused;
  }
  bool obeyed(const Inputs& in) const { return !in.status || (in.status->in_control && !now_.link_lost); }
  struct Alarms {
    Alarm fence, gnss, pitot, radio, link, attitude, wind, drifting, estimator;
  };
  Polygon polygon_;
  double floor_m_ = -not_given, ceiling_m_ = not_given;
  std::vector<Spot> places_;
  Alarms alarms_;
  Battery battery_;
  Motor motor_;
  RunUp run_up_;
  GroundWind ground_wind_;
  Reckoned reckoned_;
  Reports reports_;
  SafetyState now_;
  bool above_floor_ = false;  ///< the aircraft has been above it: before that it takes off
  bool kept_fence_ = false;
  bool radio_heard_ = false, airspeed_heard_ = false, position_heard_ = false;
  bool radio_there_ = false, drift_ends_wait_ = false;
  double aloft_s_ = 0;
  Vec3<Ned> wind_;
  bool wind_known_ = false;
};

inline void Monitor::configure(const Params& p) {
  polygon_ = {};
  places_ = p.places.is_given ? places_of(*p.places, *p.origin) : std::vector<Spot>{};
  if (p.places.is_given && places_.empty())
    throw std::runtime_error(located("places.places", safety_messages::places_missing()).line());
  if (places_.empty()) places_.push_back({});
  if (p.fence.is_given) {
    polygon_.set(*p.fence, *p.origin);
    floor_m_ = now_.floor_m = p.fence->floor_m;
    ceiling_m_ = now_.ceiling_m = p.fence->ceiling_m;
    const double room = polygon_.room_m(places_[0].north_m, places_[0].east_m);
    const auto north = std::lround(places_[0].north_m), east = std::lround(places_[0].east_m);
    if (room < 0)
      throw std::runtime_error(
          located("fence.corners", safety_messages::home_outside_fence(north, east)).line());
    if (room < p.fencing.fence_margin)
      throw std::runtime_error(
          located("fence.corners",
                  safety_messages::home_near_fence(north, east, Fixed{room, 1}, p.fencing.fence_margin.value))
              .line());
  }
  refuse_crossed(p.battery);
}

inline bool Monitor::is_airborne(const Inputs& in, const Params& p) const {
  const double carries = 0.5 * p.airframe->limits.airspeed_min_mps;
  const VehicleState& s = *in.state;
  if (in.ground) {
    if (in.ground->landed || in.ground->contact == Contact::ground) return false;
    return in.ground->contact == Contact::air || now_.airborne;
  }
  if (!in.status) return s.height_m > 3 && s.ground_speed_mps > carries;
  if (!in.status->armed || in.status->on_ground) return false;
  if (!s.velocity_valid && !s.airspeed_valid) return now_.airborne;
  return (s.velocity_valid && s.ground_speed_mps > carries) || (s.airspeed_valid && s.airspeed_mps > carries);
}

/// A short lift of a wheel is no flight. Each flight clears the alarms.
inline void Monitor::take_off(bool airborne, const Params& p, double dt) {
  aloft_s_ = airborne ? aloft_s_ + dt : 0;
  const bool before = now_.airborne;
  now_.airborne = airborne && (before || aloft_s_ > p.airborne_raise);
  if (!now_.airborne || before) return;
  above_floor_ = kept_fence_ = false;
  alarms_.fence.reset();
  alarms_.attitude.reset();
  alarms_.pitot.reset();
  alarms_.wind.reset();
  motor_.reset();
  now_.waiting_s = now_.returning_s = 0;
}

inline Status Monitor::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
  const VehicleState& s = *in.state;
  take_off(is_airborne(in, p), p, dt);
  radio_and_link(tick, in, p, dt);
  wind(s, p, dt);
  sensors(tick, in, p, dt);
  battery(in, p, dt);
  fence(s, p, dt);
  motor(in, p, dt);
  flags();
  gate(in, p, dt);
  now_.answer = answer(s, p, dt);
  out.safety = now_;
  reports_.step(now_, facts(in, p), tick, dt, out.notices);
  return Status::ok;
}

inline Reports::Facts Monitor::facts(const Inputs& in, const Params& p) const {
  const VehicleState& s = *in.state;
  Reports::Facts f;
  f.battery_ratio = in.status ? in.status->battery_frac : 1;
  f.wind_mps = now_.wind_ratio * p.airframe->limits.airspeed_cruise_mps;
  f.ground_wind_mps = ground_wind_.mps();
  f.roll_rad = s.roll_rad;
  f.pitch_rad = s.pitch_rad;
  f.room_m = polygon_.given() ? polygon_.room_m(s.position_m.north, s.position_m.east) : not_given;
  f.below_ceiling_m = ceiling_m_ - s.height_m;
  f.above_floor_m = s.height_m - floor_m_;
  f.tail_wind = run_up_.tail_wind();
  f.aloft = aloft_s_ > 0;
  f.by_side = now_.fence_margin_m < p.fencing.fence_margin;
  f.landing = p.landing;
  f.drift_ends_wait = drift_ends_wait_;
  f.kept_fence = kept_fence_;
  return f;
}

inline void Monitor::flags() {
  now_.fence = alarms_.fence.raised();
  now_.gnss_lost = alarms_.gnss.raised();
  now_.pitot_lost = alarms_.pitot.raised();
  now_.radio_lost = alarms_.radio.raised();
  now_.link_lost = alarms_.link.raised();
  now_.battery_low = battery_.low();
  now_.battery_empty = battery_.empty();
  now_.attitude_excessive = alarms_.attitude.raised();
  now_.engine_failed = motor_.failed();
  now_.engine_weak = motor_.weak();
  now_.thrust_ratio = motor_.ratio();
  now_.wind_excessive = alarms_.wind.raised();
  now_.drifting = alarms_.drifting.raised();
  now_.estimator_failed = alarms_.estimator.raised();
}

inline void Monitor::fence(const VehicleState& s, const Params& p, double dt) {
  const FenceLimits& f = p.fencing;
  now_.fence_margin_m = now_.height_margin_m = not_given;
  now_.turn = SafetyTurn::either;
  if (!polygon_.given()) return;
  const bool known = s.position_valid && s.velocity_valid;
  if (!now_.airborne) {
    if (s.position_valid) now_.fence_margin_m = polygon_.room_m(s.position_m.north, s.position_m.east);
    if (s.height_valid) now_.height_margin_m = ceiling_m_ - s.height_m;
    return;
  }
  if (known) {
    TurnBack t;
    t.north_m = s.position_m.north;
    t.east_m = s.position_m.east;
    t.v_north_mps = s.velocity_mps.north;
    t.v_east_mps = s.velocity_mps.east;
    if (s.wind_valid) {
      t.w_north_mps = s.wind_mps.north;
      t.w_east_mps = s.wind_mps.east;
    }
    t.roll_rad = f.fence_bank_ratio * p.airframe->limits.roll_max_rad;
    t.reaction_s = f.fence_reaction;
    const WayBack way = way_back(polygon_, t, places_[0], f.fence_margin + f.fence_clear);
    now_.fence_margin_m = way.room_m;
    // When the course to home is nearly behind, the short side of the turn may change at any time.
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
  // A change of height is quicker than a turn: a part of the margin is enough, and wind has no effect.
  const double height = now_.height_margin_m, level = now_.fence_margin_m;
  const bool bad = level < f.fence_margin || height < 0;
  const bool good = level > f.fence_margin + f.fence_clear && height > 0.2 * f.fence_clear;
  if (alarms_.attitude.raised()) return;  // its velocity is invalid for a turn back
  alarms_.fence.step(bad, good, 0, 2, dt);
}

inline void Monitor::sensors(const Tick&, const Inputs& in, const Params& p, double dt) {
  const VehicleState& s = *in.state;
  const bool healthy = !in.health || in.health.stale() || !gone(in.health->gnss_position);
  position_heard_ = position_heard_ || s.position_valid;
  alarms_.gnss.step(position_heard_ && !(s.position_valid && healthy), p.gnss.gnss_raise, p.gnss.gnss_clear,
                    dt);
  now_.waiting_s = alarms_.gnss.raised() && now_.airborne ? now_.waiting_s + dt : 0;
  reckoned_.step(s, wind_, p.gnss.reckon_std, dt);

  const bool tube = !in.health || in.health.stale() || in.health->pitot.state == SensorState::ok ||
                    in.health->pitot.state == SensorState::noisy;
  const bool measured = s.airspeed_valid && tube;
  // A pitot that measured on the ground counts as present, even if it was blocked before the take-off.
  const bool fitted = in.health && in.health->pitot.state != SensorState::never;
  airspeed_heard_ = airspeed_heard_ || ((measured || fitted) && now_.airborne);
  if (now_.airborne)
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
  radio_there_ = age < r.radio_timeout;
  radio_heard_ = radio_heard_ || radio_there_;
  alarms_.radio.step((radio_heard_ || r.radio_required) && !radio_there_, radio_there_, r.radio_raise,
                     r.radio_clear, dt);

  const double silent = in.status ? 1e-9 * static_cast<double>(tick.now_ns - in.status.valid_at_ns()) : 0;
  alarms_.link.step(silent > p.link.link_timeout, 0, p.link.link_clear, dt);
}

inline void Monitor::battery(const Inputs& in, const Params& p, double dt) {
  if (in.status) battery_.step(*in.status, p.airframe->propulsion.battery_volt, p.battery, dt);
}

/// While commands did not move the aircraft, its motion is no evidence about the motor.
inline void Monitor::motor(const Inputs& in, const Params& p, double dt) {
  const VehicleState& s = *in.state;
  if (!obeyed(in)) return motor_.reset();
  if (!now_.airborne || !in.actuators || !s.attitude_valid || !s.velocity_valid) return;
  const double volt = in.status ? volt_share(in.status->battery_volt, *p.airframe) : 1;
  motor_.step(s, *p.airframe, volt * std::clamp(in.actuators->throttle_frac, 0.0, 1.0), volt, p.engine, dt);
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
  const double most = p.airframe->limits.airspeed_max_mps / p.airframe->limits.airspeed_cruise_mps;
  alarms_.drifting.step(known && now_.wind_ratio > 0.95 * most, known && now_.wind_ratio < 0.9 * most,
                        w.wind_raise, w.wind_clear, dt);
  if (!now_.airborne) ground_wind_.step(s, w.wind_smoothing, dt);
}

inline bool Monitor::leaves_by_drift(const VehicleState& s, const Params& p) const {
  if (!polygon_.given() || !reckoned_.known() || !s.height_valid) return false;
  const Airframe& a = *p.airframe;
  constexpr double bank_rad = 0.26, sure = 2;
  const double rho = standard_air(s.origin_altitude_m + s.height_m).density_kgm3;
  const double sink = std::max(sink_rate(a, 1.2 * a.limits.airspeed_min_mps, bank_rad, rho), 0.5);
  const double down_s = std::max(s.height_m - places_[0].up_m, 0.0) / sink;
  const double drift_s = reckoned_.drifts() ? down_s : 0;
  const double room =
      polygon_.room_m(reckoned_.north_m() + wind_.north * drift_s, reckoned_.east_m() + wind_.east * drift_s);
  return room - sure * reckoned_.std_m() < p.fencing.fence_margin;
}

inline void Monitor::gate(const Inputs& in, const Params& p, double dt) {
  const VehicleState& s = *in.state;
  const bool fresh = in.health && !in.health.stale();
  const double throttle = in.actuators ? in.actuators->throttle_frac : 0;
  const bool run = in.status && in.status->armed && obeyed(in) && !now_.airborne && s.velocity_valid;
  const double max_wind = p.gate.take_off_wind * p.airframe->limits.airspeed_cruise_mps;
  const bool windy = ground_wind_.mps() > (now_.not_ready.wind ? 0.8 : 1.0) * max_wind;
  run_up_.step(run, throttle, forward_speed(s), windy, p.gate.motor_test, dt);
  NotReady& n = now_.not_ready;
  n = {};
  now_.ready = false;
  if (now_.airborne) return;
  const double margin = p.fencing.fence_margin;
  n.estimator = !s.attitude_valid || !s.height_valid || !s.velocity_valid;
  n.position = !s.position_valid || (fresh && gone(in.health->gnss_position));
  n.pitot = fresh && in.health->pitot.state >= SensorState::stuck;  // not `refused`: a tail wind causes it
  n.radio = p.radio.radio_required || radio_heard_ ? !radio_there_ : false;
  n.battery = now_.battery_low || now_.battery_empty;
  n.wind = windy || run_up_.tail_wind();
  n.fence = now_.fence_margin_m < margin;
  n.height = now_.height_margin_m < margin;
  n.motor = run_up_.failed();
  now_.ready = !any(n);
}

/// Near the ground a landing is finished, even without a position, and in the flare without a motor.
inline SafetyAnswer Monitor::answer(const VehicleState& s, const Params& p, double dt) {
  const SafetyAnswer before = now_.answer, now = wanted(s, p, dt);
  const bool lands =
      before == SafetyAnswer::none || before == SafetyAnswer::land || before == SafetyAnswer::home;
  if (!now_.airborne || !p.landing || !s.height_valid || !lands) return now;
  const double height = s.height_m - places_[0].up_m, committed = p.gnss.committed_height;
  const bool circles = now == SafetyAnswer::wait || now == SafetyAnswer::descend;
  const bool flares = now == SafetyAnswer::glide && height < committed / 3;
  return (circles && height < committed) || flares ? before : now;
}

inline SafetyAnswer Monitor::wanted(const VehicleState& s, const Params& p, double dt) {
  if (!now_.airborne || !now_.gnss_lost) drift_ends_wait_ = false;
  if (!now_.airborne) return SafetyAnswer::none;
  if (now_.engine_failed || now_.battery_empty) return SafetyAnswer::glide;
  if (now_.attitude_excessive || now_.estimator_failed) return SafetyAnswer::level;
  if (now_.gnss_lost) {
    const bool over = now_.waiting_s > p.gnss.wait_time || now_.battery_low;
    drift_ends_wait_ = drift_ends_wait_ || (!over && leaves_by_drift(s, p));
    return over || drift_ends_wait_ ? SafetyAnswer::descend : SafetyAnswer::wait;
  }
  kept_fence_ = p.fencing.keep_fence && (kept_fence_ || now_.fence);
  const bool returns = now_.radio_lost || now_.link_lost || now_.fence || kept_fence_;
  now_.returning_s = returns ? now_.returning_s + dt : 0;
  if (now_.battery_low || now_.pitot_lost || now_.wind_excessive || now_.engine_weak)
    return SafetyAnswer::land;
  if (!returns) return p.asked;
  return now_.returning_s > p.radio.land_after ? SafetyAnswer::land : SafetyAnswer::home;
}

}  // namespace fulmar::safety
