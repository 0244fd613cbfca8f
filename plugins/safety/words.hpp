// SPDX-License-Identifier: BSD-3-Clause
// One line for each begin and end of a cause: fault, action of the aircraft, and action for the pilot.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fulmar/flight/control/alarms.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "fulmar/plugin.hpp"
#include "gate.hpp"
#include "messages.hpp"

namespace fulmar::safety {

class Reports {
 public:
  using Queue = OutQueue<Notice, 12>;
  using Line = std::array<char, 97>;
  struct Facts {
    double battery_ratio = 1, wind_mps = 0, ground_wind_mps = 0, roll_rad = 0, pitch_rad = 0;
    double room_m = 0;                              ///< to the nearest side of the fence, now
    double below_ceiling_m = 0, above_floor_m = 0;  ///< now
    bool tail_wind = false;                         ///< detected in a take-off run
    bool aloft = false;                             ///< off the ground, for any duration
    bool by_side = false;  ///< the turn back comes too near to a side, not to floor or ceiling
    bool landing = false, drift_ends_wait = false, kept_fence = false;
  };

  void step(const SafetyState& now, const Facts& facts, const Tick& tick, double dt, Queue& out) {
    now_ = &now;
    tick_ = &tick;
    out_ = &out;
    said_ = false;
    lands_ = facts.landing;
    faults(facts);
    place(facts);
    changes(facts);
    before_take_off(facts, dt);
    reported_ = now;
  }

 private:
  static constexpr std::array<const MessageText<0>*, 7> does{
      &safety_messages::goes_on,  &safety_messages::levels, &safety_messages::glides,
      &safety_messages::descends, &safety_messages::waits,  &safety_messages::lands,
      &safety_messages::returns};

  const char* answer() const {
    if (lands_ && now_->answer == SafetyAnswer::none) return safety_messages::finishes.c_str();
    return does[static_cast<std::size_t>(now_->answer)]->c_str();
  }

  void push(const char* text, Severity severity, Cause cause = Cause::none) {
    Notice notice;
    notice.text = text;
    notice.severity = severity;
    notice.cause = cause;
    out_->push(notice, tick_->now_ns);
    said_ = true;
  }
  template <std::size_t N, class... Values>
  static Line line(const MessageText<N>& text, const Values&... values) {
    Line made{};
    text.write(made.data(), made.size(), values...);
    return made;
  }

  void say(bool SafetyState::*flag, const Line& wrong, const MessageText<0>& right, const char* pilot) {
    const bool raised = now_->*flag;
    if (raised == reported_.*flag) return;
    const Cause cause = alarm(flag).cause;
    const char* const what = raised ? wrong.data() : right.c_str();
    if (!now_->airborne) return push(what, raised ? Severity::warning : Severity::info, cause);
    if (raised)
      return push(line(safety_messages::alarm, what, answer(), pilot).data(), Severity::warning, cause);
    const bool free = now_->answer == SafetyAnswer::none;
    push(line(free ? safety_messages::cleared : safety_messages::cleared_still, what, answer()).data(),
         Severity::info, cause);
  }
  /// The text of an alarm.
  void say(bool SafetyState::*flag, const MessageText<0>& right, const char* pilot) {
    say(flag, line(*alarm(flag).message), right, pilot);
  }
  /// The text of an alarm, with a figure.
  template <std::size_t N, class... Figures>
  void say(bool SafetyState::*flag, const MessageText<0>& right, const char* pilot,
           const MessageText<N>& with, const Figures&... figures) {
    say(flag, line(with, alarm(flag).words(), figures...), right, pilot);
  }

  void faults(const Facts& f) {
    using S = SafetyState;
    constexpr double deg = std::numbers::pi / 180;
    const int charge = static_cast<int>(std::lround(100 * std::clamp(f.battery_ratio, 0.0, 1.0)));
    const int thrust = static_cast<int>(std::lround(100 * std::clamp(now_->thrust_ratio, 0.0, 1.0)));
    using namespace safety_messages;
    say(&S::engine_failed, motor_back, "land ahead");
    if (!now_->engine_failed) say(&S::engine_weak, thrust_back, "no go-around", thrust_left, thrust);
    say(&S::battery_empty, battery_charged, "land now", charge_left, charge);
    say(&S::attitude_excessive, attitude_back, "take over", tilted, Fixed{std::abs(f.roll_rad) / deg, 0},
        Fixed{std::abs(f.pitch_rad) / deg, 0});
    say(&S::estimator_failed, estimate_back, "take over");
    say(&S::gnss_lost, position_back, "take over by sight");
    say(&S::battery_low, battery_high, "clear the runway", charge_left, charge);
    say(&S::pitot_lost, airspeed_back, "fly fast");
    say(&S::wind_excessive, wind_back, "keep the field clear", wind_at, Fixed{f.wind_mps, 0});
    say(&S::radio_lost, radio_back, "check the transmitter");
    say(&S::link_lost, link_back, "check the link");
    if (now_->drifting != reported_.drifting)
      push((now_->drifting ? line(drifts, Fixed{f.wind_mps, 0}) : line(drift_ended)).data(),
           now_->drifting ? Severity::warning : Severity::info, Cause::drifting);
  }

