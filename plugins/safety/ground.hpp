// SPDX-License-Identifier: BSD-3-Clause
// Ground contact, standing, rolling or flying, estimated from the navigation state and the throttle, which
// every vehicle has. A flight controller has no contact switch, so that of a simulated aircraft is not read
// either.
#pragma once
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/landing_progress.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/takeoff_request.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "messages.hpp"
#include "touch_down.hpp"

namespace fulmar::safety {

/// True after a condition has held for a time.
class HeldFor {
 public:
  bool step(bool holds, double for_s, double dt) {
    held_s_ = holds ? held_s_ + dt : 0;
    return holds && held_s_ >= for_s;
  }

 private:
  double held_s_ = 0;
};

struct Ground {
  static constexpr const char* doc =
      "Lift-off and touch-down by acceleration, climb rate, height and speed; throttle lock after a landing.";
  struct Inputs {
    In<VehicleState> state;
    Optional<VehicleStatus> status;     // armed, and the source of commands; without it armed and no pilot
    Optional<Actuators> actuators;      // its throttle; without it an open one
    Optional<LandingProgress> landing;  // height above a runway; without it the height of the take-off
    Request<TakeoffRequest> takeoff;    // opens the throttle after a landing
  };
  struct Outputs {
    GroundState state;
    OutQueue<Notice, 4> notices;
  };
  struct Params {
    Record<Airframe> airframe{"airframe with airspeeds", required};
    TouchParams touch;
    Param touch_height{15, "m", 1, 1000,
                       "height band around the place of the take-off or the runway for a touch-down with "
                       "power; no limit with closed throttle"};
    Param lift_height{1.5, "m", 0.2, 50, "height above the place of the start that counts as flight"};
    Param slow{0.6, "ratio", 0.1, 1, "share of the minimum airspeed below which flight is impossible"};
    Param landed_after{0.5, "s", 0, 60, "duration of slow rolling before the throttle is locked"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    const VehicleState& s = *in.state;
    now_.since_s += dt;
    read(tick, in, p);
    release(in);
    if (!s.attitude_valid || !s.height_valid) {
      now_.touch_evidence_ratio = 0;
      touch_.reset();
    } else if (now_.contact == Contact::air) {
      fly(s, in, p, dt);
    } else {
      stand(s, p, dt);
    }
    lock(p, dt);
    out.state = now_;
    report(tick, out);
    return Status::ok;
  }

 private:
  /// Evaluates whether it moves fast enough to fly, as far as that is measured.
  void read(const Tick& tick, const Inputs& in, const Params& p) {
    const VehicleState& s = *in.state;
    const double least = p.airframe->limits.airspeed_min_mps;
    armed_ = !in.status || in.status->armed;
    if (s.reset_count != resets_) height_m_ -= s.reset_position_m.down;
    resets_ = s.reset_count;
    // In wind an aircraft on the ground has airspeed, and one in the air may have no ground speed.
    speed_ratio_ = (s.airspeed_valid ? s.airspeed_mps : s.ground_speed_mps) / least;
    moves_ = !s.velocity_valid || s.ground_speed_mps > moving_mps || std::abs(s.climb_rate_mps) > moving_mps;
    slow_ = speed_ratio_ < p.slow && (!s.velocity_valid || s.ground_speed_mps < p.slow * least);
    // In a strong wind the pitot of a standing aircraft measures the wind.
    still_ = s.velocity_valid && s.ground_speed_mps < still_mps && std::abs(s.climb_rate_mps) < still_mps;
    // The last progress of a landing that is no longer active stays on its port.
    approaches_ = in.landing && tick.now_ns - in.landing.valid_at_ns() < current_ns;
  }

  /// A hand-over by the pilot, arming, or a request opens the throttle again.
  void release(const Inputs& in) {
    const bool pilot = in.status && in.status->override;
    const bool handed_over = armed_ && had_pilot_ && !pilot;
    const bool arms = armed_ && !was_armed_;
    had_pilot_ = pilot;
    was_armed_ = armed_;
    bool asked = false;
    for (auto request : in.takeoff) {
      if (now_.contact == Contact::air) {
        request.refuse(safety_messages::aircraft_flies.c_str());
        continue;
      }
      request.accept();
      asked = true;
    }
    if (handed_over || arms || asked) now_.landed = now_.throttle_locked = false;
  }

  /// Transition into the air, from the ground or from an unknown contact at the start.
  void stand(const VehicleState& s, const Params& p, double dt) {
    now_.touch_evidence_ratio = 0;
    const bool rests = (slow_ && std::abs(s.climb_rate_mps) < 1) || still_;
    if (now_.contact == Contact::unknown && stands_.step(rests, 1.0, dt)) set(Contact::ground);
    if (now_.contact == Contact::ground) follow_ground(s, dt);
    const bool high = placed_ && s.height_m - height_m_ > p.lift_height;
    const bool rises = high && speed_ratio_ > p.slow && moves_;
    // Once it has stood, speed alone means a roll. At the start of a host it may already fly.
    const bool fast = now_.contact == Contact::unknown && speed_ratio_ > 0.85 && moves_;
    const bool climbs = s.velocity_valid && s.climb_rate_mps > steep_mps(s) && speed_ratio_ > 0.8;
    const bool risen = rises_.step(rises, 0.2, dt), climbed = climbs_.step(climbs, 0.5, dt);
    const bool fell = falls(s, dt);
    const bool flies = fast_.step(fast, 0.5, dt) || risen || climbed || fell;
    if (!armed_ || !flies) return;
    set(Contact::air);
    if (fell) {
      --now_.touch_downs;
      height_m_ = last_m_;
      released_at_ = std::min(released_at_, now_.touch_downs);
    } else {
      ++now_.lift_offs;
    }
    now_.landed = false;
    touch_.reset();
  }