  /// Distances without a sign.
  static Line side(double room_m) {
    return line(room_m < 0 ? safety_messages::outside_fence : safety_messages::near_fence,
                Fixed{std::abs(room_m), 0});
  }
  static Line ceiling(double below_m) {
    return line(below_m < 0 ? safety_messages::above_ceiling : safety_messages::near_ceiling,
                Fixed{std::abs(below_m), 0});
  }
  static Line floor(double above_m) {
    return line(above_m < 0 ? safety_messages::below_floor : safety_messages::near_floor,
                Fixed{std::abs(above_m), 0});
  }
  static Line where(const Facts& f) {
    if (f.by_side) return side(f.room_m);
    return f.below_ceiling_m < f.above_floor_m ? ceiling(f.below_ceiling_m) : floor(f.above_floor_m);
  }

  void place(const Facts& f) {
    const MessageText<0>& right =
        f.kept_fence ? safety_messages::inside_fence_returning : safety_messages::inside_fence;
    say(&SafetyState::fence, where(f), right, "keep inside");
  }

  /// Reports answers that change with time alone.
  void changes(const Facts& f) {
    if (said_ || !now_->airborne || !reported_.airborne || now_->answer == reported_.answer) return;
    if (now_->answer == SafetyAnswer::descend)
      push(line(f.drift_ends_wait ? safety_messages::descends_near_fence
                                  : safety_messages::descends_without_position,
                Fixed{now_->waiting_s, 0}, answer())
               .data(),
           Severity::warning);
    else if (now_->answer == SafetyAnswer::land)
      push(line(safety_messages::lands_after_return, Fixed{now_->returning_s, 0}).data(), Severity::warning);
  }

  /// The list of missing items, when it has been the same for a while; before a flight it is reported once.
  void before_take_off(const Facts& f, double dt) {
    constexpr double settled_s = 2, apart_s = 5;
    flew_ = flew_ || now_->airborne;
    since_s_ += dt;
    if (flew_ || f.aloft) return;
    const std::uint32_t bits = mask(now_->not_ready);
    same_s_ = bits == bits_ ? same_s_ + dt : 0;
    bits_ = bits;
    if (same_s_ < settled_s || since_s_ < apart_s || bits == listed_) return;
    if (bits != 0)
      push(line(safety_messages::not_ready, missing(f).data()).data(), Severity::warning);
    else
      push(safety_messages::ready.c_str(), Severity::info);
    listed_ = bits;
    since_s_ = 0;
  }

  static std::uint32_t mask(const NotReady& n) {
    std::uint32_t bits = 0;
    for (const bool b :
         {n.motor, n.fence, n.height, n.wind, n.pitot, n.battery, n.radio, n.position, n.estimator})
      bits = 2 * bits + (b ? 1U : 0U);
    return bits;
  }

  Line missing(const Facts& f) const {
    const NotReady& n = now_->not_ready;
    Line list{};
    std::size_t used = 0;
    const auto put = [&](const char* words) {
      for (; *words != 0 && used + 1 < list.size(); ++words) list[used++] = *words;
    };
    const auto add = [&](bool is, const Line& what) {
      if (!is) return;
      if (used > 0) put(", ");
      put(what.data());
    };
    using namespace safety_messages;
    add(n.motor, line(flight_messages::engine_failed));
    add(n.fence, side(f.room_m));
    add(n.height, ceiling(f.below_ceiling_m));
    add(n.wind, f.tail_wind ? line(tail_wind) : line(wind_strong, Fixed{f.ground_wind_mps, 0}));
    add(n.pitot, line(pitot_missing));
    add(n.battery, line(battery_missing));
    add(n.radio, line(radio_missing));
    add(n.position, line(position_missing));
    add(n.estimator, line(estimate_missing));
    return list;
  }

  const SafetyState* now_ = nullptr;
  const Tick* tick_ = nullptr;
  Queue* out_ = nullptr;
  SafetyState reported_;
  std::uint32_t bits_ = 0, listed_ = 0;
  double same_s_ = 0, since_s_ = 1e9;
  bool said_ = false, flew_ = false, lands_ = false;
};

}  // namespace fulmar::safety