  /// Under a rolling aircraft the height of the ground changes by its slope, under a standing one by the
  /// drift of the estimate.
  void follow_ground(const VehicleState& s, double dt) {
    const double off = s.height_m - height_m_, most = steepest_ground * s.ground_speed_mps * dt;
    if (!placed_)
      height_m_ = s.height_m;
    else
      height_m_ += slow_ ? std::min(dt / 0.5, 1.0) * off : std::clamp(off, -most, most);
    placed_ = true;
  }
  /// Climb rate beyond that of a roll along a slope of the ground.
  static double steep_mps(const VehicleState& s) { return 0.4 + steepest_ground * s.ground_speed_mps; }

  void fly(const VehicleState& s, const Inputs& in, const Params& p, double dt) {
    const double place = placed_ ? std::abs(s.height_m - height_m_) : unknown_m;
    const double runway = approaches_ ? std::abs(in.landing->height_m) : unknown_m;
    const double off = std::min({place, runway, unknown_m});
    const bool sinks = approaches_ && (in.landing->stage == LandingStage::flare ||
                                       (in.landing->stage == LandingStage::approach && off < short_final_m));
    const bool closed = closed_.step(in.actuators && in.actuators->throttle_frac < 0.03, 1.0, dt);
    now_.touch_evidence_ratio = touch_.step(s, {off, speed_ratio_ < 1.1, sinks, closed}, p.touch, dt);
    // Far from any known ground a gliding aircraft may still touch down.
    const bool touches = now_.touch_evidence_ratio >= 1 && (closed || off < p.touch_height);
    // An aircraft that neither moves nor climbs for a second is on the ground in any case. Without airspeed a
    // slow ground speed may be a flight against the wind.
    const bool slow = slow_ && (s.airspeed_valid || still_) && std::abs(s.climb_rate_mps) < 0.5;
    const bool rests = stands_.step(slow, s.airspeed_valid ? 1.0 : 3.0, dt);
    if (!touches && !rests) return;
    now_.touch_sink_mps = touch_.sink_mps();
    ++now_.touch_downs;
    set(Contact::ground);
    last_m_ = placed_ ? height_m_ : s.height_m;
    height_m_ = s.height_m;
    placed_ = true;
  }
  /// After a false touch-down or a bounce it sinks faster than a roll along a slope of the ground.
  bool falls(const VehicleState& s, double dt) {
    constexpr double soon_s = 4;
    const bool soon = now_.since_s < soon_s;
    const double steep = soon ? steep_mps(s) : 2 * steep_mps(s);
    const bool down = now_.touch_downs > 0 && -s.climb_rate_mps > steep && !slow_;
    return falls_.step(down, soon ? 0.15 : 0.5, dt);
  }

  void set(Contact contact) {
    now_.contact = contact;
    now_.since_s = 0;
    rises_ = climbs_ = fast_ = falls_ = stands_ = locks_ = {};
  }

  void lock(const Params& p, double dt) {
    const bool rolled =
        now_.contact == Contact::ground && now_.touch_downs > 0 && (slow_ || still_) && !released();
    if (!locks_.step(rolled, p.landed_after, dt)) return;
    now_.landed = now_.throttle_locked = true;
    released_at_ = now_.touch_downs;
  }
  /// One landing locks once: after a hand-over the aircraft is slow as well.
  bool released() const { return released_at_ == now_.touch_downs; }

  void report(const Tick& tick, Outputs& out) {
    const auto say = [&](const MessageText<0>& text) {
      Notice notice;
      notice.text = text.c_str();
      out.notices.push(notice, tick.now_ns);
    };
    if (now_.lift_offs != reported_.lift_offs) say(safety_messages::lift_off);
    if (now_.touch_downs > reported_.touch_downs) say(safety_messages::touch_down);
    if (now_.touch_downs < reported_.touch_downs) say(safety_messages::still_in_air);
    if (now_.throttle_locked && !reported_.throttle_locked) say(safety_messages::throttle_locked);
    reported_ = now_;
  }

  static constexpr double moving_mps = 3, still_mps = 1, short_final_m = 8, unknown_m = 100;
  static constexpr std::int64_t current_ns = 500'000'000;
  GroundState now_, reported_;
  TouchDown touch_;
  HeldFor rises_, climbs_, fast_, falls_, stands_, closed_, locks_;
  std::uint32_t resets_ = 0;       ///< last counter of resets of the state
  std::uint32_t released_at_ = 0;  ///< the touch-down that has already locked
  double height_m_ = 0;            ///< last height on the ground
  double last_m_ = 0;              ///< the same before the last touch-down
  double speed_ratio_ = 0;         ///< speed over least airspeed
  bool placed_ = false, armed_ = false, was_armed_ = false, had_pilot_ = false, moves_ = false, slow_ = false;
  bool still_ = false, approaches_ = false;
};

}  // namespace fulmar::safety
